/* Options that change while the window is open: tried, and taken back where they cannot be drawn. */
#include "window/viewer.h"

#include "base/clock.h"

#include <stdio.h>

static mns_status try_it(viewer *v, bool opens, mns_error *error)
{
    const window_host *host = &v->desc->host;
    trial *t = &v->trial;
    if (!t->is_on)
        *t = (trial){.camera = v->camera,
                     .home = v->home,
                     .seen = v->seen,
                     .stage = v->failed ? STAGE_CHANGED : v->stage,
                     .is_coarse = v->is_coarse,
                     .width = v->width,
                     .height = v->height};
    v->settings = host->settings(host->context);
    mns_status status = opens ? subject_open(v, true, error) : subject_follow(v, error);
    if (!status) {
        t->is_on = true;
        return MNS_OK;
    }
    host->back(host->context);
    v->settings = host->settings(host->context);
    subject_look(v);
    return status;
}

mns_status settings_change(viewer *v, const char *name, const char *value, mns_error *error)
{
    const window_host *host = &v->desc->host;
    mns_status status = host->set(host->context, name, value, error);
    return status ? status : try_it(v, false, error);
}

mns_status settings_open(viewer *v, const char *const *names, size_t count, mns_error *error)
{
    const window_host *host = &v->desc->host;
    mns_status status = host->open(host->context, names, count, error);
    if (!status) status = try_it(v, true, error);
    if (!status) snprintf(v->trial.opens, sizeof v->trial.opens, "opened %.400s", names[0]);
    return status;
}

void settings_kept(viewer *v)
{
    const window_host *host = &v->desc->host;
    trial *t = &v->trial;
    if (!t->is_on) return;
    host->keep(host->context);
    subject_free(v, t->before);
    if (*t->opens) viewer_tell(v, "%s", t->opens);
    *t = (trial){0};
}

/* The input before was never closed: it goes on where it was. */
static void put_back(viewer *v, subject *before)
{
    subject_settle(v);
    subject_free(v, v->now);
    v->now = before;
    if (before->timeline.playing) timeline_play(&before->timeline, clock_ms());
}

void settings_refused(viewer *v)
{
    const window_host *host = &v->desc->host;
    trial *t = &v->trial;
    if (!t->is_on) return;
    host->undo(host->context);
    v->settings = host->settings(host->context);
    if (t->before) put_back(v, t->before);
    v->camera = t->camera;
    v->home = t->home;
    v->seen = t->seen;
    subject_look(v);
    drawing_renew(v);
    /* Its picture was never drawn over; that of a first side may have been before the second one failed. */
    if (drawing_sides(v) == 1 && t->stage != STAGE_CHANGED && v->width == t->width &&
        v->height == t->height) {
        v->stage = t->stage;
        v->is_coarse = t->is_coarse;
        v->is_new = false;
    }
    *t = (trial){0};
}
