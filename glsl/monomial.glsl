// The paper's formulas as written (Szecsi & Illes 2012, section 4), kept to be compared with: one running cubic in powers of the
// ray parameter, changed at every separator. Its slip is mended (the factor is the density in the middle of the chord, not at the
// separator, where it is zero at both ends); the fold of peak / Q^3 keeps short chords finite.

vec4 monomial_w; // coefficients of s^3, s^2, s, 1

// Change of the coefficients: at the entry (alpha + beta), in the middle (-2 alpha), at the exit (alpha - beta).
vec4 monomial_change(Chord chord, float q, float s, float alpha_times, float beta_times)
{
    float half_length = 0.5 * (chord.b - chord.a);
    float cube = q * density_over_cube(KERNEL, 1.0 - half_length * half_length * chord.shrink) * chord.shrink * sqrt(chord.shrink);
    vec4 alpha = vec4(-2.0, 6.0 * s, -6.0 * s * s, 2.0 * s * s * s);
    vec4 beta = half_length * vec4(0.0, 3.0, -6.0 * s, 3.0 * s * s);
    return cube * (alpha_times * alpha + beta_times * beta);
}

// The running cubic from scratch at s, where the walk begins or comes out of a gap.
void monomial_begin(float s)
{
    monomial_w = vec4(0.0);
    EACH_ACTIVE(j) {
        Chord chord = active_chord(j);
        float middle = 0.5 * (chord.a + chord.b);
        monomial_w += monomial_change(chord, chord.strength, chord.a, 1.0, 1.0);
        if (middle <= s) monomial_w += monomial_change(chord, chord.strength, middle, -2.0, 0.0);
    }
}

// Everything that happens in (s, stop]: entries, middles and exits.
void monomial_pass(float s, float stop)
{
    for (int j = 0; j < slot_count; j++) {
        Chord chord = active_chord(j);
        float q = chord.strength;
        float middle = 0.5 * (chord.a + chord.b);
        if (chord.b <= s) continue;
        if (chord.a > s && chord.a <= stop) monomial_w += monomial_change(chord, q, chord.a, 1.0, 1.0);
        if (middle > s && middle <= stop) monomial_w += monomial_change(chord, q, middle, -2.0, 0.0);
        if (chord.b <= stop) monomial_w += monomial_change(chord, q, chord.b, 1.0, -1.0);
    }
}

float monomial_at(float s, float side)
{
    return -side * (((monomial_w.x * s + monomial_w.y) * s + monomial_w.z) * s + monomial_w.w - level.x);
}

void piece_begin()
{
}

void piece_take(Chord chord, float s, float stop)
{
}

bool piece_may(float s, float stop, float side)
{
    return true;
}

// The first place in [s, stop] where the cubic is above zero, if its ends or its turning points show one.
int piece_solve(float s, float stop, float side, int steps, out float hit)
{
    float low = s, high = stop;
    hit = s;
    if (monomial_at(low, side) >= 0.0) return PIECE_HIT;
    if (monomial_at(high, side) < 0.0) {
        // Not the monotonous case of the paper, or no root: look at the turning points of the cubic.
        vec3 d = -side * vec3(3.0 * monomial_w.x, 2.0 * monomial_w.y, monomial_w.z);
        float square = d.y * d.y - 4.0 * d.x * d.z;
        if (square <= 0.0) return PIECE_NONE;
        float root = -0.5 * (d.y + (d.y < 0.0 ? -sqrt(square) : sqrt(square)));
        float first = root / d.x, second = d.z / root;
        float top = monomial_at(first, side) > monomial_at(second, side) ? first : second;
        if (!(top > s && top < stop) || monomial_at(top, side) < 0.0) return PIECE_NONE;
        high = top;
    }
    for (int step = 0; step < steps && step < 24; step++) {
        float middle = 0.5 * (low + high);
        if (monomial_at(middle, side) < 0.0)
            low = middle;
        else
            high = middle;
    }
    hit = 0.5 * (low + high);
    return PIECE_HIT;
}
