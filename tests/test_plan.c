/* What each scene needs, and no more: the exact features and passes of a table of scenes, and why the rest is
 * left out. */
#include "support/scenes.h"
#include "support/variants.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define POLY2     MNS_KERNEL_POLY2
#define POLY3     MNS_KERNEL_POLY3
#define CUBIC     ((unsigned)MNS_SOLVER_CUBIC << 3)
#define MONOMIAL  ((unsigned)MNS_SOLVER_CUBIC_MONOMIAL << 3)
#define CORE      FEATURE_CORE
#define RADII     FEATURE_RADII
#define STRENGTHS FEATURE_STRENGTHS
#define QUADS     FEATURE_QUADS
#define POINTS    FEATURE_POINTS
#define SPECULAR  FEATURE_SPECULAR
#define IN_BALL   FEATURE_EYE_IN_BALL
#define LEAST     (QUADS | SPECULAR)                                       /* of a driver with 4.3's minima */
#define SOFTWARE  (POINTS | FEATURE_CLIP_ZERO | FEATURE_TEXELS | SPECULAR) /* of llvmpipe */

#define PLAIN_PASSES "sort upload gather cast resolve shade"
#define TREE_PASSES  "build upload trace resolve shade"
#define CORE_PASSES  "sort upload core_depth gather cast resolve shade"
#define TILE_PASSES  "sort bin upload cast resolve shade"
#define TILES        (FEATURE_TILES | SPECULAR)
#define TILE_METHOD  .options = {.method = MNS_METHOD_TILE}
#define TRUE_METHOD  .options = {.method = MNS_METHOD_REFERENCE}
#define LIT_PASSES   "trace effects shade"
#define LIT          (POLY3 | FEATURE_REFERENCE | FEATURE_LIT)
#define LIT_BY_RAYS  (FEATURE_LIT | FEATURE_RAYS)
#define FROM_A_SIDE  .light = MNS_LIGHT_DIRECTIONAL
#define MATERIALS    FEATURE_MATERIALS

#define BLEND_HEAT(low, high) .blend.by = "heat", .blend.range = {low, high}

static const mns_mesh floor_mesh = {.file = "floor.obj"};
static const mns_light point_light = {.kind = MNS_LIGHT_POINT, .position = {1, 2, 3}},
                       area_light = {.kind = MNS_LIGHT_AREA, .position = {1, 2, 3}, .radius = 0.5},
                       dim_light = {.kind = MNS_LIGHT_HEAD, .strength = 0.5},
                       two_lights[2] = {{.kind = MNS_LIGHT_HEAD}, {.kind = MNS_LIGHT_DIRECTIONAL}},
                       plain_light = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {0, 1, 0}, .strength = 1};

