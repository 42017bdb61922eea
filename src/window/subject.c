/* What is looked at: the input that was opened, the frame that is shown, and the one that comes next. */
#include "base/clock.h"
#include "base/status.h"
#include "window/viewer.h"

#include <math.h>
#include <string.h>

void subject_settle(viewer *v)
{
    for (int i = 0; i < SIDES; i++)
        if (v->side[i].renderer) mns_renderer_prepare(v->side[i].renderer, NULL, NULL, NULL);
}

static void drop_ahead(viewer *v)
{
    if (!v->ahead) return;
    subject_settle(v);
    mns_field_destroy(v->ahead);
    v->ahead = NULL;
}

/* What hangs on the field that is shown. */
static void drop_field(viewer *v)
{
    check_stop(&v->check);
    mns_reference_destroy(v->reference);
    v->reference = NULL;
    v->hover.is_known = false;
    mns_field_destroy(v->field);
    v->field = NULL;
}

void subject_close(viewer *v)
{
    subject_settle(v);
    drop_ahead(v);
    drop_field(v);
    mns_field_destroy(v->first);
    v->first = NULL;
    player_close(&v->player);
}

/* ---- Opening ---- */

/* The fields that an opened input begins with. */
typedef struct beginning {
    mns_input *input;
    mns_field *first, *field; /* frame 0, of a sequence; the frame to show */
    long frames, frame;
    double ms;
} beginning;

static void beginning_free(beginning *b)
{
    mns_field_destroy(b->first);
    mns_field_destroy(b->field);
    mns_input_close(b->input);
}

static mns_status read_beginning(const window_settings *s, long frame, beginning *b, mns_error *error)
{
    mns_status status = mns_input_open(s->inputs, s->input_count, &s->field, &b->input, error);
    if (status) return status;
    b->frames = (long)mns_input_frames(b->input);
    b->frame = frame;
    if (frame >= b->frames)
        return status_fail(error, MNS_ERROR_USAGE, "--frame %ld: the input has %ld frame%s, counted from 0",
                           frame, b->frames, b->frames == 1 ? "" : "s");
    double start = clock_ms();
    status = mns_input_read(b->input, (size_t)frame, &b->field, error);
    b->ms = clock_ms() - start;
    /* Camera and colours are those of frame 0, as `meniscus render` has them. */
    if (!status && b->frames > 1) status = mns_input_read(b->input, 0, &b->first, error);
    return status;
}

static mns_status resolve(const viewer *v, const mns_field *first, mns_view *view, mns_error *error)
{
    *view = v->settings->view;
    view->width = v->width;
    view->height = v->height;
    return mns_view_resolve(view, first, view, error);
}

void subject_look(viewer *v)
{
    const window_host *host = &v->desc->host;
    v->look = v->settings->look;
    if (v->first) host->fix_look(host->context, v->first, &v->look);
}

mns_status subject_open(viewer *v, bool fits, mns_error *error)
{
    beginning b = {0};
    mns_view view;
    long frame = fits || !v->field ? v->settings->frame : v->timeline.shown;
    mns_status status = read_beginning(v->settings, frame, &b, error);
    if (!status) status = resolve(v, b.first ? b.first : b.field, &view, error);
    if (status) {
        beginning_free(&b);
        return status;
    }
    subject_close(v);
    v->field = b.field;
    v->first = b.first;
    v->read_ms = b.ms;
    v->opened = v->settings->field;
    v->seen = v->settings->view;
    v->wanted = -1;
    timeline before = v->timeline;
    timeline_begin(&v->timeline, b.frames, b.frame);
    if (!fits && before.frames) {
        v->timeline.speed = before.speed;
        v->timeline.loops = before.loops;
    }
    if (fits) v->camera = v->home = camera_of(&view);
    subject_look(v);
    drawing_change(v, false);
    return player_open(&v->player, b.input, viewer_wake, error);
}

