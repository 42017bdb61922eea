/* Actions that move the camera, and what the mouse does. */
#include "window/action.h"

#include "base/clock.h"
#include "base/status.h"

static const double DEGREE = 3.14159265358979323846 / 180;

static mns_status moved(viewer *v)
{
    drawing_change(v, true);
    return MNS_OK;
}

mns_status action_orbit(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    camera_orbit(&v->camera, w->number[0] * DEGREE, w->number[1] * DEGREE);
    return moved(v);
}

mns_status action_turn(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    camera_turn(&v->camera, w->number[0] * DEGREE, w->number[1] * DEGREE);
    return moved(v);
}

mns_status action_pan(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    camera_pan(&v->camera, w->number[0], w->number[1]);
    return moved(v);
}

mns_status action_zoom(viewer *v, const words *w, mns_error *error)
{
    if (!(w->number[0] > 0))
        return status_fail(error, MNS_ERROR_USAGE, "zoom %s: expected a factor above 0", w->text);
    camera_zoom(&v->camera, w->number[0], v->camera.target);
    return moved(v);
}

mns_status action_fly(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    camera_fly(&v->camera, w->number[0], w->number[1], w->number[2]);
    return moved(v);
}

mns_status action_fit(viewer *v, const words *w, mns_error *error)
{
    (void)w, (void)error;
    mns_field_info info;
    mns_field_get_info(v->now->field, &info);
    camera_fit(&v->camera, info.effective_lo, info.effective_hi, (double)v->width / v->height);
    return moved(v);
}

mns_status action_home(viewer *v, const words *w, mns_error *error)
{
    (void)w, (void)error;
    v->camera = v->home;
    return moved(v);
}

mns_status action_spin(viewer *v, const words *w, mns_error *error)
{
    if (!(w->number[0] > 0))
        return status_fail(error, MNS_ERROR_USAGE, "spin %s: expected seconds above 0", w->text);
    if (!spin_begin(&v->spin, clock_ms(), w->number[0])) return status_no_memory(error, "beginning to spin");
    return MNS_OK;
}

mns_status action_side_of(viewer *v, const words *w, mns_error *error)
{
    if (!camera_stand(&v->camera, w->text))
        return status_fail(error, MNS_ERROR_USAGE,
                           "side %.40s: expected front, back, left, right, top or bottom", w->text);
    return moved(v);
}

mns_status action_fov(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    camera_widen(&v->camera, w->number[0]);
    return moved(v);
}

mns_status action_widen(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    camera_widen(&v->camera, v->camera.fov * w->number[0]);
    return moved(v);
}

/* ---- The mouse ---- */

mns_status action_drag(viewer *v, const words *w, mns_error *error)
{
    if (!(w->number[0] >= 0 && w->number[0] <= 2))
        return status_fail(error, MNS_ERROR_USAGE, "drag %.80s: expected button 0, 1 or 2", w->text);
    events_move(v, w->number[1], w->number[2]);
    events_press(v, (int)w->number[0], true, 0);
    events_move(v, w->number[3], w->number[4]);
    events_press(v, (int)w->number[0], false, 0);
    return MNS_OK;
}

mns_status action_move(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    events_move(v, w->number[0], w->number[1]);
    return MNS_OK;
}

mns_status action_scroll(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    events_scroll(v, 0, w->number[0]);
    return MNS_OK;
}

mns_status action_centre(viewer *v, const words *w, mns_error *error)
{
    vec3 point;
    if (!drawing_point(v, w->number[0], w->number[1], &point))
        return status_fail(error, MNS_ERROR_USAGE, "centre %.40s: there is no surface under it", w->text);
    camera_centre(&v->camera, point);
    return moved(v);
}
