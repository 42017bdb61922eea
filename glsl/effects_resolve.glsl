// The rays beyond the first hit that float could not decide, asked in doubles: of a walk that waits with one, an entry of a list each,
// the ray is made again in doubles and traced by the walk that is always right; with the answer the walk goes on in float. What doubles
// leave open is counted, and the pixel is marked. Compute shader, one invocation an entry; a ray that takes long is left to the next
// dispatch.
//
// A ray from the first hit is made from the pixel's own ray and its root, all in doubles. One that leaves a surface further on starts
// where float has found that, moved along itself onto the surface.
#include "real.glsl"
#define UINT uint
#include "density.glsl"
#include "optics.glsl"
#include "real_trig.glsl"
#define sin real_sine
#define cos real_cosine
#include "samples.glsl"
#undef sin
#undef cos
#include "view.glsl"
#if defined(COLORS) && !defined(COLOR_LABELS)
#include "color.glsl"
#endif
#define LIGHTING_BLOCK 2
#include "lighting.glsl"
#include "paths_block.glsl"
#include "environment.glsl"
#ifdef SOLIDS
#include "solids_texels.glsl"
#include "solids.glsl"
#endif
#include "paths.glsl"
#include "redo.glsl"
#include "paths_planes.glsl"
#include "paths_pixel.glsl"
#include "paths_store.glsl"
#include "balls.glsl"
#include "tree.glsl"
#include "chord.glsl"
#include "loops.glsl"
#include "side.glsl"
#include "active_references.glsl"
#include "leap.glsl"
#include "exact.glsl"
#include "surface.glsl"
#include "resolve_search.glsl"
#include "tree_walk.glsl"
#ifdef SOLIDS
#include "paths_solids.glsl"
#endif

void take_ray(Ray ray)
{
    leaf_ray = ray;
    view_reach = sqrt(dot(ray.start, ray.start)) / NUM(256.0); // as for a tree's first rays (view.glsl)
    tree_aim(vec3(ray.start), vec3(ray.way));
}

// The root on leaf_ray near s, and the surface there.
Surface polish(inout REAL s)
{
    REAL slack = NUM(1.0e-6) * (s + NUM(256.0) * view_reach);
    Stretch stretch = Stretch(FAR_AWAY, FAR_AWAY, 0u, 0u);
    for (int back = 0; back < 2 && stretch.begin > s + slack; back++) // or else it lies in the face behind
        stretch = stretch_after(max(s - REAL(back) * slack, NUM(0.0)), FAR_AWAY);
    leaf_first = stretch.first;
    leaf_past = stretch.past;
    Surface surface = surface_none();
    for (int step = 0; step < 3; step++) {
        active_from = s;
        surface = surface_at(leaf_ray, s);
        if (abs(surface.shift) <= NUM(1.0e-2) * surface.radius) s += surface.shift;
    }
    return surface;
}

// The ray that path_next asks for, in doubles. False: it asks for none, or for another than in float. `first`: it leaves the first hit,
// which is the walk's place.
bool ray_next(bool first)
{
    uvec3 asked = uvec3(uint(path_asks), place_light, place_sample);
    if (!path_next() || asked != uvec3(uint(path_asks), place_light, place_sample)) return false;
#ifdef PATHS_ON
    if (path_asks == ASKS_PATH && first) { // what waits is in floats
        path_ray.start = place_at;
#if defined(MIRROR) && defined(REFRACTION)
        path_ray.way = (wait_rest[path_top - 1].x & 1u) == 0u ? place_mirror_way() : place_refracted_way();
#elif defined(MIRROR)
        path_ray.way = place_mirror_way();
#else
        path_ray.way = place_refracted_way();
#endif
    }
#endif
    path_ray.way /= sqrt(dot(path_ray.way, path_ray.way)); // what comes from floats is a unit only to theirs
    return true;
}

// Whether the walk's ray leaves the first hit.
bool leaves_first()
{
#ifdef PATHS_ON
    if (place_path == 0u) return wait_rest[path_top - 1].x >> 1u == 1u;
#endif
    return place_path == 1u;
}