static const scene scenes[] = {
    {"defaults, the least driver", .desc = {SCENE_UNIT}, .features = POLY3 | CORE | LEAST,
     .passes = CORE_PASSES, .left_out = "points for small balls: this driver's points are too small"},
    {"least driver, what it cannot read", .desc = {SCENE_UNIT}, .features = POLY3 | CORE | LEAST,
     .passes = CORE_PASSES, .left_out = "reading by texels: this driver's buffer textures are too small"},
    {"llvmpipe", .desc = {SCENE_UNIT}, .limits = &scene_llvmpipe, .features = POLY3 | CORE | SOFTWARE | QUADS,
     .passes = CORE_PASSES, .left_out = "a radius a ball: all are equal"},
    {"a small frame: points alone", .desc = {SCENE_UNIT}, .limits = &scene_llvmpipe,
     .view = {.width = 64, .height = 48}, .features = POLY3 | CORE | SOFTWARE, .passes = CORE_PASSES,
     .left_out = "rectangles for large balls: every ball fits a point"},
    {"many small balls: points alone", .generator = "scattered:1000", .limits = &scene_llvmpipe,
     .features = POLY3 | CORE | SOFTWARE, .passes = CORE_PASSES},
    {"so many that cores are flat", .generator = "scattered:20000", .limits = &scene_llvmpipe,
     .features = POLY3 | CORE | FEATURE_FLAT_CORES | FEATURE_FAR | SOFTWARE, .passes = CORE_PASSES},
    {"one fewer: cores are spheres", .generator = "scattered:19999", .limits = &scene_llvmpipe,
     .features = POLY3 | CORE | FEATURE_FAR | SOFTWARE, .passes = CORE_PASSES},
    {"mixed sizes", .generator = "mixed:1000", .limits = &scene_llvmpipe,
     .features = POLY3 | RADII | CORE | SOFTWARE | QUADS, .passes = CORE_PASSES},
    {"poly2", .desc = {SCENE_UNIT, .kernel = POLY2}, .features = POLY2 | CORE | LEAST, .passes = CORE_PASSES},
    {"poly4, cubic", .desc = {SCENE_UNIT, .kernel = MNS_KERNEL_POLY4},
     .options = {.solver = MNS_SOLVER_CUBIC}, .features = MNS_KERNEL_POLY4 | CUBIC | CORE | LEAST,
     .passes = CORE_PASSES, .left_out = "certification: the solver is a model of the field"},
    {"wyvill, cubic-monomial", .desc = {SCENE_UNIT, .kernel = MNS_KERNEL_WYVILL},
     .options = {.solver = MNS_SOLVER_CUBIC_MONOMIAL},
     .features = MNS_KERNEL_WYVILL | MONOMIAL | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "certification: the solver is a model of the field"},
    {"perlin", .desc = {SCENE_UNIT, .kernel = MNS_KERNEL_PERLIN},
     .features = MNS_KERNEL_PERLIN | CORE | LEAST, .passes = CORE_PASSES},
    {"wendland", .desc = {SCENE_UNIT, .kernel = MNS_KERNEL_WENDLAND},
     .features = MNS_KERNEL_WENDLAND | CORE | LEAST, .passes = CORE_PASSES},
    {"radii", .desc = {SCENE_ROW, .radius = {.data = scene_sizes}}, .features = POLY3 | RADII | CORE | LEAST,
     .passes = CORE_PASSES, .left_out = "a strength a ball: all are 1"},
    {"radii, but all equal", .desc = {SCENE_ROW, .radius = {.data = scene_equal}},
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES, .left_out = "a radius a ball: all are equal"},
    {"strengths: a core radius each", .desc = {SCENE_UNIT, .strength = {.data = scene_gains}},
     .features = POLY3 | STRENGTHS | CORE | FEATURE_CORE_RADII | LEAST, .passes = CORE_PASSES},
    {"strengths, but all 1", .desc = {SCENE_UNIT, .strength = {.data = scene_equal}},
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES, .left_out = "a strength a ball: all are 1"},
    {"radii and strengths",
     .desc = {SCENE_ROW, .radius = {.data = scene_sizes}, .strength = {.data = scene_gains}},
     .features = POLY3 | RADII | STRENGTHS | CORE | FEATURE_CORE_RADII | LEAST, .passes = CORE_PASSES},
    {"a negative strength", .desc = {SCENE_UNIT, .strength = {.data = scene_carving}},
     .features = POLY3 | STRENGTHS | LEAST, .passes = PLAIN_PASSES,
     .left_out = "core depth: a negative strength could carve a core"},
    {"strengths that alone never reach L", .desc = {SCENE_UNIT, .strength = {.data = scene_weak}},
     .features = POLY3 | STRENGTHS | LEAST, .passes = PLAIN_PASSES,
     .left_out = "core depth: no ball alone reaches L"},
    {"L at the kernel's peak", .desc = {SCENE_UNIT, .iso = 1}, .features = POLY3 | LEAST,
     .passes = PLAIN_PASSES, .left_out = "core depth: no ball alone reaches L"},
    {"L just below it", .desc = {SCENE_UNIT, .iso = 0.999}, .features = POLY3 | CORE | LEAST,
     .passes = CORE_PASSES},
    {"the eye in a ball, outside the surface", .desc = {SCENE_UNIT}, SCENE_EYE(0, 0, 0.9),
     .features = POLY3 | IN_BALL | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "the way out of the surface: f(eye) < L"},
    {"the eye in the box, outside every ball", .desc = {SCENE_UNIT}, SCENE_EYE(0.5, 0.95, 0.95),
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "rays that start inside a ball: the eye is outside every effective sphere"},
    {"the eye inside the surface", .desc = {SCENE_UNIT}, SCENE_EYE(0, 0, 0.1),
     .features = POLY3 | IN_BALL | FEATURE_EYE_INSIDE | LEAST, .passes = PLAIN_PASSES,
     .left_out = "core depth: f(eye) >= L: the way out may lie behind a core"},
    {"the eye at 30 radii", .desc = {SCENE_UNIT}, SCENE_EYE(0, 0, 31), .features = POLY3 | CORE | LEAST,
     .passes = CORE_PASSES,
     .left_out = "rays that begin at the box: the eye is within 30 radii of the field's box"},
    {"the eye beyond 30 radii", .desc = {SCENE_UNIT}, SCENE_EYE(0, 0, 31.01),
     .features = POLY3 | FEATURE_FAR | CORE | LEAST, .passes = CORE_PASSES},
    {"30 of the largest radii", .desc = {SCENE_ROW, .radius = {.data = scene_sizes}}, SCENE_EYE(0, 0, 46),
     .features = POLY3 | RADII | CORE | LEAST, .passes = CORE_PASSES},
    {"a pool that buffer textures hold", .desc = {SCENE_UNIT}, .options = {.max_pool_nodes = 65536},
     .features = POLY3 | CORE | LEAST | FEATURE_TEXELS, .passes = CORE_PASSES},
    {"a pool one node larger", .desc = {SCENE_UNIT}, .options = {.max_pool_nodes = 65537},
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES},
    {"coloured by numbers", .desc = {SCENE_UNIT}, .look = {.color_by = "heat"},
     .features = POLY3 | CORE | LEAST | FEATURE_COLORS, .passes = CORE_PASSES},
    {"coloured by labels", .generator = "molecule:50", .look = {.color_by = "element"},
     .limits = &scene_llvmpipe,
     .features = POLY3 | RADII | CORE | SOFTWARE | QUADS | FEATURE_COLORS | FEATURE_LABELS,
     .passes = CORE_PASSES},
    {"columns that nobody asks for", .generator = "molecule:50", .limits = &scene_llvmpipe,
     .features = POLY3 | RADII | CORE | SOFTWARE | QUADS, .passes = CORE_PASSES,
     .left_out = "colours of balls: one colour for all"},
    {"a tree, the least driver", .desc = {SCENE_UNIT}, .options = {.method = MNS_METHOD_FBVH},
     .features = POLY3 | FEATURE_TREE | FEATURE_TEXELS | SPECULAR, .passes = TREE_PASSES,
     .left_out = "gather: rays are traced through a tree"},
    {"a tree of overlapping leaves, llvmpipe", .generator = "mixed:1000", .limits = &scene_llvmpipe,
     .options = {.method = MNS_METHOD_BVH},
     .features = POLY3 | RADII | FEATURE_TREE | FEATURE_OVERLAPS | FEATURE_TEXELS | SPECULAR,
     .passes = TREE_PASSES, .left_out = "counts of a ray's work: nobody asks for them"},
    {"a tree that buffer textures do not hold", .generator = "scattered:10000",
     .options = {.method = MNS_METHOD_FBVH}, .features = POLY3 | FEATURE_TREE | FEATURE_FAR | SPECULAR,
     .passes = TREE_PASSES, .left_out = "reading by texels: this driver's buffer textures are too small"},
    {"a tree, secants, counted", .desc = {SCENE_UNIT}, SCENE_EYE(0, 0, 0.1),
     .options = {.method = MNS_METHOD_FBVH, .solver = MNS_SOLVER_SECANT, .counters = true},
     .features = POLY3 | (unsigned)MNS_SOLVER_SECANT << 3 | IN_BALL | FEATURE_EYE_INSIDE | FEATURE_TREE |
                 FEATURE_TEXELS | FEATURE_COUNTERS | SPECULAR,
     .passes = TREE_PASSES, .left_out = "certification: the solver is not certified"},
    {"tiles, the least driver", .desc = {SCENE_UNIT}, TILE_METHOD, .features = POLY3 | CORE | TILES,
     .passes = TILE_PASSES, .left_out = "reading by texels: this driver's buffer textures are too small"},
    {"tiles, llvmpipe", .generator = "scattered:20000", .limits = &scene_llvmpipe, TILE_METHOD,
     .features = POLY3 | CORE | FEATURE_FAR | FEATURE_TEXELS | TILES | FEATURE_SQUARES, .passes = TILE_PASSES,
     .left_out = "gather: tiles are binned on the CPU"},
    {"tiles, large balls too", .desc = {SCENE_UNIT}, SCENE_EYE(0, 0, 0.9), .limits = &scene_llvmpipe,
     TILE_METHOD, .features = POLY3 | CORE | IN_BALL | FEATURE_TEXELS | TILES | FEATURE_SQUARES,
     .passes = TILE_PASSES, .left_out = "billboards: tiles are binned on the CPU"},
    {"tiles, a core radius each", .desc = {SCENE_UNIT, .strength = {.data = scene_gains}}, TILE_METHOD,
     .features = POLY3 | STRENGTHS | CORE | FEATURE_CORE_RADII | TILES, .passes = TILE_PASSES,
     .left_out = "core depth as a pass: cores close the tiles' masks"},
    {"tiles, a negative strength", .desc = {SCENE_UNIT, .strength = {.data = scene_carving}}, TILE_METHOD,
     .features = POLY3 | STRENGTHS | TILES, .passes = TILE_PASSES,
     .left_out = "core depth: a negative strength could carve a core"},
    {"tiles, the eye inside the surface", .desc = {SCENE_UNIT}, SCENE_EYE(0, 0, 0.1), TILE_METHOD,
     .features = POLY3 | IN_BALL | FEATURE_EYE_INSIDE | TILES, .passes = TILE_PASSES,
     .left_out = "core depth: f(eye) >= L: the way out may lie behind a core"},
    {"tiles, no balls", TILE_METHOD, .features = POLY3 | TILES, .passes = TILE_PASSES,
     .left_out = "core depth: there are no balls"},
    {"tiles on a host, cubic, coloured, sampled", .desc = {SCENE_ROW, .radius = {.data = scene_sizes}},
     .look = {.color_by = "heat"}, .host = true,
     .options = {.method = MNS_METHOD_TILE, .solver = MNS_SOLVER_CUBIC, .samples = 4},
     .features = POLY3 | CUBIC | RADII | CORE | FEATURE_HOST | FEATURE_COLORS | FEATURE_SAMPLES | TILES,
     .passes = "sort bin upload cast resolve shade host_draw",
     .left_out = "certification: the solver is a model of the field"},
    {"cel", .desc = {SCENE_UNIT}, .look = {.shading = MNS_SHADING_CEL},
     .features = POLY3 | CORE | LEAST | FEATURE_CEL, .passes = CORE_PASSES},
    {"a directional light", .desc = {SCENE_UNIT}, .look = {.light = MNS_LIGHT_DIRECTIONAL},
     .features = POLY3 | CORE | LEAST | FEATURE_DIRECTIONAL, .passes = CORE_PASSES},
    {"no specular", .desc = {SCENE_UNIT}, .look = {.set = MNS_LOOK_SPECULAR},
     .features = POLY3 | CORE | QUADS, .passes = CORE_PASSES, .left_out = "specular: its strength is 0"},
    {"samples", .desc = {SCENE_UNIT}, .options = {.samples = 4},
     .features = POLY3 | CORE | LEAST | FEATURE_SAMPLES, .passes = CORE_PASSES},
    {"one sample", .desc = {SCENE_UNIT}, .options = {.samples = 1}, .features = POLY3 | CORE | LEAST,
     .passes = CORE_PASSES, .left_out = "samples beside the centre: one sample a pixel"},
    {"the paper's gather", .desc = {SCENE_UNIT}, .options = {.gather = MNS_GATHER_PAPER},
     .features = POLY3 | CORE | LEAST | FEATURE_PAPER, .passes = CORE_PASSES},
    {"shuffled lists", .desc = {SCENE_UNIT}, .options = {.shuffle = 1},
     .features = POLY3 | CORE | LEAST | FEATURE_SHUFFLE,
     .passes = "sort upload core_depth gather shuffle cast resolve shade"},
    {"the reference", .desc = {SCENE_ROW, .radius = {.data = scene_sizes}, .strength = {.data = scene_gains}},
     SCENE_EYE(0, 0, 99), .limits = &scene_llvmpipe,
     .options = {.method = MNS_METHOD_REFERENCE, .gather = MNS_GATHER_PAPER, .shuffle = 3},
     .features = POLY3 | SPECULAR | FEATURE_REFERENCE, .passes = "trace shade",
     .left_out = "gather: the reference is traced on the CPU"},
    {"the reference, coloured and sampled", .generator = "molecule:50",
     .look = {.color_by = "element", .shading = MNS_SHADING_CEL},
     .options = {.method = MNS_METHOD_REFERENCE, .samples = 2},
     .features = POLY3 | SPECULAR | FEATURE_REFERENCE | FEATURE_SAMPLES | FEATURE_COLORS | FEATURE_LABELS |
                 FEATURE_CEL,
     .passes = "trace shade"},
    {"one light in a list, as plain as the look's", .desc = {SCENE_UNIT},
     .look = {.lights = &plain_light, .light_count = 1},
     .features = POLY3 | CORE | LEAST | FEATURE_DIRECTIONAL, .passes = CORE_PASSES,
     .left_out = "several lights: one light, white, of strength 1"},
    {"shadows of a light at the eye", .desc = {SCENE_UNIT}, .look = {.effects = {.shadows = true}},
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "shadows: a light at the eye casts none"},
    {"a mirror that mirrors nothing", .desc = {SCENE_UNIT},
     .look = {.set = MNS_LOOK_MIRROR, .effects = {.reflections = 3}}, .features = POLY3 | CORE | LEAST,
     .passes = CORE_PASSES, .left_out = "mirroring: nothing is mirrored"},
    {"an index of 1", .desc = {SCENE_UNIT}, .look = {.effects = {.index = 1}},
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "Fresnel's share: no index of refraction above 1"},
    {"glass that lets nothing through", .desc = {SCENE_UNIT},
     .look = {.set = MNS_LOOK_TRANSMISSION, .effects = {.refractions = 4, .absorption = {1, 1, 1}}},
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "refraction: nothing goes through the surface"},
    {"occlusion of no ambient light", .desc = {SCENE_UNIT},
     .look = {.set = MNS_LOOK_AMBIENT, .effects = {.occlusion_rays = 8}}, .features = POLY3 | CORE | LEAST,
     .passes = CORE_PASSES, .left_out = "occlusion: the ambient light's strength is 0"},
    {"shadows of light that does nothing", .desc = {SCENE_UNIT},
     .look = {FROM_A_SIDE, .set = MNS_LOOK_DIFFUSE | MNS_LOOK_SPECULAR, .effects = {.shadows = true}},
     .features = POLY3 | CORE | QUADS | FEATURE_DIRECTIONAL, .passes = CORE_PASSES,
     .left_out = "shadows: no light's share of the picture is above 0"},
    {"shadows", .desc = {SCENE_UNIT}, TRUE_METHOD, .look = {FROM_A_SIDE, .effects = {.shadows = true}},
     .features = LIT | SPECULAR | FEATURE_DIRECTIONAL | FEATURE_SHADOWS, .passes = LIT_PASSES,
     .left_out = "soft shadows: no light is a sphere"},
    {"a point light, without shadows", .desc = {SCENE_UNIT}, TRUE_METHOD,
     .look = {.lights = &point_light, .light_count = 1}, .features = LIT | SPECULAR | FEATURE_POINT_LIGHTS,
     .passes = LIT_PASSES, .left_out = "a light of its own: every light is at the eye or at a point"},
    {"soft shadows", .desc = {SCENE_UNIT}, TRUE_METHOD,
     .look = {.lights = &area_light, .light_count = 1, .effects = {.shadows = true}},
     .features = LIT | SPECULAR | FEATURE_POINT_LIGHTS | FEATURE_SHADOWS | FEATURE_SOFT_SHADOWS,
     .passes = LIT_PASSES, .left_out = "occlusion: nobody asks for them"},
    {"two lights", .desc = {SCENE_UNIT}, TRUE_METHOD, .look = {.lights = two_lights, .light_count = 2},
     .features = LIT | SPECULAR | FEATURE_LIGHTS | FEATURE_DIRECTIONAL, .passes = LIT_PASSES},
    {"a dim light", .desc = {SCENE_UNIT}, TRUE_METHOD, .look = {.lights = &dim_light, .light_count = 1},
     .features = LIT | SPECULAR | FEATURE_LIGHTS, .passes = LIT_PASSES,
     .left_out = "shadows: nobody asks for them"},
    {"a mirror, and no shadow code", .desc = {SCENE_UNIT}, TRUE_METHOD,
     .look = {.effects = {.reflections = 3}}, .features = LIT | SPECULAR | FEATURE_MIRROR,
     .passes = LIT_PASSES, .left_out = "shadows: nobody asks for them"},
    {"Fresnel and the sky", .desc = {SCENE_UNIT}, TRUE_METHOD,
     .look = {.effects = {.index = 1.3, .environment = "sky"}},
     .features = LIT | SPECULAR | FEATURE_MIRROR | FEATURE_FRESNEL | FEATURE_SKY, .passes = LIT_PASSES,
     .left_out = "an environment's map: the sky is built in"},
    {"a map", .desc = {SCENE_UNIT}, TRUE_METHOD, .look = {.effects = {.environment = "map.exr"}},
     .features = LIT | SPECULAR | FEATURE_ENVIRONMENT, .passes = LIT_PASSES,
     .left_out = "a built-in sky: the environment is a map"},
    {"occlusion", .desc = {SCENE_UNIT}, TRUE_METHOD, .look = {.effects = {.occlusion_rays = 8}},
     .features = LIT | SPECULAR | FEATURE_OCCLUSION, .passes = LIT_PASSES},
    {"refraction without an index, and what it absorbs", .desc = {SCENE_UNIT}, TRUE_METHOD,
     .look = {.effects = {.refractions = 2, .absorption = {0, 0, 2}, .occlusion_rays = 8}},
     .features = LIT | SPECULAR | FEATURE_REFRACTION | FEATURE_ABSORPTION, .passes = LIT_PASSES,
     .left_out = "occlusion: nothing is shaded: all is mirrored or goes through"},
    {"a preset", .desc = {SCENE_UNIT}, TRUE_METHOD, .look = {.preset = "glass"},
     .features = LIT | SPECULAR | FEATURE_DIRECTIONAL | FEATURE_MIRROR | FEATURE_FRESNEL |
                 FEATURE_REFRACTION | FEATURE_SKY,
     .passes = LIT_PASSES, .left_out = "absorption: its strength is 0"},
    {"shadows, the first hits by lists", .desc = {SCENE_UNIT}, .limits = &scene_llvmpipe,
     .look = {FROM_A_SIDE, .effects = {.shadows = true}},
     .features = POLY3 | CORE | SOFTWARE | QUADS | FEATURE_DIRECTIONAL | FEATURE_SHADOWS | LIT_BY_RAYS,
     .passes = "sort build upload core_depth gather cast resolve effects shade",
     .left_out = "mirroring: nothing is mirrored"},
    {"occlusion, the first hits by tiles", .desc = {SCENE_UNIT}, TILE_METHOD,
     .look = {.effects = {.occlusion_rays = 8}},
     .features = POLY3 | CORE | TILES | FEATURE_OCCLUSION | LIT_BY_RAYS,
     .passes = "sort bin build upload cast resolve effects shade"},
    {"a mesh, seen and no more", .desc = {SCENE_UNIT}, .look = {.meshes = &floor_mesh, .mesh_count = 1},
     .features = POLY3 | CORE | LEAST | FEATURE_SOLIDS | FEATURE_LIT,
     .passes = "sort upload core_depth gather cast resolve solids effects shade",
     .left_out = "FBVH: no secondary rays are asked for"},
    {"a mesh that all the mirror shows casts shadows on", .desc = {SCENE_UNIT}, .limits = &scene_llvmpipe,
     .options = {.method = MNS_METHOD_FBVH},
     .look = {.meshes = &floor_mesh,
              .mesh_count = 1,
              FROM_A_SIDE,
              .set = MNS_LOOK_SPECULAR,
              .effects = {.shadows = true, .mirror = 1, .reflections = 1, .occlusion_rays = 4}},
     .features = POLY3 | FEATURE_TEXELS | FEATURE_TREE | FEATURE_DIRECTIONAL | FEATURE_SHADOWS |
                 FEATURE_MIRROR | FEATURE_OCCLUSION | FEATURE_SOLIDS | LIT_BY_RAYS,
     .passes = "build upload trace resolve solids effects shade"},
    {"no mesh", .desc = {SCENE_UNIT}, .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "meshes: nobody asks for them"},
    {"a second material that mirrors", .desc = {SCENE_UNIT}, TRUE_METHOD,
     .look = {BLEND_HEAT(4, 5), .blend.mirror = 0.5}, .features = LIT | SPECULAR | FEATURE_MIRROR | MATERIALS,
     .passes = LIT_PASSES, .left_out = "refraction: nothing goes through the surface"},
    {"a second material of another colour: no effect", .desc = {SCENE_UNIT},
     .look = {BLEND_HEAT(4, 5), .blend.color = {1, 0, 0}}, .features = POLY3 | CORE | LEAST | MATERIALS,
     .passes = CORE_PASSES, .left_out = "colours of balls: one colour for all"},
    {"a second material and a colour map, by a tree", .desc = {SCENE_UNIT}, .limits = &scene_llvmpipe,
     .options = {.method = MNS_METHOD_FBVH},
     .look = {BLEND_HEAT(4, 5), .blend.color = {1, 0, 0}, .color_by = "heat", .effects = {.reflections = 1}},
     .features = POLY3 | SPECULAR | FEATURE_TEXELS | FEATURE_TREE | FEATURE_COLORS | FEATURE_MIRROR |
                 MATERIALS | LIT_BY_RAYS,
     .passes = "build upload trace resolve effects shade"},
    {"a second material that lets through, and absorbs", .desc = {SCENE_UNIT}, TRUE_METHOD,
     .look = {BLEND_HEAT(4, 5), .set = MNS_LOOK_TRANSMISSION, .effects = {.refractions = 2},
              .blend.transmission = 0.5, .blend.absorption = {1, 0, 0}},
     .features = LIT | SPECULAR | FEATURE_REFRACTION | FEATURE_ABSORPTION | MATERIALS, .passes = LIT_PASSES},
    {"a second material of which no ball has any", .desc = {SCENE_UNIT},
     .look = {BLEND_HEAT(5, 6), .blend.mirror = 0.5}, .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "a second material: no ball has any of it"},
    {"a second material that is all balls'", .desc = {SCENE_UNIT},
     .look = {BLEND_HEAT(2, 3), .color_by = "heat", .blend.color = {1, 0, 0}, .blend.set = MNS_LOOK_MIRROR,
              .effects = {.mirror = 0.5}},
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "a second material: it is every ball's, and so the only one"},
    {"a second material as the first", .desc = {SCENE_UNIT},
     .look = {BLEND_HEAT(4, 5), .blend.transmission = 0.5, .blend.absorption = {1, 1, 1}},
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "a second material: it is seen nowhere, or as the first is"},
    {"one material", .desc = {SCENE_UNIT}, .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES,
     .left_out = "a second material: nobody asks for it"},
    {"mirrors, all by a tree", .desc = {SCENE_UNIT}, .limits = &scene_llvmpipe,
     .options = {.method = MNS_METHOD_FBVH}, .look = {.effects = {.reflections = 2}},
     .features = POLY3 | SPECULAR | FEATURE_TEXELS | FEATURE_TREE | FEATURE_MIRROR | LIT_BY_RAYS,
     .passes = "build upload trace resolve effects shade"},
    {"a mirror of the sky alone: no ray, and no tree", .desc = {SCENE_UNIT},
     .look = {.set = MNS_LOOK_MIRROR, .effects = {.mirror = 0.5, .environment = "sky"}},
     .features = POLY3 | CORE | LEAST | FEATURE_MIRROR | FEATURE_SKY | FEATURE_LIT,
     .passes = "sort upload core_depth gather cast resolve effects shade",
     .left_out = "FBVH: no secondary rays are asked for"},
    {"two lights, by a tree", .desc = {SCENE_UNIT}, .options = {.method = MNS_METHOD_BVH},
     .look = {.lights = two_lights, .light_count = 2},
     .features = POLY3 | SPECULAR | FEATURE_TEXELS | FEATURE_TREE | FEATURE_OVERLAPS | FEATURE_LIGHTS |
                 FEATURE_DIRECTIONAL | FEATURE_LIT,
     .passes = "build upload trace resolve effects shade",
     .left_out = "rays beyond the first: no secondary rays are asked for"},
    {"a preset, and by hand what it would change", .desc = {SCENE_UNIT},
     .look = {.preset = "glass",
              .set = MNS_LOOK_LIGHT | MNS_LOOK_REFLECTIONS | MNS_LOOK_REFRACTIONS | MNS_LOOK_INDEX |
                     MNS_LOOK_ENVIRONMENT},
     .features = POLY3 | CORE | LEAST, .passes = CORE_PASSES},
    {"no balls", .features = POLY3 | LEAST, .passes = PLAIN_PASSES,
     .left_out = "core depth: there are no balls"},
    {"one ball", .desc = {.count = 1, .position = {.data = scene_row}}, .limits = &scene_llvmpipe,
     .features = POLY3 | CORE | SOFTWARE | QUADS, .passes = CORE_PASSES},
    {"a host", .desc = {SCENE_UNIT}, .host = true, .features = POLY3 | CORE | LEAST | FEATURE_HOST,
     .passes = "sort upload host_depth core_depth gather cast resolve shade host_draw"},
    {"a host, no cores", .desc = {SCENE_UNIT, .iso = 2}, .host = true,
     .features = POLY3 | LEAST | FEATURE_HOST,
     .passes = "sort upload host_depth gather cast resolve shade host_draw"},
    {"much at once",
     .desc = {SCENE_ROW, .radius = {.data = scene_sizes}, .strength = {.data = scene_gains}, .kernel = POLY2},
     SCENE_EYE(0, 0, 99),
     .look = {.shading = MNS_SHADING_CEL, .light = MNS_LIGHT_DIRECTIONAL, .color_by = "heat"},
     .options = {.solver = MNS_SOLVER_CUBIC, .gather = MNS_GATHER_PAPER, .samples = 2, .shuffle = 5},
     .limits = &scene_llvmpipe, .host = true,
     .features = POLY2 | CUBIC | RADII | STRENGTHS | CORE | FEATURE_CORE_RADII | FEATURE_PAPER | FEATURE_FAR |
                 FEATURE_HOST | FEATURE_SHUFFLE | FEATURE_COLORS | FEATURE_CEL | FEATURE_DIRECTIONAL |
                 FEATURE_SAMPLES | SOFTWARE,
     .passes = "sort upload host_depth core_depth gather shuffle cast resolve shade host_draw"},
};

