/* Cases built of touches: rays that meet the surface where it parts, tangentially, or where it is thin. */
#include "compare/stiff_makers.h"

#include "field/kernel.h"

#include <math.h>

/* ---- One structure a cell of 8 by 8 pixels, aimed at the ray of the cell's middle pixel ---- */

enum { CELL = 8 };

/* Where a cell's structure lies: on the ray, `along` it, `aside` a unit vector across it; and by which part
 * it is off from the touch: +-2^-2 down to +-2^-55 over the cells of a frame. */
typedef struct cell {
    vec3 on_ray, along, aside;
    double off;
} cell;

static void put_cells(stiff_scene *scene, void (*put)(stiff_scene *, const cell *))
{
    const double distance = 10;
    stiff_look(scene, vec3_make(0.3, -0.2, distance), vec3_make(0.3, -0.2, 0), 45, 96, 72);
    const mns_view *view = &scene->view;
    int across = view->width / CELL;
    for (int i = 0; i < across * (view->height / CELL); i++) {
        int column = i % across, row = i / across;
        double x = (column + 0.5) * CELL + 0.5, y = (row + 0.5) * CELL + 0.5, direction[3];
        mns_view_ray(view, x, y, direction);
        vec3 along = vec3_load(direction), right = vec3_unit(vec3_cross(along, vec3_make(0, 1, 0)));
        vec3 up = vec3_cross(right, along);
        cell c = {.on_ray = vec3_along(vec3_load(view->eye), distance, along),
                  .along = along,
                  .aside = vec3_add(vec3_scale(right, cos(2.4 * i)), vec3_scale(up, sin(2.4 * i))),
                  .off = ldexp(i % 2 ? -1 : 1, -2 - i / 2)};
        put(scene, &c);
    }
}

static void put_silhouette(stiff_scene *scene, const cell *c)
{
    const double radius = 0.4;
    double away = radius * stiff_inverse(scene, scene->iso) * (1 + c->off);
    stiff_ball(scene, vec3_along(c->on_ray, away, c->aside), radius, 1);
}

void stiff_silhouettes(stiff_scene *scene, const double *number)
{
    (void)number;
    put_cells(scene, put_silhouette);
}

/* A pair whose middle is at L (1 +- a little): the neck between them is just there, or just not. */
static void put_pair(stiff_scene *scene, const cell *c, vec3 axis)
{
    const double radius = 0.25;
    double away = radius * stiff_inverse(scene, scene->iso / 2) * (1 + 0.5 * c->off);
    stiff_ball(scene, vec3_along(c->on_ray, away, axis), radius, 1);
    stiff_ball(scene, vec3_along(c->on_ray, -away, axis), radius, 1);
}

static void put_neck(stiff_scene *scene, const cell *c)
{
    put_pair(scene, c, c->aside);
}

void stiff_necks(stiff_scene *scene, const double *number)
{
    (void)number;
    put_cells(scene, put_neck);
}

/* As a neck, but crossed in the direction in which f neither falls nor rises to second order: with the axis
 * at angle a to the ray, cos^2 a k'' + sin^2 a k'/v = 0. */
static void put_saddle(stiff_scene *scene, const cell *c)
{
    int kernel = (int)scene->kernel;
    double v = stiff_inverse(scene, scene->iso / 2), step = 1e-5;
    double bend =
        (density_slope(kernel, (v + step) * (v + step)) - density_slope(kernel, (v - step) * (v - step))) /
        (2 * step);
    double angle = atan(sqrt(fmax(bend, 0) / -density_slope_over_v(kernel, v * v)));
    vec3 axis = vec3_add(vec3_scale(c->along, cos(angle)), vec3_scale(c->aside, sin(angle)));
    put_pair(scene, c, axis);
}

void stiff_saddles(stiff_scene *scene, const double *number)
{
    (void)number;
    put_cells(scene, put_saddle);
}

