/* Cases about numbers: radii and strengths far apart, crowds at one point, sums that nearly cancel, levels at
 * the ends of what a ball can reach. */
#include "compare/stiff_makers.h"

#include <math.h>

/* One large ball, and small ones strewn over its surface before the eye, which is near enough to see them a
 * few pixels wide. */
void stiff_ratio_near(stiff_scene *scene, const double *number)
{
    double small = 1 / number[0], surface = stiff_inverse(scene, scene->iso);
    uint64_t random = 21;
    stiff_ball(scene, vec3_make(0, 0, 0), 1, 1);
    for (int i = 0; i < 200; i++) {
        vec3 aside = stiff_random_ball(&random);
        vec3 at = vec3_make(14 * small * aside.x, 11 * small * aside.y, surface + small * aside.z);
        stiff_ball(scene, at, small * (1 + stiff_random(&random)), 1);
    }
    stiff_look(scene, vec3_make(0, 0, surface + 22 * small), vec3_make(0, 0, surface), 50, 96, 72);
}

/* Radii spread evenly over their decades, in one picture. */
void stiff_ratio_far(stiff_scene *scene, const double *number)
{
    uint64_t random = 22;
    for (int i = 0; i < 240; i++) {
        double share = i / 239.0, radius = 0.5 * pow(number[0], -share);
        vec3 at = stiff_random_cube(&random);
        if (i % 2 && i > 40) /* half the smaller ones sit on the first ball, where they can be seen */
            at = vec3_along(vec3_load(scene->position), 0.45 * stiff_random(&random),
                            stiff_random_sphere(&random));
        stiff_ball(scene, at, radius, 1);
    }
    stiff_look(scene, vec3_make(0.5, 0.8, 2.4), vec3_make(0.5, 0.5, 0.5), 40, 96, 72);
}

void stiff_coincident(stiff_scene *scene, const double *number)
{
    uint64_t random = 23;
    for (int i = 0; i < (int)number[0]; i++)
        stiff_ball(scene, vec3_scale(stiff_random_ball(&random), number[1]), 1, 1);
    if (number[2] > 0) scene->iso = number[2];
    stiff_look(scene, vec3_make(0, 1, 3), vec3_make(0, 0, 0), 45, 16, 12);
}

/* Pairs of a strength and all but its negative, a body's worth of them: each pair is worth 1. */
void stiff_cancelling(stiff_scene *scene, const double *number)
{
    uint64_t random = 24;
    stiff_scene body = {.kernel = scene->kernel};
    stiff_body(&body, 1, vec3_make(0, 0, 0));
    for (size_t i = 0; i < body.count; i++) {
        vec3 at = vec3_load(body.position + 3 * i);
        vec3 beside = vec3_along(at, number[1] * body.radius[i], stiff_random_sphere(&random));
        stiff_ball(scene, at, body.radius[i], number[0]);
        stiff_ball(scene, beside, body.radius[i], 1 - number[0]);
    }
    scene->failed |= body.failed;
    stiff_scene_free(&body);
    stiff_look_at_body(scene, 1, vec3_make(0, 0, 0));
}

/* All balls cover the middle; the higher L, the deeper into the crowd a ray goes before it hits. */
void stiff_active(stiff_scene *scene, const double *number)
{
    uint64_t random = 25;
    for (int i = 0; i < (int)number[0]; i++)
        stiff_ball(scene, vec3_scale(stiff_random_ball(&random), 0.6), 0.7 + 0.6 * stiff_random(&random), 1);
    scene->iso = number[1];
    stiff_look(scene, vec3_make(0.5, 1, 4), vec3_make(0, 0, 0), 40, 24, 18);
}

void stiff_level(stiff_scene *scene, const double *number)
{
    scene->iso = number[0];
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    stiff_look_at_body(scene, 1, vec3_make(0, 0, 0));
}

/* Sixteen balls that do not reach one another, so that each one's peak against L decides alone. */
void stiff_level_alone(stiff_scene *scene, const double *number)
{
    scene->iso = number[0];
    double core = number[0] < 1 ? stiff_inverse(scene, number[0]) : 0;
    double spacing = fmax(6 * core, 1e-3); /* in radii: the cores are what is to be seen */
    for (int i = 0; i < 16; i++) {
        int column = i % 4, row = i / 4;
        vec3 at = vec3_make(2.5 * (column - 1.5), 2.5 * (row - 1.5), 0.1 * i);
        stiff_ball(scene, at, 1, 1);
    }
    /* straight at one centre, the frame a few cores wide */
    vec3 target = vec3_load(scene->position + 3 * 5);
    stiff_look(scene, vec3_add(target, vec3_make(0.01, 0.02, 4)), target, 2 * atan(spacing / 8) * 57.29577951,
               96, 72);
}

void stiff_strengths(stiff_scene *scene, const double *number)
{
    uint64_t random = 26;
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    for (size_t i = 0; i < scene->count; i++)
        scene->strength[i] = pow(10, number[0] * (2 * stiff_random(&random) - 1));
    stiff_look_at_body(scene, 1, vec3_make(0, 0, 0));
}

void stiff_carving(stiff_scene *scene, const double *number)
{
    stiff_body(scene, 1, vec3_make(0, 0, 0));
    for (size_t i = 0; i < scene->count; i += 3) scene->strength[i] = -number[0];
    stiff_look_at_body(scene, 1, vec3_make(0, 0, 0));
}

/* So many balls in the unit cube, all of it inside the middle pixel. */
void stiff_million(stiff_scene *scene, const double *number)
{
    uint64_t random = 27;
    double radius = 0.8 / cbrt(number[0]);
    for (size_t i = 0; i < (size_t)number[0]; i++) stiff_ball(scene, stiff_random_cube(&random), radius, 1);
    vec3 middle = vec3_make(0.5, 0.5, 0.5);
    stiff_look(scene, vec3_along(middle, 100, vec3_make(0.48, 0.6, 0.64)), middle, 45, 33, 25);
}

/* So many balls in a row along the view, which L lets a ray pass; the last is strong enough to be hit. */
void stiff_line(stiff_scene *scene, const double *number)
{
    size_t count = (size_t)number[0];
    scene->iso = 10;
    for (size_t i = 0; i < count; i++)
        stiff_ball(scene, vec3_make(0, 0, -0.3 * (double)i), 1, i + 1 < count ? 1 : 100);
    stiff_look(scene, vec3_make(0, 0, 3), vec3_make(0, 0, 0), 45, 9, 7);
}
