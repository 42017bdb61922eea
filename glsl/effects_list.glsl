// The pixels that see a surface, one after the other, as entries that have not been begun (paths_store.glsl); those that see none show
// what the planes were cleared to, or the environment. So the passes that follow, whose text is long, run on full groups. Compute shader,
// a block of 4x2 pixels an invocation: they are counted at once, since every atomic operation on one counter waits for the last.
#include "real.glsl"
#define LIGHTING_BLOCK 2
#include "lighting.glsl"
#include "paths_block.glsl"
#include "environment.glsl"
#include "redo.glsl"
#include "paths_planes.glsl"

const ivec2 BLOCK = ivec2(4, 2); // as src/shade/effects.c has it

ivec2 block_pixel(ivec2 corner, int i)
{
    return corner + ivec2(i % BLOCK.x, i / BLOCK.x);
}

// Whether the pixel is one of the region's, and what it sees: bit i of either.
void block_look(ivec2 corner, out uint within, out uint hit)
{
    within = hit = 0u;
    for (int i = 0; i < BLOCK.x * BLOCK.y; i++) {
        ivec2 at = block_pixel(corner, i);
        if (at.x >= path_region.z || at.y >= path_region.w) continue;
        within |= 1u << i;
        if (!isinf(texelFetch(plane_t, at, 0).x)) hit |= 1u << i;
    }
}

void main()
{
    ivec2 corner = path_region.xy + BLOCK * ivec2(8u * gl_WorkGroupID.xy + uvec2(gl_LocalInvocationIndex & 7u, gl_LocalInvocationIndex >> 3u));
    uint within, hit;
    block_look(corner, within, hit);
    if (hit != 0u) {
        uint slot = atomicAdd(redo_count, uint(bitCount(hit)));
        for (uint left = hit; left != 0u; left &= left - 1u) {
            ivec2 at = block_pixel(corner, findLSB(left));
            redo_entry[slot].xy = uvec2(uint(at.x) | uint(at.y) << 16u, slot);
            slot++;
        }
    }
#if defined(SKY) || defined(ENVIRONMENT)
    for (uint left = within & ~hit; left != 0u; left &= left - 1u) {
        ivec2 at = block_pixel(corner, findLSB(left));
        imageStore(plane_lit, at, vec4(environment_color(vec3(path_first_way(vec2(at) + 0.5))) * background.a, background.a));
    }
#endif
}
