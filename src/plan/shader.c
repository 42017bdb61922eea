#include "plan/plan.h"

#include "solid/solid.h"

#include <stdio.h>
#include <string.h>

typedef struct shader_part {
    const char *vertex, *fragment, *compute;
    uint64_t reads; /* features that change its text */
} shader_part;

#define READS_BALL (FEATURE_KERNEL | FEATURE_RADII | FEATURE_STRENGTHS | FEATURE_FAR)
#define READS_RAY                                                                                            \
    (READS_BALL | FEATURE_SOLVER | FEATURE_EYE_IN_BALL | FEATURE_EYE_INSIDE | FEATURE_EYE_ON |               \
     FEATURE_HOST | FEATURE_BLENDS | FEATURE_LABELS | FEATURE_TEXELS | FEATURE_TILES)
#define READS_TREE ((READS_RAY | FEATURE_OVERLAPS) & ~(FEATURE_SOLVER | FEATURE_TEXELS | FEATURE_TILES))
#define READS_PATH                                                                                           \
    (FEATURE_KERNEL | FEATURE_RADII | FEATURE_STRENGTHS | FEATURE_OVERLAPS | FEATURE_TEXELS |                \
     FEATURE_EYE_INSIDE | FEATURE_EYE_ON)
#define READS_LIT                                                                                            \
    (FEATURE_BLENDS | FEATURE_LABELS | FEATURE_CEL | FEATURE_SPECULAR | FEATURE_MIRROR | FEATURE_FRESNEL |   \
     FEATURE_ENVIRONMENT | FEATURE_SKY | FEATURE_SOLIDS)
#define READS_WALK                                                                                           \
    (READS_LIT | FEATURE_SHADOWS | FEATURE_SOFT_SHADOWS | FEATURE_REFRACTION | FEATURE_ABSORPTION |          \
     FEATURE_OCCLUSION)
#define READS_BILLBOARD (FEATURE_RADII | FEATURE_FAR | FEATURE_CLIP_ZERO)

static const shader_part parts[SHADER_COUNT] = {
    [SHADER_CORE_QUADS] = {"billboard.vert.glsl", "core.frag.glsl", NULL,
                           READS_BILLBOARD | FEATURE_CORE_RADII | FEATURE_FLAT_CORES},
    [SHADER_CORE_POINTS] = {"billboard.vert.glsl", "core.frag.glsl", NULL,
                            READS_BILLBOARD | FEATURE_CORE_RADII | FEATURE_FLAT_CORES},
    [SHADER_GATHER_QUADS] = {"billboard.vert.glsl", "gather.frag.glsl", NULL,
                             READS_BILLBOARD | FEATURE_EYE_IN_BALL | FEATURE_PAPER | FEATURE_CORE |
                                 FEATURE_HOST},
    [SHADER_GATHER_POINTS] = {"billboard.vert.glsl", "gather.frag.glsl", NULL,
                              READS_BILLBOARD | FEATURE_EYE_IN_BALL | FEATURE_PAPER | FEATURE_CORE |
                                  FEATURE_HOST},
    [SHADER_ORDER] = {NULL, NULL, "order.glsl", 0},
    [SHADER_SHUFFLE] = {NULL, NULL, "shuffle.glsl", 0},
    [SHADER_CAST] = {"cast.vert.glsl", "cast.glsl", NULL, READS_RAY | FEATURE_SQUARES},
    [SHADER_WALK] = {NULL, NULL, "resolve.glsl", READS_RAY & ~(uint64_t)(FEATURE_SOLVER | FEATURE_TEXELS)},
    [SHADER_RESOLVE] = {NULL, NULL, "resolve.glsl", READS_RAY & ~(uint64_t)(FEATURE_SOLVER | FEATURE_TEXELS)},
    [SHADER_TREE] = {NULL, NULL, "fbvh.glsl",
                     READS_TREE | FEATURE_SOLVER | FEATURE_TEXELS | FEATURE_COUNTERS},
    [SHADER_TREE_WALK] = {NULL, NULL, "fbvh_resolve.glsl", READS_TREE},
    [SHADER_TREE_RESOLVE] = {NULL, NULL, "fbvh_resolve.glsl", READS_TREE},
    [SHADER_SOLIDS_FIRST] = {NULL, NULL, "solids_first.glsl", 0},
    [SHADER_EFFECTS_LIST] = {NULL, NULL, "effects_list.glsl", FEATURE_ENVIRONMENT | FEATURE_SKY},
    [SHADER_EFFECTS_PLAIN] = {NULL, NULL, "effects.glsl", READS_LIT},
    [SHADER_EFFECTS_ANY] = {NULL, NULL, "effects.glsl",
                            READS_WALK | (READS_PATH & ~(uint64_t)(FEATURE_OVERLAPS | FEATURE_EYE_INSIDE |
                                                                   FEATURE_EYE_ON))},
    [SHADER_EFFECTS] = {NULL, NULL, "effects.glsl", READS_WALK | READS_PATH},
    [SHADER_EFFECTS_RESOLVE] = {NULL, NULL, "effects_resolve.glsl",
                                (READS_WALK | READS_PATH) & ~(uint64_t)FEATURE_TEXELS},
    [SHADER_SHADE] = {"screen.vert.glsl", "shade.frag.glsl", NULL,
                      FEATURE_BLENDS | FEATURE_LABELS | FEATURE_CEL | FEATURE_DIRECTIONAL | FEATURE_SPECULAR |
                          FEATURE_LIT},
    [SHADER_HOST_DEPTH] = {"screen.vert.glsl", "host_depth.frag.glsl", NULL, FEATURE_FAR},
    [SHADER_HOST_DRAW] = {"screen.vert.glsl", "host_draw.frag.glsl", NULL, 0},
};

