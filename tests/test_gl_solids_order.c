/* Meshes where floats place badly what a ray meets: a hair before or behind the surface, and near the horizon
 * of a wide floor that a ball mirrors. What is told as certain is right. */
#include "support/draw_fixture.h"
#include "support/mesh_file.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDTH = 48, HEIGHT = 36, PIXELS = WIDTH * HEIGHT };

enum { BALLS_MOST = 400 };

/* Balls of radius 1 in a row along -z, and a view along (0, -dive, -1) from `eye`, whose pixels have that
 * size at distance `away`. */
typedef struct scene {
    const char *what;
    size_t count;
    double first[3], apart, strength; /* of the balls */
    double eye[3], dive, away, pixel;
    double nearest, farthest; /* from the surface: where the triangles are */
} scene;

static mns_field *field_of(const scene *s)
{
    double at[3 * BALLS_MOST], strength[BALLS_MOST];
    for (size_t i = 0; i < s->count; i++) {
        at[3 * i] = s->first[0], at[3 * i + 1] = s->first[1];
        at[3 * i + 2] = s->first[2] - s->apart * (double)i;
        strength[i] = s->strength;
    }
    return draw_field(s->count, at, NULL, 1, strength, MNS_KERNEL_POLY3);
}

static const mns_options truth = {.method = MNS_METHOD_REFERENCE};

static mns_view view_of(const scene *s)
{
    const double at[3] = {s->eye[0], s->eye[1] - s->away * s->dive, s->eye[2] - s->away};
    double half = 0.5 * HEIGHT * s->pixel / s->away;
    return draw_view(s->eye, at, 2 * atan(half) * 180 / acos(-1), WIDTH, HEIGHT);
}

static double distance(const mns_image *image, int i)
{
    return (double)image->t[i] + (double)image->t_lo[i];
}

/* Across the ray of every pixel that sees the surface a triangle, somewhat before or behind it. */
static void write_triangles(const scene *s, const mns_image *bare, mesh_path path)
{
    static char text[200 * PIXELS];
    const double c = 1 / sqrt(1 + s->dive * s->dive), d = s->dive * c;
    size_t used = 0;
    int count = 0;
    uint64_t seed = 1;
    for (int i = 0; i < PIXELS; i++) {
        double off = s->nearest * pow(s->farthest / s->nearest, draw_random(&seed));
        double t = distance(bare, i) + (draw_random(&seed) < 0.5 ? -off : off);
        if (isinf(bare->t[i])) continue;
        int column = i % WIDTH, row = i / WIDTH;
        double right = s->pixel / s->away * (column + 0.5 - 0.5 * WIDTH);
        double up = s->pixel / s->away * (0.5 * HEIGHT - row - 0.5);
        double deep = t / sqrt(1 + right * right + up * up), half = 0.4 * s->pixel / s->away * deep;
        double x = s->eye[0] + right * deep, y = s->eye[1] + (up * c - d) * deep,
               z = s->eye[2] - (c + up * d) * deep;
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "v %.12g %.12g %.12g\nv %.12g %.12g %.12g\nv %.12g %.12g %.12g\n", x - half,
                                 y - half, z, x + half, y - half, z, x, y + half, z);
        count++;
    }
    for (int i = 0; i < count; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "f %d %d %d\n", 3 * i + 1, 3 * i + 2,
                                 3 * i + 3);
    assert_true(count > 200 && used < sizeof text);
    mesh_write(".obj", text, path);
}

static void expect_order(draw_fixture *d, const scene *s, const mns_options *options)
{
    mesh_path path;
    mns_field *field = field_of(s);
    const mns_view view = view_of(s);
    const mns_light sun = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 2, 1.5}};
    mns_look look = {.lights = &sun, .light_count = 1};
    mns_image *bare = draw_image(d, field, &view, &look, &truth);
    write_triangles(s, bare, path);
    const mns_mesh mesh = {.file = path};
    look.meshes = &mesh, look.mesh_count = 1;
    mns_image *want = draw_image(d, field, &view, &look, &truth);
    mns_image *got = draw_image(d, field, &view, &look, options);
    int wrong = 0, seen = 0, certain = 0;
    for (int i = 0; i < PIXELS; i++) {
        seen += want->mesh[i] > 0;
        if (isinf(want->t[i]) || got->certain[i] * want->certain[i] != 1) continue;
        certain++;
        wrong += got->mesh[i] != want->mesh[i];
    }
    print_message("%s: %d seen, %d certain, %d wrong\n", s->what, seen, certain, wrong);
    if (wrong || seen < 100 || certain < 100)
        fail_msg("%s: %d wrong of %d, %d seen", s->what, wrong, certain, seen);
    mns_image_destroy(got);
    mns_image_destroy(want);
    mns_image_destroy(bare);
    mns_field_destroy(field);
    unlink(path);
}

