/* A camera that goes around by itself for a time, and how fast the pictures came meanwhile. */
#ifndef MNS_WINDOW_SPIN_H
#define MNS_WINDOW_SPIN_H

#include <stdbool.h>
#include <stddef.h>

enum { SPIN_TIMES = 4096 };

typedef struct spin {
    double until_ms; /* 0: it stands still */
    double turned_ms, shown_ms;
    size_t count; /* of the pictures' times: from one on the window to the next */
    double *ms;   /* SPIN_TIMES of them */
} spin;

/* Begins to go around for `seconds`. False: out of memory. */
bool spin_begin(spin *s, double now_ms, double seconds);
void spin_free(spin *s);
/* How far to go on, radians, a turn taking eight seconds. */
double spin_step(spin *s, double now_ms);
/* A picture came on the window. */
void spin_shown(spin *s, double now_ms);
/* It has come to its end: median and 95th percentile of the times; false: it goes on, or none was begun. */
bool spin_end(spin *s, double now_ms, double *median, double *p95);

#endif
