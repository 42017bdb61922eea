/* The certified tracer, with the scratch of one thread kept from ray to ray. */
#ifndef MNS_REFERENCE_REFERENCE_H
#define MNS_REFERENCE_REFERENCE_H

#include "reference/search.h"

struct mns_reference {
    const mns_field *field;
    reference_tree tree;
};

/* mns_reference_trace for a ray known to be good; a hit's chords stay in the scratch, and s is where on them
 * it lies. False: out of memory. */
bool reference_trace(const mns_reference *reference, reference_scratch *scratch, const double origin[3],
                     const double direction[3], mns_hit *hit, double *s);
/* q k of a chord's ball at s. */
double reference_share(const reference_chord *chord, mns_kernel kernel, double s);
void reference_scratch_free(reference_scratch *scratch);

#endif
