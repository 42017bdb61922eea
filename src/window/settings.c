/* Options that change while the window is open: tried, and taken back where they cannot be drawn. */
#include "window/viewer.h"

static void take_back(viewer *v)
{
    const window_host *host = &v->desc->host;
    host->undo(host->context);
    v->settings = host->settings(host->context);
    subject_look(v);
}

static mns_status try_it(viewer *v, mns_status status, bool opens, mns_error *error)
{
    const window_host *host = &v->desc->host;
    v->settings = host->settings(host->context);
    if (!status) status = opens ? subject_open(v, true, error) : subject_follow(v, error);
    if (status)
        take_back(v);
    else
        v->on_trial = true;
    return status;
}

mns_status settings_change(viewer *v, const char *name, const char *value, mns_error *error)
{
    const window_host *host = &v->desc->host;
    return try_it(v, host->set(host->context, name, value, error), false, error);
}

mns_status settings_open(viewer *v, const char *const *names, size_t count, mns_error *error)
{
    const window_host *host = &v->desc->host;
    return try_it(v, host->open(host->context, names, count, error), true, error);
}

void settings_refused(viewer *v)
{
    mns_error error;
    if (!v->on_trial) return;
    v->on_trial = false;
    take_back(v);
    if (subject_follow(v, &error)) viewer_tell_error(v, &error);
}
