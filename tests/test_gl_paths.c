/* Light beyond the first hit, traced on the GPU, against the truth's: terms and colours, pixel by pixel, of
 * every method and effect, at every scale, from inside too. */
#include "support/light_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static void every_method_draws_the_truth(void **state)
{
    static const struct {
        const char *field;
        const light_look *look;
        mns_method method;
        int off;
    } cases[] = {
        {"dense:500", &light_soft, MNS_METHOD_FBVH, 0},    {"dense:500", &light_soft, MNS_METHOD_TILE, 0},
        {"tornado:1000", &light_soft, MNS_METHOD_LIST, 0}, {"tornado:1000", &light_glass, MNS_METHOD_FBVH, 6},
        {"dense:500", &light_glass, MNS_METHOD_FBVH, 6},   {"tornado:1000", &light_glass, MNS_METHOD_BVH, 6}};
    draw_fixture *d = *state;
    for (size_t i = 0; i < (light_is_second(d) ? 1 : sizeof cases / sizeof *cases); i++) {
        mns_field *field = draw_generated(cases[i].field, MNS_KERNEL_DEFAULT);
        const mns_options options = {.method = cases[i].method};
        light_expect_truth(d, field, &light_view, cases[i].look, &options, 1e-4, cases[i].off,
                           cases[i].field);
        mns_field_destroy(field);
    }
}

/* A polynomial along a ray, and one that is none. */
static void every_kind_of_kernel_leaves_the_surface(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_FBVH};
    static const mns_kernel kernels[] = {MNS_KERNEL_WENDLAND, MNS_KERNEL_POLY4};
    for (int i = 0; i < (light_is_second(d) ? 1 : 2); i++) {
        mns_field *field = draw_generated("mixed:200", kernels[i]);
        light_expect_truth(d, field, &light_view, &light_mirror, &options, 1e-4, 2,
                           mns_kernel_name(kernels[i]));
        mns_field_destroy(field);
    }
}

/* ---- Scales ---- */

enum { BALLS = 150 };

/* Every fifth ball carves. */
static mns_field *balls_of_size(double size)
{
    double position[3 * BALLS], strength[BALLS];
    uint64_t state = 5;
    for (int i = 0; i < 3 * BALLS; i++) position[i] = size * draw_random(&state);
    for (int i = 0; i < BALLS; i++) strength[i] = i % 5 ? 1 : -0.75;
    return draw_field(BALLS, position, NULL, 0.16 * size, strength, MNS_KERNEL_POLY3);
}

static light_look mirror_and_occlusion(void)
{
    light_look look = light_mirror;
    look.look.effects.occlusion_rays = 4;
    return look;
}

static void no_scale_has_acne_or_leaks(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_FBVH};
    const light_look look = mirror_and_occlusion();
    for (double size = 1e-6; size < 1e7; size *= 1e12) {
        const double eye[3] = {0.5 * size, 0.7 * size, 2.6 * size},
                     at[3] = {0.5 * size, 0.5 * size, 0.5 * size};
        char what[32];
        snprintf(what, sizeof what, "size %g", size);
        mns_field *field = balls_of_size(size);
        mns_view view = draw_view(eye, at, 40, LIGHT_WIDTH, LIGHT_HEIGHT);
        light_expect_truth(d, field, &view, &look, &options, 1e-4 * size, 2, what);
        mns_field_destroy(field);
    }
}

/* An eye 100,000 sizes away: its first hits come from a plane at the box. */
static void a_far_eye_sees_the_same_light(void **state)
{
    draw_fixture *d = *state;
    const double eye[3] = {0.5, 3e4, 1e5}, at[3] = {0.5, 0.5, 0.5};
    const mns_options options = {.method = MNS_METHOD_LIST};
    const light_look look = mirror_and_occlusion();
    if (light_is_second(d)) skip();
    mns_field *field = balls_of_size(1);
    mns_view view = draw_view(eye, at, 1e-3, LIGHT_WIDTH, LIGHT_HEIGHT);
    light_expect_truth(d, field, &view, &look, &options, 1e-3, 2, "far");
    mns_field_destroy(field);
}

static void an_eye_inside_sees_light_too(void **state)
{
    draw_fixture *d = *state;
    const double eye[3] = {1, 0.25, 0.5}, at[3] = {0, 0.1, 0.2};
    const mns_options options = {.method = MNS_METHOD_FBVH};
    if (light_is_second(d)) skip();
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    mns_view view = draw_view(eye, at, 60, LIGHT_WIDTH, LIGHT_HEIGHT);
    light_expect_truth(d, field, &view, &light_soft, &options, 1e-4, 0, "inside");
    light_expect_truth(d, field, &view, &light_glass, &options, 1e-4, 8, "inside");
    mns_field_destroy(field);
}

/* ---- Pictures ---- */

static void colours_cel_and_samples_are_the_truths(void **state)
{
    draw_fixture *d = *state;
    mns_options few = {.method = MNS_METHOD_FBVH, .samples = 2};
    mns_options same = light_truth;
    same.samples = 2;
    static const struct {
        const char *field, *color_by;
        mns_shading shading;
    } cases[] = {{"tornado:500", "speed", MNS_SHADING_SMOOTH}, {"molecule:100", "element", MNS_SHADING_CEL}};
    if (light_is_second(d)) skip();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_field *field = draw_generated(cases[i].field, MNS_KERNEL_DEFAULT);
        light_look look = light_mirror;
        look.look.color_by = cases[i].color_by;
        look.look.shading = cases[i].shading;
        mns_image *want = draw_image(d, field, &light_view, &look.look, &same);
        mns_image *got = draw_image(d, field, &light_view, &look.look, &few);
        light_tally sum = light_compare(got, want, 1e-4, 4e-3);
        if (sum.wrong || sum.off > 16 || sum.open > 4)
            fail_msg("%s: %d open, %d wrong, %d off", cases[i].field, sum.open, sum.wrong, sum.off);
        mns_image_destroy(want);
        mns_image_destroy(got);
        mns_field_destroy(field);
    }
}

