// The pixels that see a surface, one after the other, as entries that have not been begun (paths_store.glsl); those that see none show
// what the planes were cleared to, or the environment. So the passes that follow, whose text is long, run on full groups. Compute shader,
// a pixel an invocation, eight neighbours a block of 4x2 pixels.
#include "real.glsl"
#define LIGHTING_BLOCK 2
#include "lighting.glsl"
#include "paths_block.glsl"
#include "environment.glsl"
#include "redo.glsl"
#include "paths_planes.glsl"

void main()
{
    uint lane = gl_LocalInvocationIndex;
    ivec2 within = ivec2((lane & 3u) | (lane >> 1u & 4u), (lane >> 2u & 1u) | (lane >> 3u & 6u));
    ivec2 at = path_region.xy + 8 * ivec2(gl_WorkGroupID.xy) + within;
    if (at.x >= path_region.z || at.y >= path_region.w) return;
    if (!isinf(texelFetch(plane_t, at, 0).x)) {
        uint slot = atomicAdd(redo_count, 1u);
        redo_entry[slot].xy = uvec2(uint(at.x) | uint(at.y) << 16u, slot);
    }
#if defined(SKY) || defined(ENVIRONMENT)
    else
        imageStore(plane_lit, at, vec4(environment_color(vec3(path_first_way(vec2(at) + 0.5))) * background.a, background.a));
#endif
}