static void expect_passes(const scene *s, const mns_plan *plan)
{
    char passes[256] = "";
    size_t count, used = 0;
    const char *const *pass = mns_plan_passes(plan, &count);
    for (size_t i = 0; i < count; i++)
        used += (size_t)snprintf(passes + used, sizeof passes - used, "%s%s", i ? " " : "", pass[i]);
    if (strcmp(passes, s->passes) != 0) fail_msg("%s: passes %s; expected %s", s->name, passes, s->passes);
}

static bool is_left_out(const mns_plan *plan, const char *part)
{
    size_t count;
    const mns_left_out *left = mns_plan_left_out(plan, &count);
    for (size_t i = 0; i < count; i++)
        if (!strcmp(left[i].part, part)) return true;
    return false;
}

static void expect_reason(const scene *s, const mns_plan *plan)
{
    size_t count;
    const mns_left_out *left = mns_plan_left_out(plan, &count);
    for (size_t i = 0; i < count && s->left_out; i++) {
        char line[200];
        snprintf(line, sizeof line, "%s: %s", left[i].part, left[i].reason);
        if (!strcmp(line, s->left_out)) return;
    }
    if (s->left_out) fail_msg("%s: not said: %s", s->name, s->left_out);
}

static void each_scene_has_its_features_and_passes(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        const scene *s = &scenes[i];
        mns_field *field = scene_field(s);
        mns_plan *plan = scene_plan(s, field);
        uint64_t got = mns_plan_features(plan), more = got & ~s->features, less = s->features & ~got;
        if (more || less)
            fail_msg("%s: features 0x%llx too many, 0x%llx too few\n%s", s->name, (unsigned long long)more,
                     (unsigned long long)less, mns_plan_text(plan));
        assert_true(variant_possible(got)); /* what test_shaders takes for granted */
        expect_passes(s, plan);
        expect_reason(s, plan);
        mns_plan_destroy(plan);
        mns_field_destroy(field);
    }
}

