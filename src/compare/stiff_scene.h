/* A scene under construction, and the parts that many cases share. */
#ifndef MNS_COMPARE_STIFF_SCENE_H
#define MNS_COMPARE_STIFF_SCENE_H

#include "base/vec.h"
#include "meniscus.h"

/* Balls as packed arrays. A failed allocation sets `failed`, and what follows adds nothing. */
typedef struct stiff_scene {
    size_t count, capacity;
    double *position, *radius, *strength; /* 3, 1 and 1 a ball */
    mns_kernel kernel;
    double iso; /* 0.2 unless a maker sets another */
    mns_view view;
    bool failed;
} stiff_scene;

void stiff_scene_free(stiff_scene *scene);
void stiff_ball(stiff_scene *scene, vec3 centre, double radius, double strength);
/* In [0, 1): the next number of a fixed sequence, *state its place in it. */
double stiff_random(uint64_t *state);
/* A point of the unit cube, of the unit ball, of the unit sphere. */
vec3 stiff_random_cube(uint64_t *state);
vec3 stiff_random_ball(uint64_t *state);
vec3 stiff_random_sphere(uint64_t *state);
void stiff_look(stiff_scene *scene, vec3 eye, vec3 look_at, double fov, int width, int height);
/* f at a point, in doubles, by the sum over all balls. */
double stiff_value(const stiff_scene *scene, vec3 at);
/* The v at which the scene's kernel is `ratio`, in (0, 1). */
double stiff_inverse(const stiff_scene *scene, double ratio);

/* Sixty balls of radii 0.15 to 0.3 in the unit cube, scaled and then moved: the body that is put into extreme
 * places; and a view of it as seen from (0.5, 0.8, 2.4), which shows it whole. */
void stiff_body(stiff_scene *scene, double scale, vec3 moved);
void stiff_look_at_body(stiff_scene *scene, double scale, vec3 moved);

#endif
