#include "app/drawing.h"

#include "app/app.h"
#include "app/render.h"

#include <omp.h>
#include <string.h>

/* Resolves the view by frame 0, so that a frame is seen as in a sequence. */
static mns_status resolve_view(const app_options *o, drawing *d, size_t frame, mns_error *error)
{
    const unsigned whole = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT;
    if (frame == 0 || (o->view.set & whole) == whole)
        return mns_view_resolve(&o->view, d->field, &d->view, error);
    mns_field *first = NULL;
    mns_status status = mns_input_read(d->input, 0, &first, error);
    if (!status) status = mns_view_resolve(&o->view, first, &d->view, error);
    mns_field_destroy(first);
    return status;
}

/* A plan that cannot be made is told of when the frame is drawn. */
static void note_domain(const drawing *d)
{
    mns_plan *plan;
    if (mns_plan_create(d->field, &d->view, NULL, NULL, mns_renderer_limits(d->renderer), &plan, NULL))
        return;
    app_note_warnings(plan);
    mns_plan_destroy(plan);
}

mns_status drawing_open(const app_options *o, drawing *d, mns_error *error)
{
    memset(d, 0, sizeof *d);
    if (o->input_count == 0)
        return app_fail(
            error, MNS_ERROR_USAGE,
            "no input: expected a particle file, a scene with an input, or a generator such as tornado:4000");
    if (o->threads) omp_set_num_threads(o->threads);
    mns_status status = mns_input_open(o->inputs, o->input_count, &o->field, &d->input, error);
    if (status) return status;
    size_t frame = o->frames.given ? (size_t)o->frames.first : 0, frames = mns_input_frames(d->input);
    if (frame >= frames || o->frames.last > o->frames.first)
        return app_fail(error, MNS_ERROR_USAGE,
                        "--frame: expected one frame below %zu, the number in the input", frames);
    status = mns_input_read(d->input, frame, &d->field, error);
    if (status) return status;
    render_note_field(o->inputs[0], d->field);
    status = resolve_view(o, d, frame, error);
    if (!status) status = mns_context_create(o->backend, &d->context, error);
    if (!status) status = mns_renderer_create(mns_context_get_proc(d->context), &d->renderer, error);
    if (!status && o->no_cache) mns_renderer_keep_programs(d->renderer, NULL);
    if (!status) note_domain(d);
    return status;
}

void drawing_close(drawing *d)
{
    mns_renderer_destroy(d->renderer);
    mns_context_destroy(d->context);
    mns_field_destroy(d->field);
    mns_input_close(d->input);
}
