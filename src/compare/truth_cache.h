/* Truths kept on disk under the hash of what they hang on. */
#ifndef MNS_COMPARE_TRUTH_CACHE_H
#define MNS_COMPARE_TRUTH_CACHE_H

#include "compare/truth.h"

/* Empty planes of a size, ours to fill: no radius and no rgba unless asked for. Errors: USAGE (a side below
 * 1), MEMORY. */
mns_status truth_allocate(int width, int height, bool radius, bool rgba, truth_planes **result,
                          mns_error *error);

/* Terms of effects, those of the bits in `which` (1 << truth_term), and their certainty. False: out of
 * memory. */
bool truth_allocate_effects(truth_planes *planes, unsigned which);
void truth_free_effects(truth_planes *planes);
/* Fills planes->hash's planes from the cache; false where it holds none that fits: such a file is removed.
 * The planes' size, and whether they have rgba, must fit too. */
bool truth_cache_read(truth_planes *planes);
/* Leaves the planes in the cache, and removes the oldest files beyond its size. planes->note says why where
 * it cannot. */
void truth_cache_write(truth_planes *planes);

#endif
