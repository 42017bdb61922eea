/* The certified tracer, with the scratch of one thread kept from ray to ray. */
#ifndef MNS_REFERENCE_REFERENCE_H
#define MNS_REFERENCE_REFERENCE_H

#include "reference/search.h"

struct mns_reference {
    const mns_field *field;
    reference_tree tree;
};

/* Lengths here are in the field's own unit. */
typedef struct reference_query {
    double origin[3], direction[3]; /* known to be good */
    double side;  /* 0; or of a ray that starts on the surface, as near as rounding allows, the side it leaves
                     to:  1 inside, -1 outside */
    double reach; /* what lies beyond is not looked at: distance from the origin, or INFINITY */
} reference_query;

typedef struct reference_answer {
    mns_hit hit;
    double s;        /* of a hit: where it lies on the chords that are left in the scratch */
    double point[3]; /* and in space, to half a unit in the last place */
} reference_answer;

/* False: out of memory. */
bool reference_ask(const mns_reference *reference, reference_scratch *scratch, const reference_query *query,
                   reference_answer *answer);
/* mns_reference_trace for a ray known to be good, in the field's own unit; a hit's chords stay in the
 * scratch, and s is where on them it lies. False: out of memory. */
bool reference_trace(const mns_reference *reference, reference_scratch *scratch, const double origin[3],
                     const double direction[3], mns_hit *hit, double *s);
/* q k of a chord's ball at s. */
double reference_share(const reference_chord *chord, mns_kernel kernel, double s);
void reference_scratch_free(reference_scratch *scratch);

#endif
