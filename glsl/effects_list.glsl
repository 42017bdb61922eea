// The pixels that see a surface, one after the other, as entries that have not been begun (paths_store.glsl); those that see none are lit already. So the
// passes that follow, whose text is long, run on full groups. Compute shader, a pixel an invocation, eight neighbours a block of 4x2 pixels.
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
    if (isinf(texelFetch(plane_t, at, 0).x)) {
        vec3 color = environment_color(vec3(path_first_way(vec2(at) + 0.5)));
        paths_write(at, vec4(color * background.a, background.a), vec4(1.0, 1.0, PATH_NOTHING, PATH_NOTHING), true);
    } else {
        uint slot = atomicAdd(redo_count, 1u);
        redo_entry[slot] = uvec4(uint(at.x) | uint(at.y) << 16u, slot, 0u, 0u);
    }
}
