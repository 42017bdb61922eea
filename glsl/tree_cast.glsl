// The cast of a ray through a tree, leaf by leaf, near ones first (Gourmel et al. 2010, sections 4 and 5).
//
// In a fitted tree leaves share at most faces, so the first hit met is the hit. In an overlapping tree (OVERLAPS) a leaf knows the
// field only where one of its own balls' spheres covers the ray, and the walk goes on where leaves may begin before the best hit.

#if defined(EYE_INSIDE) || defined(EYE_ON) || defined(BOTH_SIDES)
#define MAY_BE_INSIDE
#endif

struct Cast {
    int found;      // verdict of a piece
    float t;        // the hit, or where the walk gave up
    uint leaf;      // link of the leaf of the hit
};

Ray cast_ray = Ray(vec3(0.0), vec3(0.0));
float cast_begin = 0.0; // of the ray
float cast_limit = 0.0; // beyond this nothing counts
float cast_side = -1.0; // -1 outside, 1 inside
float cast_s = 0.0;     // the current piece
float cast_stop = 0.0;
float cast_next = 0.0;
#ifdef PATHS
float cast_rest = 0.0;  // the most that f can be on what of the leaf lies beyond the current piece
#endif
float cast_cover = 0.0; // up to here the leaves met have covered the ray
#ifdef OVERLAPS
float cast_past = 0.0;  // here the ray has crossed the surface for certain: the hit lies before
#endif
Leaf cast_leaf = Leaf(0u, 0u, 0.0, 0.0);
bool cast_held = false; // the slots hold a leaf that is not done with
int cast_work = 0;
#ifdef COUNTERS
vec4 cast_counts = vec4(0.0); // steps through pairs, leaves tested, balls considered, rounds: pieces summed and searched, or secants
#define COUNT(what, many) cast_counts.what += float(many)
#else
#define COUNT(what, many)
#endif

// Goes on to the next leaf in which f may reach L, its chords in the slots. cast_held: there is one.
void cast_find_leaf()
{
    while (!cast_held && tree_link != LINK_NONE && cast_work < WALK_BUDGET) {
        while (tree_inner() && cast_work < WALK_BUDGET) {
            tree_step(cast_begin, cast_limit);
            cast_work++;
            COUNT(x, 1);
        }
        if (tree_link == LINK_NONE || tree_inner()) break;
        cast_leaf = tree_leaf_at(tree_link, cast_begin, cast_limit);
        bool meets = cast_leaf.begin <= cast_leaf.end;
        if (!meets) cast_leaf.past = cast_leaf.first;
        COUNT(y, meets ? 1 : 0);
        COUNT(z, cast_leaf.past - cast_leaf.first);
        cast_work += 1 + int(cast_leaf.past - cast_leaf.first);
        float most = slots_fill(cast_ray, cast_leaf, cast_stop);
        cast_s = cast_leaf.begin;
        cast_stop = min(cast_stop, cast_leaf.end);
        cast_held = meets && slot_count > 0;
#ifdef MAY_BE_INSIDE
        cast_held = cast_held && (cast_side > 0.0 || most >= level.x);
#else
        cast_held = cast_held && most >= level.x;
#endif
        slot_overflow = cast_held && slot_count > SLOTS;
        slot_count = min(slot_count, SLOTS);
        if (!cast_held) tree_next();
    }
}

#if SOLVER == SOLVER_SECANT
#include "secant.glsl"
#else
// Sums the piece [cast_s, cast_stop]. `known`: there are balls, and what they sum to is f.
bool cast_sum()
{
    bool known = false;
    float next = FAR_AWAY;
#ifdef PATHS
    cast_rest = slot_margin;
#endif
    active_from = cast_s;
    piece_begin();
    for (int j = 0; j < slot_count; j++) {
        Chord chord = active_chord(j);
        next = min(next, slot_next(chord, cast_stop));
#ifdef PATHS
        float near = clamp(0.5 * (chord.a + chord.b), cast_stop, cast_leaf.end);
        float most = clamp((near - chord.a) * (chord.b - near) * chord.shrink, 0.0, 1.0);
        cast_rest += max(chord.strength, 0.0) * density_value(KERNEL, 1.0 - most);
#endif
        if (chord.a <= cast_s && chord.b > cast_s) {
            piece_take(chord, cast_s, cast_stop);
#ifdef OVERLAPS
            known = known || slot_ball[j] < REFERENCE_SPLIT;
#else
            known = true;
#endif
        }
    }
    cast_next = next;
    return known;
}