void plan_shader_files(plan_shader shader, const char **vertex, const char **fragment, const char **compute)
{
    *vertex = parts[shader].vertex;
    *fragment = parts[shader].fragment;
    *compute = parts[shader].compute;
}

static void add(char *defines, const char *name, int value)
{
    size_t used = strlen(defines);
    snprintf(defines + used, PLAN_DEFINES - used, "#define %s %d\n", name, value);
}

static void add_features(char *defines, uint64_t f)
{
    static const struct {
        uint64_t bit;
        const char *name;
    } names[] = {
        {FEATURE_RADII, "RADII"},
        {FEATURE_STRENGTHS, "STRENGTHS"},
        {FEATURE_CORE_RADII, "CORE_RADII"},
        {FEATURE_EYE_IN_BALL, "EYE_IN_BALL"},
        {FEATURE_EYE_INSIDE, "EYE_INSIDE"},
        {FEATURE_EYE_ON, "EYE_ON"},
        {FEATURE_FAR, "FAR"},
        {FEATURE_HOST, "HOST_DEPTH"},
        {FEATURE_COLORS, "COLORS"},
        {FEATURE_LABELS, "COLOR_LABELS"},
        {FEATURE_CEL, "CEL"},
        {FEATURE_DIRECTIONAL, "DIRECTIONAL"},
        {FEATURE_SPECULAR, "SPECULAR"},
        {FEATURE_CLIP_ZERO, "CLIP_ZERO_TO_ONE"},
        {FEATURE_TEXELS, "BALL_TEXELS"},
        {FEATURE_TILES, "TILES"},
        {FEATURE_SQUARES, "SQUARES"},
        {FEATURE_OVERLAPS, "OVERLAPS"},
        {FEATURE_COUNTERS, "COUNTERS"},
        {FEATURE_LIT, "LIT"},
        {FEATURE_SHADOWS, "SHADOWS"},
        {FEATURE_SOFT_SHADOWS, "SOFT_SHADOWS"},
        {FEATURE_MIRROR, "MIRROR"},
        {FEATURE_FRESNEL, "FRESNEL"},
        {FEATURE_REFRACTION, "REFRACTION"},
        {FEATURE_ABSORPTION, "ABSORPTION"},
        {FEATURE_OCCLUSION, "OCCLUSION"},
        {FEATURE_ENVIRONMENT, "ENVIRONMENT"},
        {FEATURE_SKY, "SKY"},
        {FEATURE_RAYS, "RAYS"},
        {FEATURE_SOLIDS, "SOLIDS"},
        {FEATURE_MATERIALS, "MATERIALS"},
        {FEATURE_BLENDS, "BLENDS"},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (f & names[i].bit) add(defines, names[i].name, 1);
}

/* Loop rounds that one invocation may take: drivers may stop endless-looking shaders; llvmpipe does after
 * 65,535 rounds of all the loops of eight lanes together. The cast, whose lanes walk much alike, may take
 * more: a cut is noticed, and the walk done again. A walk over the list, which comes back for more, stays
 * below a cut by lanes however different. */
enum { CAST_BUDGET = 24000, WALK_BUDGET = 5000, RESOLVE_STEPS = 200 };

enum { PATH_SLOTS = 64, PATH_SLOTS_OVERLAPS = 256 }; /* balls of a leaf at once, as trees have them */

static bool is_tree(plan_shader shader)
{
    return shader == SHADER_TREE || shader == SHADER_TREE_WALK || shader == SHADER_TREE_RESOLVE;
}

/* Numbers that a walk along a ray is specialised by. */
static void add_ray(const mns_plan *plan, plan_shader shader, char *defines, uint64_t f)
{
    add(defines, "KERNEL", (int)(f & FEATURE_KERNEL));
    /* The trees ask for the side where it matters. */
    if (is_tree(shader) && f & FEATURE_EYE_ON && !(f & FEATURE_EYE_INSIDE)) add(defines, "EYE_INSIDE", 1);
    add(defines, "WALK_BUDGET", shader == SHADER_CAST || shader == SHADER_TREE ? CAST_BUDGET : WALK_BUDGET);
    if (is_tree(shader)) add(defines, "TREE_DEPTH", FBVH_DEPTH_MOST + 1);
    if (shader == SHADER_RESOLVE || shader == SHADER_TREE_RESOLVE) add(defines, "MNS_DOUBLE", 1);
    if (shader != SHADER_CAST && shader != SHADER_TREE) {
        add(defines, "REDO_GROUP", RESOLVE_GROUP);
        add(defines, "RESOLVE_STEPS", RESOLVE_STEPS);
        return;
    }
    add(defines, "SOLVER_EXACT", MNS_SOLVER_EXACT);
    if (is_tree(shader))
        add(defines, "SOLVER_SECANT", MNS_SOLVER_SECANT);
    else
        add(defines, "SOLVER_CUBIC", MNS_SOLVER_CUBIC);
    add(defines, "SOLVER", (int)((f & FEATURE_SOLVER) >> 3));
    add(defines, "SLOTS", plan->options.slots);
    add(defines, "ROOT_STEPS", plan->options.root_steps);
}

/* Rays that wait at once: each surface leaves two where light is mirrored and goes through, and one follows
 * them down first. */
static int path_stack(const mns_plan *plan, uint64_t f)
{
    const mns_effects *e = &plan->look.effects;
    return f & FEATURE_MIRROR && f & FEATURE_REFRACTION ? e->reflections + e->refractions + 1 : 1;
}

int plan_path_stack(const mns_plan *plan)
{
    return path_stack(plan, plan->features);
}

/* Whether bounds are asked first: in leaves that know all of f, from outside, and of many rays a surface or
 * where a walk ends with them, for to leave it costs what they spare of one ray. */
static bool bounds_tell(uint64_t f)
{
    bool on = f & (FEATURE_MIRROR | FEATURE_REFRACTION);
    return f & (FEATURE_OCCLUSION | FEATURE_SOFT_SHADOWS | (on ? 0 : FEATURE_SHADOWS)) &&
           !(f & (FEATURE_OVERLAPS | FEATURE_EYE_INSIDE));
}

/* What light's ways beyond the first hit are specialised by; returns the features that are left to tell. */
static uint64_t add_paths(const mns_plan *plan, plan_shader shader, char *defines, uint64_t f)
{
    add(defines, "PATHS", 1);
    add(defines, "PATH_STACK", path_stack(plan, f));
    if (shader == SHADER_EFFECTS_PLAIN) return f; /* of meshes but their colours */
    add(defines, "RAYS_NOW", 1);
    if (f & FEATURE_SOLIDS) add(defines, "SOLID_DEPTH", SOLID_DEPTH);
    if (plan->look.light_count > 1) add(defines, "LIGHTS_MANY", 1);
    if (f & (FEATURE_EYE_INSIDE | FEATURE_EYE_ON | FEATURE_REFRACTION) && shader != SHADER_EFFECTS_ANY)
        add(defines, "BOTH_SIDES", 1);
    add(defines, "KERNEL", (int)(f & FEATURE_KERNEL));
    add(defines, "TREE_DEPTH", FBVH_DEPTH_MOST + 1);
    if (shader == SHADER_EFFECTS_ANY) {
        add(defines, "RAYS_ANY", 1);
        add(defines, "WALK_BUDGET", CAST_BUDGET);
    } else if (shader == SHADER_EFFECTS) {
        if (bounds_tell(f)) add(defines, "BOUNDS_FIRST", 1);
        add(defines, "WALK_BUDGET", CAST_BUDGET);
        add(defines, "SOLVER_EXACT", MNS_SOLVER_EXACT);
        add(defines, "SOLVER_SECANT", MNS_SOLVER_SECANT);
        add(defines, "SOLVER", MNS_SOLVER_EXACT);
        add(defines, "SLOTS", f & FEATURE_OVERLAPS ? PATH_SLOTS_OVERLAPS : PATH_SLOTS);
        add(defines, "ROOT_STEPS", plan->options.root_steps);
    } else {
        add(defines, "WALK_BUDGET", WALK_BUDGET);
        add(defines, "MNS_DOUBLE", 1);
        add(defines, "RESOLVE_STEPS", RESOLVE_STEPS);
    }
    return f & ~(FEATURE_EYE_INSIDE | FEATURE_EYE_ON);
}

void plan_shader_defines(const mns_plan *plan, plan_shader shader, char defines[PLAN_DEFINES])
{
    uint64_t f = plan->features & parts[shader].reads;
    if (f & FEATURE_LIT) f = FEATURE_LIT; /* all that is left is to weight what it finds */
    defines[0] = '\0';
    if (shader >= SHADER_EFFECTS_PLAIN && shader <= SHADER_EFFECTS_RESOLVE)
        f = add_paths(plan, shader, defines, f);
    if (shader == SHADER_SOLIDS_FIRST) {
        add(defines, "MNS_DOUBLE", 1);
        add(defines, "SOLID_DEPTH", SOLID_DEPTH);
    }
    if (shader == SHADER_CAST || shader == SHADER_WALK || shader == SHADER_RESOLVE || is_tree(shader))
        add_ray(plan, shader, defines, f);
    if (shader == SHADER_CORE_QUADS || shader == SHADER_CORE_POINTS) {
        add(defines, "CORE_SPHERE", 1);
        if (f & FEATURE_FLAT_CORES) add(defines, "CORE_FLAT", 1);
    }
    if (shader == SHADER_CORE_POINTS || shader == SHADER_GATHER_POINTS) add(defines, "POINTS", 1);
    if (shader == SHADER_GATHER_QUADS || shader == SHADER_GATHER_POINTS) {
        bool tested = f & (FEATURE_CORE | FEATURE_HOST);
        if (tested && f & FEATURE_PAPER) add(defines, "GATHER_PAPER", 1);
        if (tested && !(f & FEATURE_PAPER)) add(defines, "EARLY_Z", 1);
        f &= ~(uint64_t)FEATURE_HOST;
    }
    if (shader == SHADER_CORE_QUADS || shader == SHADER_CORE_POINTS) f &= ~(uint64_t)FEATURE_EYE_IN_BALL;
    add_features(defines, f);
}

bool plan_needs(const mns_plan *plan, plan_shader shader)
{
    uint64_t f = plan->features;
    if (f & FEATURE_REFERENCE) return shader == SHADER_SHADE;
    if (shader == SHADER_EFFECTS || shader == SHADER_EFFECTS_RESOLVE) return f & FEATURE_RAYS;
    if (shader == SHADER_EFFECTS_ANY) return f & FEATURE_RAYS && bounds_tell(f);
    if (shader == SHADER_SOLIDS_FIRST) return f & FEATURE_SOLIDS;
    if (shader == SHADER_EFFECTS_LIST) return f & FEATURE_LIT;
    if (shader == SHADER_EFFECTS_PLAIN) return f & FEATURE_LIT && !(f & FEATURE_RAYS);
    if (is_tree(shader)) return f & FEATURE_TREE;
    if (f & FEATURE_TREE && shader < SHADER_TREE) return false;
    if (f & FEATURE_TILES && shader < SHADER_SHUFFLE) return false;
    switch (shader) {
    case SHADER_CORE_QUADS:
        return f & FEATURE_CORE && f & FEATURE_QUADS;
    case SHADER_CORE_POINTS:
        return f & FEATURE_CORE && f & FEATURE_POINTS;
    case SHADER_GATHER_QUADS:
        return f & FEATURE_QUADS;
    case SHADER_GATHER_POINTS:
        return f & FEATURE_POINTS;
    case SHADER_SHUFFLE:
        return f & FEATURE_SHUFFLE;
    case SHADER_HOST_DEPTH: /* for the core pass and gather; a cast reads the host's depth itself */
        return f & FEATURE_HOST && !(f & FEATURE_TILES);
    case SHADER_HOST_DRAW:
        return f & FEATURE_HOST;
    default:
        return true;
    }
}
