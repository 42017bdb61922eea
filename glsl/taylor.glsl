// The true field of any kernel on one piece of the ray, by value, slope and a bound on the second derivative.
//
// From a point where f is known, f(s + h) <= f + f' h + M h^2 / 2 with M a bound on how fast the slopes can rise: stepping to where
// that parabola first comes near L never passes a root. At a point inside the margin, f'^2 > 2 M' (what is missing) proves that f
// rises through L right there, M' bounding the curvature of both signs.

struct Slope {
    REAL value, slope;  // of the field less L, turned so that the ray comes from below zero
};

Slope taylor_at(REAL s, REAL side)
{
    REAL value = NUM(0.0);
    REAL slope = NUM(0.0);
    EACH_ACTIVE(j) {
        Chord chord = active_chord(j);
        REAL q = chord.strength;
        REAL w = clamp((s - chord.a) * (chord.b - s) * chord.shrink, NUM(0.0), NUM(1.0));
        REAL u = NUM(1.0) - w;
        value += q * density_value(KERNEL, u);
        slope += q * density_slope_over_v(KERNEL, u) * (s - NUM(0.5) * (chord.a + chord.b)) * chord.shrink;
    }
    Slope at;
    at.value = side * (level.x - value);
    at.slope = -side * slope;
    return at;
}

REAL taylor_peak;     // no more than this on the piece
REAL taylor_margin;   // of rounding
REAL taylor_rise;     // bound on the second derivative where it helps f towards L from outside
REAL taylor_sink;     // and from inside

void piece_begin()
{
    taylor_peak = taylor_margin = taylor_rise = taylor_sink = NUM(0.0);
}

void piece_take(Chord chord, REAL s, REAL stop)
{
    REAL q = abs(chord.strength);
    REAL middle = clamp(NUM(0.5) * (chord.a + chord.b), s, stop);
    REAL most = clamp((middle - chord.a) * (chord.b - middle) * chord.shrink, NUM(0.0), NUM(1.0));
    taylor_peak += max(chord.strength, NUM(0.0)) * density_value(KERNEL, NUM(1.0) - most);
    REAL reach = chord_reach(chord, stop);
    taylor_margin += q * density_slope_bound(KERNEL, most) * reach;
    most = min(most + NUM(2.0) * TAU * reach, NUM(1.0)); // as far as rounding may have lowered it
    REAL rise = q * chord.shrink * density_rise_bound(KERNEL, most);
    REAL bend = q * chord.shrink * density_curvature_bound(KERNEL, most);
    bool adds = chord.strength > NUM(0.0);
    taylor_rise += adds ? rise : bend;
    taylor_sink += adds ? bend : rise;
}

bool piece_may(REAL s, REAL stop, REAL side)
{
    taylor_margin *= TAU;
    return side > NUM(0.0) || taylor_peak + taylor_margin >= level.x;
}

// The bounds of a part of the piece, from s to `end`.
void taylor_part(REAL s, REAL end)
{
    piece_begin();
    EACH_ACTIVE(j) piece_take(active_chord(j), s, end);
    taylor_margin *= TAU;
}

const int TAYLOR_CLIMB = 12;

// From s, where the field is within the margin of L: goes up through it by steps over which the slope cannot vanish. True: it rises
// through L once, at `hit`.
bool taylor_climbs(REAL s, REAL end, Slope from, REAL side, out REAL hit)
{
    REAL margin = taylor_margin;
    REAL bend = max(taylor_rise, taylor_sink);
    REAL x = s;
    Slope at = from;
    hit = s;
    for (int step = 0; step < TAYLOR_CLIMB && from.value <= NUM(2.0) * margin; step++) {
        if (!(at.slope > NUM(0.0) && at.slope * at.slope > bend * margin)) return false; // else rounding could make it a slope
        x += NUM(0.5) * at.slope / bend;
        if (!(x < end)) return false;
        at = taylor_at(x, side);
        if (at.value > NUM(2.0) * margin) {
            hit = s + (x - s) * clamp(-from.value / (at.value - from.value), NUM(0.0), NUM(1.0));
            return true;
        }
    }
    return false;
}

#ifdef PATHS
// As of polynomials (piece.glsl).
REAL piece_leave(REAL s, REAL stop, REAL side)
{
    Slope at = taylor_at(s, side);
    REAL doubt = taylor_margin + abs(at.value);
    if (doubt > LEAVE_DOUBT * taylor_margin || !(at.slope < NUM(0.0))) return s;
    REAL bend = max(taylor_rise, taylor_sink);
    REAL h = min(-at.slope / bend, stop - s);
    REAL value = at.value + h * (at.slope + NUM(0.5) * bend * h);
    return value < NUM(-3.0) * taylor_margin ? s + h : s;
}
#endif

const int TAYLOR_PARTS = 8;

// What rounding may do goes by the kernels' slopes, and towards the end of a chord these are far less than anywhere on the piece.
// So where nothing is proven, the bounds are taken again over a sixteenth of what lies ahead, and then of that.
int piece_solve(REAL s, REAL stop, REAL side, int steps, out REAL hit)
{
    REAL begin = s;
    REAL end = stop; // the bounds hold up to here
    int parts = 0;
    for (int step = 0; step < steps; step++) {
        hit = s;
        REAL margin = taylor_margin;
        REAL rise = side < NUM(0.0) ? taylor_rise : taylor_sink;
        REAL bend = max(taylor_rise, taylor_sink);
        Slope at = taylor_at(s, side);
        REAL next = s;
        if (at.value < NUM(-2.0) * margin) {
#ifdef PIECE_PAUSE
            // All before s is proven, and so is the side at s: within the margin, what begins there anew could not tell it.
            if (s > begin && PIECE_PAUSE) return PIECE_LATER;
#endif
            REAL lack = -margin - at.value;
            REAL ahead = end - s;
            bool clear = at.value + ahead * (at.slope + NUM(0.5) * rise * ahead) < -margin;
            REAL root = sqrt(at.slope * at.slope + NUM(2.0) * rise * lack);
            REAL h = at.slope > NUM(0.0) ? NUM(2.0) * lack / (at.slope + root) : (root - at.slope) / rise;
            if (clear || !(h < ahead)) {
                if (end == stop) return PIECE_NONE;
                s = end;
                end = stop;
                taylor_part(s, end);
                continue;
            }
            next = s + h;
        } else {
            hit = at.slope > NUM(0.0) ? s - at.value / at.slope : s;
            bool crosses = at.slope > NUM(0.0) && at.slope * at.slope > NUM(4.0) * bend * (NUM(3.0) * margin + abs(at.value));
#ifdef EYE_IN_BALL
            crosses = crosses && s > RAY_BEGIN; // which side the ray starts on must be certain too
#endif
            if (crosses && at.value <= NUM(2.0) * margin) return PIECE_HIT;
#ifdef MNS_DOUBLE
            REAL root;
            if (s > begin && taylor_climbs(s, end, at, side, root)) {
                hit = root;
                return PIECE_HIT;
            }
#endif
        }
        if (next == s) { // no way ahead
            end = s + (end - s) / NUM(16.0);
            if (parts == TAYLOR_PARTS || !(end > s)) return PIECE_OPEN;
            parts++;
            taylor_part(s, end);
        }
        s = next;
    }
    hit = s;
    return PIECE_CAP;
}
