// The active set of a stretch of the ray in one leaf: the chords that meet the stretch, in slots.

#include "slots.glsl" // of a ball with REFERENCE_SPLIT

float slot_margin = 0.0; // what rounding may add to a sum of densities on the leaf's stretch

uint active_ball(int j)
{
    return slot_ball[j] & REFERENCE_BALL;
}

void slots_begin()
{
    slot_count = 0;
    slot_overflow = false;
    active_from = 0.0;
    // Written once, so that no compiler has to suspect the arrays of being read unwritten.
    slot_a[0] = 0.0;
    slot_b[0] = 0.0;
#ifdef RADII
    slot_shrink[0] = 0.0;
#endif
#ifdef STRENGTHS
    slot_q[0] = 0.0;
#endif
    slot_ball[0] = 0u;
}

// Fills the slots from a leaf. Returns the most that f can be on the stretch, rounding allowed for; `stop` is the first end of a
// chord after its begin.
float slots_fill(Ray ray, Leaf leaf, out float stop)
{
    float most = 0.0;
    float margin = 0.0;
    stop = FAR_AWAY;
    slot_count = 0;
    for (uint at = leaf.first; at < leaf.past; at++) {
        uint reference = tree_reference(at);
        Chord chord;
        bool holds = chord_cut(ray, ball_get(reference & REFERENCE_BALL), chord);
        holds = holds && chord.b > leaf.begin && chord.a < leaf.end;
        // Put down before it is known to be held: a wide machine stores lane by lane, and branches that all lanes take alike are cheap.
        if (slot_count < SLOTS) slot_put(slot_count, chord, reference);
        if (holds) {
            float middle = clamp(0.5 * (chord.a + chord.b), leaf.begin, leaf.end);
            float w = clamp((middle - chord.a) * (chord.b - middle) * chord.shrink, 0.0, 1.0);
            most += max(chord.strength, 0.0) * density_value(KERNEL, 1.0 - w);
            margin += abs(chord.strength) * density_slope_bound(KERNEL, w) * chord_reach(chord, leaf.end);
            stop = min(stop, chord.a > leaf.begin ? chord.a : chord.b);
            slot_count++;
        }
    }
    slot_margin = 2.0 * TAU * margin;
    return most + slot_margin;
}

// The first end of a chord after `stop`.
float slot_next(Chord chord, float stop)
{
    float next = chord.a > stop ? chord.a : chord.b;
    return next > stop ? next : FAR_AWAY;
}