/* Each sample of a pixel has rays of its own, of the seed's sequence. */
static void samples_and_seeds_have_the_truths_rays(void **state)
{
    draw_fixture *d = *state;
    mns_options few = {.method = MNS_METHOD_FBVH, .samples = 3}, same = light_truth;
    same.samples = 3;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    mns_look look = light_soft.look;
    for (uint32_t seed = 0; seed < 8; seed += 7) {
        look.effects.seed = seed;
        mns_image *want = draw_image(d, field, &light_view, &look, &same);
        mns_image *got = draw_image(d, field, &light_view, &look, &few);
        light_tally sum = light_compare(got, want, 1e-4, 3e-3);
        if (sum.wrong || sum.off > 4 || sum.open > 4)
            fail_msg("seed %u: %d open, %d wrong, %d off", seed, sum.open, sum.wrong, sum.off);
        mns_image_destroy(want);
        mns_image_destroy(got);
    }
    mns_field_destroy(field);
}

/* So far away that floats do not hold the square of it, by the same program. */
static const mns_light far_lamps[LIGHT_LAMPS] = {
    {.kind = MNS_LIGHT_POINT, .position = {1e25, 2e25, 2e25}, .color = {1, 0.5, 0.25}},
    {.kind = MNS_LIGHT_AREA, .position = {-1e22, 2e22, 1e22}, .radius = 5e21, .strength = 0.5},
    {.kind = MNS_LIGHT_HEAD, .strength = 0.25},
    {.kind = MNS_LIGHT_AREA, .position = {0, 1, 0.5}, .radius = 1e23, .strength = 0.25}};

/* Between balls, or around one: what stands behind a light, or in it, shades nothing. */
static const mns_light near_lamps[LIGHT_LAMPS] = {
    {.kind = MNS_LIGHT_POINT, .position = {1.1, 0.1, 0.3}},
    {.kind = MNS_LIGHT_AREA, .position = {1.1, -0.6, 0.2}, .radius = 0.9},
    {.kind = MNS_LIGHT_HEAD, .strength = 0.25},
    {.kind = MNS_LIGHT_AREA, .position = {1.1, 0.3, -0.2}, .radius = 0.1}};

static void lights_may_be_endlessly_far_and_between_balls(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_FBVH};
    light_look look = light_soft;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    look.look.lights = far_lamps;
    light_expect_truth(d, field, &light_view, &look, &options, 1e-4, 0, "far lamps");
    mns_field_destroy(field);
    static const double three[9] = {0, 0, 0, 2.2, 0, 0, 1.1, -0.75, 0};
    field = draw_field(3, three, NULL, 1, NULL, MNS_KERNEL_DEFAULT);
    look.look.lights = near_lamps;
    light_expect_truth(d, field, &light_view, &look, &options, 1e-4, 0, "near lamps");
    mns_field_destroy(field);
}

static void a_map_stands_around_the_scene(void **state)
{
    draw_fixture *d = *state;
    char path[] = "/tmp/paths-XXXXXX.exr";
    mns_error error;
    if (light_is_second(d)) skip();
    mns_field *field = draw_generated("scattered:200", MNS_KERNEL_DEFAULT);
    mns_image *picture = draw_image(d, field, &light_view, NULL, NULL);
    int file = mkstemps(path, 4);
    assert_true(file >= 0);
    close(file);
    if (mns_image_write(picture, path, &error)) fail_msg("%s", error.text);
    light_look look = light_mirror;
    look.look.effects.environment = path;
    const mns_options options = {.method = MNS_METHOD_LIST};
    /* Between two texels of an edge in the map a ray's last digits are seen. */
    light_expect_truth(d, field, &light_view, &look, &options, 1e-4, 12, "map");
    /* Another in the same file: its top is where the view's is, and behind its two ends meet. */
    static const double eye[3] = {0.5, 0.6, -2}, at[3] = {0.5, 0.5, 0.5};
    mns_view behind = draw_view(eye, at, 60, LIGHT_WIDTH, LIGHT_HEIGHT);
    memcpy(behind.up, light_tilted_view.up, sizeof behind.up);
    mns_image *other = draw_image(d, field, &(mns_view){.width = 13, .height = 7}, NULL, NULL);
    uint64_t seed = 1;
    for (int i = 0; i < 4 * 13 * 7; i++) other->rgba[i] = i % 4 < 3 ? (float)draw_random(&seed) : 1;
    if (mns_image_write(other, path, &error)) fail_msg("%s", error.text);
    light_expect_truth(d, field, &behind, &look, &options, 1e-4, 0, "another map");
    unlink(path);
    mns_image_destroy(other);
    mns_image_destroy(picture);
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_draws_the_truth),
        cmocka_unit_test(every_kind_of_kernel_leaves_the_surface),
        cmocka_unit_test(no_scale_has_acne_or_leaks),
        cmocka_unit_test(a_far_eye_sees_the_same_light),
        cmocka_unit_test(an_eye_inside_sees_light_too),
        cmocka_unit_test(colours_cel_and_samples_are_the_truths),
        cmocka_unit_test(samples_and_seeds_have_the_truths_rays),
        cmocka_unit_test(lights_may_be_endlessly_far_and_between_balls),
        cmocka_unit_test(a_map_stands_around_the_scene),
    };
    return cmocka_run_group_tests_name("light's ways", tests, draw_fixture_setup, draw_fixture_teardown);
}
