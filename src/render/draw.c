/* One frame from plan to planes to colour. */
#include "render/draw.h"

#include "base/clock.h"
#include "base/status.h"
#include "gl/state.h"
#include "list/uniforms.h"
#include "render/host.h"
#include "shade/shade.h"

#include <string.h>

/* Closes a phase: what ran since the last mark is its time. */
void draw_mark(draw *d, mns_phase phase)
{
    if (d->plan->options.measure) d->r->device.gl.Finish();
    double now = clock_ms();
    d->stats->ms[phase] += now - d->last_mark;
    d->last_mark = now;
}

void draw_pause(draw *d)
{
    double now = clock_ms();
    d->spent += now - d->last_mark;
    d->last_mark = now;
}

void draw_send(draw *d, gl_buffer *buffer, const void *data, size_t size)
{
    const GladGLContext *gl = &d->r->device.gl;
    gl->BindBuffer(GL_UNIFORM_BUFFER, buffer->id);
    gl->BufferSubData(GL_UNIFORM_BUFFER, 0, (GLsizeiptr)size, data);
}

/* The camera of one sample, to the uniform blocks. */
static void set_view(draw *d, const double jitter[2])
{
    float *narrow = d->r->passes.view_now;
    double far_block[FAR_VECTORS * 4];
    list_view_block(d->plan, d->field, jitter, d->target, d->wide, narrow);
    draw_send(d, &d->r->passes.view, narrow, sizeof d->r->passes.view_now);
    if (!(d->plan->features & FEATURE_FAR)) return;
    list_far_block(d->plan, far_block);
    draw_send(d, &d->r->passes.far_block, far_block, sizeof far_block);
}

mns_status draw_late_program(draw *d, plan_shader which, mns_phase phase, mns_error *error)
{
    char defines[PLAN_DEFINES];
    gl_shader shader = {.defines = defines};
    plan_shader_files(which, &shader.vertex, &shader.fragment, &shader.compute);
    plan_shader_defines(d->plan, which, defines);
    draw_mark(d, phase);
    mns_status status = gl_program_get(&d->r->device, &d->r->programs, &shader, &d->program[which], error);
    draw_pause(d);
    return status;
}

static mns_status late_program(draw *d, plan_shader which, mns_error *error)
{
    return draw_late_program(d, which, MNS_PHASE_CAST, error);
}

/* Pixels that the cast left: first those that only need room, then those that need doubles. */
static mns_status resolve(draw *d, list_counts *counts, mns_error *error)
{
    const GLuint planes[3] = {d->frame->t, d->frame->normal, d->frame->color};
    list_passes *p = &d->r->passes;
    if (counts->active + counts->steps > 0) {
        mns_status status = late_program(d, SHADER_WALK, error);
        if (status) return status;
        list_resolve(p, &d->r->device, d->plan, d->program[SHADER_WALK], false, planes, counts);
    }
    if (!counts->undecided_float) return MNS_OK;
    mns_status status = late_program(d, SHADER_RESOLVE, error);
    if (!status) status = draw_low_upload(d, error);
    if (status) return status;
    list_resolve(p, &d->r->device, d->plan, d->program[SHADER_RESOLVE], true, planes, counts);
    return MNS_OK;
}

static mns_status draw_region(draw *d, list_region region, mns_error *error);

/* A region whose lists pass what the driver's blocks hold is drawn as two. */
static mns_status draw_halves(draw *d, list_region region, mns_error *error)
{
    if (region.width == 1 && region.height == 1)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "pixel %d,%d: its list alone passes the node pool (%zu nodes)", region.x,
                           d->plan->frame.height - 1 - region.y, d->plan->pool_most);
    list_region first = region, second = region;
    if (region.height > 1) {
        first.height = region.height / 2;
        second.y += first.height;
        second.height -= first.height;
    } else {
        first.width = region.width / 2;
        second.x += first.width;
        second.width -= first.width;
    }
    d->stats->fallbacks.tiled++;
    mns_status status = draw_region(d, first, error);
    return status ? status : draw_region(d, second, error);
}

static mns_status sort_lists(draw *d, list_region region, mns_error *error)
{
    mns_status status = late_program(d, SHADER_ORDER, error);
    if (status) return status;
    d->stats->fallbacks.lists_sorted++;
    list_counts counts;
    list_sort_nodes(&d->r->passes, &d->r->device, d->program[SHADER_ORDER], region, &counts);
    if (!counts.disorder) return MNS_OK;
    return status_fail(error, MNS_ERROR_GL,
                       "%s cannot sort the lists of %u pixels; draw fewer balls or a smaller frame",
                       d->r->device.name, counts.disorder);
}

/* Casts a region's lists. Where they turn out not to be in order they are sorted and cast again; from then on
 * they are sorted first. */
