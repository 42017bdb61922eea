// Lists a tile of pixels long, made on the CPU in order of effective distance: the balls themselves, one after the other, so that a node
// is a ball's record and the next is the record after it. A pixel walks its tile's list as it would its own; the chords, which gather
// would have left in the nodes, are cut here from the pixel's ray, list_ray. A ball that the ray misses has a chord without length.

layout(location = 3) uniform ivec4 tile_grid;  // where the region begins, tiles across, log2 of a tile's side

#ifdef LISTS_TEXELS
layout(binding = 4) uniform usamplerBuffer tile_texels;
uvec2 tile_head(int tile) { return texelFetch(tile_texels, tile).xy; }
#else
layout(std430, binding = 5) readonly buffer Heads {
    uvec2 tile_heads[];
};
uvec2 tile_head(int tile) { return tile_heads[tile]; }
#endif

Ray list_ray = Ray(REAL3(0.0), REAL3(0.0));
uint tile_last = NO_NODE;  // of the pixel's list

uint list_head(ivec2 pixel)
{
    ivec2 tile = (pixel - tile_grid.xy) >> tile_grid.w;
    uvec2 head = tile_head(tile.y * tile_grid.z + tile.x);
    tile_last = head.x == NO_NODE ? NO_NODE : head.y - 1u;
    return head.x;
}

// Balls that the ray misses which one look may pass over; none where rounds of loops are counted: there even a loop of no rounds is
// one.
#ifndef RESOLVE_STEPS
const int TILE_SKIP = 62;
#endif

bool tile_misses(Ball ball)
{
    REAL middle;
    REAL3 offset = chord_offset(ball.centre - list_ray.start, list_ray.way, middle);
    return dot(offset, offset) >= ball.radius * ball.radius;
}

// Each lane goes ahead to its next ball that the ray meets. What is used behind the loop is written before it and in its last
// statement: llvmpipe's storage loads give zero to lanes that have left, and a value of the loop's middle would be that zero.
uvec4 list_node(uint node)
{
    Ball ball = ball_get(node);
#ifndef RESOLVE_STEPS
    uint last = node == NO_NODE ? NO_NODE : tile_last;
    for (int skipped = 0; skipped < TILE_SKIP && node < last && tile_misses(ball); skipped++) {
        node++;
        ball = ball_get(node);
    }
#endif
    REAL2 ends;
    bool meets = chord_ends(ball.centre - list_ray.start, ball.radius, list_ray.way, NUM(0.0), ends);
    vec2 chord = vec2(ends);
    uint next = node < tile_last ? node + 1u : NO_NODE;
    return uvec4(node, next, floatBitsToUint(chord.x), floatBitsToUint(meets ? chord.y : chord.x));
}
