// The slots in which a ray's active set is kept: a chord each, and whose it is.

float slot_a[SLOTS];
float slot_b[SLOTS];
#ifdef RADII
float slot_shrink[SLOTS];
#endif
#ifdef STRENGTHS
float slot_q[SLOTS];
#endif
uint slot_ball[SLOTS];
int slot_count = 0;
bool slot_overflow = false;
float active_from = 0.0; // where the current piece begins

#define EACH_ACTIVE(j) for (int j = 0; j < slot_count; j++) if (slot_a[j] <= active_from && slot_b[j] > active_from)

Chord active_chord(int j)
{
    Chord chord;
    chord.a = slot_a[j];
    chord.b = slot_b[j];
#ifdef RADII
    chord.shrink = slot_shrink[j];
#else
    chord.shrink = level.z;
#endif
#ifdef STRENGTHS
    chord.strength = slot_q[j];
#else
    chord.strength = 1.0;
#endif
    return chord;
}

void slot_put(int j, Chord chord, uint ball)
{
    slot_a[j] = chord.a;
    slot_b[j] = chord.b;
#ifdef RADII
    slot_shrink[j] = chord.shrink;
#endif
#ifdef STRENGTHS
    slot_q[j] = chord.strength;
#endif
    slot_ball[j] = ball;
}
