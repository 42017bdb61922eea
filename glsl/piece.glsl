// The true field of a polynomial kernel on one piece of the ray, [s, stop], between neighbouring ends of chords.
//
// There w = (s - a)(b - s) / R^2 of an active ball is a quadratic whose three Bernstein coefficients are products of positive
// differences; the kernel, a polynomial in w, has coefficients that are sums of products of those. With positive strengths the
// sum over the balls cancels nothing.

// Adds q k of one chord to the coefficients, those between the ends times piece_parts; returns the most that w reaches.
//
// With c0, c1, c2 of w and p = c0 c2 the products of Bernstein polynomials come to
//   w^2    c0^2, c0 c1, (p + 2 c1^2) / 3, c1 c2, c2^2
//   w^3    c0^3, c0^2 c1, c0 (p + 4 c1^2) / 5, c1 (3 p + 2 c1^2) / 5, c2 (p + 4 c1^2) / 5, c1 c2^2, c2^3
//   w^4    with e of w^2 times 1, 1, 3, 1, 1: e0^2, e0 e1, (e0 e2 + 4 e1^2) / 7, (e0 e3 + 2 e1 e2) / 7,
//          (e0 e4 + 16 e1 e3 + 2 e2^2) / 35, (e1 e4 + 2 e2 e3) / 7, (e2 e4 + 4 e3^2) / 7, e3 e4, e4^2
REAL piece_add(inout KEPT b[DEGREE + 1], Chord chord, REAL q, REAL s, REAL stop)
{
    precise REAL head_a = s - chord.a;
    precise REAL head_b = chord.b - s;
    precise REAL tail_a = stop - chord.a;
    precise REAL tail_b = chord.b - stop;
    REAL c0 = head_a * head_b * chord.shrink;
    REAL c1 = NUM(0.5) * (head_a * tail_b + tail_a * head_b) * chord.shrink;
    REAL c2 = tail_a * tail_b * chord.shrink;
    REAL p = c0 * c2;
    REAL m = c1 * c1;
#if KERNEL == DENSITY_POLY3
    REAL outer = q * (p + NUM(4.0) * m);
    REAL e0 = q * c0 * c0;
    REAL e2 = q * c2 * c2;
    kept_add(b[0], e0 * c0);
    kept_add(b[1], e0 * c1);
    kept_add(b[2], outer * c0);
    kept_add(b[3], q * c1 * (NUM(3.0) * p + NUM(2.0) * m));
    kept_add(b[4], outer * c2);
    kept_add(b[5], e2 * c1);
    kept_add(b[6], e2 * c2);
#else
    REAL e0 = c0 * c0;
    REAL e1 = c0 * c1;
    REAL e2 = p + NUM(2.0) * m;
    REAL e3 = c1 * c2;
    REAL e4 = c2 * c2;
#if KERNEL == DENSITY_POLY2
    kept_add(b[0], q * e0);
    kept_add(b[1], q * e1);
    kept_add(b[2], q * e2);
    kept_add(b[3], q * e3);
    kept_add(b[4], q * e4);
#elif KERNEL == DENSITY_POLY4
    kept_add(b[0], q * e0 * e0);
    kept_add(b[1], q * e0 * e1);
    kept_add(b[2], q * (e0 * e2 + NUM(4.0) * e1 * e1));
    kept_add(b[3], q * (e0 * e3 + NUM(2.0) * e1 * e2));
    kept_add(b[4], q * (e0 * e4 + NUM(16.0) * e1 * e3 + NUM(2.0) * e2 * e2));
    kept_add(b[5], q * (e1 * e4 + NUM(2.0) * e2 * e3));
    kept_add(b[6], q * (e2 * e4 + NUM(4.0) * e3 * e3));
    kept_add(b[7], q * e3 * e4);
    kept_add(b[8], q * e4 * e4);
#else
    // Times (5 + 4w) / 9.
    REAL f0 = q * (NUM(5.0) + NUM(4.0) * c0);
    REAL f1 = q * (NUM(5.0) + NUM(4.0) * c1);
    REAL f2 = q * (NUM(5.0) + NUM(4.0) * c2);
    kept_add(b[0], e0 * f0);
    kept_add(b[1], NUM(2.0) * e1 * f0 + e0 * f1);
    kept_add(b[2], NUM(2.0) * e2 * f0 + NUM(8.0) * e1 * f1 + e0 * f2);
    kept_add(b[3], e3 * f0 + e2 * f1 + e1 * f2);
    kept_add(b[4], e4 * f0 + NUM(8.0) * e3 * f1 + NUM(2.0) * e2 * f2);
    kept_add(b[5], e4 * f1 + NUM(2.0) * e3 * f2);
    kept_add(b[6], e4 * f2);
#endif
#endif
    return max(c0, max(c1, c2));
}

