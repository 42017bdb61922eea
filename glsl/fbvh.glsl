// The frame by a tree: one pixel's ray an invocation. Compute shader; eight neighbouring invocations see a block of 4x2 pixels.
#define VIEW_LOOSE
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#include "far.glsl"
#include "balls.glsl"
#ifdef BALL_TEXELS
#define TREE_TEXELS
#endif
#include "tree.glsl"
#include "chord.glsl"
#include "loops.glsl"
#include "side.glsl"
#include "active_leaf.glsl"
#if SOLVER == SOLVER_EXACT
#include "exact.glsl"
#else
const int PIECE_NONE = 0, PIECE_HIT = 1, PIECE_OPEN = 2, PIECE_CAP = 3;
#endif
#include "tree_cast.glsl"
#include "surface.glsl"
#include "planes.glsl"
#include "redo.glsl"
#ifdef HOST_DEPTH
#include "host.glsl"
#endif

layout(local_size_x = 64) in;
layout(location = 3) uniform ivec4 tree_region; // x, y, past x, past y
layout(std430, binding = 7) readonly buffer Blocks {
    uint block_count;
    uint block[]; // of 8x8 pixels that some box touches: column, and row 16 bits up
};
layout(binding = 1, rg32f) writeonly uniform image2D plane_t;
layout(binding = 2, rgba32f) writeonly uniform image2D plane_normal;
#ifdef MATERIALS
layout(binding = 3, rgba32f) writeonly uniform image2D plane_color;
#elif defined(COLORS)
layout(binding = 3, rgba16f) writeonly uniform image2D plane_color;
#endif
#ifdef COUNTERS
layout(binding = 4, rgba32f) writeonly uniform image2D plane_counts;
#endif

void main()
{
    uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (group >= block_count) return;
    uint lane = gl_LocalInvocationIndex;
    ivec2 within = ivec2((lane & 3u) | (lane >> 1u & 4u), (lane >> 2u & 1u) | (lane >> 3u & 6u));
    ivec2 at = tree_region.xy + 8 * ivec2(block[group] & 0xffffu, block[group] >> 16u) + within;
    if (at.x >= tree_region.z || at.y >= tree_region.w) return;
    vec2 position = vec2(at) + 0.5;
    Ray ray = view_ray(position);
    float limit = FAR_AWAY;
#ifdef HOST_DEPTH
    limit = host_limit(position);
#endif
    Pixel pixel = pixel_miss(true);
    side_take(ray);
    Cast got = tree_cast(ray, RAY_BEGIN, limit, float(SIDE));
    int found = got.found;
    if (found == PIECE_HIT) {
#ifdef OVERLAPS
        cast_gather(ray, got);
#endif
        Surface surface = surface_at(ray, got.t);
#if SOLVER == SOLVER_EXACT
        // A leaf's face may cut a hump between its two roots, and so leave one that is certain and yet ill placed: such a Newton
        // step is not small, and double shall decide.
        if (!surface_settled(surface, got.t) || !(abs(surface.shift) <= 1.0e-4 * surface.radius)) found = PIECE_OPEN;
#else
        surface.shift = 0.0;
#endif
        pixel.t = pixel_distance(position, got.t, surface.shift);
        pixel.normal = vec4(surface.normal, 1.0);
        pixel.color = surface.color;
    }
    if (!loops_whole(int(level_two))) found = PIECE_CAP;
    if (found == PIECE_OPEN) {
        atomicAdd(count_float, 1u);
        redo_add(position, REDO_DOUBLE, 0.0);
    } else if (found == PIECE_CAP) {
        if (slot_overflow)
            atomicAdd(count_active, 1u);
        else
            atomicAdd(count_steps, 1u);
        redo_add(position, REDO_FLOAT, 0.0);
    }
    imageStore(plane_t, at, vec4(pixel.t, 0.0, 0.0));
    imageStore(plane_normal, at, pixel.normal);
#ifdef BLENDS
    imageStore(plane_color, at, pixel.color);
#endif
#ifdef COUNTERS
    imageStore(plane_counts, at, cast_counts);
#endif
}