// The walk's ray once more, in doubles, from a root found in doubles: of the pixel's own ray, whose place it then leaves, or of its own.
// In two steps, so that neither has its text twice.
bool ray_again(ivec2 at)
{
    bool first = leaves_first();
    REAL s = NUM(0.0);
    for (int step = 0; step < 2; step++) {
        if ((step == 0) != first) {
            if (!ray_next(first)) return false;
            take_ray(path_ray);
            continue;
        }
        vec2 t = texelFetch(plane_t, at, 0).xy;
        if (first) {
            take_ray(Ray(path_eye.xyz, path_first_way(vec2(at) + 0.5)));
            s = REAL(t.x) + REAL(t.y);
        }
#ifdef SOLIDS
        if (!path_on_surface()) { // a mesh's place is as good as its distance
            if (first) place_at = leaf_ray.start + s * leaf_ray.way;
            continue;
        }
#endif
        Surface surface = polish(s);
        if (first) {
            place_at = leaf_ray.start + s * leaf_ray.way;
            place_turn(leaf_ray.way, surface.normal);
        } else {
            path_ray.start += s * path_ray.way;
            take_ray(path_ray);
        }
    }
    return true;
}

void use(int found, REAL s)
{
    Surface surface = surface_none();
    if (found == PIECE_HIT && path_asks == ASKS_PATH) surface = surface_at(leaf_ray, s);
    if (found != PIECE_HIT && found != PIECE_NONE) path_doubt = true;
    if (abs(surface.shift) <= NUM(1.0e-2) * surface.radius) s += surface.shift;
    path_met(surface.color);
    path_use(found == PIECE_HIT, s, surface.normal, lighting_albedo(surface.color));
}

#ifdef SOLIDS
// The meshes' part in the answer: none, or all of it.
const int SOLID_AWAY = 0, SOLID_MET = 1;

int solid_use(Solid solid, inout int found, REAL s)
{
    if (solid.open) path_doubt = true;
    path_met_solid = false;
    if (!solid.hit) return SOLID_AWAY;
    REAL gap = solid_gap(solid);
    if (found == PIECE_HIT && s < solid.t - gap) return SOLID_AWAY;
    if (found != PIECE_NONE && path_asks == ASKS_PATH) path_doubt = true;
    path_met_solid = true;
    path_use(true, solid.t, solid.normal, solid_color(solid.mesh));
    return SOLID_MET;
}
#endif

void main()
{
    uint index = path_index();
    if (index >= path_lists.w) return;
    uvec4 entry = redo_entry[path_lists.x + index];
    ivec2 at = ivec2(entry.x & 0xffffu, entry.x >> 16u);
    if ((entry.y & ENTRY_HELD) != 0u)
        path_load(at, entry.y);
    else
        begin(at);
    REAL s = max(resolve_unpack(entry.zw), RAY_BEGIN);
    if (ray_again(at)) {
        REAL limit = path_limit;
        bool walks = true;
#ifdef SOLIDS
        Solid solid = solid_ask(leaves_first() ? TAU : NUM(9.5367431640625e-7)); // what is further on was found in float
        limit = solid_before(solid);
        walks = !solid.hit || path_asks == ASKS_PATH;
#endif
        int found = PIECE_NONE;
        if (walks) found = resolve_walk(limit, path_inwards ? NUM(1.0) : NUM(-1.0), s);
        if (!loops_whole(int(level_two))) found = PIECE_CAP;
        if (found == PIECE_LATER) {
            entry.zw = resolve_pack(s);
            entry_wait_double(entry);
            return;
        }
        atomicAdd(count_spare, 1u);
#ifdef SOLIDS
        if (solid_use(solid, found, s) == SOLID_AWAY)
#endif
            use(found, s);
    }
    entry = uvec4(entry.x, (entry.y & ENTRY_SLOT) | ENTRY_HELD, 0u, 0u);
    path_save(entry.y);
    entry_wait(entry);
}
