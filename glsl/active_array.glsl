// The active set (the balls whose chord holds the current piece of the ray) in local arrays, fed from a window of the pixel's list
// sorted by where the ray enters each ball, ties by ball. Fragments may have arrived in any order. A list longer than the window
// is read again for the next balls; an active set larger than ACTIVE_MAX is told by active_overflow.

float window_entry[WINDOW_MAX];
uint window_ball[WINDOW_MAX];
int window_count;
bool window_more;   // the list holds balls beyond the window

float active_a[ACTIVE_MAX];
float active_b[ACTIVE_MAX];
#ifdef RADII
float active_shrink[ACTIVE_MAX];
#endif
#ifdef STRENGTHS
float active_q[ACTIVE_MAX];
#endif
uint active_id[ACTIVE_MAX];
int active_count;
float active_end;   // least b of the set
bool active_overflow;

#define EACH_ACTIVE(j) for (int j = 0; j < active_count; j++)

Chord active_chord(int j)
{
    Chord chord;
    chord.a = active_a[j];
    chord.b = active_b[j];
#ifdef RADII
    chord.shrink = active_shrink[j];
#else
    chord.shrink = level.z;
#endif
    return chord;
}

float active_strength(int j)
{
#ifdef STRENGTHS
    return active_q[j];
#else
    return 1.0;
#endif
}

uint active_ball(int j)
{
    return active_id[j];
}

bool window_before(float entry_a, uint ball_a, float entry_b, uint ball_b)
{
    return entry_a < entry_b || (entry_a == entry_b && ball_a < ball_b);
}

// Fills the window with the first WINDOW_MAX balls after (last_entry, last_ball). Returns the length of the whole list.
int window_load(Ray ray, uint head, float last_entry, uint last_ball)
{
    window_count = 0;
    window_more = false;
    int length = 0;
    for (uint node = head; node != NO_NODE; length++) {
        uvec2 link = list_nodes[node];
        node = link.y;
        Chord chord;
        if (!chord_cut(ray, link.x, chord)) continue;
        if (!window_before(last_entry, last_ball, chord.a, link.x)) continue;
        if (window_count == WINDOW_MAX) {
            window_more = true;
            if (!window_before(chord.a, link.x, window_entry[WINDOW_MAX - 1], window_ball[WINDOW_MAX - 1])) continue;
            window_count--;
        }
        int place = window_count++;
        while (place > 0 && window_before(chord.a, link.x, window_entry[place - 1], window_ball[place - 1])) {
            window_entry[place] = window_entry[place - 1];
            window_ball[place] = window_ball[place - 1];
            place--;
        }
        window_entry[place] = chord.a;
        window_ball[place] = link.x;
    }
    return length;
}

void active_clear()
{
    active_count = 0;
    active_end = FAR_AWAY;
    active_overflow = false;
}

// Takes a ball in at s, where its chord begins or where the ray does.
void active_add(Ray ray, uint ball, float s)
{
    Chord chord;
    chord_cut(ray, ball, chord);
    if (chord.b <= s) return;
    if (active_count == ACTIVE_MAX) {
        active_overflow = true;
        return;
    }
    active_a[active_count] = chord.a;
    active_b[active_count] = chord.b;
#ifdef RADII
    active_shrink[active_count] = chord.shrink;
#endif
#ifdef STRENGTHS
    active_q[active_count] = ball_strength(ball);
#endif
    active_id[active_count] = ball;
    active_count++;
    active_end = min(active_end, chord.b);
}

// Lets go of the balls that end at or before s.
void active_drop(float s)
{
    int kept = 0;
    active_end = FAR_AWAY;
    for (int j = 0; j < active_count; j++) {
        float b = active_b[j];
        if (b <= s) continue;
        active_a[kept] = active_a[j];
        active_b[kept] = b;
#ifdef RADII
        active_shrink[kept] = active_shrink[j];
#endif
#ifdef STRENGTHS
        active_q[kept] = active_q[j];
#endif
        active_id[kept] = active_id[j];
        active_end = min(active_end, b);
        kept++;
    }
    active_count = kept;
}
