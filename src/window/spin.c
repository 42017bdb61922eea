#include "window/spin.h"

#include <stdlib.h>

bool spin_begin(spin *s, double now_ms, double seconds)
{
    if (!s->ms) s->ms = malloc(SPIN_TIMES * sizeof *s->ms);
    if (!s->ms) return false;
    s->until_ms = now_ms + 1000 * seconds;
    s->turned_ms = now_ms;
    s->shown_ms = 0;
    s->count = 0;
    return true;
}

void spin_free(spin *s)
{
    free(s->ms);
    *s = (spin){0};
}

double spin_step(spin *s, double now_ms)
{
    const double turn = 6.28318530717958647692, turn_ms = 8000;
    double by = (now_ms - s->turned_ms) / turn_ms * turn;
    s->turned_ms = now_ms;
    return by;
}

void spin_shown(spin *s, double now_ms)
{
    if (!s->until_ms) return;
    if (s->shown_ms > 0 && s->count < SPIN_TIMES) s->ms[s->count++] = now_ms - s->shown_ms;
    s->shown_ms = now_ms;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

bool spin_end(spin *s, double now_ms, double *median, double *p95)
{
    if (!s->until_ms || now_ms < s->until_ms) return false;
    s->until_ms = 0;
    *median = *p95 = 0;
    if (!s->count) return true;
    qsort(s->ms, s->count, sizeof *s->ms, by_size);
    *median = s->ms[s->count / 2];
    *p95 = s->ms[s->count * 95 / 100];
    return true;
}
