#include "window/camera.h"

#include <string.h>

#define PI 3.14159265358979323846
/* How near the view may come to the scene's up. */
static const double POLE = 0.01;

camera camera_of(const mns_view *view)
{
    camera c = {vec3_load(view->eye), vec3_load(view->look_at), vec3_unit(vec3_load(view->up)), view->fov};
    return c;
}

void camera_put(const camera *c, mns_view *view)
{
    vec3_store(view->eye, c->eye);
    vec3_store(view->look_at, c->target);
    vec3_store(view->up, c->up);
    view->fov = c->fov;
    view->set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT;
}

void camera_axes(const camera *c, vec3 *right, vec3 *up, vec3 *forward)
{
    *forward = vec3_unit(vec3_sub(c->target, c->eye));
    *right = vec3_unit(vec3_cross(*forward, c->up));
    *up = vec3_cross(*right, *forward);
}

/* v turned about the unit axis by `angle` (Rodrigues). */
static vec3 turned(vec3 v, vec3 axis, double angle)
{
    double s = sin(angle), c = cos(angle);
    vec3 out = vec3_along(vec3_scale(v, c), s, vec3_cross(axis, v));
    return vec3_along(out, (1 - c) * vec3_dot(axis, v), axis);
}

/* What of a turn upwards may be done by a unit view without passing a pole of `up`. */
static double up_to_pole(vec3 forward, vec3 up, double upwards)
{
    double height = acos(fmax(-1, fmin(1, vec3_dot(forward, up)))); /* the view's angle from up */
    return fmax(height - (PI - POLE), fmin(height - POLE, upwards));
}

void camera_orbit(camera *c, double across, double over)
{
    vec3 right, up, forward;
    camera_axes(c, &right, &up, &forward);
    vec3 away = vec3_sub(c->eye, c->target);
    /* The eye goes up where the view goes down. */
    away = turned(away, right, up_to_pole(forward, c->up, -over));
    c->eye = vec3_add(c->target, turned(away, c->up, across));
}

void camera_turn(camera *c, double right_by, double upwards)
{
    vec3 right, up, forward;
    camera_axes(c, &right, &up, &forward);
    vec3 ahead = vec3_sub(c->target, c->eye);
    ahead = turned(ahead, right, up_to_pole(forward, c->up, upwards));
    c->target = vec3_add(c->eye, turned(ahead, c->up, -right_by));
}

static void move(camera *c, vec3 by)
{
    c->eye = vec3_add(c->eye, by);
    c->target = vec3_add(c->target, by);
}

void camera_pan(camera *c, double right_by, double upwards)
{
    double height = 2 * tan(c->fov * PI / 360) * vec3_length(vec3_sub(c->target, c->eye));
    camera_fly(c, right_by * height, upwards * height, 0);
}

void camera_zoom(camera *c, double factor, vec3 towards)
{
    camera nearer = *c;
    nearer.eye = vec3_along(towards, factor, vec3_sub(c->eye, towards));
    nearer.target = vec3_along(towards, factor, vec3_sub(c->target, towards));
    vec3 way = vec3_sub(nearer.target, nearer.eye);
    /* Not so near that rounding turns the view. */
    double most = fmax(vec3_length(nearer.eye), vec3_length(nearer.target));
    if (factor > 0 && vec3_is_finite(way) && vec3_length(way) > 1e-9 * most) *c = nearer;
}

void camera_fly(camera *c, double right_by, double upwards, double forward_by)
{
    vec3 right, up, forward;
    camera_axes(c, &right, &up, &forward);
    vec3 by = vec3_along(vec3_scale(right, right_by), upwards, up);
    move(c, vec3_along(by, forward_by, forward));
}

void camera_centre(camera *c, vec3 point)
{
    move(c, vec3_sub(point, c->target));
}

void camera_fit(camera *c, const double lo[3], const double hi[3], double aspect)
{
    vec3 right, up, forward, a = vec3_load(lo), b = vec3_load(hi);
    double half = tan(c->fov * PI / 360), distance = 0, depth = 0;
    vec3 centre = vec3_add(vec3_scale(a, 0.5), vec3_scale(b, 0.5));
    camera_axes(c, &right, &up, &forward);
    for (int i = 0; i < 8; i++) {
        vec3 corner = {i & 1 ? a.x : b.x, i & 2 ? a.y : b.y, i & 4 ? a.z : b.z};
        vec3 at = vec3_sub(corner, centre);
        double beside = fmax(fabs(vec3_dot(at, right)) / aspect, fabs(vec3_dot(at, up)));
        distance = fmax(distance, beside / half - vec3_dot(at, forward));
        depth = fmax(depth, -vec3_dot(at, forward));
    }
    /* Where the view is wide, the corners that are nearest may lie beside the eye. */
    distance = fmax(distance, depth * 1.001);
    if (!(distance > 0) || !isfinite(distance)) return;
    c->target = centre;
    c->eye = vec3_along(centre, -distance, forward);
}

bool camera_stand(camera *c, const char *side)
{
    static const struct {
        const char *name;
        double away[3];
    } sides[] = {{"front", {0, 0, 1}}, {"back", {0, 0, -1}}, {"left", {-1, 0, 0}},
                 {"right", {1, 0, 0}}, {"top", {0, 1, 0}},   {"bottom", {0, -1, 0}}};
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
        if (strcmp(sides[i].name, side) != 0) continue;
        vec3 away = vec3_load(sides[i].away);
        double distance = vec3_length(vec3_sub(c->eye, c->target));
        /* Along the scene's up the frame has another one: what lies ahead of the front view. */
        if (fabs(vec3_dot(away, c->up)) > cos(POLE)) {
            vec3 aside = fabs(c->up.z) > 0.9 ? vec3_make(0, 1, 0) : vec3_make(0, 0, 1);
            away = vec3_unit(vec3_along(away, 2 * POLE, aside));
        }
        c->eye = vec3_along(c->target, distance, away);
        return true;
    }
    return false;
}

void camera_widen(camera *c, double fov)
{
    double before = tan(c->fov * PI / 360);
    c->fov = fmax(1, fmin(170, fov));
    vec3 away = vec3_sub(c->eye, c->target);
    c->eye = vec3_along(c->target, before / tan(c->fov * PI / 360), away);
}
