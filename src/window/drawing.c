/* The picture on its way: coarse while it moves, whole when it rests, and then sample by sample. */
#include "base/clock.h"
#include "window/viewer.h"

#include <math.h>
#include <string.h>

/* How long a camera rests before the picture is drawn whole. */
static const double REST_MS = 150;
enum { ASKED_MOST = 2 };

mns_status drawing_begin(viewer *v, mns_error *error)
{
    for (int i = 0; i < SIDES; i++) {
        side *s = &v->side[i];
        mns_status status = mns_renderer_create(v->get_proc, &s->renderer, error);
        if (!status && v->settings->no_cache) mns_renderer_keep_programs(s->renderer, NULL);
        if (!status) status = mns_frame_create(s->renderer, &s->frame, error);
        if (status) return status;
    }
    pace_begin(&v->pace, mns_renderer_limits(v->side[0].renderer)->is_software);
    return MNS_OK;
}

void drawing_end(viewer *v)
{
    for (int i = 0; i < SIDES; i++) {
        mns_frame_destroy(v->side[i].frame);
        mns_renderer_destroy(v->side[i].renderer);
    }
    memset(v->side, 0, sizeof v->side);
}

int drawing_sides(const viewer *v)
{
    return v->compare == COMPARE_OFF ? 1 : 2;
}

mns_options drawing_options(const viewer *v, int which)
{
    mns_options options = which ? v->other : v->settings->draw;
    options.samples = v->settings->draw.samples ? v->settings->draw.samples : 1;
    options.measure = v->panel && panel_measures(v->panel);
    return options;
}

mns_view drawing_view(const viewer *v)
{
    mns_view view = {.width = v->width, .height = v->height};
    camera_put(&v->camera, &view);
    return view;
}

void drawing_change(viewer *v, bool moves)
{
    v->stage = STAGE_CHANGED;
    v->failed = false;
    v->is_coarse = false;
    v->asked = 0;
    v->difference.is_known = false;
    v->hover.is_known = v->scrolls = false;
    check_forget(&v->check);
    if (moves) v->moved_ms = clock_ms();
}

void drawing_renew(viewer *v)
{
    drawing_change(v, false);
    v->is_new = true;
}

/* ---- One bit of it ---- */

/* Into a frame of its own where that costs nothing, or where it may fail: the picture before stays until this
 * one is there. */
static mns_status draw_frame(viewer *v, side *s, const mns_view *view, const mns_options *options,
                             mns_error *error)
{
    const mns_stats *last = mns_frame_stats(s->frame);
    bool other = v->trial.is_on || last->width != view->width || last->height != view->height;
    if (!s->is_drawn || options->sample_first || !other)
        return mns_renderer_draw(s->renderer, v->now->field, view, &v->look, options, s->frame, error);
    mns_frame *fresh;
    mns_status status = mns_frame_create(s->renderer, &fresh, error);
    if (status) return status;
    status = mns_renderer_draw(s->renderer, v->now->field, view, &v->look, options, fresh, error);
    mns_frame_destroy(status ? fresh : s->frame);
    if (!status) s->frame = fresh;
    return status;
}

static mns_status draw_side(viewer *v, int i, const mns_view *view, const mns_options *options,
                            mns_error *error)
{
    side *s = &v->side[i];
    double start = clock_ms();
    mns_status status = draw_frame(v, s, view, options, error);
    v->screen.gl.Finish();
    if (status) { /* the second side's picture would be of another view than the first's */
        s->is_drawn = s->is_drawn && i == 0 && mns_frame_plan(s->frame);
        return status;
    }
    s->ms = clock_ms() - start;
    s->is_drawn = true;
    s->samples = options->samples;
    s->sum = options->sample_count ? options->sample_first + options->sample_count : options->samples;
    return MNS_OK;
}

