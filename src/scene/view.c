#include "scene/view.h"

#include "base/status.h"

#include <math.h>
#include <string.h>

/* Below this sine between view and up, the frame's right would hang on rounding. */
#define SINE_MIN 1e-9

static const double PI = 3.14159265358979323846;

static bool all_finite(const double v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/* v / |v| without over- or underflow of the squares; zero where v is zero. */
static vec3 unit_of(vec3 v)
{
    double largest = fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
    if (!(largest > 0)) return v;
    return vec3_unit(vec3_make(v.x / largest, v.y / largest, v.z / largest));
}

/* Directions of a frame looking along `forward` (unit); false where up lies along it. */
static bool orient(vec3 forward, vec3 up, view_frame *frame)
{
    vec3 right = vec3_cross(forward, unit_of(up));
    if (!(vec3_length(right) > SINE_MIN)) return false;
    frame->forward = forward;
    frame->right = vec3_unit(right);
    frame->up = vec3_cross(frame->right, forward);
    return true;
}

void view_basis(const mns_view *resolved, view_frame *frame)
{
    vec3 eye = vec3_load(resolved->eye);
    frame->eye = eye;
    frame->tan_half = tan(resolved->fov * PI / 360);
    frame->width = resolved->width;
    frame->height = resolved->height;
    orient(unit_of(vec3_sub(vec3_load(resolved->look_at), eye)), vec3_load(resolved->up), frame);
}

vec3 view_direction(const view_frame *frame, double px, double py)
{
    double step = 2 * frame->tan_half / frame->height;
    vec3 across = vec3_along(frame->forward, (px - 0.5 * frame->width) * step, frame->right);
    return vec3_unit(vec3_along(across, (0.5 * frame->height - py) * step, frame->up));
}

/* The box to be fitted; an empty field is seen as [-1, 1]^3. */
static void fitted_box(const mns_field *field, vec3 *lo, vec3 *hi)
{
    *lo = vec3_make(-1, -1, -1);
    *hi = vec3_make(1, 1, 1);
    if (!field) return;
    mns_field_info info;
    mns_field_get_info(field, &info);
    if (info.count == 0) return;
    *lo = vec3_load(info.effective_lo);
    *hi = vec3_load(info.effective_hi);
}

/* The least distance from `target` back along the view at which the box's eight corners lie inside the frame
 * less its margin. A corner at offset c needs |c . right| <= (d + c . forward) tan_x, and the same with up.
 */
static double fit_distance(const view_frame *frame, vec3 target, vec3 lo, vec3 hi)
{
    double tan_y = frame->tan_half * (1 - VIEW_MARGIN);
    double tan_x = tan_y * frame->width / frame->height;
    double distance = 0;
    for (int corner = 0; corner < 8; corner++) {
        vec3 point = {corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z};
        vec3 c = vec3_sub(point, target);
        double side = fmax(fabs(vec3_dot(c, frame->right)) / tan_x, fabs(vec3_dot(c, frame->up)) / tan_y);
        distance = fmax(distance, side - vec3_dot(c, frame->forward));
    }
    return distance;
}

static mns_status check_numbers(const mns_view *v, mns_error *error)
{
    if ((v->set & MNS_VIEW_EYE) && !all_finite(v->eye))
        return status_fail(error, MNS_ERROR_USAGE, "eye %g,%g,%g: expected three finite numbers", v->eye[0],
                           v->eye[1], v->eye[2]);
    if ((v->set & MNS_VIEW_LOOK_AT) && !all_finite(v->look_at))
        return status_fail(error, MNS_ERROR_USAGE, "look-at %g,%g,%g: expected three finite numbers",
                           v->look_at[0], v->look_at[1], v->look_at[2]);
    if (!all_finite(v->up))
        return status_fail(error, MNS_ERROR_USAGE, "up %g,%g,%g: expected three finite numbers", v->up[0],
                           v->up[1], v->up[2]);
    if (!(v->fov > 0 && v->fov < 180))
        return status_fail(error, MNS_ERROR_USAGE,
                           "field of view %g: expected degrees between 0 and 180, both excluded", v->fov);
    if (v->width < 1 || v->height < 1 || v->width > VIEW_MAX_SIZE || v->height > VIEW_MAX_SIZE)
        return status_fail(error, MNS_ERROR_USAGE, "size %dx%d: expected 1 to %d pixels a side", v->width,
                           v->height, VIEW_MAX_SIZE);
    return MNS_OK;
}

/* Fills eye and look_at where they are not given; both stay as they are where they are. */
static mns_status fit(mns_view *v, const mns_field *field, mns_error *error)
{
    bool has_eye = v->set & MNS_VIEW_EYE, has_target = v->set & MNS_VIEW_LOOK_AT;
    if (has_eye && has_target) return MNS_OK;
    vec3 lo, hi;
    fitted_box(field, &lo, &hi);
    vec3 centre = vec3_add(vec3_scale(lo, 0.5), vec3_scale(hi, 0.5));
    if (has_eye) {
        /* An eye in the very centre has no direction of its own: it looks along -z. */
        vec3 eye = vec3_load(v->eye), away = vec3_sub(centre, eye);
        if (away.x == 0 && away.y == 0 && away.z == 0) centre.z -= 0.5 * (hi.z - lo.z);
        vec3_store(v->look_at, centre);
        return MNS_OK;
    }
    view_frame frame = {.tan_half = tan(v->fov * PI / 360), .width = v->width, .height = v->height};
    if (!orient(vec3_make(0, 0, -1), vec3_load(v->up), &frame))
        return status_fail(
            error, MNS_ERROR_USAGE,
            "up %g,%g,%g lies along the view, which is -z where no eye is given: give another up, "
            "or an eye",
            v->up[0], v->up[1], v->up[2]);
    vec3 target = has_target ? vec3_load(v->look_at) : centre;
    double distance = fit_distance(&frame, target, lo, hi);
    vec3_store(v->look_at, target);
    vec3_store(v->eye, vec3_along(target, -distance, frame.forward));
    if (!all_finite(v->eye) || !all_finite(v->look_at))
        return status_fail(
            error, MNS_ERROR_USAGE,
            "no eye fits a field this large into a field of view of %g degrees: give an eye and a "
            "look-at point",
            v->fov);
    return MNS_OK;
}

static mns_status check_directions(const mns_view *v, mns_error *error)
{
    vec3 view = vec3_sub(vec3_load(v->look_at), vec3_load(v->eye));
    view_frame frame;
    if (!isfinite(view.x) || !isfinite(view.y) || !isfinite(view.z))
        return status_fail(error, MNS_ERROR_USAGE,
                           "eye and look-at point are too far apart: bring them nearer together");
    if (view.x == 0 && view.y == 0 && view.z == 0)
        return status_fail(error, MNS_ERROR_USAGE,
                           "eye and look-at point are both %.9g,%.9g,%.9g: expected two different points",
                           v->eye[0], v->eye[1], v->eye[2]);
    if (!orient(unit_of(view), vec3_load(v->up), &frame))
        return status_fail(error, MNS_ERROR_USAGE,
                           "up %g,%g,%g lies along the view: give an up that points aside from it", v->up[0],
                           v->up[1], v->up[2]);
    return MNS_OK;
}

mns_status mns_view_resolve(const mns_view *view, const mns_field *field, mns_view *resolved,
                            mns_error *error)
{
    if (!resolved) return status_fail(error, MNS_ERROR_USAGE, "view: nowhere to put it");
    mns_view v;
    memset(&v, 0, sizeof v);
    if (view) v = *view;
    if (v.up[0] == 0 && v.up[1] == 0 && v.up[2] == 0) v.up[1] = 1;
    if (v.fov == 0) v.fov = 45;
    if (v.width == 0) v.width = 1024;
    if (v.height == 0) v.height = 768;
    mns_status status = check_numbers(&v, error);
    if (!status) status = fit(&v, field, error);
    if (!status) status = check_directions(&v, error);
    if (status) return status;
    v.set |= MNS_VIEW_EYE | MNS_VIEW_LOOK_AT;
    *resolved = v;
    return MNS_OK;
}

void mns_view_ray(const mns_view *resolved, double x, double y, double direction[3])
{
    view_frame frame;
    view_basis(resolved, &frame);
    vec3_store(direction, view_direction(&frame, x, y));
}
