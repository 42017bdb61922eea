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

float spline_v0, spline_v1, spline_g0, spline_g1; // values and slopes at both ends of the piece
float spline_b[DEGREE + 1];

void piece_begin()
{
    spline_v0 = spline_v1 = spline_g0 = spline_g1 = 0.0;
}

void piece_take(Chord chord, float s, float stop)
{
    bool rising = s < 0.5 * (chord.a + chord.b);
    spline_add(chord, chord.strength, s, rising, spline_v0, spline_g0);
    spline_add(chord, chord.strength, stop, rising, spline_v1, spline_g1);
}

bool piece_may(float s, float stop, float side)
{
    float third = (stop - s) / 3.0;
    spline_b[0] = -side * (spline_v0 - level.x);
    spline_b[1] = -side * (spline_v0 + third * spline_g0 - level.x);
    spline_b[2] = -side * (spline_v1 - third * spline_g1 - level.x);
    spline_b[3] = -side * (spline_v1 - level.x);
    return max(max(spline_b[0], spline_b[1]), max(spline_b[2], spline_b[3])) >= 0.0;
}

int piece_solve(float s, float stop, float side, int steps, out float hit)
{
    float x;
    int found = bernstein_first(spline_b, 0.0, steps, x);
    hit = s + x * (stop - s);
    // A model is not certified: what its rounding leaves open counts as the root when the value is there, else as none.
    if (found == PIECE_OPEN || found == PIECE_CAP) found = spline_b[0] >= 0.0 ? PIECE_HIT : PIECE_NONE;
    return found;
}
