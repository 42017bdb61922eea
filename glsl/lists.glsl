// The per-pixel linked lists that gather leaves: heads in an image, nodes of (ball, next, a, b) in a buffer, [a, b] being the chord
// that the ball cuts from the pixel's ray, in float; nearest ball first where the fragments ran in the order in which they were drawn.

// Node 0 is never given out: it ends every list. Invocations beside a primitive's edge may run with loads that return zero, and so
// find an empty list instead of one without an end.
const uint NO_NODE = 0u;

#ifdef TILES
#include "chord_ends.glsl"
#include "tiles.glsl"
#else
layout(binding = 0, r32ui) LISTS_ACCESS uniform uimage2D list_heads;
#ifdef LISTS_TEXELS
layout(binding = 3) uniform usamplerBuffer list_texels;
uvec4 list_node(uint node) { return texelFetch(list_texels, int(node)); }
#else
layout(std430, binding = 2) LISTS_ACCESS buffer Nodes {
    uvec4 list_nodes[];
};
uvec4 list_node(uint node) { return list_nodes[node]; }
#endif

uint list_head(ivec2 pixel) { return imageLoad(list_heads, pixel).x; }
#endif
