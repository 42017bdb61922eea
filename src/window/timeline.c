#include "window/timeline.h"

#include <math.h>

void timeline_begin(timeline *t, long frames, long first)
{
    *t = (timeline){.frames = frames > 1 ? frames : 1, .shown = first, .rate = 24, .speed = 1, .loops = true};
}

static double step_ms(const timeline *t)
{
    return 1000 / (t->rate * t->speed);
}

/* How many steps after the one shown `frame` comes, at least 1. */
static long steps_to(const timeline *t, long frame)
{
    long ahead = frame - t->shown;
    return ahead > 0 ? ahead : ahead + t->frames;
}

void timeline_play(timeline *t, double now_ms)
{
    if (t->frames < 2) return;
    t->playing = true;
    t->dropped = 0;
    t->shown_ms = now_ms;
}

void timeline_pause(timeline *t)
{
    t->playing = false;
}

void timeline_loop(timeline *t, bool loops)
{
    t->loops = loops;
    if (!loops && t->shown == t->frames - 1) t->playing = false;
}

void timeline_speed(timeline *t, double speed, double now_ms)
{
    t->speed = fmax(1.0 / 64, fmin(64, speed));
    t->shown_ms = now_ms;
}

long timeline_clamp(const timeline *t, long frame)
{
    return frame < 0 ? 0 : frame >= t->frames ? t->frames - 1 : frame;
}

double timeline_due_ms(const timeline *t, long frame)
{
    return t->shown_ms + (double)steps_to(t, frame) * step_ms(t);
}

long timeline_next(const timeline *t, long after, double now_ms, double lead_ms)
{
    const long last = t->frames - 1;
    if (!t->playing || (!t->loops && after == last && after != t->shown)) return -1;
    /* What would be over before it is there is passed by, but not more than once around, nor an end. */
    long least = after == t->shown ? 1 : steps_to(t, after) + 1;
    long most = t->loops ? least + last - 1 : t->shown == last ? t->frames : last - t->shown;
    double behind = floor((now_ms + lead_ms - t->shown_ms) / step_ms(t));
    long steps = behind < (double)least ? least : behind > (double)most ? most : (long)behind;
    return (t->shown + steps) % t->frames;
}

void timeline_show(timeline *t, long frame, double now_ms)
{
    double due = timeline_due_ms(t, frame);
    if (t->playing) t->dropped += steps_to(t, frame) - 1;
    t->shown = frame;
    /* On the beat, but for what came a whole step late. */
    t->shown_ms = now_ms - due < step_ms(t) ? due : now_ms;
    if (!t->loops && frame == t->frames - 1) t->playing = false;
}
