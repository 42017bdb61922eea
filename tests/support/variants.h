/* The feature masks that a plan can come to. */
#ifndef MNS_TESTS_VARIANTS_H
#define MNS_TESTS_VARIANTS_H

#include "plan/plan.h"

/* Whether some scene has exactly these features: what excludes or implies what, as plan.c decides it. */
bool variant_possible(uint64_t features);

/* The features that change the text of a shader. */
uint64_t variant_reads(plan_shader shader);

/* A mask that has exactly `subset` of what the shader reads, the rest filled in as a plan would have it.
 * False where there is none. */
bool variant_of(plan_shader shader, uint64_t reads, uint64_t subset, uint64_t *features);

#endif
