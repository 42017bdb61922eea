// What light does beyond each pixel's first hit, to its colour and its terms, from the list of pixels that see a surface. Compute
// shader. Without rays (RAYS_NOW) it is done at once. With them an invocation leads the walk of an entry of a list: it traces a ray, uses
// what was found, looks for the next, and goes on until the walk ends, or the dispatch has done enough, or float cannot decide; that ray
// is asked in doubles (effects_resolve.glsl). What waits is listed anew by every dispatch, so that groups are full.
//
// Dispatches of two programs take turns where bounds can tell of rays: RAYS_ANY goes on as long as they do, and the other casts the ray
// that it was left at. In one text every lane would pay for both.
#ifdef RAYS_NOW
#define VIEW_LOOSE
#define PATHS_LOOSE
#endif
#include "real.glsl"
#define UINT uint
#include "density.glsl"
#include "optics.glsl"
#include "samples.glsl"
#include "view.glsl"
#if defined(COLORS) && !(defined(COLOR_LABELS) && defined(RAYS_NOW) && !defined(RAYS_ANY))
#include "color.glsl"
#endif
#define LIGHTING_BLOCK 2
#include "lighting.glsl"
#include "paths_block.glsl"
#include "environment.glsl"
#ifdef SOLIDS
#include "solids_texels.glsl"
#ifdef RAYS_NOW
#include "solids.glsl"
#endif
#endif
#include "paths.glsl"
#include "redo.glsl"
#include "paths_planes.glsl"
#include "paths_pixel.glsl"

#ifndef RAYS_NOW
void main()
{
    uint index = path_index();
    if (index >= redo_count) return;
    uint pixel = redo_entry[index].x;
    ivec2 at = ivec2(pixel & 0xffffu, pixel >> 16u);
    begin(at);
    path_next();
    finish(at);
}
#else
#include "paths_store.glsl"
#include "loops.glsl"
#include "balls.glsl"
#ifdef BALL_TEXELS
#define TREE_TEXELS
#endif
#include "tree.glsl"
#include "chord.glsl"
#if defined(RAYS_ANY) || defined(BOUNDS_FIRST)
#define BOUNDS_TELL (path_asks != ASKS_PATH && !path_inwards) // they may, of path_ray
#else
#define BOUNDS_TELL false
#endif
#ifdef RAYS_ANY
const int PIECE_NONE = 0, PIECE_HIT = 1, PIECE_OPEN = 2, PIECE_CAP = 3, PIECE_LATER = 4;
#include "tree_any.glsl"
#else
#include "active_leaf.glsl"
#define ROOT_MATTERS (path_asks == ASKS_PATH)
#include "exact.glsl"
#include "tree_cast.glsl"
#include "surface.glsl"
#endif

#ifdef SOLIDS
#include "paths_solids.glsl"
#endif

// What path_ray met; PIECE_OPEN and PIECE_CAP: not known; PIECE_LATER: to be asked by the other program.
struct Answer {
    int found;
    float t;
    vec3 normal;
    vec3 albedo;
};