static mns_status cast(draw *d, list_region region, list_counts *counts, mns_error *error)
{
    /* GL promises no order of fragments, and a cast sees only as much of a list as it reads. */
    bool ordered = d->plan->limits.is_software && !(d->plan->features & FEATURE_SHUFFLE) && !d->r->disordered;
    ordered = ordered || d->plan->features & FEATURE_TILES; /* these come from the CPU */
    mns_status status = ordered ? MNS_OK : sort_lists(d, region, error);
    if (status) return status;
    list_cast(&d->r->passes, &d->r->device, d->plan, d->program, d->frame->planes_target, region, counts);
    if (!counts->disorder) return MNS_OK;
    d->r->disordered = true;
    status = sort_lists(d, region, error);
    if (status) return status;
    list_cast(&d->r->passes, &d->r->device, d->plan, d->program, d->frame->planes_target, region, counts);
    return MNS_OK;
}

/* Makes and casts the lists of a region of the frame. */
static mns_status draw_region(draw *d, list_region region, mns_error *error)
{
    size_t pixels = (size_t)region.width * (size_t)region.height;
    if (pixels > d->r->passes.redo_capacity) return draw_halves(d, region, error);
    bool fits;
    mns_status status = draw_lists(d, region, &fits, error);
    if (status) return status;
    if (!fits) return draw_halves(d, region, error);
    d->stats->tiles++;
    list_counts counts;
    status = cast(d, region, &counts, error);
    if (!status && counts.redo) status = resolve(d, &counts, error);
    draw_mark(d, MNS_PHASE_CAST);
    draw_counts_add(d->stats, &counts);
    return status;
}

/* The first hits of one sample, into the planes. */
static mns_status draw_planes(draw *d, const double jitter[2], mns_error *error)
{
    const mns_plan *plan = d->plan;
    if (plan->features & FEATURE_REFERENCE) return draw_reference_sample(d, jitter, error);
    list_region whole = {0, 0, plan->frame.width, plan->frame.height};
    set_view(d, jitter);
    if (plan->features & FEATURE_TREE) return draw_tree_sample(d, error);
    if (plan->features & (FEATURE_CORE | FEATURE_HOST) && !(plan->features & FEATURE_TILES)) {
        list_core_depth(&d->r->passes, &d->r->device, plan, &d->r->order, d->program, whole);
        draw_mark(d, MNS_PHASE_CORE_DEPTH);
    }
    return draw_region(d, whole, error);
}

/* All passes of one sample, into the planes. */
static mns_status draw_sample(draw *d, const double jitter[2], mns_error *error)
{
    mns_status status = draw_planes(d, jitter, error);
    bool lit = d->plan->features & FEATURE_LIT && !(d->plan->features & FEATURE_REFERENCE);
    return !status && lit ? draw_effects_sample(d, jitter, error) : status;
}

static mns_status shade_sample(draw *d, int sample, const double jitter[2], mns_error *error)
{
    const mns_frame *f = d->frame;
    const GLuint planes[3] = {f->t, f->normal, d->plan->features & FEATURE_LIT ? f->lit : f->color};
    mns_status status = shade_pass(&d->r->device, &d->r->shade, d->r->passes.vertex_array, d->plan,
                                   d->program[SHADER_SHADE], planes, f->shaded_target, sample, jitter, error);
    draw_mark(d, MNS_PHASE_SHADE);
    return status;
}

/* Samples beside the centre only make colour; the planes are the centre's, drawn last. */
static mns_status draw_samples(draw *d, mns_error *error)
{
    const mns_options *o = &d->plan->options;
    int samples = o->samples, end = o->sample_first + o->sample_count;
    double jitter[2];
    mns_status status = MNS_OK;
    for (int i = o->sample_first; i < end && samples > 1 && !status; i++) {
        list_jitter(i, samples, jitter);
        d->sample = i;
        status = draw_sample(d, jitter, error);
        if (!status) status = shade_sample(d, i, jitter, error);
    }
    if (status) return status;
    d->frame->summed = end;
    if (end < samples) {
        d->stats->ms_total = clock_ms() - d->stats->ms_total - d->stats->ms[MNS_PHASE_SHADE];
        return MNS_OK;
    }
    memset(&d->stats->fallbacks, 0, sizeof d->stats->fallbacks);
    d->stats->tiles = d->stats->list_nodes = d->stats->pixels_hit = d->stats->pixels_undecided = 0;
    d->lengths.count = 0;
    list_jitter(0, 1, jitter);
    d->sample = 0;
    status = draw_sample(d, jitter, error);
    d->stats->ms_total = clock_ms() - d->stats->ms_total - d->stats->ms[MNS_PHASE_SHADE];
    if (!status && samples == 1) status = shade_sample(d, 0, jitter, error);
    return status;
}