/* All sides: samples from `first` on, at a part of the window's size. */
static mns_status draw(viewer *v, int step, int samples, int first, mns_error *error)
{
    mns_view view = drawing_view(v);
    view.width = pace_size_at(step, v->width);
    view.height = pace_size_at(step, v->height);
    mns_status status = MNS_OK;
    for (int i = 0; i < drawing_sides(v) && !status; i++) {
        mns_options options = drawing_options(v, i);
        options.samples = samples;
        options.sample_first = first;
        options.sample_count = samples > 1;
        options.measure = options.measure || v->asked;
        status = draw_side(v, i, &view, &options, error);
    }
    if (status) subject_settle(v); /* a side may not have come to take its tree */
    v->failed = status != MNS_OK;
    v->scrolls = false;
    v->is_new = false;
    v->stale = true;
    v->draws++;
    if (!status) settings_kept(v);
    return status;
}

/* With what putting it on the window takes. */
static double drawn_ms(const viewer *v)
{
    double ms = v->show_ms;
    for (int i = 0; i < drawing_sides(v); i++) ms += v->side[i].ms;
    return ms;
}

/* The picture is whole. */
static void finish(viewer *v)
{
    v->stage = STAGE_DONE;
    if (v->compare != COMPARE_OFF && !v->failed) divider_count(v);
}

/* One sample of the whole picture; the first of them is the pixels' centre. */
static mns_status draw_sample(viewer *v, int first, mns_error *error)
{
    int samples = drawing_options(v, 0).samples;
    mns_status status = draw(v, PACE_STEPS, samples, first, error);
    if (!first && v->pace.step == PACE_STEPS)
        pace_drawn(&v->pace, drawn_ms(v)); /* moving, it would take as long */
    if (status || first + 1 >= samples)
        finish(v);
    else
        v->stage = STAGE_SUMMED;
    return status;
}

/* At a part of the window's size. */
static mns_status draw_coarse(viewer *v, int step, mns_error *error)
{
    mns_status status = draw(v, step, 1, 0, error);
    v->stage = status ? STAGE_DONE : STAGE_COARSE;
    v->coarse_step = step;
    return status;
}

static mns_status draw_moving(viewer *v, mns_error *error)
{
    mns_status status = draw_coarse(v, v->pace.step, error);
    pace_drawn(&v->pace, drawn_ms(v));
    v->moving_ms[1] = v->moving_ms[0];
    v->moving_ms[0] = drawn_ms(v);
    return status;
}

/* What of the last draw hangs on no pixel, as far as its phases were measured. */
static double fixed_ms(const viewer *v)
{
    static const mns_phase fixed[] = {MNS_PHASE_SORT, MNS_PHASE_BIN, MNS_PHASE_UPLOAD, MNS_PHASE_BUILD};
    double ms = 0;
    for (int i = 0; i < drawing_sides(v); i++) {
        const mns_stats *s = mns_frame_stats(v->side[i].frame);
        for (size_t k = 0; s->timed && k < sizeof fixed / sizeof *fixed; k++) ms += s->ms[fixed[k]];
    }
    return ms;
}

/* What a coarse picture says of the whole one, milliseconds. */
static double whole_ms(const viewer *v)
{
    const mns_stats *s = mns_frame_stats(v->side[0].frame);
    double part = (double)s->width * s->height / ((double)v->width * v->height), fixed = fixed_ms(v);
    return part < 1 ? fixed + (drawn_ms(v) - v->show_ms - fixed) / part : 0;
}

/* What takes long is drawn whole only when it is asked for: nothing else happens meanwhile. The first picture
 * by other settings may have waited for a compiler or a tree, and the first whose phases are
 * measured for another compiler, so that what they say is asked once more. */
static mns_status draw_whole(viewer *v, mns_error *error)
{
    double ms = v->patient ? 0 : whole_ms(v);
    if (v->asked == ASKED_MOST) pace_expect(&v->pace, ms, fixed_ms(v));
    if (ms <= v->settings->patience_ms) {
        v->asked = 0;
        return draw_sample(v, 0, error);
    }
    if (v->asked < ASKED_MOST) {
        v->asked++;
        return draw_coarse(v, v->coarse_step, error);
    }
    v->stage = STAGE_DONE;
    v->is_coarse = true;
    viewer_tell(v, "the whole picture would take some %.3g s: Return draws it", ms / 1000);
    return MNS_OK;
}

