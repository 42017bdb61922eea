// The active set read straight from the pixel's list, for any number of balls: no array, no limit, nothing written.
//
// The list is ordered by effective distance, before which no ball of its rest can begin. What has been read but has not wholly ended
// is the stretch [links_first, links_past); the active set is what of it holds the current piece.

Ray links_ray = Ray(REAL3(0.0), REAL3(0.0));
uint links_first = NO_NODE;
uint links_past = NO_NODE;
REAL active_from = NUM(0.0);
int links_work = 0;     // nodes visited, so that no dispatch runs without end

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

// Effective distance of the first ball that has not been read, in the ray's parameter, less what float and rounding may add.
REAL links_near()
{
    if (links_past == NO_NODE) return FAR_AWAY;
    uvec4 link = list_node(links_past);
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

// From s on: the next place at which a chord begins or ends, all balls read that may begin before. FAR_AWAY: there is none.
REAL links_stop(REAL s)
{
    REAL stop = FAR_AWAY;
    bool leading = true; // all before has ended: let it go
    active_from = s;
    uint node = links_first;
    REAL near = NUM(0.0);
    for (;;) {
        if (node == links_past) {
            near = links_near();
            if (near > stop || links_past == NO_NODE) return stop;
            links_past = list_node(links_past).y;
        }
        Place place = links_at(node);
        node = place.link.y;
        if (!place.holds || place.chord.b <= s) {
            if (leading) links_first = node;
            continue;
        }
        leading = false;
        stop = min(stop, place.chord.a > s ? place.chord.a : place.chord.b);
    }
    return stop;
}
