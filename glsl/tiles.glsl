// Lists a tile of pixels long, made on the CPU in order of effective distance: an entry is a ball's place, the last of a tile has
// bit 31 set. A pixel walks its tile's list as it would its own; the chords, which gather would have left in the nodes, are cut
// here from the pixel's ray, list_ray. A ball that the ray misses has a chord without length.

layout(location = 3) uniform ivec4 tile_grid;  // where the region begins, tiles across, log2 of a tile's side

#ifdef LISTS_TEXELS
layout(binding = 3) uniform usamplerBuffer list_texels;
layout(binding = 4) uniform usamplerBuffer tile_texels;
uint tile_entry(uint node) { return texelFetch(list_texels, int(node)).x; }
uint tile_head(int tile) { return texelFetch(tile_texels, tile).x; }
#else
layout(std430, binding = 2) readonly buffer Entries {
    uint tile_entries[];
};
layout(std430, binding = 5) readonly buffer Heads {
    uint tile_heads[];
};
uint tile_entry(uint node) { return tile_entries[node]; }
uint tile_head(int tile) { return tile_heads[tile]; }
#endif

Ray list_ray = Ray(REAL3(0.0), REAL3(0.0));

uint list_head(ivec2 pixel)
{
    ivec2 tile = (pixel - tile_grid.xy) >> tile_grid.w;
    return tile_head(tile.y * tile_grid.z + tile.x);
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
    uint entry = tile_entry(node);
    Ball ball = ball_get(entry & 0x7fffffffu);
#ifndef RESOLVE_STEPS
    for (int skipped = 0; skipped < TILE_SKIP && entry < 0x80000000u && tile_misses(ball); skipped++) {
        entry = tile_entry(++node);
        ball = ball_get(entry & 0x7fffffffu);
    }
#endif
    REAL2 ends;
    bool meets = chord_ends(ball.centre - list_ray.start, ball.radius, list_ray.way, NUM(0.0), ends);
    vec2 chord = vec2(ends);
    uint next = entry < 0x80000000u ? node + 1u : NO_NODE;
    return uvec4(entry & 0x7fffffffu, next, floatBitsToUint(chord.x), floatBitsToUint(meets ? chord.y : chord.x));
}
