// What a dispatch leaves to the next, and the counts of why. Of a cast the pixels: long walks and crowded ones go on in float over the
// whole list or leaf, and what float cannot decide is solved again in doubles. Of light beyond the first hits the walks, in lists of
// their own within redo_entry (paths_store.glsl).

layout(std430, binding = 3) buffer Redo {
    uint redo_count;
    uint count_disorder;   // pixels whose list was out of order: to be sorted and cast again
    uint count_active;     // pixels whose active set outgrew the slots
    uint count_steps;      // pixels whose walk or root search took too many steps for the cast; light's walks that wait in float
    uint count_float;      // pixels that float could not decide; light's walks that wait for doubles
    uint count_undecided;  // pixels that doubles left open
    uint count_unfinished; // entries that wait for another dispatch
    uint count_spare;      // rays traced by light's walks
    uvec4 redo_entry[];    // pixel x + 65536 y; of a cast: state + 4 * the walk's own; where the walk has come to, as bits
};

const uint REDO_FLOAT = 1u;   // walk on in float
const uint REDO_DOUBLE = 2u;  // solve in doubles
const uint REDO_DONE = 3u;

void redo_add(vec2 position, uint state, float s)
{
    uint at = atomicAdd(redo_count, 1u);
    redo_entry[at] = uvec4(uint(position.x) | uint(position.y) << 16u, state, floatBitsToUint(s), 0u);
}
