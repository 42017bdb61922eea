/* A frame of the tree methods: the tree built and sent where it changed, and its rays traced. */
#include "base/status.h"
#include "render/draw.h"

#include <string.h>

/* Features that change what is sent of a ball. */
#define TREE_FEATURES (FEATURE_RADII | FEATURE_STRENGTHS)

/* ---- The tree ---- */

static bool same_tree(const draw *d)
{
    const render_tree *last = &d->r->tree;
    const mns_plan *plan = d->plan;
    return !plan->options.moved && last->field == d->field && last->stamp == d->field->stamp &&
           last->features == (plan->features & TREE_FEATURES) &&
           memcmp(&last->options, &plan->tree, sizeof plan->tree) == 0;
}

static bool same_colors(const draw *d)
{
    const render_tree *last = &d->r->tree;
    const render_colors colors = draw_colors_of(d->plan);
    return !(d->plan->features & FEATURE_BLENDS) ||
           (last->colored && memcmp(&last->colors, &colors, sizeof colors) == 0);
}

static mns_status send_tree(draw *d, mns_error *error)
{
    mns_renderer *r = d->r;
    const fbvh_tree *tree = NULL;
    memset(&r->tree, 0, sizeof r->tree);
    mns_status status = trace_worker_take(&r->worker, d->field, &d->plan->tree, &tree, error);
    draw_mark(d, MNS_PHASE_BUILD);
    if (!status) status = trace_upload(&r->trace, &r->device, d->plan, tree, error);
    draw_mark(d, MNS_PHASE_UPLOAD);
    if (status) return status;
    r->tree.field = d->field;
    r->tree.stamp = d->field->stamp;
    r->tree.features = d->plan->features & TREE_FEATURES;
    r->tree.options = d->plan->tree;
    r->tree.figures = tree->figures;
    r->tree.references = tree->reference_count;
    return MNS_OK;
}

static mns_status send_colors(draw *d, mns_error *error)
{
    render_tree *last = &d->r->tree;
    const mns_plan *plan = d->plan;
    last->colored = false;
    mns_status status = trace_upload_colors(&d->r->trace, &d->r->device, plan, d->field, error);
    draw_mark(d, MNS_PHASE_UPLOAD);
    if (status) return status;
    last->colored = true;
    last->colors = draw_colors_of(plan);
    return MNS_OK;
}

static void tell_tree(draw *d)
{
    const fbvh_figures *f = &d->r->tree.figures;
    d->stats->tree = (mns_tree_stats){.balls = d->r->trace.count,
                                      .leaves = f->leaves,
                                      .depth = f->depth,
                                      .references = d->r->tree.references,
                                      .leaf_largest = f->leaf_largest,
                                      .discarded = f->discarded,
                                      .leaves_bounded = f->leaves_bounded,
                                      .bytes = f->memory_bytes,
                                      .leaf_mean = f->leaf_mean,
                                      .made_smaller = f->made_smaller,
                                      .build_ms = f->build_ms,
                                      .sort_ms = f->sort_ms};
}

mns_status draw_tree_begin(draw *d, mns_error *error)
{
    mns_status status = same_tree(d) ? MNS_OK : send_tree(d, error);
    if (!status) tell_tree(d);
    if (!status && !same_colors(d)) status = send_colors(d, error);
    return status;
}

/* ---- The rays ---- */

mns_status draw_tree_low(draw *d, mns_phase phase, mns_error *error)
{
    mns_status status = draw_wide_view(d, error);
    if (status || d->r->tree.low) return status;
    draw_mark(d, phase);
    status = trace_upload_low(&d->r->trace, &d->r->device, d->plan, d->field, error);
    d->r->tree.low = !status;
    draw_mark(d, MNS_PHASE_UPLOAD);
    return status;
}

/* Pixels that the cast left: first those that only need room, then those that need doubles. */
static mns_status resolve(draw *d, const GLuint *planes, list_counts *counts, mns_error *error)
{
    mns_renderer *r = d->r;
    if (counts->active + counts->steps > 0) {
        mns_status status = draw_late_program(d, SHADER_TREE_WALK, MNS_PHASE_TRACE, error);
        if (status) return status;
        trace_resolve(&r->trace, &r->passes, &r->device, d->plan, d->program[SHADER_TREE_WALK], false, planes,
                      counts);
    }
    if (!counts->undecided_float) return MNS_OK;
    mns_status status = draw_late_program(d, SHADER_TREE_RESOLVE, MNS_PHASE_TRACE, error);
    if (!status) status = draw_tree_low(d, MNS_PHASE_TRACE, error);
    if (status) return status;
    trace_resolve(&r->trace, &r->passes, &r->device, d->plan, d->program[SHADER_TREE_RESOLVE], true, planes,
                  counts);
    return MNS_OK;
}

static mns_status trace_rows(draw *d, list_region region, mns_error *error)
{
    const mns_frame *f = d->frame;
    const GLuint planes[TRACE_PLANES] = {f->t, f->normal, d->plan->features & FEATURE_BLENDS ? f->color : 0,
                                         d->plan->features & FEATURE_COUNTERS ? f->work : 0};
    mns_renderer *r = d->r;
    list_counts counts;
    mns_status status = trace_cast(&r->trace, &r->passes, &r->device, d->plan, d->program[SHADER_TREE],
                                   f->planes_target, planes, region, &counts, error);
    if (status) return status;
    d->stats->tiles++;
    if (counts.redo) status = resolve(d, planes, &counts, error);
    draw_mark(d, MNS_PHASE_TRACE);
    draw_counts_add(d->stats, &counts);
    return status;
}

/* As many rows at once as the list of pixels to resolve has room for. */
mns_status draw_tree_sample(draw *d, mns_error *error)
{
    int width = d->plan->frame.width, height = d->plan->frame.height;
    size_t most = d->r->passes.redo_capacity / (size_t)width;
    if (!most)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "size %dx%d: this driver's storage blocks hold no row", width, height);
    mns_status status = MNS_OK;
    for (int y = 0; y < height && !status;) {
        int rows = most < (size_t)(height - y) ? (int)most : height - y;
        status = trace_rows(d, (list_region){0, y, width, rows}, error);
        y += rows;
    }
    return status;
}

/* ---- The next frame's tree ---- */

mns_status mns_renderer_prepare(mns_renderer *r, const mns_field *field, const mns_options *options,
                                mns_error *error)
{
    if (!r) return status_fail(error, MNS_ERROR_USAGE, "prepare: the renderer is NULL");
    if (!field) {
        trace_worker_settle(&r->worker);
        return MNS_OK;
    }
    mns_options asked = options ? *options : (mns_options){0};
    asked.method = plan_required(&asked).method;
    if (asked.method != MNS_METHOD_FBVH && asked.method != MNS_METHOD_BVH) return MNS_OK;
    fbvh_options how;
    mns_status status = plan_tree_options(&asked, &r->device.limits, &how, error);
    return status ? status : trace_worker_begin(&r->worker, field, &how, error);
}
