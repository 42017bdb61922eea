// The pixels that the cast leaves to resolve, and the counts of why.

layout(std430, binding = 3) buffer Redo {
    uint redo_count;
    uint count_disorder;  // pixels whose list was out of order: to be sorted and cast again
    uint count_active;    // pixels whose active set outgrew the slots
    uint count_steps;     // pixels whose root search hit its cap
    uint count_float;     // pixels that float could not decide
    uint count_undecided; // pixels that doubles left open
    uint count_spare[2];
    uint redo_pixels[];   // x + 65536 y
};

const int REDO_FLOAT = 0, REDO_ACTIVE = 1, REDO_STEPS = 2;

void redo_add(vec2 position, int why)
{
    if (why == REDO_ACTIVE)
        atomicAdd(count_active, 1u);
    else if (why == REDO_STEPS)
        atomicAdd(count_steps, 1u);
    else
        atomicAdd(count_float, 1u);
    uint at = atomicAdd(redo_count, 1u);
    redo_pixels[at] = uint(position.x) | uint(position.y) << 16u;
}
