// The slow path of a tree's frame that is always right: pixels that the cast could not hold go on in float, pixels that float could
// not decide are solved in doubles (MNS_DOUBLE), by the same pieces, over all references of the leaves along the ray. Compute
// shader, one invocation an entry of the redo list; a walk that takes long is left at a piece's end and taken up by the next
// dispatch.
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#include "far.glsl"
#include "balls.glsl"
#include "tree.glsl"
#include "chord.glsl"
#include "loops.glsl"
#include "side.glsl"
#include "active_references.glsl"
#include "leap.glsl"
#include "exact.glsl"
#include "surface.glsl"
#include "planes.glsl"
#include "redo.glsl"
#ifdef HOST_DEPTH
#include "host.glsl"
#endif
#include "resolve_entry.glsl"
#include "tree_walk.glsl"

void main()
{
    uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(REDO_GROUP);
    if (index >= redo_count) return;
    uvec4 entry = redo_entry[index];
    if (entry.y != RESOLVE_STATE) return;
    ivec2 at = ivec2(entry.x & 0xffffu, entry.x >> 16u);
    vec2 position = vec2(at) + 0.5;
    leaf_ray = view_ray(position);
    tree_aim(vec3(leaf_ray.start), vec3(leaf_ray.way));
    REAL limit = FAR_AWAY;
#ifdef HOST_DEPTH
    limit = REAL(host_limit(position));
#endif
    side_take(leaf_ray);
    REAL s = max(resolve_unpack(entry.zw), RAY_BEGIN);
    int found = resolve_walk(limit, SIDE, s);
    Surface surface = surface_none();
    if (found == PIECE_HIT) surface = surface_at(leaf_ray, s);
    resolve_finish(index, entry, 0u, found, s, surface);
}
