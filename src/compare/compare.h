/* Many runs over one scene that lies in memory. */
#ifndef MNS_COMPARE_COMPARE_H
#define MNS_COMPARE_COMPARE_H

#include "compare/run.h"

/* Called when a run has ended; the image is NULL where it was refused. What is not OK ends the comparison. */
typedef mns_status compare_seen(void *context, const run_result *result, const mns_image *image,
                                mns_error *error);

/* Draws `field` by each of the runs with `frames` frames, measures them against `truth` (of the same field
 * and view, by truth_create), and marks the front. `results` has room for run_count of them; `seen` may be
 * NULL. Errors: MEMORY, GL, what `seen` gives. A run that the renderer refuses says so in its result and is
 * no error. */
mns_status compare_scene(mns_renderer *renderer, const mns_field *field, const mns_view *view,
                         const mns_look *look, const run_spec *runs, size_t run_count, int frames,
                         const truth_planes *truth, run_result *results, compare_seen *seen, void *context,
                         mns_error *error);

#endif
