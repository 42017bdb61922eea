/* Cases about places: far from zero, far eyes, eyes within, frames of odd sizes, lengths at floats' limits.
 */
#include "compare/stiff_makers.h"

#include <math.h>

static const double degrees = 180 / 3.14159265358979323846;

void stiff_offset(stiff_scene *scene, const double *number)
{
    /* along a direction in which no coordinate is a round number */
    vec3 moved = vec3_scale(vec3_make(0.48, -0.6, 0.64), number[0]);
    stiff_body(scene, number[1], moved);
    stiff_look_at_body(scene, number[1], moved);
}

void stiff_far_eye(stiff_scene *scene, const double *number)
{
    const double largest = 0.3;
    double distance = number[0] * largest;
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    vec3 middle = vec3_make(0.5, 0.5, 0.5);
    vec3 eye = vec3_along(middle, distance, vec3_make(0.48, 0.6, 0.64));
    stiff_look(scene, eye, middle, 2 * atan(0.8 / distance) * degrees, 96, 72);
}

void stiff_scaled(stiff_scene *scene, const double *number)
{
    stiff_body(scene, number[0], vec3_make(0, 0, 0));
    stiff_look_at_body(scene, number[0], vec3_make(0, 0, 0));
}

void stiff_spread(stiff_scene *scene, const double *number)
{
    stiff_ball(scene, vec3_make(0, 0, -2 * number[1]), number[1], 1);
    stiff_ball(scene, vec3_make(0, 0, 0), number[0], 1);
    stiff_look(scene, vec3_make(0, 0, 3 * number[0]), vec3_make(0, 0, 0), 60, 64, 48);
}

/* A point near the body's middle where f is between the two values, found by trying. */
static vec3 find_eye(const stiff_scene *scene, double low, double high)
{
    uint64_t random = 5;
    vec3 at = vec3_make(0.5, 0.5, 0.5);
    for (int tries = 0; tries < 100000; tries++) {
        at = vec3_along(vec3_make(0.2, 0.2, 0.2), 0.6, stiff_random_cube(&random));
        double value = stiff_value(scene, at);
        if (value > low && value < high) break;
    }
    return at;
}

static void look_around(stiff_scene *scene, vec3 eye)
{
    stiff_look(scene, eye, vec3_add(eye, vec3_make(0.36, -0.48, -0.8)), 110, 96, 72);
}

void stiff_eye_in_ball(stiff_scene *scene, const double *number)
{
    (void)number;
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    look_around(scene, find_eye(scene, 0.05 * scene->iso, 0.9 * scene->iso));
}

void stiff_eye_inside(stiff_scene *scene, const double *number)
{
    (void)number;
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    look_around(scene, find_eye(scene, 1.5 * scene->iso, 10 * scene->iso));
}

void stiff_eye_at_centre(stiff_scene *scene, const double *number)
{
    (void)number;
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    look_around(scene, vec3_load(scene->position + 3 * 17));
}

/* One ball around zero and one aside; the eye at half a radius from the first, where f = L to the last bit.
 */
void stiff_eye_on_surface(stiff_scene *scene, const double *number)
{
    vec3 on = vec3_make(0, 0, 0.5);
    stiff_ball(scene, vec3_make(0, 0, 0), 1, 1);
    scene->iso = stiff_value(scene, on);
    stiff_ball(scene, vec3_make(1.75, 0.25, 0), 1, 1);
    vec3 eye = vec3_make(0, 0, 0.5 + number[0]);
    stiff_look(scene, eye, vec3_add(eye, vec3_make(1, 0.125, -0.0625)), 120, 96, 72);
}

/* A ring of balls around the eye, half of each behind it, and a body ahead. */
void stiff_near_plane(stiff_scene *scene, const double *number)
{
    (void)number;
    vec3 eye = vec3_make(0.5, 0.5, 2);
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    for (int i = 0; i < 24; i++) {
        double angle = i * 0.2617993877991494, away = i % 2 ? 0.5 : 0.35;
        vec3 at = vec3_make(away * cos(angle), away * sin(angle), 0.02 * (i % 3 - 1));
        stiff_ball(scene, vec3_add(eye, at), i % 2 ? 0.49 : 0.34, 1);
    }
    stiff_look(scene, eye, vec3_make(0.5, 0.5, 0.5), 100, 96, 72);
}

/* The same ring, which a very wide view sees all of. */
void stiff_wide_view(stiff_scene *scene, const double *number)
{
    stiff_near_plane(scene, number);
    scene->view.fov = number[0];
}

void stiff_frame(stiff_scene *scene, const double *number)
{
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    stiff_look_at_body(scene, 1, vec3_make(0, 0, 0));
    scene->view.width = (int)number[0], scene->view.height = (int)number[1];
    /* a frame that is wider than high sees the body along its whole width */
    if (number[0] > 16 * number[1]) scene->view.fov = 2 * atan(1.2 * number[1] / number[0]) * degrees;
}

void stiff_one_ball(stiff_scene *scene, const double *number)
{
    (void)number;
    stiff_ball(scene, vec3_make(0.1, -0.2, 0.3), 1, 1);
    stiff_look(scene, vec3_make(0.5, 1, 3), vec3_make(0.1, -0.2, 0.3), 45, 96, 72);
}

void stiff_no_ball(stiff_scene *scene, const double *number)
{
    (void)number;
    stiff_look(scene, vec3_make(0, 0, 3), vec3_make(0, 0, 0), 45, 96, 72);
}

/* The whole body inside the middle pixel, which its ray meets. */
void stiff_one_pixel(stiff_scene *scene, const double *number)
{
    (void)number;
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    vec3 middle = vec3_make(0.5, 0.5, 0.5);
    stiff_look(scene, vec3_along(middle, 400, vec3_make(0.48, 0.6, 0.64)), middle, 45, 65, 49);
}
