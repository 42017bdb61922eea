// For tests: puts each pixel's list in an order drawn from a seed, as no driver's scheduling would be so unkind to.
#define LISTS_ACCESS
#include "lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(location = 0) uniform uint seed;
layout(location = 1) uniform ivec4 region; // lower left corner, size

uint shuffle_hash(uint x)
{
    x ^= x >> 16u;
    x *= 0x7feb352du;
    x ^= x >> 15u;
    x *= 0x846ca68bu;
    return x ^ x >> 16u;
}

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy) + region.xy;
    if (any(greaterThanEqual(at, region.xy + region.zw))) return;
    uint state = shuffle_hash(seed ^ uint(at.x) * 0x9e3779b9u ^ uint(at.y) * 0x85ebca6bu);
    // Take the nodes off one by one and put each at a random place of what has been put so far.
    uint head = NO_NODE, count = 0u;
    for (uint node = imageLoad(list_heads, at).x; node != NO_NODE;) {
        uint next = list_nodes[node].y;
        state = shuffle_hash(state + 0x6d2b79f5u);
        uint place = state % (count + 1u);
        if (place == 0u) {
            list_nodes[node].y = head;
            head = node;
        } else {
            uint before = head;
            for (uint step = 1u; step < place; step++) before = list_nodes[before].y;
            list_nodes[node].y = list_nodes[before].y;
            list_nodes[before].y = node;
        }
        count++;
        node = next;
    }
    imageStore(list_heads, at, uvec4(head));
}