// What piece_add leaves to be done once a piece.
void piece_parts(inout KEPT b[DEGREE + 1])
{
#if KERNEL == DENSITY_POLY2
    b[2] = keep(kept(b[2]) * (NUM(1.0) / NUM(3.0)));
#elif KERNEL == DENSITY_POLY3
    for (int i = 2; i < 5; i++) b[i] = keep(kept(b[i]) * (NUM(1.0) / NUM(5.0)));
#elif KERNEL == DENSITY_POLY4
    for (int i = 2; i < 7; i++) b[i] = keep(kept(b[i]) * (NUM(1.0) / (i == 4 ? NUM(35.0) : NUM(7.0))));
#else
    const float over[DEGREE + 1] = float[](9.0, 27.0, 135.0, 45.0, 135.0, 27.0, 9.0);
    for (int i = 0; i <= DEGREE; i++) b[i] = keep(kept(b[i]) * (NUM(1.0) / NUM(over[i])));
#endif
}

KEPT piece_b[DEGREE + 1];  // the field on the piece, as piece_add makes it; from piece_may on less L, turned so that the ray comes from below zero
REAL piece_margin;         // the rounding that each coefficient may carry

void piece_begin()
{
    for (int i = 0; i <= DEGREE; i++) piece_b[i] = keep(NUM(0.0));
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
    piece_parts(piece_b);
#if defined(EYE_INSIDE) || defined(EYE_ON) || defined(BOTH_SIDES)
    for (int i = 0; i <= DEGREE; i++) piece_b[i] = keep((level.x - kept(piece_b[i])) * side);
#else
    for (int i = 0; i <= DEGREE; i++) kept_add(piece_b[i], -level.x);
#endif
    return bernstein_sees(piece_b, piece_margin) != SEES_NONE;
}

#ifdef PATHS
// Of a ray that leaves the surface at s, on a piece that piece_may did not refuse: up to where the field surely is on the ray's side,
// but for the start itself; s where rounding could decide. b[0] is zero, to rounding, and the first slope says that it falls; that
// over a bound on the second derivative is a way on which it does not turn.
REAL piece_leave(REAL s, REAL stop, REAL side)
{
    REAL doubt = piece_margin + abs(kept(piece_b[0]));
    REAL most = kept(piece_b[1]);
    REAL bend = NUM(0.0);
    for (int i = 2; i <= DEGREE; i++) {
        most = max(most, kept(piece_b[i]));
        bend = max(bend, abs(kept(piece_b[i]) - NUM(2.0) * kept(piece_b[i - 1]) + kept(piece_b[i - 2])));
    }
    if (doubt > LEAVE_DOUBT * piece_margin) return s; // the start is not where it should be
    if (most < -doubt) return stop;
    bend *= NUM(DEGREE * (DEGREE - 1));
    REAL slope = NUM(DEGREE) * (kept(piece_b[1]) - kept(piece_b[0]));
    if (!(slope < NUM(0.0))) return s;
    REAL x = -slope / max(bend, -slope);
    REAL value = kept(piece_b[0]) + x * (slope + NUM(0.5) * bend * x);
    return value < NUM(-2.0) * piece_margin ? s + x * (stop - s) : s;
}
#endif

// The first sign change of the field on a piece that piece_may did not refuse.
int piece_solve(REAL s, REAL stop, REAL side, int steps, out REAL hit)
{
    REAL x;
    hit = s;
#ifdef EYE_IN_BALL
    // Which side the ray starts on must be certain too.
    if (s <= RAY_BEGIN && !(kept(piece_b[0]) < -piece_margin)) return PIECE_OPEN;
#endif
    int found = bernstein_first(piece_b, piece_margin, steps, x);
    hit = s + x * (stop - s);
    return found;
}
