// The walk of a ray through a tree that is always right, however many balls there are: over all references of the leaves along it, in
// float or double, and from where a dispatch before left it.
//
// The ray is walked from its start on, stretch by stretch: a stretch is what of it a leaf knows (in a fitted tree the leaf's box,
// in an overlapping one the chord of one of its own balls), and the next is always the one that begins first.

struct Stretch {
    REAL begin, end;    // begin FAR_AWAY: none is left
    uint first, past;   // references
};

// Takes [begin, end] for the next stretch if it goes past s and begins before the one found, or as early and ends later.
void stretch_offer(REAL s, REAL begin, REAL end, Leaf leaf, inout Stretch next)
{
    begin = max(begin, s);
    if (!(end > begin) || begin > next.begin || (begin == next.begin && end <= next.end)) return;
    next.begin = begin;
    next.end = end;
    next.first = leaf.first;
    next.past = leaf.past;
}

// What of the ray a leaf's box holds, in this precision.
REAL2 stretch_box(uint link)
{
    uint at = 2u * (link & LINK_PLACE);
    REAL3 start = leaf_ray.start;
    REAL3 safe = REAL3(max(abs(leaf_ray.way), REAL3(1.0e-9)));
    safe.x = leaf_ray.way.x < NUM(0.0) ? -safe.x : safe.x;
    safe.y = leaf_ray.way.y < NUM(0.0) ? -safe.y : safe.y;
    safe.z = leaf_ray.way.z < NUM(0.0) ? -safe.z : safe.z;
    REAL3 a = (REAL3(uintBitsToFloat(tree_leaf(at).xyz)) - start) / safe;
    REAL3 b = (REAL3(uintBitsToFloat(tree_leaf(at + 1u).xyz)) - start) / safe;
#ifdef MNS_DOUBLE
    REAL3 slack = REAL3(tree_slack) * NUM(1.0e-7);
#else
    REAL3 slack = tree_slack;
#endif
    REAL3 enter = min(a, b) - slack;
    REAL3 leave = max(a, b) + slack;
    return REAL2(max(enter.x, max(enter.y, enter.z)), min(leave.x, min(leave.y, leave.z)));
}

// Looks at the reference at `at`: false past a leaf's own balls, which come first.
bool stretch_own(uint at, REAL s, REAL2 box, Leaf leaf, inout Stretch next)
{
    Place place = leaf_place(at);
    if (at == leaf.past || place.reference >= REFERENCE_SPLIT) return false;
    if (place.holds) stretch_offer(s, max(box.x, place.chord.a), min(box.y, place.chord.b), leaf, next);
    return true;
}

// The stretch that is known first of what lies after s. One loop for nodes and references, so that lanes which come to a crowd at
// different times do not add their rounds up.
Stretch stretch_after(REAL s, REAL limit)
{
    Stretch next = Stretch(FAR_AWAY, FAR_AWAY, 0u, 0u);
    Leaf leaf = Leaf(0u, 0u, 0.0, 0.0);
    REAL2 box = REAL2(0.0);
    uint at = 0u;
    bool within = false; // of a leaf, at its reference `at`
    tree_begin();
    while (tree_link != LINK_NONE) {
        if (within) {
            within = stretch_own(at, s, box, leaf, next);
            at++;
            if (!within) tree_next();
            continue;
        }
        leaf_work++;
        if (tree_inner()) {
            float to = float(min(next.begin, limit));
            float from = float(s);
            tree_step(from - 1.0e-6 * abs(from), to + 1.0e-6 * abs(to));
            continue;
        }
        leaf = tree_leaf_at(tree_link, 0.0, float(FAR_AWAY));
        box = stretch_box(tree_link);
        box.x = max(box.x, NUM(0.0));
#ifdef OVERLAPS
        at = leaf.first;
        within = true;
#else
        stretch_offer(s, box.x, box.y, leaf, next);
        tree_next();
#endif
    }
    return next;
}