mns_status subject_follow(viewer *v, mns_error *error)
{
    const window_settings *s = v->settings;
    if (memcmp(&s->field, &v->opened, sizeof s->field) != 0) {
        mns_status status = subject_open(v, false, error);
        if (status) return status;
    }
    if (memcmp(&s->view, &v->seen, sizeof s->view) != 0) {
        mns_view view;
        mns_status status = resolve(v, v->first ? v->first : v->field, &view, error);
        if (status) return status;
        v->camera = camera_of(&view);
        v->seen = s->view;
    }
    subject_settle(v);
    subject_look(v);
    drawing_change(v, false);
    return MNS_OK;
}

mns_reference *subject_reference(viewer *v)
{
    if (!v->reference && v->field) {
        mns_error error;
        if (mns_reference_create(v->field, &v->reference, &error)) viewer_tell_error(v, &error);
    }
    return v->reference;
}

/* ---- Frames ---- */

static void show_field(viewer *v, mns_field *field, long frame)
{
    drop_field(v);
    v->field = field;
    timeline_show(&v->timeline, frame, clock_ms());
    drawing_change(v, v->timeline.playing);
}

void subject_go(viewer *v, long frame)
{
    timeline_pause(&v->timeline);
    v->wanted = timeline_clamp(&v->timeline, frame);
    drop_ahead(v);
    if (v->wanted == v->timeline.shown)
        v->wanted = -1;
    else
        player_ask(&v->player, v->wanted);
}

void subject_play(viewer *v, bool plays)
{
    if (plays && !v->timeline.playing)
        timeline_play(&v->timeline, clock_ms());
    else if (!plays)
        timeline_pause(&v->timeline);
    v->stale = true;
}

/* The tree of the frame that comes next is begun before the one shown now is drawn. */
static void prepare(viewer *v)
{
    mns_error error;
    for (int i = 0; i < drawing_sides(v); i++) {
        mns_options options = drawing_options(v, i);
        if (v->side[i].is_drawn && options.method == MNS_METHOD_AUTO)
            options.method = mns_plan_method(mns_frame_plan(v->side[i].frame), NULL);
        if (mns_renderer_prepare(v->side[i].renderer, v->ahead, &options, &error))
            viewer_tell_error(v, &error);
    }
}

/* What was read: the frame that was asked for by hand, or the next one to play. */
static void take(viewer *v)
{
    mns_field *field;
    mns_status status;
    mns_error error;
    long frame;
    if (!player_take(&v->player, &frame, &field, &v->read_ms, &status, &error)) return;
    if (status) {
        timeline_pause(&v->timeline);
        if (frame == v->wanted) v->wanted = -1;
        viewer_tell_error(v, &error);
    } else if (frame == v->wanted) {
        v->wanted = -1;
        show_field(v, field, frame);
    } else if (v->timeline.playing && !v->ahead && v->wanted < 0) {
        v->ahead = field;
        v->ahead_frame = frame;
        prepare(v);
    } else {
        mns_field_destroy(field);
    }
}

double subject_step(viewer *v)
{
    if (!v->player.input) return INFINITY;
    take(v);
    timeline *t = &v->timeline;
    double now = clock_ms(), due = INFINITY;
    if (!t->playing) return INFINITY;
    if (v->ahead) due = timeline_due_ms(t, v->ahead_frame);
    if (v->ahead && now >= due && v->stage <= STAGE_SUMMED && v->stage != STAGE_CHANGED) {
        mns_field *field = v->ahead;
        v->ahead = NULL;
        due = INFINITY;
        show_field(v, field, v->ahead_frame);
    }
    if (!v->ahead && player_busy(&v->player) < 0) {
        long next = timeline_next(t, clock_ms(), v->read_ms + fmin(v->moving_ms[0], v->moving_ms[1]));
        if (next >= 0) player_ask(&v->player, next);
    }
    return due - now;
}
