/* What a ray meets first, by the truth: the surface, or a solid beside it. */
#ifndef MNS_EFFECTS_MEET_H
#define MNS_EFFECTS_MEET_H

#include "reference/reference.h"
#include "solid/solid.h"

typedef struct effects_met {
    reference_answer answer;
    size_t mesh; /* 1 + the index of the mesh met, whose normal is turned against the ray; 0: the surface */
} effects_met;

/* As reference_ask, of the surface and `solids` (NULL: none); `leaves`: the normal of the solid's triangle
 * that the ray leaves, or zeros. False: out of memory. */
bool effects_meet(const mns_reference *reference, const solid_set *solids, reference_scratch *scratch,
                  const reference_query *query, vec3 leaves, effects_met *met);

#endif
