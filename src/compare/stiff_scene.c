#include "compare/stiff_scene.h"

#include "base/memory.h"
#include "field/kernel.h"

void stiff_scene_free(stiff_scene *scene)
{
    free(scene->position);
    free(scene->radius);
    free(scene->strength);
    *scene = (stiff_scene){0};
}

static bool reserve(stiff_scene *s)
{
    if (s->count < s->capacity) return true;
    size_t capacity = s->capacity ? 2 * s->capacity : 128;
    double *position = memory_resize(s->position, capacity, 3 * sizeof *position);
    if (position) s->position = position;
    double *radius = memory_resize(s->radius, capacity, sizeof *radius);
    if (radius) s->radius = radius;
    double *strength = memory_resize(s->strength, capacity, sizeof *strength);
    if (strength) s->strength = strength;
    if (!position || !radius || !strength) return false;
    s->capacity = capacity;
    return true;
}

void stiff_ball(stiff_scene *scene, vec3 centre, double radius, double strength)
{
    if (scene->failed || !reserve(scene)) {
        scene->failed = true;
        return;
    }
    vec3_store(scene->position + 3 * scene->count, centre);
    scene->radius[scene->count] = radius;
    scene->strength[scene->count++] = strength;
}

double stiff_random(uint64_t *state) /* splitmix64: Steele, Lea, Flood 2014 */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

vec3 stiff_random_cube(uint64_t *state)
{
    double x = stiff_random(state), y = stiff_random(state);
    return vec3_make(x, y, stiff_random(state));
}

vec3 stiff_random_ball(uint64_t *state)
{
    for (;;) {
        vec3 at = vec3_along(vec3_make(-1, -1, -1), 2, stiff_random_cube(state));
        double square = vec3_dot(at, at);
        if (square <= 1 && square > 1e-6) return at;
    }
}

vec3 stiff_random_sphere(uint64_t *state)
{
    return vec3_unit(stiff_random_ball(state));
}

void stiff_look(stiff_scene *scene, vec3 eye, vec3 look_at, double fov, int width, int height)
{
    scene->view = (mns_view){.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT,
                             .up = {0, 1, 0},
                             .fov = fov,
                             .width = width,
                             .height = height};
    vec3_store(scene->view.eye, eye);
    vec3_store(scene->view.look_at, look_at);
}

double stiff_value(const stiff_scene *scene, vec3 at)
{
    double sum = 0;
    for (size_t i = 0; i < scene->count; i++) {
        vec3 away = vec3_scale(vec3_sub(at, vec3_load(scene->position + 3 * i)), 1 / scene->radius[i]);
        double u = vec3_dot(away, away);
        if (u < 1) sum += scene->strength[i] * density_value((int)scene->kernel, u);
    }
    return sum;
}

double stiff_inverse(const stiff_scene *scene, double ratio)
{
    return kernel_core_radius(scene->kernel, ratio);
}

void stiff_body(stiff_scene *scene, double scale, vec3 moved)
{
    uint64_t random = 11;
    for (int i = 0; i < 60; i++) {
        vec3 at = vec3_along(moved, scale, stiff_random_cube(&random));
        stiff_ball(scene, at, scale * (0.15 + 0.15 * stiff_random(&random)), 1);
    }
}

void stiff_look_at_body(stiff_scene *scene, double scale, vec3 moved)
{
    vec3 eye = vec3_along(moved, scale, vec3_make(0.5, 0.8, 2.4));
    stiff_look(scene, eye, vec3_along(moved, scale, vec3_make(0.5, 0.5, 0.5)), 40, 96, 72);
}