// Walks the leaf's pieces up to one on which f may pass L. False: there is none.
bool cast_find_piece()
{
    bool may = false;
    while (cast_s < cast_leaf.end && cast_held && !slot_overflow && cast_work < WALK_BUDGET) {
        bool known = cast_sum();
        may = piece_may(cast_s, cast_stop, cast_side) && known;
        float next = cast_stop;
#ifdef PATHS
        if (may && cast_s == cast_begin && path_on_surface()) { // on the surface: the search begins where it is left
            next = piece_leave(cast_s, cast_stop, cast_side);
            may = next == cast_s;
        }
#endif
        if (may) break;
        cast_s = next;
#ifdef PATHS
        // A ray that leaves the surface is in dense parts first, and soon out of them.
        if (next == cast_stop && cast_side < 0.0 && cast_rest < level.x) cast_s = cast_stop = cast_leaf.end;
#endif
        if (next == cast_stop) cast_stop = min(cast_next, cast_leaf.end);
        cast_work += slot_count + 2;
        COUNT(w, 1);
    }
    return may;
}

#ifdef OVERLAPS
// Whether the piece begins on the far side of the surface for certain: then the ray has crossed it before, where another leaf's
// balls cover it, and this leaf has nothing to tell.
bool cast_crossed()
{
    float value = 0.0;
    float margin = 0.0;
    EACH_ACTIVE(j) {
        Chord chord = active_chord(j);
        float w = clamp((cast_s - chord.a) * (chord.b - cast_s) * chord.shrink, 0.0, 1.0);
        value += chord.strength * density_value(KERNEL, 1.0 - w);
        margin += abs(chord.strength) * density_slope_bound(KERNEL, w) * chord_reach(chord, cast_stop);
    }
    return cast_side * (level.x - value) > 2.0 * TAU * margin;
}
#endif

int cast_solve(out float hit)
{
#ifdef PATHS
    hit = cast_s;
    if (cast_s == cast_begin && path_on_surface()) return PIECE_OPEN; // the surface could not be left
#endif
    int found = piece_solve(cast_s, cast_stop, cast_side, ROOT_STEPS, hit);
#ifdef OVERLAPS
    if (found == PIECE_OPEN && cast_crossed()) {
        cast_past = min(cast_past, cast_s);
        cast_limit = min(cast_limit, cast_s);
        cast_next = FAR_AWAY;
        cast_stop = cast_leaf.end;
        found = PIECE_NONE;
    }
#endif
    COUNT(w, 1);
    return found;
}
#endif

// The first change of sign of f - L at t in [begin, limit] from the given side, or why it is not known.
Cast tree_cast(Ray ray, float begin, float limit, float side)
{
    Cast best;
    best.found = PIECE_NONE;
    best.t = limit;
    best.leaf = LINK_NONE;
    cast_ray = ray;
    cast_begin = begin;
    cast_limit = limit;
    cast_side = side;
    cast_cover = begin;
#ifdef OVERLAPS
    cast_past = FAR_AWAY;
#endif
    cast_held = false;
    cast_work = 0;
#ifdef COUNTERS
    cast_counts = vec4(0.0);
#endif
    slots_begin();
    tree_aim(ray.start, ray.way);
    tree_begin();
    for (;;) {
        bool may = false;
        for (;;) {
            cast_find_leaf();
            if (!cast_held || slot_overflow || cast_work >= WALK_BUDGET) break;
#if defined(MAY_BE_INSIDE) && !defined(OVERLAPS)
            // From inside, what no leaf covers lies outside already: the way out was passed within rounding.
            if (cast_side > 0.0 && cast_leaf.begin > cast_cover) {
                best.found = PIECE_OPEN;
                return best;
            }
#endif
            may = cast_find_piece();
            if (may || cast_work >= WALK_BUDGET) break;
            cast_cover = max(cast_cover, cast_leaf.end);
            cast_held = false;
            tree_next();
        }
        if (slot_overflow || cast_work >= WALK_BUDGET) {
            best.found = PIECE_CAP;
            best.t = cast_held ? cast_s : best.t;
            break;
        }
        if (!may) break;
        float hit;
        int found = cast_solve(hit);
        cast_work += 64;
        if (found == PIECE_NONE) {
            cast_s = cast_stop;
            cast_stop = min(cast_next, cast_leaf.end);
            continue;
        }
        best.found = found;
        best.t = hit;
        best.leaf = tree_link;
#ifdef OVERLAPS
        // Only what begins before can matter yet.
        cast_limit = min(hit, cast_limit);
        cast_held = false;
        tree_next();
#else
        break;
#endif
    }
    if (best.t > limit && best.found == PIECE_HIT) best.found = PIECE_NONE;
#ifdef OVERLAPS
    // A crossing in the last digits of a stretch is left to what comes after; where no leaf knows that, this tells of it.
    if (cast_past < limit && best.t > cast_past && best.found != PIECE_CAP) best.found = PIECE_OPEN;
#endif
#ifdef MAY_BE_INSIDE
    if (side > 0.0 && best.found == PIECE_NONE && cast_cover < limit) best.found = PIECE_OPEN; // it must come out
#endif
    return best;
}

#ifdef OVERLAPS
// Fills the slots with what is active at a hit: in an overlapping tree other leaves were met since.
void cast_gather(Ray ray, Cast got)
{
    float stop;
    slots_fill(ray, tree_leaf_at(got.leaf, got.t, got.t), stop);
    slot_count = min(slot_count, SLOTS);
    active_from = got.t;
}
#endif
