// A ray's walk from outside the surface: over whole stretches where a sum of bounds stays below L, and from separator to separator only
// where it does not.
//
// A ball is on no stretch denser than at the place there that is nearest to its chord's middle, so n balls are passed over with n
// numbers where pieces would take n^2 polynomials. Balls of negative strength count as nothing. Where a stretch may hold the hit
// it is halved, and what is left is gone over piece by piece. A piece always reaches from separator to separator, wherever the
// bounds have left off: the hit is then the same to its last bit, whatever else is in the list.

const float WALK_STEP = 0.125;    // of the next ball's radius: balls that begin nearer to each other are bounded together
const int WALK_HALVES = 2;
const float WALK_SUM = 1.0 + 1.2e-7 * float(SLOTS + 8); // what a sum over the slots may lose by rounding

float walk_here = 0.0;  // no more than this is f on the stretch
float walk_rest = 0.0;  // and this beyond it, by the balls taken so far
float walk_last = 0.0;  // where the last chord ends
float walk_begin = 0.0; // the last separator not after where the walk is

// No less than the ball's density on the ray where w has this value, for all that rounding may have moved the ball (chord_reach).
float walk_most(Chord chord, float w)
{
    float widen = 2.0 * TAU * chord_reach(chord, chord.b);
    return max(chord.strength, 0.0) * density_value(KERNEL, 1.0 - clamp(w + widen, 0.0, 1.0));
}

void walk_add(int j, float s, float end)
{
    Chord chord = active_chord(j);
    float middle = 0.5 * (chord.a + chord.b);
    float near = clamp(middle, s, end);
    float later = max(middle, end);
    walk_here += walk_most(chord, (near - chord.a) * (chord.b - near) * chord.shrink);
    walk_rest += walk_most(chord, (later - chord.a) * (chord.b - later) * chord.shrink);
    walk_last = max(walk_last, chord.b);
    bool past = chord.b <= s;
    slot_free = past ? min(slot_free, j) : slot_free;
    walk_begin = past ? max(walk_begin, chord.b) : walk_begin;
}

// Bounds f on [s, end] and beyond. False where it may reach L on the stretch.
bool walk_clear(float s, float end)
{
    walk_here = 0.0;
    walk_rest = 0.0;
    walk_last = s;
    slot_free = slot_count;
    EACH_SLOT(walk_add(j, s, end))
    walk_here *= WALK_SUM;
    walk_rest *= WALK_SUM;
    return walk_here < level.x;
}

// The separators around s.
void walk_around(int j, float s, inout float begin, inout float stop)
{
    float a = slot_a[j];
    float b = slot_b[j];
    begin = max(begin, b <= s ? b : a <= s ? a : begin);
    stop = min(stop, a > s ? a : b > s ? b : stop);
}

// Goes over the pieces from the one that holds s on, up to `end`. True: one of them may hold the hit, s and stop are its ends.
bool walk_pieces(inout float s, out float stop, float end)
{
    stop = FAR_AWAY;
    EACH_SLOT(walk_around(j, s, walk_begin, stop))
    s = walk_begin;
    while (s < end && stop < FAR_AWAY) {
        stream_fill(s, stop);
        if (slot_overflow) return false;
        bool some;
        float next = slot_sum(s, stop, some);
        if (piece_may(s, stop, SIDE) && some) return true;
        s = stop;
        stop = next;
    }
    return false;
}

// Takes in the balls from here on until together they could reach L, and those that begin soon after.
void walk_fill(float s)
{
    while (stream_near < FAR_AWAY && !slot_overflow && (walk_rest < level.x || stream_near < s + WALK_STEP * stream_radius)) {
        if (stream_hold(s)) {
            float half_length = 0.5 * (stream_chord.b - stream_chord.a);
            walk_rest += WALK_SUM * walk_most(stream_chord, half_length * half_length * stream_chord.shrink);
        }
        if (!slot_overflow) stream_read(stream_next);
    }
}

// Returns the last piece's verdict; s is the hit. Taking balls in, bounding them, going over pieces and searching one are loops of their
// own, so that on a wide machine no lane pays for what another does.
int cast_walk(uint head, float limit, out float s)
{
    s = RAY_BEGIN;
    slots_clear();
    stream_read(head);
    walk_rest = 0.0;
    walk_begin = s;
    int work = 0;
    for (;;) {
        bool clear = true;
        float end = s;
        while (clear) {
            walk_fill(s);
            if (slot_overflow || walk_rest < level.x || work > WALK_BUDGET || s >= limit) break;
            end = stream_near;
            clear = walk_clear(s, end);
            work += slot_count + 2;
            s = clear ? end : s;
        }
        if (!(stream_near <= FAR_AWAY)) return PIECE_CAP; // not a number
        if (slot_overflow || work > WALK_BUDGET) return PIECE_CAP;
        if (clear) return PIECE_NONE;
        end = min(end, walk_last);
        for (int i = 0; i < WALK_HALVES; i++) {
            float middle = 0.5 * (s + end);
            if (walk_clear(s, middle))
                s = middle;
            else
                end = middle;
        }
        work += WALK_HALVES * slot_count + 64;
        float stop, hit;
        bool may = walk_pieces(s, stop, end);
        if (slot_overflow) return PIECE_CAP;
        int found = PIECE_NONE;
        if (may) found = piece_solve(s, stop, SIDE, ROOT_STEPS, hit);
        if (found != PIECE_NONE) {
            s = hit;
            return found == PIECE_HIT && s > limit ? PIECE_NONE : found;
        }
        if (may) s = stop;
        walk_begin = s;
        walk_rest = level.x;
    }
    return PIECE_CAP; // only where the driver ended the loop
}