/* A part is there or is left out with a reason, never both, never neither. */
static void what_is_not_there_is_left_out(void **state)
{
    (void)state;
    static const struct {
        uint64_t feature;
        const char *part;
    } parts[] = {
        {FEATURE_RADII, "a radius a ball"},
        {FEATURE_STRENGTHS, "a strength a ball"},
        {FEATURE_CORE, "core depth"},
        {FEATURE_POINTS, "points for small balls"},
        {FEATURE_QUADS, "rectangles for large balls"},
        {FEATURE_EYE_IN_BALL, "rays that start inside a ball"},
        {FEATURE_EYE_INSIDE, "the way out of the surface"},
        {FEATURE_FAR, "rays that begin at the box"},
        {FEATURE_HOST, "a host's depth"},
        {FEATURE_COLORS, "colours of balls"},
        {FEATURE_CEL, "cel bands"},
        {FEATURE_DIRECTIONAL, "a light of its own"},
        {FEATURE_SPECULAR, "specular"},
        {FEATURE_SAMPLES, "samples beside the centre"},
        {FEATURE_TEXELS, "reading by texels"},
        {FEATURE_LIGHTS, "several lights"},
        {FEATURE_POINT_LIGHTS, "lights at a point"},
        {FEATURE_SHADOWS, "shadows"},
        {FEATURE_SOFT_SHADOWS, "soft shadows"},
        {FEATURE_MIRROR, "mirroring"},
        {FEATURE_FRESNEL, "Fresnel's share"},
        {FEATURE_REFRACTION, "refraction"},
        {FEATURE_ABSORPTION, "absorption"},
        {FEATURE_OCCLUSION, "occlusion"},
        {FEATURE_ENVIRONMENT, "an environment's map"},
        {FEATURE_SKY, "a built-in sky"},
        {FEATURE_SOLIDS, "meshes"},
        {FEATURE_MATERIALS, "a second material"},
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        mns_field *field = scene_field(&scenes[i]);
        mns_plan *plan = scene_plan(&scenes[i], field);
        bool tiles = plan->features & FEATURE_TILES;
        for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
            if (tiles && parts[k].feature & (POINTS | QUADS)) /* both are billboards */
                assert_false(plan->features & parts[k].feature || is_left_out(plan, parts[k].part));
            else if (is_left_out(plan, parts[k].part) == !!(plan->features & parts[k].feature))
                fail_msg("%s: %s", scenes[i].name, parts[k].part);
        assert_true(is_left_out(plan, "certification") == !!(plan->features & FEATURE_SOLVER));
        assert_int_equal(is_left_out(plan, "billboards"), tiles);
        assert_int_equal(is_left_out(plan, "core depth as a pass"), tiles);
        assert_int_equal(is_left_out(plan, "pixels to be cast as squares"),
                         tiles && !(plan->features & FEATURE_SQUARES));
        assert_true(is_left_out(plan, "FBVH") == !(plan->features & (FEATURE_TREE | FEATURE_RAYS)));
        mns_plan_destroy(plan);
        mns_field_destroy(field);
    }
}

