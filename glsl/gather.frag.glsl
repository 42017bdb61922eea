// Gathering (Szecsi & Illes 2012, section 5): every fragment whose ray meets the effective sphere becomes a node of its pixel's
// list. Early z: the quad stands at its sphere's nearest point and is tested against the core depth, writing none. As in the paper
// (GATHER_PAPER): the entry of the effective interval is clipped against the core depth here.
#ifdef EARLY_Z
layout(early_fragment_tests) in;
#endif
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#define LISTS_ACCESS
#include "lists.glsl"
#include "sight.glsl"

flat in vec4 sphere; // in the camera's axes
flat in float slack;  // what a float calls a miss must be one in doubles, which may read this list again
flat in uint ball;

layout(binding = 0, offset = 0) uniform atomic_uint node_count;
layout(location = 1) uniform uint node_capacity;
#ifdef GATHER_PAPER
layout(binding = 1) uniform sampler2D core_depth;
#endif

void main()
{
    Sight sight = sight_of(gl_FragCoord.xy);
    vec2 chord;
    if (!sight_chord(sight, sphere.xyz, sphere.w, slack, chord)) discard;
#ifdef EYE_IN_BALL
    if (chord.y + slack < 0.0) discard;
#endif
#ifdef GATHER_PAPER
    float entry = chord.x + sight_excess(sight);
    if (entry * depth.x > texelFetch(core_depth, ivec2(gl_FragCoord.xy), 0).x) discard;
#endif
    uint node = atomicCounterIncrement(node_count) + 1u;
    if (node >= node_capacity) discard;
    uint after = imageAtomicExchange(list_heads, ivec2(gl_FragCoord.xy), node);
    list_nodes[node] = uvec4(ball, after, floatBitsToUint(chord));
}
