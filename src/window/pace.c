#include "window/pace.h"

#include <math.h>

void pace_begin(pace *p, int is_software)
{
    *p = (pace){.target_ms = is_software ? 1000.0 / 30 : 1000.0 / 60, .step = PACE_STEPS};
}

/* Time goes with the pixels, the square of the scale. A little over the target is left as it is, and the way
 * up is taken one step at a time, so that the size does not swing; each change makes the frame's textures
 * anew. */
void pace_drawn(pace *p, double ms)
{
    if (!(ms > 0)) return;
    int fits = (int)floor(p->step * sqrt(p->target_ms / ms));
    if (ms > 1.15 * p->target_ms)
        p->step = fits < p->step ? fits : p->step - 1;
    else if (fits > p->step)
        p->step++;
    if (p->step < PACE_LEAST) p->step = PACE_LEAST;
    if (p->step > PACE_STEPS) p->step = PACE_STEPS;
}

double pace_scale(const pace *p)
{
    return (double)p->step / PACE_STEPS;
}

int pace_size(const pace *p, int full)
{
    int size = (full * p->step + PACE_STEPS / 2) / PACE_STEPS;
    return size > 0 ? size : 1;
}