static void the_text_tells_all_of_the_plan(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        mns_field *field = scene_field(&scenes[i]);
        mns_plan *plan = scene_plan(&scenes[i], field);
        const char *text = mns_plan_text(plan);
        char line[256];
        size_t count;
        const mns_left_out *left = mns_plan_left_out(plan, &count);
        for (size_t k = 0; k < count; k++) {
            snprintf(line, sizeof line, "\n  %s: %s\n", left[k].part, left[k].reason);
            assert_non_null(strstr(text, line));
        }
        snprintf(line, sizeof line, "\npasses: %s\n", scenes[i].passes);
        assert_non_null(strstr(text, line));
        snprintf(line, sizeof line, "\nfeatures 0x%llx:", (unsigned long long)scenes[i].features);
        assert_non_null(strstr(text, line));
        snprintf(line, sizeof line, "kernel %s, L ", mns_kernel_name(field->kernel));
        assert_non_null(strstr(text, line));
        mns_plan_destroy(plan);
        mns_field_destroy(field);
    }
}

/* The names of a feature mask: those of the features that are there. */
static void the_text_names_the_features(void **state)
{
    (void)state;
    const scene *s = &scenes[sizeof scenes / sizeof *scenes - 1];
    mns_field *field = scene_field(s);
    mns_plan *plan = scene_plan(s, field);
    assert_non_null(strstr(mns_plan_text(plan),
                           ": radii strengths core core_radii paper points far host shuffle colors cel "
                           "directional specular samples clip_zero texels\n"));
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

static void the_text_names_the_method_tile(void **state)
{
    (void)state;
    scene s = {"tile", .desc = {SCENE_UNIT}, TILE_METHOD};
    mns_field *field = scene_field(&s);
    mns_plan *plan = scene_plan(&s, field);
    assert_non_null(strstr(mns_plan_text(plan), "method tile"));
    assert_non_null(strstr(mns_plan_text(plan), ": core specular tiles\n"));
    assert_true(plan->pool_most == (1u << 24) / (4 * sizeof(float)));
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

static void tiles_are_neither_gathered_nor_shuffled(void **state)
{
    (void)state;
    static const mns_options wrong[] = {{.method = MNS_METHOD_TILE, .gather = MNS_GATHER_PAPER},
                                        {.method = MNS_METHOD_TILE, .shuffle = 1},
                                        {.method = MNS_METHOD_TILE, .solver = MNS_SOLVER_SECANT},
                                        {.method = MNS_METHOD_TILE, .counters = true}};
    scene s = {"wrong", .desc = {SCENE_UNIT}};
    mns_field *field = scene_field(&s);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        mns_plan *plan = NULL;
        mns_error error;
        assert_int_equal(mns_plan_create(field, NULL, NULL, &wrong[i], NULL, &plan, &error), MNS_ERROR_USAGE);
        assert_null(plan);
        if (i < 2) assert_non_null(strstr(error.text, "tiles are not gathered"));
    }
    mns_field_destroy(field);
}

/* Whatever finds the first hit: how the tree is built that carries the rays after it can be said, where there
 * are any. */
static void the_tree_of_later_rays_is_built_as_told(void **state)
{
    (void)state;
    static const mns_method methods[] = {MNS_METHOD_LIST, MNS_METHOD_TILE};
    scene s = {"told", .desc = {SCENE_UNIT}};
    mns_field *field = scene_field(&s);
    for (size_t i = 0; i < 2; i++) {
        const mns_options options = {.method = methods[i], .tree = "references=5"};
        mns_look look = {FROM_A_SIDE, .effects = {.shadows = true}};
        mns_plan *plan = NULL;
        mns_error error;
        assert_int_equal(mns_plan_create(field, NULL, &look, &options, NULL, &plan, &error), MNS_OK);
        assert_true(plan->features & FEATURE_RAYS && plan->tree.references_a_ball == 5);
        mns_plan_destroy(plan);
        look.effects.shadows = false;
        assert_int_equal(mns_plan_create(field, NULL, &look, &options, NULL, &plan, &error), MNS_ERROR_USAGE);
        assert_non_null(strstr(error.text, "builds no tree without rays beyond the first"));
    }
    mns_field_destroy(field);
}

static void wrong_effects_are_refused(void **state)
{
    (void)state;
    static const mns_light flat = {.kind = MNS_LIGHT_AREA}, bright = {.strength = -1}, odd = {.kind = 9},
                           green = {.color = {0, 2, 0}};
    static const struct {
        mns_look look;
        const char *word;
        mns_status status;
    } cases[] = {
        {{.effects = {.reflections = 9}}, "9 reflections; take 0 to 8", MNS_ERROR_USAGE},
        {{.effects = {.refractions = -1}}, "-1 refractions; take 0 to 16", MNS_ERROR_USAGE},
        {{.effects = {.shadow_samples = 4097}}, "4097 shadow samples", MNS_ERROR_USAGE},
        {{.effects = {.occlusion_rays = 4097}}, "4097 occlusion rays", MNS_ERROR_USAGE},
        {{.effects = {.mirror = 1.1}}, "mirror 1.1", MNS_ERROR_USAGE},
        {{.effects = {.transmission = -0.1}}, "transmission -0.1", MNS_ERROR_USAGE},
        {{.effects = {.index = 0.9}}, "index of refraction 0.9", MNS_ERROR_USAGE},
        {{.effects = {.absorption = {0, -1, 0}}}, "absorption -1", MNS_ERROR_USAGE},
        {{.effects = {.occlusion_reach = -1}}, "reach -1", MNS_ERROR_USAGE},
        {{.blend.by = "cold"},
         "no column \"cold\" to blend materials by; the input has heat",
         MNS_ERROR_USAGE},
        {{BLEND_HEAT(1, 1)}, "blend: range 1 to 1; the lower comes first", MNS_ERROR_USAGE},
        {{BLEND_HEAT(0, INFINITY)}, "blend: range 0 to inf", MNS_ERROR_USAGE},
        {{BLEND_HEAT(0, 1), .blend.mirror = 2}, "blend: mirror 2", MNS_ERROR_USAGE},
        {{BLEND_HEAT(0, 1), .blend.transmission = -1}, "blend: mirror 0, transmission -1", MNS_ERROR_USAGE},
        {{BLEND_HEAT(0, 1), .blend.absorption = {0, NAN, 0}}, "blend: absorption", MNS_ERROR_USAGE},
        {{BLEND_HEAT(0, 1), .blend.color = {0, 0, 1.5}}, "blend: colours", MNS_ERROR_USAGE},
        {{.blend.mirror = 0.5},
         "no column to blend it by; name one by blend.by (--blend-by)",
         MNS_ERROR_USAGE},
        {{.blend.set = MNS_LOOK_COLOR}, "no column to blend it by", MNS_ERROR_USAGE},
        {{.light_count = 1}, "no array", MNS_ERROR_USAGE},
        {{.lights = two_lights, .light_count = 257}, "257 lights; at most 256", MNS_ERROR_UNSUPPORTED},
        {{.lights = &flat, .light_count = 1}, "light 0: radius 0", MNS_ERROR_USAGE},
        {{.lights = &bright, .light_count = 1}, "light 0: strength -1", MNS_ERROR_USAGE},
        {{.lights = &odd, .light_count = 1}, "light 0: no kind 9", MNS_ERROR_USAGE},
        {{.lights = &green, .light_count = 1}, "light 0: colours", MNS_ERROR_USAGE},
        {{.preset = "mud"},
         "no preset \"mud\"; expected one of plain clay water molecule glass",
         MNS_ERROR_USAGE},
    };
    scene s = {"wrong", .desc = {SCENE_UNIT}};
    mns_field *field = scene_field(&s);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_plan *plan = NULL;
        mns_error error;
        assert_int_equal(mns_plan_create(field, NULL, &cases[i].look, NULL, NULL, &plan, &error),
                         cases[i].status);
        assert_null(plan);
        if (!strstr(error.text, cases[i].word)) fail_msg("%s: not said: %s", error.text, cases[i].word);
    }
    mns_field_destroy(field);
}

