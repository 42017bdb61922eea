#include "window/pace.h"

#include <math.h>

void pace_begin(pace *p, int is_software)
{
    *p = (pace){.target_ms = is_software ? 1000.0 / 30 : 1000.0 / 60, .step = PACE_STEPS};
}

/* Two frames of different sizes tell what part of their time no pixel has. */
static void learn(pace *p, double ms)
{
    double more = p->step * p->step - p->last_step * p->last_step;
    double slope = more != 0 ? (ms - p->last_ms) / more : 0;
    if (p->last_step && slope > 0) p->fixed_ms = fmax(0, ms - slope * p->step * p->step);
    p->last_step = p->step;
    p->last_ms = ms;
}

/* The rest of the time goes with the pixels, the square of the scale; where the fixed part alone is too much,
 * they get a quarter of it on top. A little over the target is left as it is, and the way up is taken one
 * step at a time, so that the size does not swing: each change makes the frame's textures anew. */
void pace_drawn(pace *p, double ms)
{
    if (!(ms > 0)) return;
    learn(p, ms);
    double target = fmax(p->target_ms, 1.25 * p->fixed_ms), pixels = ms - p->fixed_ms;
    int fits = pixels > 0 ? (int)floor(p->step * sqrt((target - p->fixed_ms) / pixels)) : PACE_STEPS;
    if (ms > 1.15 * target)
        p->step = fits < p->step ? fits : p->step - 1;
    else if (fits > p->step)
        p->step++;
    if (p->step < PACE_LEAST) p->step = PACE_LEAST;
    if (p->step > PACE_STEPS) p->step = PACE_STEPS;
}

void pace_expect(pace *p, double whole_ms, double fixed_ms)
{
    double target = fmax(p->target_ms, 1.25 * fixed_ms), pixels = whole_ms - fixed_ms;
    double fits = pixels > 0 ? floor(PACE_STEPS * sqrt((target - fixed_ms) / pixels)) : PACE_STEPS;
    if (fits < p->step) p->step = fits > PACE_LEAST ? (int)fits : PACE_LEAST;
}

double pace_scale(const pace *p)
{
    return (double)p->step / PACE_STEPS;
}

int pace_size_at(int step, int full)
{
    int size = (full * step + PACE_STEPS / 2) / PACE_STEPS;
    return size > 0 ? size : 1;
}

int pace_size(const pace *p, int full)
{
    return pace_size_at(p->step, full);
}
