// The slow path that is always right: pixels that the cast could not decide or hold, solved again in doubles by the same pieces,
// over the pixel's whole list in place. Compute shader, one invocation a pixel of the redo list.
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#include "far.glsl"
#include "balls.glsl"
#define LISTS_ACCESS
#include "lists.glsl"
#include "chord.glsl"
#include "active_links.glsl"
#if KERNEL <= DENSITY_WYVILL
#if KERNEL == DENSITY_POLY2
#define DEGREE 4
#elif KERNEL == DENSITY_POLY4
#define DEGREE 8
#else
#define DEGREE 6
#endif
#include "bernstein.glsl"
#include "piece.glsl"
#else
#define DEGREE 1
#include "bernstein.glsl"
#include "taylor.glsl"
#endif
#include "surface.glsl"
#include "planes.glsl"
#include "redo.glsl"
#ifdef HOST_DEPTH
#include "host.glsl"
#endif

layout(local_size_x = REDO_GROUP) in;
layout(binding = 1, rg32f) writeonly uniform image2D plane_t;
layout(binding = 2, rgba32f) writeonly uniform image2D plane_normal;
#ifdef COLORS
layout(binding = 3, rgba16f) writeonly uniform image2D plane_color;
#endif

int resolve_walk(REAL limit, out REAL s)
{
    s = NUM(0.0);
    active_past = active_head;
    for (;;) {
        active_move(s);
        if (active_head == active_past) {
            if (active_past == NO_NODE) return PIECE_NONE;
            s = max(s, active_chord(active_past).a);
            continue;
        }
        if (s >= limit) return PIECE_NONE;
        REAL stop = active_end;
        if (active_past != NO_NODE) stop = min(stop, active_chord(active_past).a);
        piece_begin();
        EACH_ACTIVE(j) piece_take(active_chord(j), s, stop);
        if (piece_may(s, stop, SIDE)) {
            REAL hit;
            int found = piece_solve(s, stop, SIDE, RESOLVE_STEPS, hit);
            if (found != PIECE_NONE) {
                s = hit;
                return found == PIECE_HIT && s > limit ? PIECE_NONE : found;
            }
        }
        s = stop;
    }
}

void main()
{
    if (gl_GlobalInvocationID.x >= redo_count) return;
    uint packed_pixel = redo_pixels[gl_GlobalInvocationID.x];
    ivec2 at = ivec2(packed_pixel & 0xffffu, packed_pixel >> 16u);
    vec2 position = vec2(at) + 0.5;
    links_ray = view_ray(position);
    active_head = list_sort(links_hit(imageLoad(list_heads, at).x));
    REAL limit = FAR_AWAY;
#ifdef HOST_DEPTH
    limit = REAL(host_limit(position));
#endif
    REAL t;
    int found = resolve_walk(limit, t);
    Pixel pixel = pixel_miss(found == PIECE_NONE);
    if (found == PIECE_HIT) {
        Surface surface = surface_at(links_ray, t);
        REAL shift = surface.shift;
        if (!(abs(shift) <= NUM(1.0e-2) * surface.radius)) shift = NUM(0.0);
        pixel.t = pixel_distance(position, t, shift);
        pixel.normal = vec4(surface.normal, 1.0);
        pixel.color = surface.color;
    } else if (found != PIECE_NONE) {
        atomicAdd(count_undecided, 1u);
    }
    imageStore(plane_t, at, vec4(pixel.t, 0.0, 0.0));
    imageStore(plane_normal, at, pixel.normal);
#ifdef COLORS
    imageStore(plane_color, at, pixel.color);
#endif
}
