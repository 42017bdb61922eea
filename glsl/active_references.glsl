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

REAL leaf_end = FAR_AWAY; // the next place, of those gone over, at which a chord begins or ends, at most where it was begun

// Whether the place's chord reaches beyond s.
bool leaf_reaches(Place place, REAL s)
{
    bool live = place.holds && place.chord.b > s;
    if (live) leaf_end = min(leaf_end, place.chord.a > s ? place.chord.a : place.chord.b);
    return live;
}

// For leaps (leap.glsl); leaf_end is set before to what is known of the ray.
#define LEAP_EACH(s, to)                                                                                                          \
    for (Place place = leaf_place(leaf_first); place.at < leaf_past; place = leaf_place(place.at + 1u))                            \
        if (leaf_reaches(place, s))
#define LEAP_CHORD place.chord
#define LEAP_STOP leaf_end

// From s on: the next place at which a chord begins or ends, at most `stop`.
REAL leaf_stop(REAL s, REAL stop)
{
    leaf_end = stop;
    for (Place place = leaf_place(leaf_first); place.at < leaf_past; place = leaf_place(place.at + 1u)) leaf_reaches(place, s);
    return leaf_end;
}

const uint LEAF_FEW = 48u;   // more make a crowd,
const uint LEAF_MANY = 500u; // and more than these are gone over only where a dispatch begins

bool leaf_crowded()
{
    return leaf_past - leaf_first > LEAF_FEW;
}

// A long round in the midst of a dispatch? There eight lanes could each begin theirs at another time, and the driver counts the
// rounds of all of them (loops.glsl).
bool leaf_waits()
{
    return leaf_work > 2 * int(LEAF_FEW) && leaf_past - leaf_first > LEAF_MANY;
}
