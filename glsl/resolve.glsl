// The slow path that is always right: pixels that the cast could not hold go on in float, pixels that float could not decide are
// solved in doubles (MNS_DOUBLE), by the same pieces, over the pixel's whole list. Compute shader, one invocation an entry of the redo
// list; a walk that takes long is left at a piece's end and taken up by the next dispatch.
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#include "far.glsl"
#include "balls.glsl"
#define LISTS_ACCESS readonly
#include "lists.glsl"
#include "chord.glsl"
#include "stream.glsl"
#include "side.glsl"
#include "loops.glsl"
#include "active_links.glsl"
#include "leap.glsl"
#include "exact.glsl"
#include "surface.glsl"
#include "planes.glsl"
#include "redo.glsl"
#ifdef HOST_DEPTH
#include "host.glsl"
#endif
#include "resolve_entry.glsl"

// Walks on from s until there is a verdict, or too much work for one dispatch.
int resolve_walk(REAL limit, inout REAL s)
{
    while (links_work < WALK_BUDGET) {
        REAL stop;
        bool crowded = links_crowded(s);
        if (links_wait(links_work)) break;
        REAL clear = s;
        if (crowded)
            clear = leap_clear(s, links_leap(), SIDE, stop);
        else
            stop = links_stop(s);
        if (links_cut) break;
        if (clear > s) {
            s = clear;
            continue;
        }
        if (stop == FAR_AWAY || s >= limit) return PIECE_NONE;
        piece_begin();
        EACH_ACTIVE(j) piece_take(active_chord(j), s, stop);
        if (piece_may(s, stop, SIDE)) {
            REAL hit;
            int found = piece_solve(s, stop, SIDE, RESOLVE_SEARCH, hit);
            links_work += 64;
            if (found != PIECE_NONE) {
                s = hit;
                return found == PIECE_HIT && s > limit ? PIECE_NONE : found;
            }
        }
        s = stop;
    }
    return PIECE_LATER;
}

void main()
{
    uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(REDO_GROUP);
    if (index >= redo_count) return;
    uvec4 entry = redo_entry[index];
    if ((entry.y & 3u) != RESOLVE_STATE) return;
    ivec2 at = ivec2(entry.x & 0xffffu, entry.x >> 16u);
    vec2 position = vec2(at) + 0.5;
    links_ray = view_ray(position);
#ifdef TILES
    list_ray = links_ray;
#endif
    links_first = entry.y >> 2u;
    uint head = list_head(at);
    if (links_first == NO_NODE) links_first = head;
    links_past = links_first;
    REAL limit = FAR_AWAY;
#ifdef HOST_DEPTH
    limit = REAL(host_limit(position));
#endif
    side_take(links_ray);
    REAL s = max(resolve_unpack(entry.zw), RAY_BEGIN);
    int found = resolve_walk(limit, s);
    Surface surface = surface_none();
    if (found == PIECE_HIT) surface = surface_at(links_ray, s);
    resolve_finish(index, entry, links_first, found, s, surface);
}
