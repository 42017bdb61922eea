// The active set read straight from a leaf's references, for any number of balls: no array, no limit, nothing written.

Ray leaf_ray = Ray(REAL3(0.0), REAL3(0.0));
uint leaf_first = 0u;
uint leaf_past = 0u;
REAL active_from = NUM(0.0);
int leaf_work = 0; // references visited, so that no dispatch runs without end
#define PIECE_PAUSE (leaf_work > WALK_BUDGET)

// A place of the run. Used as EACH_ACTIVE(j) statement, with active_chord(j), active_ball(j).
struct Place {
    uint at;
    uint reference;
    Chord chord;
    bool holds;
};

// One more reference than there are stands in the buffer, so that the place past the last can be read.
Place leaf_place(uint at)
{
    Place place;
    place.at = at;
    place.reference = tree_reference(at);
    place.holds = chord_cut(leaf_ray, ball_get(place.reference & REFERENCE_BALL), place.chord);
    leaf_work++;
    return place;
}

#define EACH_ACTIVE(j)                                                                                                            \
    for (Place j = leaf_place(leaf_first); j.at < leaf_past; j = leaf_place(j.at + 1u))                                            \
        if (j.holds && j.chord.a <= active_from && j.chord.b > active_from)

Chord active_chord(Place place)
{
    return place.chord;
}

uint active_ball(Place place)
{
    return place.reference & REFERENCE_BALL;
}

// From s on: the next place at which a chord begins or ends, at most `stop`.
REAL leaf_stop(REAL s, REAL stop)
{
    for (uint at = leaf_first; at < leaf_past; at++) {
        Place place = leaf_place(at);
        if (!place.holds || place.chord.b <= s) continue;
        stop = min(stop, place.chord.a > s ? place.chord.a : place.chord.b);
    }
    return stop;
}
