/* The first change of sign of f - L along a ray, proven from left to right. */
#ifndef MNS_REFERENCE_SEARCH_H
#define MNS_REFERENCE_SEARCH_H

#include "reference/piece.h"

/* What one thread needs to trace; zeroed is empty, and it may serve any number of rays. */
typedef struct reference_scratch {
    reference_list ball; /* met by the ray */
    reference_chord *chord;
    size_t chord_count, chord_capacity;
    double vague; /* from here on there are balls that rounding hides, which have no chord; or INFINITY */
    reference_list active; /* a stack of lists of chords, one for each piece being looked at */
} reference_scratch;

typedef struct search_result {
    bool found, certain;
    double lo, hi; /* holds the first change of sign, where found */
    double at;     /* the best guess inside */
} search_result;

/* Looks for the change of sign along the chords in `scratch`, up to `reach` from the eye. `side` is 0, or of
 * a ray that leaves the surface 1 (inwards) or -1. False: out of memory. */
bool reference_search(reference_scratch *scratch, const mns_field *field, const reference_ray *ray,
                      double side, double reach, search_result *result);

#endif