#ifdef RAYS_ANY
Answer ask(bool first, out int work)
{
    Answer answer = Answer(PIECE_LATER, 0.0, vec3(0.0), vec3(0.0));
    work = 0;
    if (!BOUNDS_TELL) return answer;
#ifdef SOLIDS
    Solid solid = solid_ask(TAU);
    work = solid_work;
    if (!solid.open && solid.hit) answer.found = PIECE_HIT;
    if (solid.open || solid.hit) return answer;
#endif
    int looked;
    answer.found = tree_any(path_ray, path_limit, looked);
    work += looked;
    return answer;
}
#else
Answer ask(bool first, out int work)
{
    Answer answer = Answer(PIECE_LATER, 0.0, vec3(0.0), vec3(0.0));
    work = 0;
    if (!first && BOUNDS_TELL) return answer;
    view_reach = sqrt(dot(path_ray.start, path_ray.start));
    float limit = path_limit;
#ifdef SOLIDS
    Solid solid = solid_ask(TAU);
    work = solid_work;
    path_met_solid = false;
    if (solid.open || (solid.hit && path_asks != ASKS_PATH)) {
        answer.found = solid.open ? PIECE_OPEN : PIECE_HIT;
        return answer;
    }
    limit = solid_before(solid);
#endif
    Cast got = tree_cast(path_ray, 0.0, limit, path_inwards ? 1.0 : -1.0);
    work += cast_work;
    answer.found = got.found;
    answer.t = got.t;
#if defined(SOLIDS) && defined(PATHS_ON)
    if (solid.hit && got.found == PIECE_HIT && got.t > solid.t - solid_gap(solid)) answer.found = PIECE_OPEN;
    if (solid.hit && got.found == PIECE_NONE) {
        path_met_solid = true;
        int found = solid_steep(solid) ? PIECE_HIT : PIECE_OPEN;
        return Answer(found, solid.t, solid.normal, solid_color(solid.mesh));
    }
#endif
#ifdef PATHS_ON
    if (path_asks != ASKS_PATH || answer.found != PIECE_HIT) return answer;
#ifdef OVERLAPS
    cast_gather(path_ray, got);
#endif
    Surface surface = surface_at(path_ray, got.t);
    float lengths = got.t + view_reach + surface.radius;
#ifdef SOLIDS
    if (solid.hit) lengths -= surface.radius; // as solid_gap has it
#endif
    bool settled = abs(surface.shift) <= 1.0e-4 * surface.radius && surface.blur <= SETTLED * lengths;
    if (!settled) answer.found = PIECE_OPEN;
    answer.t = got.t + surface.shift;
    answer.normal = surface.normal;
    answer.albedo = lighting_albedo(surface.color);
    path_met(surface.color);
#endif
    return answer;
}
#endif

const int PATH_BUDGET = WALK_BUDGET / 6; // work after which a walk goes on in another dispatch

// Goes on up to the walk's end, REDO_DONE, or to where it is to be left: REDO_FLOAT, REDO_DOUBLE. `most`: work of this dispatch.
uint walk(int most, out uint rays)
{
    uint state;
    int work = 0;
    rays = 0u;
    do {
        state = REDO_DONE;
        if (!path_next()) break;
        int cost;
        Answer answer = ask(rays == 0u, cost);
        work += cost + 16;
        state = REDO_FLOAT;
        if (answer.found == PIECE_LATER) break;
        state = REDO_DOUBLE;
        if (answer.found != PIECE_OPEN && answer.found != PIECE_CAP) {
            rays++;
            path_use(answer.found == PIECE_HIT, answer.t, answer.normal, answer.albedo);
            state = REDO_FLOAT;
        }
    } while (state == REDO_FLOAT && work < most);
    return state;
}

void main()
{
    uint index = path_index();
    if (index >= path_lists.w) return;
    uvec4 entry = uvec4(redo_entry[path_lists.x + index].xy, 0u, 0u);
    ivec2 at = ivec2(entry.x & 0xffffu, entry.x >> 16u);
    bool alone = (entry.y & ENTRY_ALONE) != 0u;
    uint held = entry.y & ENTRY_HELD;
    uint rays;
    if (held != 0u)
        path_load(at, entry.y);
    else
        begin(at);
    uint state = walk(alone ? 1 : PATH_BUDGET, rays);
    if (!loops_whole(int(level_two))) {
        // The driver has cut loops short, and nothing has come of it: from where it was taken up the walk is led one ray a dispatch,
        // and where it was so already, in doubles.
        entry.y |= ENTRY_ALONE;
        state = alone ? REDO_DOUBLE : REDO_FLOAT;
    } else {
        atomicAdd(count_spare, rays);
        if (rays > 0u || state == REDO_DOUBLE) held = ENTRY_HELD;
        entry.y = (entry.y & ENTRY_SLOT) | held;
        if (state == REDO_DONE)
            finish(at);
        else if (held != 0u)
            path_save(entry.y);
    }
    if (state == REDO_FLOAT) entry_wait(entry);
    if (state == REDO_DOUBLE) entry_wait_double(entry);
}
#endif
