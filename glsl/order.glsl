// Puts every pixel's list in order of effective distance, which is the order of the balls: for drivers that run fragments out of
// the order in which they were drawn, which GL allows.
#define LISTS_ACCESS
#include "lists.glsl"
#include "redo.glsl"
#include "loops.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(location = 0) uniform int two; // 2
layout(location = 1) uniform ivec4 region; // lower left corner, size: other lists may be a former region's

bool list_before(uint node_a, uint node_b)
{
    return list_nodes[node_a].x < list_nodes[node_b].x;
}
#include "list_sort.glsl"

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy) + region.xy;
    if (any(greaterThanEqual(at, region.xy + region.zw))) return;
    uint head = imageLoad(list_heads, at).x;
    bool ordered = true;
    for (uint node = head; node != NO_NODE;) {
        uvec4 link = list_nodes[node];
        if (link.y != NO_NODE && list_nodes[link.y].x < link.x) ordered = false;
        node = link.y;
    }
    if (!ordered) imageStore(list_heads, at, uvec4(list_sort(head)));
    if (!loops_whole(two)) atomicAdd(count_disorder, 1u); // the driver cut the sort short: nodes may be lost
}
