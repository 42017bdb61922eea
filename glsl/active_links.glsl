// The active set kept in the pixel's own linked list, for any number of balls: sorted in place by where the ray enters each ball
// (ties by ball), the list's first part up to active_past is the active set, and what has ended is unlinked. No array, no limit.

uint active_head = NO_NODE;   // first node of the list that is left
uint active_past = NO_NODE;   // first node not yet active
REAL active_end = FAR_AWAY;    // least b of the active set

#define EACH_ACTIVE(j) for (uint j = active_head; j != active_past; j = list_nodes[j].y)

Ray links_ray = Ray(REAL3(0.0), REAL3(0.0)); // the ray that the chords are cut from

Chord active_chord(uint node)
{
    Chord chord;
    chord_cut(links_ray, ball_get(list_nodes[node].x), chord);
    return chord;
}

uint active_ball(uint node)
{
    return list_nodes[node].x;
}

// Unlinks the nodes whose ball the ray misses in this precision, so that active_chord always holds.
uint links_hit(uint head)
{
    uint kept = NO_NODE;
    uint last = NO_NODE;
    for (uint node = head; node != NO_NODE;) {
        uint next = list_nodes[node].y;
        Chord chord;
        if (chord_cut(links_ray, ball_get(list_nodes[node].x), chord)) {
            if (last == NO_NODE)
                kept = node;
            else
                list_nodes[last].y = node;
            last = node;
        }
        node = next;
    }
    if (last != NO_NODE) list_nodes[last].y = NO_NODE;
    return kept;
}

bool list_before(uint node_a, uint node_b)
{
    REAL a = active_chord(node_a).a;
    REAL b = active_chord(node_b).a;
    return a < b || (a == b && list_nodes[node_a].x < list_nodes[node_b].x);
}
#include "list_sort.glsl"

// Lets go of the balls that end at or before s, takes in those that begin there.
void active_move(REAL s)
{
    while (active_past != NO_NODE && active_chord(active_past).a <= s) active_past = list_nodes[active_past].y;
    uint last = NO_NODE;
    active_end = FAR_AWAY;
    for (uint node = active_head; node != active_past;) {
        uint next = list_nodes[node].y;
        REAL b = active_chord(node).b;
        if (b <= s) {
            if (last == NO_NODE)
                active_head = next;
            else
                list_nodes[last].y = next;
        } else {
            active_end = min(active_end, b);
            last = node;
        }
        node = next;
    }
}
