// The active set (the balls whose chord holds the current piece of the ray) in a few slots, fed from the pixel's list.
//
// The list is ordered by effective distance, |p - e| - R, before which no ball of its rest can begin (the "safe zone" of Szecsi &
// Illes 2012, section 6): a ball is read only when the walk comes near, and a walk that hits leaves the rest unread. The slots are
// in no order; what has ended makes room. A list out of order is told by stream_disorder, more balls at once than slots by
// slot_overflow.

#include "slots.glsl"

// Visits every slot in use, as j. The first are visited by their numbers, which costs a wide machine one load each; a slot whose number
// is not known before costs it a load a lane. They always hold a chord, at first one that has ended.
#if SLOTS < 8
#define SLOTS_FIRST SLOTS
#define EACH_SLOT(visit) for (int j = 0; j < slot_count; j++) visit;
#else
#define SLOTS_FIRST 8
#define EACH_SLOT(visit)                                   \
    for (int j = 0; j < 2; j++) visit;                     \
    if (slot_count > 2) for (int j = 2; j < 4; j++) visit; \
    if (slot_count > 4) for (int j = 4; j < 8; j++) visit; \
    for (int j = 8; j < slot_count; j++) visit;
#endif

// Of the slot_count in use those whose ball has ended are free.
int slot_free;       // one of the free, or slot_count

uint stream_node;    // the node read last; its ball is not in a slot yet
uint stream_next;    // the node after it
uint stream_ball;
Chord stream_chord;
float stream_near;   // no ball from stream_node on begins before this; below zero where the ray misses the ball
float stream_radius;
bool stream_disorder;

uint active_ball(int j)
{
    return slot_ball[j];
}

// The first separator after `stop` on this chord: its begin, its end, and for the splines its middle.
float slot_next(Chord chord, float stop)
{
#ifdef MIDDLES
    float middle = 0.5 * (chord.a + chord.b);
    float rest = middle > stop ? middle : chord.b;
#else
    float rest = chord.b;
#endif
    float next = chord.a > stop ? chord.a : rest;
    return next > stop ? next : FAR_AWAY;
}

// Before the first piece. A slot is written so that no compiler has to suspect the arrays of being read unwritten.
void slots_clear()
{
    slot_count = 0;
    slot_free = 0;
    slot_overflow = false;
    active_from = 0.0;
    stream_disorder = false;
    stream_ball = 0u;
    stream_next = NO_NODE;
    for (int j = 0; j < SLOTS_FIRST; j++) {
        slot_a[j] = 0.0;
        slot_b[j] = 0.0;
#ifdef RADII
        slot_shrink[j] = 1.0;
#endif
#ifdef STRENGTHS
        slot_q[j] = 0.0;
#endif
    }
    slot_ball[0] = 0u;
}

// Looks at the ball of `node`.
void stream_read(uint node)
{
    stream_node = node;
    uvec4 link = list_node(node);
    bool ends = node == NO_NODE;
    if (!ends && link.x < stream_ball) stream_disorder = true;
    stream_ball = link.x;
    stream_next = ends ? NO_NODE : link.y;
    stream_chord.a = uintBitsToFloat(link.z);
    stream_chord.b = uintBitsToFloat(link.w);
#if defined(RADII) || defined(STRENGTHS)
    Ball ball = ball_get(link.x);
    float radius = ball.radius;
    stream_chord.strength = ball.strength;
#else
    float radius = level.y;
    stream_chord.strength = 1.0;
#endif
#ifdef RADII
    stream_chord.shrink = 1.0 / (radius * radius);
#else
    stream_chord.shrink = level.z;
#endif
    stream_radius = radius;
    stream_near = stream_distance(stream_chord.a, stream_chord.b, radius);
    if (stream_chord.a == stream_chord.b) stream_near = -FAR_AWAY;
    if (ends) stream_near = FAR_AWAY;
}

// Puts the ball that was read into a slot.
void stream_take()
{
    slot_put(slot_free, stream_chord, stream_ball);
    slot_count = max(slot_count, slot_free + 1);
    slot_free = slot_count;
}

// Takes the ball that was read into a slot. False where it has ended before s, has no chord, or finds no room (slot_overflow).
bool stream_hold(float s)
{
    if (!(stream_chord.b > s && stream_chord.a < stream_chord.b)) return false;
    if (slot_free == SLOTS) {
        // Room may have been made in a slot that was passed over.
        for (int j = 0; j < SLOTS; j++)
            if (slot_b[j] <= s) slot_free = j;
        slot_overflow = slot_free == SLOTS;
    }
    if (!slot_overflow) stream_take();
    return !slot_overflow;
}

// Takes in every ball that may begin before `stop`, lowering it to where one does.
void stream_fill(float s, inout float stop)
{
    while (stream_near <= stop && stream_near < FAR_AWAY && !slot_overflow) {
        if (stream_hold(s)) stop = min(stop, slot_next(stream_chord, s));
        stream_read(stream_next);
    }
}
