// What resolving a pixel of the redo list shares, whatever finds the balls on its ray: how an entry keeps a walk's place, and what
// becomes of a verdict.

layout(local_size_x = REDO_GROUP) in;
layout(binding = 1, rg32f) writeonly uniform image2D plane_t;
layout(binding = 2, rgba32f) writeonly uniform image2D plane_normal;
#ifdef MATERIALS
layout(binding = 3, rgba32f) writeonly uniform image2D plane_color;
#elif defined(COLORS)
layout(binding = 3, rgba16f) writeonly uniform image2D plane_color;
#endif

#include "resolve_search.glsl"

// Writes the pixel, or leaves its entry to another dispatch: `held` is what the walk wants to find there again, below 2^30.
void resolve_finish(uint index, uvec4 entry, uint held, int found, REAL s, Surface surface)
{
    ivec2 at = ivec2(entry.x & 0xffffu, entry.x >> 16u);
    vec2 position = vec2(at) + 0.5;
    bool whole = loops_whole(int(level_two));
#ifndef MNS_DOUBLE
    if (found == PIECE_HIT && !surface_settled(surface, s)) found = PIECE_OPEN;
    if (found == PIECE_OPEN || found == PIECE_CAP || !whole) {
        atomicAdd(count_float, 1u);
        redo_entry[index] = uvec4(entry.x, REDO_DOUBLE, 0u, 0u);
        return;
    }
#endif
    if (found == PIECE_LATER && whole) {
        redo_entry[index] = uvec4(entry.x, RESOLVE_STATE | held << 2u, resolve_pack(s));
        atomicAdd(count_unfinished, 1u);
        return;
    }
    redo_entry[index] = uvec4(entry.x, REDO_DONE, 0u, 0u);
    Pixel pixel = pixel_miss(found == PIECE_NONE && whole);
    if (found == PIECE_HIT) {
        if (!(abs(surface.shift) <= NUM(1.0e-2) * surface.radius)) surface.shift = NUM(0.0);
        pixel.t = pixel_distance(position, s, surface.shift);
        pixel.normal = vec4(surface.normal, whole ? 1.0 : 0.0);
        pixel.color = surface.color;
    }
    if (pixel.normal.w == 0.0) atomicAdd(count_undecided, 1u);
    imageStore(plane_t, at, vec4(pixel.t, 0.0, 0.0));
    imageStore(plane_normal, at, pixel.normal);
#ifdef BLENDS
    imageStore(plane_color, at, pixel.color);
#endif
}
