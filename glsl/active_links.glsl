// The active set read straight from the pixel's list, for any number of balls: no array, no limit, nothing written.
//
// The list is ordered by effective distance, before which no ball of its rest can begin. What has been read but has not wholly ended
// is the stretch [links_first, links_past); the active set is what of it holds the current piece.

Ray links_ray = Ray(REAL3(0.0), REAL3(0.0));
uint links_first = NO_NODE;
uint links_past = NO_NODE;
REAL active_from = NUM(0.0);
int links_work = 0;     // nodes visited, so that no dispatch runs without end
#define PIECE_PAUSE (links_work > WALK_BUDGET)

// The node's chord in this precision; false where the ray misses the ball.
bool links_chord(uvec4 link, out Chord chord)
{
#ifdef MNS_DOUBLE
    return chord_cut(links_ray, ball_get(link.x), chord);
#else
    chord.a = uintBitsToFloat(link.z);
    chord.b = uintBitsToFloat(link.w);
    chord.shrink = level.z;
    chord.strength = 1.0;
#if defined(RADII) || defined(STRENGTHS)
    Ball ball = ball_get(link.x);
    chord.strength = ball.strength;
#ifdef RADII
    chord.shrink = 1.0 / (ball.radius * ball.radius);
#endif
#endif
    return chord.b > 0.0 && chord.a < chord.b;
#endif
}

// Effective distance of a node's ball, in the ray's parameter, less what float and rounding may add.
REAL links_near(uvec4 link)
{
    return NUM(stream_distance(uintBitsToFloat(link.z), uintBitsToFloat(link.w), float(ball_get(link.x).radius)));
}

// A place of the stretch: its node, and what follows it. Used as EACH_ACTIVE(j) statement, with active_chord(j), active_ball(j).
struct Place {
    uint node;
    uvec4 link;
    Chord chord;
    bool holds;
};

Place links_at(uint node)
{
    Place place;
    place.node = node;
    place.link = list_node(node);
    place.holds = links_chord(place.link, place.chord);
    links_work++;
    return place;
}

#define EACH_ACTIVE(j)                                                                                                            \
    for (Place j = links_at(links_first); j.node != links_past; j = links_at(j.link.y))                                            \
        if (j.holds && j.chord.a <= active_from && j.chord.b > active_from)

Chord active_chord(Place place)
{
    return place.chord;
}

uint active_ball(Place place)
{
    return place.link.x;
}

Place links_here;    // the place that links_next has come to
uint links_node;     // and the node after it
bool links_live;     // its chord reaches on
bool links_cut = false;
bool links_leading;  // all before it has ended
REAL links_end;      // the next place, of those come to, at which a chord begins or ends
int links_size = -1; // places that the last round went over; -1 before the first

void links_begin(REAL s)
{
    active_from = s;
    links_node = links_first;
    links_leading = true;
    links_end = FAR_AWAY;
    links_size = 0;
}

// Comes to the next place of the stretch; links_live tells whether its chord reaches beyond s. The list is read on to all that may
// begin before links_end or `ahead`. False: there is none, or (links_cut) all so far has ended and was enough for a dispatch. What has
// ended at the head of the stretch is let go.
bool links_next(REAL s, REAL ahead)
{
    links_cut = links_leading && links_work > WALK_BUDGET;
    if (links_cut) return false;
    if (links_node == links_past) {
        if (links_past == NO_NODE) return false;
        uvec4 link = list_node(links_past);
        REAL near = links_near(link);
        if (near > links_end && near > ahead) return false;
        links_past = link.y;
    }
    links_here = links_at(links_node);
    links_node = links_here.link.y;
    links_size++;
    links_live = links_here.holds && links_here.chord.b > s;
    if (links_live) {
        links_leading = false;
        links_end = min(links_end, links_here.chord.a > s ? links_here.chord.a : links_here.chord.b);
    } else if (links_leading) {
        links_first = links_node;
    }
    return true;
}

// From s on: the next place at which a chord begins or ends, all balls read that may begin before. FAR_AWAY: there is none.
REAL links_stop(REAL s)
{
    links_begin(s);
    while (links_next(s, s)) {
    }
    return links_end;
}

const int LINKS_FEW = 48;   // more make a crowd,
const int LINKS_MANY = 500; // and more than these are gone over only where a dispatch begins

// A long round in the midst of a dispatch? There eight lanes could each begin theirs at another time, and the driver counts the
// rounds of all of them (loops.glsl).
bool links_wait(int before)
{
    return before > 2 * LINKS_FEW && links_size > LINKS_MANY;
}

// Whether so many balls lie between the first that reaches on and s that a round over them is long.
bool links_crowded(REAL s)
{
    if (links_size >= 0) return links_size > LINKS_FEW;
    uint node = links_first;
    for (int i = 0; i < LINKS_FEW && node != NO_NODE; i++) node = list_node(node).y;
    links_work += LINKS_FEW;
    if (node == NO_NODE) return false;
    return links_near(list_node(node)) <= s;
}

// For leaps (leap.glsl).
#define LEAP_EACH(s, to) links_begin(s); while (links_next(s, to)) if (links_live)
#define LEAP_CHORD links_here.chord
#define LEAP_STOP links_end

const REAL LINKS_LEAP = NUM(0.5); // the longest, in radii of the first ball that reaches on

REAL links_leap()
{
    return LINKS_LEAP * ball_get(list_node(links_first).x).radius;
}
