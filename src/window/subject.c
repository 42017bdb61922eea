/* What is looked at: the input that was opened, and what hangs on the field that is shown. */
#include "base/clock.h"
#include "base/status.h"
#include "window/viewer.h"

#include <stdlib.h>
#include <string.h>

void subject_settle(viewer *v)
{
    for (int i = 0; i < SIDES; i++)
        if (v->side[i].renderer) mns_renderer_prepare(v->side[i].renderer, NULL, NULL, NULL);
}

void subject_drop_field(viewer *v, subject *s)
{
    check_stop(&v->check);
    mns_reference_destroy(s->reference);
    s->reference = NULL;
    v->hover.is_known = false;
    mns_field_destroy(s->field);
    s->field = NULL;
}

void subject_free(viewer *v, subject *s)
{
    if (!s) return;
    if (s->ahead) subject_settle(v);
    mns_field_destroy(s->ahead);
    subject_drop_field(v, s);
    mns_field_destroy(s->first);
    player_close(&s->player);
    free(s);
}

/* ---- Opening ---- */

/* The frame to show and, of a sequence, frame 0: camera and colours are of that one, as `meniscus render` has
 * them. The input is the player's, if it is one. */
static mns_status read_beginning(const window_settings *w, long frame, subject *s, mns_input **opened,
                                 mns_error *error)
{
    mns_status status = mns_input_open(w->inputs, w->input_count, &w->field, opened, error);
    if (status) return status;
    long frames = (long)mns_input_frames(*opened);
    if (frame >= frames)
        return status_fail(error, MNS_ERROR_USAGE, "--frame %ld: the input has %ld frame%s, counted from 0",
                           frame, frames, frames == 1 ? "" : "s");
    double start = clock_ms();
    status = mns_input_read(*opened, (size_t)frame, &s->field, error);
    s->read_ms = clock_ms() - start;
    timeline_begin(&s->timeline, frames, frame);
    if (!status && frames > 1) status = mns_input_read(*opened, 0, &s->first, error);
    return status;
}

static mns_status resolve(const viewer *v, const subject *s, mns_view *view, mns_error *error)
{
    *view = v->settings->view;
    view->width = v->width;
    view->height = v->height;
    return mns_view_resolve(view, s->first ? s->first : s->field, view, error);
}

void subject_look(viewer *v)
{
    const window_host *host = &v->desc->host;
    v->look = v->settings->look;
    if (v->now->first) host->fix_look(host->context, v->now->first, &v->look);
}

static mns_status make(const viewer *v, long frame, subject **made, mns_view *view, mns_error *error)
{
    mns_input *input = NULL;
    subject *s = calloc(1, sizeof *s);
    if (!s) return status_no_memory(error, "opening an input");
    s->opened = v->settings->field;
    s->wanted = -1;
    *made = s;
    mns_status status = read_beginning(v->settings, frame, s, &input, error);
    if (!status) status = resolve(v, s, view, error);
    if (!status) return player_open(&s->player, input, viewer_wake, v->settings->threads, error);
    mns_input_close(input);
    return status;
}

/* As fast as it was, and playing if it did. */
static void go_on(timeline *t, const timeline *before)
{
    t->speed = before->speed;
    t->loops = before->loops;
    if (before->playing) timeline_play(t, clock_ms());
}

mns_status subject_open(viewer *v, bool fits, mns_error *error)
{
    subject *next = NULL;
    mns_view view;
    long frame = fits || !v->now ? v->settings->frame : v->now->timeline.shown;
    mns_status status = make(v, frame, &next, &view, error);
    if (status) {
        subject_free(v, next);
        return status;
    }
    subject_settle(v);
    if (!fits && v->now) go_on(&next->timeline, &v->now->timeline);
    if (v->trial.before)
        subject_free(v, v->now); /* of which nothing was drawn */
    else
        v->trial.before = v->now;
    v->now = next;
    v->seen = v->settings->view;
    if (fits) v->camera = v->home = camera_of(&view);
    subject_look(v);
    drawing_renew(v);
    return MNS_OK;
}

mns_status subject_follow(viewer *v, mns_error *error)
{
    const window_settings *s = v->settings;
    mns_view view;
    mns_view seen = v->seen;
    seen.width = s->view.width, seen.height = s->view.height; /* these are the window's */
    bool moves = memcmp(&s->view, &seen, sizeof seen) != 0;
    mns_status status = moves ? resolve(v, v->now, &view, error) : MNS_OK;
    if (!status && memcmp(&s->field, &v->now->opened, sizeof s->field) != 0)
        status = subject_open(v, false, error);
    if (status) return status;
    if (moves) v->camera = camera_of(&view);
    v->seen = s->view;
    subject_settle(v);
    subject_look(v);
    drawing_renew(v);
    return MNS_OK;
}

mns_reference *subject_reference(viewer *v)
{
    subject *s = v->now;
    if (!s->reference) {
        mns_error error;
        if (mns_reference_create(s->field, &s->reference, &error)) viewer_tell_error(v, &error);
    }
    return s->reference;
}
