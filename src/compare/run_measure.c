/* Drawing a run, with its times. */
#include "compare/run.h"

#include "base/memory.h"
#include "base/status.h"

#include <math.h>
#include <string.h>

enum { WARM_UP = 2, PHASE_FRAMES = 3 };

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median_of(double *value, size_t n)
{
    qsort(value, n, sizeof *value, by_value);
    return 0.5 * (value[(n - 1) / 2] + value[n / 2]);
}

static mns_status draw(const run_scene *scene, const mns_options *options, mns_frame *frame, mns_error *error)
{
    return mns_renderer_draw(scene->renderer, scene->field, scene->view, scene->look, options, frame, error);
}

/* The whole frame's time, without the brackets that phases need. */
static mns_status time_frames(const run_scene *scene, const mns_options *options, mns_frame *frame,
                              run_times *ms, mns_error *error)
{
    size_t frames = (size_t)scene->frames;
    double *total = memory_array(frames, sizeof *total);
    if (!total) return status_no_memory(error, "timing frames");
    mns_status status = MNS_OK;
    for (int i = 0; i < WARM_UP && frames > 1 && !status; i++) status = draw(scene, options, frame, error);
    for (size_t i = 0; i < frames && !status; i++) {
        status = draw(scene, options, frame, error);
        if (!status) total[i] = mns_frame_stats(frame)->ms_total;
    }
    if (!status) {
        ms->frames = scene->frames;
        ms->median = median_of(total, frames);
        ms->min = total[0], ms->max = total[frames - 1];
    }
    free(total);
    return status;
}

/* The phases' times, each closed by glFinish: frames of their own, after those that count. */
static mns_status time_phases(const run_scene *scene, mns_options options, mns_frame *frame, run_times *ms,
                              mns_error *error)
{
    double phase[MNS_PHASE_COUNT][PHASE_FRAMES];
    options.measure = true;
    for (int i = 0; i < PHASE_FRAMES; i++) {
        mns_status status = draw(scene, &options, frame, error);
        if (status) return status;
        for (int p = 0; p < MNS_PHASE_COUNT; p++) phase[p][i] = mns_frame_stats(frame)->ms[p];
    }
    for (int p = 0; p < MNS_PHASE_COUNT; p++) ms->phase[p] = median_of(phase[p], PHASE_FRAMES);
    ms->has_phases = true;
    return MNS_OK;
}

/* What the renderer refuses is told in the result. */
static bool is_refusal(mns_status status)
{
    return status == MNS_ERROR_USAGE || status == MNS_ERROR_UNSUPPORTED || status == MNS_ERROR_INPUT;
}

mns_status run_measure(const run_scene *scene, const run_spec *spec, run_result *result, mns_image **image,
                       mns_error *error)
{
    mns_frame *frame = NULL;
    mns_image *read = NULL;
    mns_field_info info;
    mns_options options = spec->options;
    options.moved = true;
    if (image) *image = NULL;
    *result = (run_result){.spec = *spec};
    mns_status status = mns_frame_create(scene->renderer, &frame, error);
    if (status) return status;
    status = time_frames(scene, &options, frame, &result->ms, error);
    if (is_refusal(status)) {
        result->status = status;
        if (error) result->error = *error;
        mns_frame_destroy(frame);
        return MNS_OK;
    }
    if (!status && scene->frames > 1) status = time_phases(scene, options, frame, &result->ms, error);
    if (!status) status = mns_frame_read(frame, &read, error);
    if (!status) {
        result->stats = *mns_frame_stats(frame);
        result->stats.method = result->spec.method, result->stats.solver = result->spec.solver;
        result->stats.gather = result->stats.color_by = result->stats.color_map = NULL; /* the frame's own */
        mns_field_get_info(scene->field, &info);
        status = metrics_measure(scene->truth, read, scene->reference, info.iso, &result->errors, error);
    }
    mns_frame_destroy(frame);
    if (!status && image) {
        *image = read;
        read = NULL;
    }
    mns_image_destroy(read);
    return status;
}

/* Both figures smaller is better; equal ones do not push each other out. */
static bool is_beaten(const run_result *a, const run_result *by)
{
    double time = a->ms.median, by_time = by->ms.median, off = a->errors.t.p99, by_off = by->errors.t.p99;
    return by_time <= time && by_off <= off && (by_time < time || by_off < off);
}

static bool has_place(const run_result *r)
{
    return !r->status && isfinite(r->ms.median) && isfinite(r->errors.t.p99);
}

void run_mark_front(run_result *result, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        result[i].pareto = has_place(&result[i]);
        for (size_t k = 0; k < count && result[i].pareto; k++)
            if (has_place(&result[k]) && is_beaten(&result[i], &result[k])) result[i].pareto = false;
    }
}
