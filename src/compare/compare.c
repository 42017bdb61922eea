#include "compare/compare.h"

mns_status compare_scene(mns_renderer *renderer, const mns_field *field, const mns_view *view,
                         const mns_look *look, const run_spec *runs, size_t run_count, int frames,
                         const truth_planes *truth, run_result *results, compare_seen *seen, void *context,
                         mns_error *error)
{
    mns_reference *reference = NULL;
    mns_error local; /* what a refused run says is kept, even where the caller wants no error */
    mns_status status = mns_reference_create(field, &reference, error);
    run_scene scene = {renderer, field, view, look, reference, truth, frames};
    for (size_t i = 0; i < run_count && !status; i++) {
        mns_image *image = NULL;
        status = run_measure(&scene, &runs[i], &results[i], &image, error ? error : &local);
        if (!status && seen) status = seen(context, &results[i], image, error);
        mns_image_destroy(image);
    }
    if (!status) run_mark_front(results, run_count);
    mns_reference_destroy(reference);
    return status;
}
