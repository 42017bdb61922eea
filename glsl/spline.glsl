// The paper's model in a local basis: each ball's density along the ray becomes two cubics, from its entry to its middle and on to
// its exit (Szecsi & Illes 2012, section 3); on a piece their sum is the cubic through its values and slopes at both ends. The
// model errs by several percent of R; its numbers do not.

// Value and slope at s of a chord's spline: peak (3 z^2 - 2 z^3), z running from 0 at the nearer end to 1 in the middle.
void spline_add(Chord chord, float q, float s, bool rising, inout float value, inout float slope)
{
    float half_length = 0.5 * (chord.b - chord.a);
    float peak = q * density_value(KERNEL, 1.0 - half_length * half_length * chord.shrink);
    float z = clamp((rising ? s - chord.a : chord.b - s) / half_length, 0.0, 1.0);
    value += peak * z * z * (3.0 - 2.0 * z);
    slope += (rising ? 6.0 : -6.0) * peak * z * (1.0 - z) / half_length;
}

// Middles of chords are separators too.
float piece_stop(float s, float stop)
{
    EACH_ACTIVE(j) {
        Chord chord = active_chord(j);
        float middle = 0.5 * (chord.a + chord.b);
        if (middle > s) stop = min(stop, middle);
    }
    return stop;
}

int piece_solve(float s, float stop, float side, int steps, out float hit)
{
    float v0 = 0.0, v1 = 0.0, g0 = 0.0, g1 = 0.0;
    EACH_ACTIVE(j) {
        Chord chord = active_chord(j);
        float q = active_strength(j);
        bool rising = s < 0.5 * (chord.a + chord.b);
        spline_add(chord, q, s, rising, v0, g0);
        spline_add(chord, q, stop, rising, v1, g1);
    }
    float third = (stop - s) / 3.0;
    float b[DEGREE + 1];
    b[0] = -side * (v0 - level.x);
    b[1] = -side * (v0 + third * g0 - level.x);
    b[2] = -side * (v1 - third * g1 - level.x);
    b[3] = -side * (v1 - level.x);
    float x;
    int found = bernstein_first(b, 0.0, steps, x);
    hit = s + x * (stop - s);
    // A model is not certified: what its rounding leaves open counts as the root when the value is there, else as none.
    if (found == PIECE_OPEN || found == PIECE_CAP) found = b[0] >= 0.0 ? PIECE_HIT : PIECE_NONE;
    return found;
}