/* Where a far eye's ray grazes a ball, floats place the hit worse than lengths at the field tell. */
static void the_order_at_a_far_limb_is_right_or_open(void **state)
{
    draw_fixture *d = *state;
    if (!mesh_is_built_in()) skip();
    const double limb = sqrt(1 - cbrt(0.2)), pixel = 1.4e-6;
    const scene s = {.what = "far",
                     .count = 1,
                     .strength = 1,
                     .eye = {0, limb - 12 * pixel, 1e5},
                     .away = 1e5,
                     .pixel = pixel,
                     .nearest = 1e-6,
                     .farthest = 3e-2};
    for (int k = 0; k < 2; k++)
        expect_order(d, &s, &(mns_options){.method = k ? MNS_METHOD_TILE : MNS_METHOD_FBVH});
}

/* Nearer than a radius floats place a hit by the radius, however short the way. */
static void the_order_beside_an_eye_is_right_or_open(void **state)
{
    draw_fixture *d = *state;
    if (!mesh_is_built_in()) skip();
    const double surface = sqrt(1 - cbrt(0.2));
    const scene s = {.what = "near",
                     .count = 1,
                     .first = {0, 0, -surface},
                     .strength = 1,
                     .eye = {0, 0, 1e-3},
                     .away = 1e-3,
                     .pixel = 2e-5,
                     .nearest = 1e-9,
                     .farthest = 1e-4};
    for (int k = 0; k < 2; k++)
        expect_order(d, &s, &(mns_options){.method = k ? MNS_METHOD_TILE : MNS_METHOD_FBVH});
}

/* A view from (0, 0, 4) of a place that mirrors the horizon: looks where of a wide view a mirrored ray goes
 * farthest. */
static mns_view view_of_horizon(draw_fixture *d, const mns_field *field, const mns_look *look)
{
    static const double eye[3] = {0, 0, 4}, at[3] = {0};
    const double fov = 20, unit = 2 * tan(fov * acos(-1) / 360) / HEIGHT;
    const mns_view wide = draw_view(eye, at, fov, WIDTH, HEIGHT);
    mns_image *image = draw_image(d, field, &wide, look, &truth);
    int best = 0;
    double most = 0;
    for (int i = 0; i < PIXELS; i++)
        if (isfinite(image->mirror_t[i]) && (double)image->mirror_t[i] > most)
            most = image->mirror_t[i], best = i;
    mns_image_destroy(image);
    int column = best % WIDTH, row = best / WIDTH;
    const double there[3] = {4 * unit * (column + 0.5 - 0.5 * WIDTH), 4 * unit * (0.5 * HEIGHT - row - 0.5),
                             0};
    return draw_view(eye, there, 0.25, WIDTH, HEIGHT);
}

/* A floor so wide that mirrored rays come near to it along it. */
static void a_mirrored_floor_is_right_up_to_its_horizon(void **state)
{
    draw_fixture *d = *state;
    static const double at[12] = {0.123, 0.217, 0.1,  -0.31, 0.11,  0.27,
                                  0.21,  -0.17, 0.33, -0.09, -0.26, 0.13};
    if (!mesh_is_built_in()) skip();
    mesh_path floor;
    mesh_write(".obj", "v -1e5 -1 -1e5\nv -1e5 -1 1e5\nv 1e5 -1 1e5\nv 1e5 -1 -1e5\nf 1 2 3 4\n", floor);
    mns_field *field = draw_field(4, at, NULL, 0.6, NULL, MNS_KERNEL_POLY3);
    const mns_mesh mesh = {.file = floor};
    const mns_look look = {.meshes = &mesh, .mesh_count = 1, .effects = {.reflections = 1, .mirror = 0.5}};
    const mns_view view = view_of_horizon(d, field, &look);
    mns_image *want = draw_image(d, field, &view, &look, &truth);
    mns_image *got = draw_image(d, field, &view, &look, &(mns_options){.method = MNS_METHOD_TILE});
    int wrong = 0, open = 0, far = 0;
    for (int i = 0; i < PIXELS; i++) {
        double t = got->mirror_t[i], right = want->mirror_t[i];
        far += right > 100 && right < 1e5;
        open += got->certain[i] * got->effects_certain[i] != 1;
        wrong += isinf(t) != isinf(right) || (!isinf(t) && fabs(t - right) > 0x1p-10 * right);
    }
    if (wrong || open > 2) fail_msg("%d wrong, %d open", wrong, open);
    assert_true(far > 100);
    mns_image_destroy(want);
    mns_image_destroy(got);
    mns_field_destroy(field);
    unlink(floor);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_order_at_a_far_limb_is_right_or_open),
        cmocka_unit_test(the_order_beside_an_eye_is_right_or_open),
        cmocka_unit_test(a_mirrored_floor_is_right_up_to_its_horizon),
    };
    return cmocka_run_group_tests_name("solids, order", tests, draw_fixture_setup, draw_fixture_teardown);
}
