// Leaps of a walk over a crowd: far over many balls' ends at once, where a sum of bounds stays on its side of L.
//
// Walked from end to end, n balls around one place cost n pieces of n balls each. Over a stretch [s, s + h] of the ray a ball's density
// lies between what it is at the end further from the chord's middle and at the place nearest to it (zero beyond the chord's
// ends); the sums of these bound f. A few lengths h are tried at once, and the longest that is clear is taken: towards the root they
// shrink like a geometric series, so that a crowd is read some tens of times, not n times.
//
// Where the balls come from is the includer's: LEAP_EACH(s, to) statement goes over those that reach beyond s, all that begin before
// `to` among them, with LEAP_CHORD; behind it LEAP_STOP is the next place, of those gone over, at which a chord begins or ends.

const int LEAPS = 6;                       // lengths, each a quarter of the one before
const REAL LEAP_SUM = NUM(0.125) * TAU;    // what adding one more number may round, relative to the sum: well above a half step

KEPT leap_sum[LEAPS];    // the most that f can be, seen from outside; the least, from inside
KEPT leap_size[LEAPS];   // of the sums of absolute values
KEPT leap_margin[LEAPS]; // of rounding, over TAU

void leap_begin()
{
    for (int k = 0; k < LEAPS; k++) leap_sum[k] = leap_size[k] = leap_margin[k] = keep(NUM(0.0));
}

// Adds a ball to the stretch [s, to]; nothing where it does not reach into it.
void leap_add(Chord chord, REAL s, REAL to, bool high, inout KEPT sum, inout KEPT size, inout KEPT margin)
{
    REAL middle = NUM(0.5) * (chord.a + chord.b);
    REAL near = clamp(middle, s, to);
    REAL far = abs(s - middle) > abs(to - middle) ? s : to;
    REAL most = clamp((near - chord.a) * (chord.b - near) * chord.shrink, NUM(0.0), NUM(1.0));
    REAL least = clamp((far - chord.a) * (chord.b - far) * chord.shrink, NUM(0.0), NUM(1.0));
    kept_add(sum, chord.strength * density_value(KERNEL, NUM(1.0) - (high ? most : least)));
    kept_add(size, abs(chord.strength) * density_value(KERNEL, NUM(1.0) - most));
    kept_add(margin, abs(chord.strength) * density_slope_bound(KERNEL, most) * chord_reach(chord, to));
}

// Adds it to [s, s + h], [s, s + h/4], ... A loop would cost a driver's count of rounds (loops.glsl) six for each ball.
void leap_take(Chord chord, REAL s, REAL h, REAL side)
{
    bool high = (chord.strength > NUM(0.0)) == (side < NUM(0.0));
    leap_add(chord, s, s + h, high, leap_sum[0], leap_size[0], leap_margin[0]);
    leap_add(chord, s, s + NUM(0.25) * h, high, leap_sum[1], leap_size[1], leap_margin[1]);
    leap_add(chord, s, s + NUM(0.0625) * h, high, leap_sum[2], leap_size[2], leap_margin[2]);
    leap_add(chord, s, s + NUM(0.015625) * h, high, leap_sum[3], leap_size[3], leap_margin[3]);
    leap_add(chord, s, s + NUM(0.00390625) * h, high, leap_sum[4], leap_size[4], leap_margin[4]);
    leap_add(chord, s, s + NUM(0.0009765625) * h, high, leap_sum[5], leap_size[5], leap_margin[5]);
}

// How far from s on, at most h, f surely stays on its side of L: s where nothing is proven. Then `stop` is the end of a piece to be
// searched, no further than any of the balls' ends, and near: what a search allows for rounding grows with the piece.
REAL leap_clear(REAL s, REAL h, REAL side, out REAL stop)
{
    REAL count = NUM(0.0);
    leap_begin();
    LEAP_EACH(s, s + h) {
        leap_take(LEAP_CHORD, s, h, side);
        count += NUM(1.0);
    }
    stop = LEAP_STOP;
    for (int k = 0; k < LEAPS; k++) {
        REAL doubt = TAU * kept(leap_margin[k]) + LEAP_SUM * count * kept(leap_size[k]);
        if (side * (kept(leap_sum[k]) - level.x) > doubt) return s + h > stop ? s + h : s;
        h *= NUM(0.25);
    }
#if KERNEL > DENSITY_WYVILL
    if (s + NUM(16.0) * h > s) stop = min(stop, s + NUM(16.0) * h);
#endif
    return s;
}
