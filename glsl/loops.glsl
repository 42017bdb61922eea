// A driver may end loops by force (llvmpipe: 65,535 rounds an invocation, all loops together). What ran until then cannot be
// trusted, so every walk ends with this: false where loops no longer run their rounds. `two` must be 2, and not a constant.
bool loops_whole(int two)
{
    int rounds = 0;
    for (int i = 0; i < two; i++) rounds++;
    return rounds == 2;
}
