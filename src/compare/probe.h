/* Random pixels of a drawn image, solved again by the reference: is the picture right? */
#ifndef MNS_COMPARE_PROBE_H
#define MNS_COMPARE_PROBE_H

#include "compare/metrics.h"

/* A hit agrees within PROBE_RELATIVE max(t*, R_j) / slope, slope being the least of 1 and |df/dt| R_j / L at
 * the hit: where the field changes slowly along the ray (a grazing ray, a neck), a rounding moves the root
 * further. Never beyond what is a wrong root (metrics.h), and besides the truth's own bound. */
#define PROBE_RELATIVE 2e-6

typedef struct probe_report {
    size_t rays;                  /* pixels drawn */
    size_t hits;                  /* of them that truly hit */
    size_t agreed;                /* the same answer, within what the image may round */
    size_t undecided;             /* the truth, or the image of itself, calls it so; whatever else differs */
    size_t missed, invented, off; /* these disagree */
    bool has_worst;
    metrics_pixel worst; /* of the decided: one that disagrees, if any does, and then the largest error */
} probe_report;

/* Draws `rays` pixels without replacement by `seed` (all, where the image has no more) and solves them again.
 * `view` is resolved, `image` is what was drawn of it. Of a pixel that shows a mesh it is asked
 * whether the surface lies behind. Parallel. Errors: MEMORY, USAGE (the sizes differ). */
mns_status probe_image(const mns_field *field, const mns_view *view, const mns_image *image, size_t rays,
                       uint64_t seed, probe_report *report, mns_error *error);

#endif
