// The true field of a polynomial kernel on one piece of the ray, [s, stop], between neighbouring ends of chords.
//
// There w = (s - a)(b - s) / R^2 of an active ball is a quadratic whose three Bernstein coefficients are products of positive
// differences; the kernel, a polynomial in w, has coefficients that are sums of products of those. With positive strengths the
// sum over the balls cancels nothing.

// Adds q k of one chord to the coefficients; returns the most that w reaches.
REAL piece_add(inout REAL b[DEGREE + 1], Chord chord, REAL q, REAL s, REAL stop)
{
    precise REAL head_a = s - chord.a;
    precise REAL head_b = chord.b - s;
    precise REAL tail_a = stop - chord.a;
    precise REAL tail_b = chord.b - stop;
    REAL c0 = head_a * head_b * chord.shrink;
    REAL c1 = NUM(0.5) * (head_a * tail_b + tail_a * head_b) * chord.shrink;
    REAL c2 = tail_a * tail_b * chord.shrink;
    // The square of w, degree 4.
    REAL e0 = c0 * c0;
    REAL e1 = c0 * c1;
    REAL e2 = (c0 * c2 + NUM(2.0) * c1 * c1) / NUM(3.0);
    REAL e3 = c1 * c2;
    REAL e4 = c2 * c2;
#if KERNEL == DENSITY_POLY2
    b[0] += q * e0;
    b[1] += q * e1;
    b[2] += q * e2;
    b[3] += q * e3;
    b[4] += q * e4;
#elif KERNEL == DENSITY_POLY4
    b[0] += q * e0 * e0;
    b[1] += q * e0 * e1;
    b[2] += q * (NUM(3.0) * e0 * e2 + NUM(4.0) * e1 * e1) / NUM(7.0);
    b[3] += q * (e0 * e3 + NUM(6.0) * e1 * e2) / NUM(7.0);
    b[4] += q * (e0 * e4 + NUM(16.0) * e1 * e3 + NUM(18.0) * e2 * e2) / NUM(35.0);
    b[5] += q * (e1 * e4 + NUM(6.0) * e2 * e3) / NUM(7.0);
    b[6] += q * (NUM(3.0) * e2 * e4 + NUM(4.0) * e3 * e3) / NUM(7.0);
    b[7] += q * e3 * e4;
    b[8] += q * e4 * e4;
#else
    // Times a third factor of degree 2: w itself, or (5 + 4w) / 9.
#if KERNEL == DENSITY_WYVILL
    REAL f0 = q * (NUM(5.0) + NUM(4.0) * c0) / NUM(9.0);
    REAL f1 = q * (NUM(5.0) + NUM(4.0) * c1) / NUM(9.0);
    REAL f2 = q * (NUM(5.0) + NUM(4.0) * c2) / NUM(9.0);
#else
    REAL f0 = q * c0;
    REAL f1 = q * c1;
    REAL f2 = q * c2;
#endif
    b[0] += e0 * f0;
    b[1] += (NUM(2.0) * e1 * f0 + e0 * f1) / NUM(3.0);
    b[2] += (NUM(6.0) * e2 * f0 + NUM(8.0) * e1 * f1 + e0 * f2) / NUM(15.0);
    b[3] += (e3 * f0 + NUM(3.0) * e2 * f1 + e1 * f2) / NUM(5.0);
    b[4] += (e4 * f0 + NUM(8.0) * e3 * f1 + NUM(6.0) * e2 * f2) / NUM(15.0);
    b[5] += (e4 * f1 + NUM(2.0) * e3 * f2) / NUM(3.0);
    b[6] += e4 * f2;
#endif
    return max(c0, max(c1, c2));
}

REAL piece_b[DEGREE + 1];  // the field on the piece; from piece_may on less L, turned so that the ray comes from below zero
REAL piece_margin;         // the rounding that each coefficient may carry

void piece_begin()
{
    for (int i = 0; i <= DEGREE; i++) piece_b[i] = NUM(0.0);
    piece_margin = NUM(0.0);
}

// Adds an active ball on [s, stop].
void piece_take(Chord chord, REAL s, REAL stop)
{
    REAL most = piece_add(piece_b, chord, chord.strength, s, stop);
    piece_margin += abs(chord.strength) * density_slope_bound(KERNEL, most) * chord_reach(chord, stop);
}

// All active balls taken: false where the field surely has no sign change on the piece. side: -1 from outside, 1 from inside.
bool piece_may(REAL s, REAL stop, REAL side)
{
    piece_margin *= TAU;
#if defined(EYE_INSIDE) || defined(EYE_ON)
    for (int i = 0; i <= DEGREE; i++) piece_b[i] = (level.x - piece_b[i]) * side;
#else
    for (int i = 0; i <= DEGREE; i++) piece_b[i] -= level.x;
#endif
    return bernstein_sees(piece_b, piece_margin) != SEES_NONE;
}

// The first sign change of the field on a piece that piece_may did not refuse.
int piece_solve(REAL s, REAL stop, REAL side, int steps, out REAL hit)
{
    REAL x;
    hit = s;
#ifdef EYE_IN_BALL
    // Which side the ray starts on must be certain too.
    if (s <= RAY_BEGIN && !(piece_b[0] < -piece_margin)) return PIECE_OPEN;
#endif
    int found = bernstein_first(piece_b, piece_margin, steps, x);
    hit = s + x * (stop - s);
    return found;
}