static void the_text_tells_the_effects(void **state)
{
    (void)state;
    scene s = {"water", .desc = {SCENE_UNIT}, TRUE_METHOD,
               .look = {.preset = "water", .effects = {.absorption = {1, 0.5, 0}, .seed = 7}}};
    mns_field *field = scene_field(&s);
    mns_plan *plan = scene_plan(&s, field);
    assert_non_null(
        strstr(mns_plan_text(plan),
               "\neffects: 1 light, mirror 0 over 1 levels, index 1.333, transmission 0.75 through 4 "
               "surfaces, absorption 1,0.5,0, environment sky, seed 7\n"));
    assert_non_null(strstr(mns_plan_text(plan), " lit mirror fresnel refraction absorption sky\n"));
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

static void the_same_inputs_give_the_same_plan(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        mns_field *field = scene_field(&scenes[i]), *again = scene_field(&scenes[i]);
        mns_plan *a = scene_plan(&scenes[i], field), *b = scene_plan(&scenes[i], field),
                 *c = scene_plan(&scenes[i], again);
        assert_string_equal(mns_plan_text(a), mns_plan_text(b));
        assert_string_equal(mns_plan_text(a), mns_plan_text(c));
        assert_true(a->pool_nodes == b->pool_nodes && a->pool_most == b->pool_most &&
                    a->features == c->features);
        mns_plan_destroy(a);
        mns_plan_destroy(b);
        mns_plan_destroy(c);
        mns_field_destroy(field);
        mns_field_destroy(again);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_scene_has_its_features_and_passes),
        cmocka_unit_test(what_is_not_there_is_left_out),
        cmocka_unit_test(the_text_tells_all_of_the_plan),
        cmocka_unit_test(the_text_names_the_features),
        cmocka_unit_test(the_text_names_the_method_tile),
        cmocka_unit_test(tiles_are_neither_gathered_nor_shuffled),
        cmocka_unit_test(the_tree_of_later_rays_is_built_as_told),
        cmocka_unit_test(wrong_effects_are_refused),
        cmocka_unit_test(the_text_tells_the_effects),
        cmocka_unit_test(the_same_inputs_give_the_same_plan),
    };
    return cmocka_run_group_tests_name("plan", tests, NULL, NULL);
}