static mns_status step(viewer *v, bool moving, mns_error *error)
{
    switch (v->stage) {
    case STAGE_DONE:
        return MNS_OK;
    case STAGE_CHANGED:
        if (v->is_new && !v->patient)
            return draw_coarse(v, PACE_LEAST, error); /* what it costs is not known */
        return moving ? draw_moving(v, error) : draw_sample(v, 0, error);
    case STAGE_COARSE:
        return moving ? MNS_OK : draw_whole(v, error);
    case STAGE_SUMMED:
        return moving ? MNS_OK : draw_sample(v, v->side[0].sum, error);
    }
    return MNS_OK;
}

mns_status drawing_step(viewer *v, double *again_ms, mns_error *error)
{
    *again_ms = INFINITY;
    if (!v->now) return MNS_OK;
    double rest = v->moved_ms + REST_MS - clock_ms();
    bool waits = v->held || v->now->timeline.playing, moving = waits || rest > 0;
    mns_status status = step(v, moving, error);
    if (v->stage != STAGE_DONE && !(moving && waits)) *again_ms = moving ? rest : 0;
    return status;
}

mns_status drawing_finish(viewer *v, mns_error *error)
{
    mns_status status = MNS_OK;
    if (v->failed) v->stage = STAGE_CHANGED; /* it fails again, and is told */
    if (v->is_coarse) v->stage = STAGE_COARSE;
    v->is_coarse = false;
    v->patient = true;
    while (v->stage != STAGE_DONE && !status) status = step(v, false, error);
    v->patient = false;
    if (status) settings_refused(v);
    /* The action that wanted it makes sense; what was to be drawn does not. */
    if (status == MNS_ERROR_USAGE) status = error->status = MNS_ERROR_UNSUPPORTED;
    return status;
}

/* ---- On the window ---- */

static screen_picture picture_of(const side *s)
{
    screen_picture p = {.frame = s->is_drawn ? s->frame : NULL, .gain = 1, .t_unit = 1};
    if (!s->is_drawn) return p;
    if (s->sum > 0) p.gain = (double)s->samples / s->sum;
    p.t_unit = mns_frame_stats(s->frame)->t_unit;
    return p;
}

static screen_mode mode_of(const viewer *v)
{
    if (v->compare == COMPARE_DIVIDER) return SCREEN_DIVIDER;
    if (v->compare == COMPARE_DIFFERENCE) return SCREEN_DIFFERENCE;
    return v->compare == COMPARE_FLICKER && v->flicker_b ? SCREEN_B : SCREEN_A;
}

void drawing_show(viewer *v)
{
    const side *a = &v->side[0], *b = &v->side[1];
    screen_desc desc = {.a = picture_of(a),
                        .mode = b->is_drawn ? mode_of(v) : SCREEN_A,
                        .width = v->width,
                        .height = v->height,
                        .place = v->place * v->width,
                        .line = 2,
                        .scale = divider_scale(v),
                        .drawn_width = v->width,
                        .drawn_height = v->height};
    if (drawing_sides(v) > 1) desc.b = picture_of(b);
    if (a->is_drawn) {
        desc.drawn_width = mns_frame_stats(a->frame)->width;
        desc.drawn_height = mns_frame_stats(a->frame)->height;
    }
    screen_show(&v->screen, &desc);
    v->shows++;
    v->stale = false;
}

bool drawing_point(viewer *v, double x, double y, vec3 *point)
{
    const side *s = &v->side[0];
    if (!s->is_drawn || v->failed || !(x >= 0 && y >= 0 && x < v->width && y < v->height)) return false;
    const mns_stats *stats = mns_frame_stats(s->frame);
    double t =
        screen_distance(&v->screen, s->frame, stats->width, stats->height,
                        (int)floor(x * stats->width / v->width), (int)floor(y * stats->height / v->height));
    if (!isfinite(t)) return false;
    mns_view view = drawing_view(v);
    double direction[3];
    mns_view_ray(&view, floor(x) + 0.5, floor(y) + 0.5, direction);
    *point = vec3_along(v->camera.eye, t * stats->t_unit, vec3_load(direction));
    return true;
}