/* Four balls around the ray: the hole in their middle is just open, or just shut. */
static void put_ring(stiff_scene *scene, const cell *c)
{
    const double radius = 0.25;
    double away = radius * stiff_inverse(scene, scene->iso / 4) * (1 + 0.5 * c->off);
    vec3 other = vec3_cross(c->along, c->aside);
    for (int i = 0; i < 4; i++) {
        vec3 axis = i % 2 ? c->aside : other;
        stiff_ball(scene, vec3_along(c->on_ray, i < 2 ? away : -away, axis), radius, 1);
    }
}

void stiff_rings(stiff_scene *scene, const double *number)
{
    (void)number;
    put_cells(scene, put_ring);
}

/* ---- Films and gaps ---- */

/* A square layer of balls of radius 1 at height y, n by n, `spacing` apart. */
static void put_layer(stiff_scene *scene, double y, int n, double spacing, double strength)
{
    for (int i = 0; i < n * n; i++) {
        int column = i % n, row = i / n;
        vec3 at = vec3_make(spacing * (column - 0.5 * (n - 1)), y, spacing * (row - 0.5 * (n - 1)));
        stiff_ball(scene, at, 1, strength);
    }
}

/* Seen slantwise from above, a layer whose thinnest places, amid four balls, are a film about to break. */
void stiff_film_face(stiff_scene *scene, const double *number)
{
    double reach = stiff_inverse(scene, scene->iso * (1 + number[0]) / 4);
    put_layer(scene, 0, 16, reach * sqrt(2), 1);
    stiff_look(scene, vec3_make(3, 14, 5), vec3_make(0, 0, 0), 45, 96, 72);
}

/* The least and the largest f in a plane y = 0 near its middle, over one spacing. */
static void range_in_plane(const stiff_scene *scene, double spacing, double range[2])
{
    range[0] = INFINITY, range[1] = 0;
    for (int i = 0; i < 121; i++) {
        int column = i % 11, row = i / 11;
        double f = stiff_value(scene, vec3_make(spacing * column / 10, 0, spacing * row / 10));
        range[0] = fmin(range[0], f), range[1] = fmax(range[1], f);
    }
}

/* A layer so dense that it is flat, L a little below its largest f: a sheet a few hundredths of a radius
 * thick, seen along its edge; the middle row of pixels looks along its very middle. */
void stiff_film_edge(stiff_scene *scene, const double *number)
{
    const double spacing = 0.4;
    double range[2];
    put_layer(scene, 0, 31, spacing, 0.05);
    range_in_plane(scene, spacing, range);
    scene->iso = range[1] / (1 + number[0]);
    stiff_look(scene, vec3_make(0, 0, 40), vec3_make(0, 0, 0), 20, 97, 73);
}

/* Two dense layers at such a distance that f in the plane between them is at most L (1 - part). */
static void put_gap(stiff_scene *scene, double part, int n, double spacing)
{
    double low = 0.3, high = 1, range[2]; /* half the distance, in radii */
    for (int step = 0; step < 40; step++) {
        double middle = 0.5 * (low + high);
        scene->count = 0;
        put_layer(scene, middle, n, spacing, 0.1);
        put_layer(scene, -middle, n, spacing, 0.1);
        range_in_plane(scene, spacing, range);
        if (range[1] > scene->iso * (1 - part))
            low = middle;
        else
            high = middle;
    }
}

void stiff_gap(stiff_scene *scene, const double *number)
{
    put_gap(scene, number[0], 21, 0.4);
    stiff_look(scene, vec3_make(0, 0, 40), vec3_make(0, 0, 0), 15, 97, 73);
}

/* The eye inside the lower layer looks up: the way out is the gap. */
void stiff_gap_inside(stiff_scene *scene, const double *number)
{
    put_gap(scene, number[0], 21, 0.4);
    vec3 eye = vec3_make(0.07, -0.5, 0.05);
    stiff_look(scene, eye, vec3_add(eye, vec3_make(0.2, 1, 0.1)), 70, 48, 36);
}
