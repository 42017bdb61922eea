/* Which frame of a sequence is due: pure, it is told the time. */
#ifndef MNS_WINDOW_TIMELINE_H
#define MNS_WINDOW_TIMELINE_H

#include <stdbool.h>

typedef struct timeline {
    long frames;  /* at least 1 */
    long shown;   /* the frame in the window */
    long dropped; /* frames that were due and never shown, since play began */
    double rate;  /* frames a second at speed 1 */
    double speed; /* times the rate */
    bool playing, loops;
    double shown_ms; /* when the frame shown was due */
} timeline;

void timeline_begin(timeline *t, long frames, long first);
/* Plays on from the frame shown; where that is the last, the first one comes next. */
void timeline_play(timeline *t, double now_ms);
void timeline_pause(timeline *t);
/* Times the rate, kept within 1/64 and 64. */
void timeline_speed(timeline *t, double speed, double now_ms);
/* Kept within the sequence. */
long timeline_clamp(const timeline *t, long frame);

/* Whether it begins again at its end. */
void timeline_loop(timeline *t, bool loops);

/* The frame to read next: of those after `after`, which is shown or one of those to come, the first that can
 * still be shown in time, `lead_ms` from now. -1: there is none, it has come to its end or is paused. */
long timeline_next(const timeline *t, long after, double now_ms, double lead_ms);
/* When `frame`, one of those to come, is due; a frame that is late is due at once. */
double timeline_due_ms(const timeline *t, long frame);
/* `frame` is in the window now: counts those passed over, and ends at the end. */
void timeline_show(timeline *t, long frame, double now_ms);

#endif
