/* Actions that change what is drawn: options, inputs, what it is compared with. */
#include "window/action.h"

#include "base/status.h"
#include "window/choices.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A solver of another method would make a new one fail. */
static mns_status set_option(viewer *v, const char *name, const char *value, mns_error *error)
{
    const window_host *host = &v->desc->host;
    const char *solver = NULL;
    mns_status status = MNS_OK;
    if (strcmp(name, "method") == 0 && v->settings->draw.solver)
        solver = mns_solver_name(v->settings->draw.solver);
    if (solver) status = host->set(host->context, "solver", NULL, error);
    if (strcmp(name, "color-by") == 0 && value && strcmp(value, "none") == 0) value = NULL;
    if (!status) status = settings_change(v, name, value, error);
    if (status && solver) { /* nothing has become of it: the solver is what it was */
        mns_error unheard;
        host->set(host->context, "solver", solver, &unheard);
        v->settings = host->settings(host->context);
    }
    if (status) return status;
    if (strcmp(name, "frame") == 0) frames_go(v, v->settings->frame);
    if (strcmp(name, "size") == 0) viewer_set_size(v, v->settings->view.width, v->settings->view.height);
    return MNS_OK;
}

mns_status action_set(viewer *v, const words *w, mns_error *error)
{
    char name[48];
    size_t length = strcspn(w->text, " ");
    const char *value = w->text + length + strspn(w->text + length, " ");
    if (length >= sizeof name || !length)
        return status_fail(error, MNS_ERROR_USAGE, "set %.60s: expected an option's name and its value",
                           w->text);
    snprintf(name, sizeof name, "%.*s", (int)length, w->text);
    return set_option(v, name, value, error);
}

mns_status action_unset(viewer *v, const words *w, mns_error *error)
{
    return set_option(v, w->text, NULL, error);
}

mns_status action_next(viewer *v, const words *w, mns_error *error)
{
    choice c;
    char line[160];
    if (!choice_named(v, w->text, &c) || !c.count)
        return status_fail(error, MNS_ERROR_USAGE, "next %.40s: there is no such choice", w->text);
    snprintf(line, sizeof line, "%s %s", c.action, c.names[(c.now + 1) % c.count]);
    mns_status status = action_run(v, line, error);
    if (!status) viewer_tell(v, "%s: %s", c.label, c.names[(c.now + 1) % c.count]);
    return status;
}

mns_status action_open_input(viewer *v, const words *w, mns_error *error)
{
    return settings_open(v, &w->text, 1, error);
}

/* ---- Comparing ---- */

mns_status action_compare(viewer *v, const words *w, mns_error *error)
{
    choice c;
    choice_named(v, "compare", &c);
    for (int i = 0; i < c.count; i++) {
        if (strcmp(c.names[i], w->text) != 0) continue;
        divider_mode(v, (compare_mode)i);
        return MNS_OK;
    }
    return status_fail(error, MNS_ERROR_USAGE, "compare %.40s: expected off, divider, flicker or difference",
                       w->text);
}

mns_status action_other(viewer *v, const words *w, mns_error *error)
{
    mns_status status = divider_other(v, w->text, error);
    if (!status && v->compare != COMPARE_OFF) drawing_renew(v);
    return status;
}

mns_status action_divider(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    v->place = fmax(0, fmin(1, w->number[0]));
    v->stale = true;
    return MNS_OK;
}

mns_status action_scale(viewer *v, const words *w, mns_error *error)
{
    if (!(w->number[0] > 0))
        return status_fail(error, MNS_ERROR_USAGE, "scale %s: expected a factor above 0", w->text);
    v->scale = fmax(1e-30, fmin(1e30, divider_scale(v) * w->number[0]));
    viewer_tell(v, "difference: full colour at %.3g", v->scale);
    v->stale = true;
    return MNS_OK;
}

mns_status action_check_it(viewer *v, const words *w, mns_error *error)
{
    (void)w;
    mns_image *image[SIDES] = {NULL, NULL};
    if (v->is_coarse)
        return status_fail(
            error, MNS_ERROR_UNSUPPORTED,
            "the error is that of a whole picture, which would take long: Return draws it first");
    mns_status status = drawing_finish(v, error);
    for (int i = 0; i < drawing_sides(v) && !status; i++)
        status = mns_frame_read(v->side[i].frame, &image[i], error);
    mns_view view = drawing_view(v);
    if (!status)
        return check_begin(&v->check, v->now->field, &view, image, viewer_wake, v->settings->threads, error);
    for (int i = 0; i < SIDES; i++) mns_image_destroy(image[i]);
    return status;
}

mns_status action_hover_on(viewer *v, const words *w, mns_error *error)
{
    (void)w, (void)error;
    v->hover.is_on = !v->hover.is_on;
    v->hover.is_known = false;
    v->stale = true;
    return MNS_OK;
}