/* The balls where the method wants them, and the samples from them. */
static mns_status draw_balls(draw *d, mns_error *error)
{
    bool traced = d->plan->features & FEATURE_REFERENCE, tree = d->plan->features & FEATURE_TREE;
    mns_status status = traced ? draw_reference_begin(d, error)
                        : tree ? draw_tree_begin(d, error)
                               : draw_balls_upload(d, error);
    if (!status && !traced && d->plan->features & FEATURE_LIT) status = draw_effects_begin(d, error);
    d->stats->balls_in_view = traced || tree ? d->field->p.count : d->r->order.in_view;
    if (!status) status = draw_samples(d, error);
    draw_reference_end(d);
    return status;
}

static mns_status draw_all(draw *d, mns_error *error)
{
    mns_renderer *r = d->r;
    bool traced = d->plan->features & FEATURE_REFERENCE;
    mns_status status = MNS_OK;
    if (!traced) status = list_passes_prepare(&r->passes, &r->device, d->plan, error);
    if (!status) status = frame_prepare(d->frame, d->plan, error);
    if (!status) status = list_passes_compile(&r->device, &r->programs, d->plan, d->program, error);
    if (status) return status;
    if (d->target) host_depth_take(&r->passes, &r->device, d->plan, d->target);
    r->device.gl.Finish();
    d->last_mark = d->stats->ms_total = clock_ms();
    status = draw_balls(d, error);
    d->stats->ms_total -= d->spent;
    if (!status && d->target)
        host_draw(&r->passes, &r->device, d->plan, d->target, d->program[SHADER_HOST_DRAW], d->frame->shaded,
                  d->frame->t);
    if (!status && d->plan->options.measure && !traced) status = draw_hits_count(d, error);
    if (!status && d->plan->features & FEATURE_COUNTERS) status = draw_work_count(d, error);
    if (!status) status = frame_leave_unit(d->frame, d->plan, error);
    list_lengths_finish(&d->lengths, d->stats);
    d->stats->programs = r->programs.count;
    d->stats->programs_kept = r->programs.binaries.taken;
    d->stats->buffers = draw_buffers_count(r);
    return status ? status : gl_check(&r->device, "drawing", error);
}

/* Samples are added to those before them alone. */
static mns_status check_sum(const mns_frame *frame, const mns_plan *plan, mns_error *error)
{
    int first = plan->options.sample_first;
    bool fits = frame->plan && frame->summed == first &&
                frame->plan->options.samples == plan->options.samples && frame->width == plan->frame.width &&
                frame->height == plan->frame.height;
    if (!first || fits) return MNS_OK;
    return status_fail(error, MNS_ERROR_USAGE,
                       "draw: sample %d is added to those before it, and the frame has %d", first,
                       frame->plan ? frame->summed : 0);
}

static mns_status draw_frame(mns_renderer *r, const mns_field *field, const mns_view *view,
                             const mns_look *look, const mns_options *options, const mns_target *target,
                             mns_frame *frame, mns_error *error)
{
    if (!r || !field || !frame || frame->renderer != r)
        return status_fail(error, MNS_ERROR_USAGE,
                           "draw: renderer, field or frame is NULL, or the frame is another's");
    mns_plan *plan;
    mns_status status =
        plan_make(field, view, look, options, &r->device.limits, target != NULL, &plan, error);
    if (status) return status;
    status = check_sum(frame, plan, error);
    if (status) {
        mns_plan_destroy(plan);
        return status;
    }
    mns_plan_destroy(frame->plan);
    frame->plan = plan;
    mns_target own = target ? *target : (mns_target){0}; /* its clip planes in the field's unit */
    own.near /= plan->unit, own.far /= plan->unit;
    frame->summed = 0; /* until it is drawn */
    draw d = {.r = r,
              .field = field,
              .plan = plan,
              .target = target ? &own : NULL,
              .frame = frame,
              .stats = &frame->stats};
    gl_state state;
    draw_stats_start(&d);
    gl_state_take(&r->device, &state);
    status = draw_all(&d, error);
    gl_state_put_back(&r->device, &state);
    if (status) { /* what the planes hold now is nobody's */
        mns_plan_destroy(frame->plan);
        frame->plan = NULL;
    }
    return status;
}

mns_status mns_renderer_draw(mns_renderer *renderer, const mns_field *field, const mns_view *view,
                             const mns_look *look, const mns_options *options, mns_frame *frame,
                             mns_error *error)
{
    return draw_frame(renderer, field, view, look, options, NULL, frame, error);
}

mns_status mns_renderer_draw_on(mns_renderer *renderer, const mns_field *field, const mns_view *view,
                                const mns_look *look, const mns_options *options, const mns_target *target,
                                mns_frame *frame, mns_error *error)
{
    if (!target || !(target->near > 0 && target->far > target->near))
        return status_fail(error, MNS_ERROR_USAGE, "draw on: a target with 0 < near < far is needed");
    return draw_frame(renderer, field, view, look, options, target, frame, error);
}
