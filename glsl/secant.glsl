// A leaf's first hit as Gourmel et al. 2010 find it (section 3): the first of the centres' projections on the ray at which f is past
// L bounds it, and secants from that bracket narrow it down. What rises and falls between two projections is missed.

float secant_low = 0.0, secant_high = 0.0;    // the bracket
float secant_below = 0.0, secant_above = 0.0; // f - L there, turned so that the ray comes from below zero

layout(location = 4) uniform int secant_steps;

float secant_at(float t)
{
    float value = 0.0;
    for (int j = 0; j < slot_count; j++) {
        Chord chord = active_chord(j);
        float w = clamp((t - chord.a) * (chord.b - t) * chord.shrink, 0.0, 1.0);
        value += chord.strength * density_value(KERNEL, 1.0 - w);
    }
    return cast_side * (level.x - value);
}

// The bracket of what is left of the leaf. False: no projection is past the surface.
bool cast_find_piece()
{
    if (!(cast_s < cast_leaf.end) || slot_overflow) return false;
    secant_low = cast_s;
    secant_high = FAR_AWAY;
    secant_below = secant_at(cast_s);
    secant_above = secant_below;
    cast_stop = cast_leaf.end;
    cast_next = FAR_AWAY;
    if (secant_below >= 0.0) { // the leaf's face, where the leaf before missed it
        secant_high = cast_s;
#ifdef OVERLAPS
        return false;
#else
        return true;
#endif
    }
    for (int j = 0; j < slot_count; j++) {
        float middle = 0.5 * (slot_a[j] + slot_b[j]);
        bool may = middle > cast_s && middle < min(cast_leaf.end, secant_high);
#ifdef OVERLAPS
        may = may && slot_ball[j] < REFERENCE_SPLIT; // the others' are looked at in their own leaves
#endif
        float value = may ? secant_at(middle) : -1.0;
        if (value > 0.0) {
            secant_high = middle;
            secant_above = value;
        }
    }
#ifndef OVERLAPS
    // The balls whose centres project beyond the leaf's box: the nearest place at which the leaf knows f is where the ray leaves it.
    if (secant_high == FAR_AWAY) {
        float value = secant_at(cast_leaf.end);
        if (value > 0.0) {
            secant_high = cast_leaf.end;
            secant_above = value;
        }
    }
#endif
    cast_work += slot_count * (slot_count + 1);
    return secant_high < FAR_AWAY;
}

// Secants within the bracket. An end that stays twice running counts half as much, or it would stay for good and the other creep.
int cast_solve(out float hit)
{
    int stays = 0; // how often the low end stayed, negative: the high one
    active_from = secant_low;
    hit = secant_high;
    for (int step = 0; step < secant_steps && secant_low < secant_high; step++) {
        float x = secant_high - secant_above * (secant_high - secant_low) / (secant_above - secant_below);
        float value = secant_at(x);
        hit = x;
        if (value < 0.0) {
            secant_low = x;
            secant_below = value;
            stays = min(stays, 0) - 1;
            if (stays < -1) secant_above *= 0.5;
        } else {
            secant_high = x;
            secant_above = value;
            stays = max(stays, 0) + 1;
            if (stays > 1) secant_below *= 0.5;
        }
        COUNT(w, 1);
        cast_work += slot_count;
        if (abs(value) <= 1.0e-6 * level.x) break;
    }
    active_from = hit;
    return PIECE_HIT;
}