// f - L at s, turned so that the ray comes from below zero, less what rounding may be of it.
REAL resolve_past(REAL s, REAL side)
{
    REAL value = NUM(0.0);
    REAL margin = NUM(0.0);
    active_from = s;
    EACH_ACTIVE(j) {
        Chord chord = active_chord(j);
        REAL w = clamp((s - chord.a) * (chord.b - s) * chord.shrink, NUM(0.0), NUM(1.0));
        value += chord.strength * density_value(KERNEL, NUM(1.0) - w);
        margin += abs(chord.strength) * density_slope_bound(KERNEL, w) * chord_reach(chord, s);
    }
    return side * (level.x - value) - NUM(2.0) * TAU * margin;
}

const REAL RESOLVE_LEAP = NUM(16.0); // the longest leap tried, in lengths of the last step,
const REAL RESOLVE_LEAST = NUM(0.0009765625); // or where none was clear, of the longest tried before

// One step from s on within the stretch, a leap or a piece; `leap` is the longest to try, and then that of the next step. PIECE_NONE:
// the surface is not passed before the new s.
int resolve_step(Stretch stretch, REAL side, bool face, inout REAL leap, inout REAL s)
{
    REAL begin = s;
    REAL stop;
    active_from = s;
    if (leaf_crowded()) {
        leaf_end = stretch.end;
        leap = min(leap, stretch.end - s);
        s = leap_clear(s, leap, side, stop);
    } else {
        stop = leaf_stop(s, stretch.end);
    }
    if (s == begin) {
        piece_begin();
        EACH_ACTIVE(j) piece_take(active_chord(j), begin, stop);
        if (piece_may(begin, stop, side)) {
#ifdef PATHS
            if (begin == RAY_BEGIN && path_on_surface()) { // on the surface: the search begins where it is left
                s = piece_leave(begin, stop, side);
                return s == begin ? PIECE_OPEN : PIECE_NONE;
            }
#endif
            int found = piece_solve(begin, stop, side, RESOLVE_SEARCH, s);
            leaf_work += 64;
            // A leaf entered on the far side of the surface: its face is the hit.
            if (found == PIECE_OPEN && face && resolve_past(begin, side) > NUM(0.0)) {
                s = begin;
                return PIECE_HIT;
            }
            if (found != PIECE_NONE) return found;
        }
        s = stop;
    }
    leap = max(RESOLVE_LEAP * (s - begin), RESOLVE_LEAST * leap);
    return PIECE_NONE;
}

// Walks on from s until there is a verdict, or too much work for one dispatch; one step is always taken.
int resolve_walk(REAL limit, REAL side, inout REAL s)
{
    bool fresh = true;           // no step yet in this dispatch
    bool begun = s == RAY_BEGIN; // nothing has been walked: no face lies behind
    bool back = !begun;          // taken up again: the leaf behind is to be known, whose face may be the hit
    while (fresh || leaf_work < WALK_BUDGET) {
        Stretch stretch = stretch_after(back ? s - NUM(1.0e-9) * abs(s) : s, limit);
        bool gap = stretch.begin > s;
#if defined(EYE_INSIDE) || defined(EYE_ON) || defined(BOTH_SIDES)
        // From inside, what no leaf knows lies outside: the way out is here, but for rounding.
        if (side > NUM(0.0) && gap && s < limit) {
            active_from = s;
#ifdef MNS_DOUBLE
            return begun || back ? PIECE_OPEN : PIECE_HIT;
#else
            return PIECE_OPEN;
#endif
        }
#endif
        if (stretch.begin >= limit || stretch.begin == FAR_AWAY) return PIECE_NONE;
        s = max(s, stretch.begin);
        back = false;
        leaf_first = stretch.first;
        leaf_past = stretch.past;
        REAL leap = FAR_AWAY;
        bool face = !begun;
        while (s < stretch.end) {
            if (!fresh && (leaf_waits() || leaf_work >= WALK_BUDGET)) return PIECE_LATER;
            int found = resolve_step(stretch, side, face, leap, s);
            if (found == PIECE_HIT && s > limit) return PIECE_NONE;
            if (found != PIECE_NONE) return found;
            fresh = begun = face = false;
        }
    }
    return PIECE_LATER;
}
