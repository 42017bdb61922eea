/* A scene times a power of two is the same picture: colours and normals bit for bit, distances times as much.
 */
#include "support/host_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { BALLS = 60 };

static mns_field *cloud(double scale)
{
    double position[3 * BALLS], radius[BALLS];
    uint64_t random = 33;
    for (size_t i = 0; i < 3 * (size_t)BALLS; i++) position[i] = draw_random(&random) * scale;
    for (size_t i = 0; i < BALLS; i++) radius[i] = (0.15 + 0.15 * draw_random(&random)) * scale;
    return draw_field(BALLS, position, radius, 0, NULL, MNS_KERNEL_POLY3);
}

static mns_view view_of(double scale)
{
    mns_view view = draw_view((const double[3]){0.5 * scale, 0.8 * scale, 2.4 * scale},
                              (const double[3]){0.5 * scale, 0.5 * scale, 0.5 * scale}, 40, 64, 48);
    return view;
}

/* `image` with its distances divided by the scale, which is exact unless it says otherwise. */
static void unscale(mns_image *image, double scale)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++) {
        image->t[i] = (float)((double)image->t[i] * image->t_unit / scale);
        image->t_lo[i] = (float)((double)image->t_lo[i] * image->t_unit / scale);
    }
}

static void a_power_of_two_changes_nothing_but_distances(void **state)
{
    draw_fixture *d = *state;
    static const double scales[] = {0x1p-1000, 0x1p-66, 0x1p66, 0x1p900};
    const mns_method methods[] = {MNS_METHOD_LIST, MNS_METHOD_TILE, MNS_METHOD_FBVH, MNS_METHOD_BVH,
                                  MNS_METHOD_REFERENCE};
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        mns_options options = {.method = methods[m]};
        mns_field *field = cloud(1);
        mns_view view = view_of(1);
        mns_image *plain = draw_image(d, field, &view, NULL, &options);
        assert_true(plain->t_unit == 1 && d->stats.t_unit == 1 && draw_count_hits(plain) > 800);
        mns_field_destroy(field);
        for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
            char what[60];
            snprintf(what, sizeof what, "method %d times %g", methods[m], scales[i]);
            field = cloud(scales[i]);
            view = view_of(scales[i]);
            mns_image *image = draw_image(d, field, &view, NULL, &options);
            bool held = scales[i] > 1e-30 && scales[i] < 1e38;
            assert_true((image->t_unit == 1) == held && d->stats.t_unit == image->t_unit);
            if (image->t_error)
                for (int k = 0; k < 64 * 48; k++)
                    assert_true(image->t_error[k] * image->t_unit <= plain->t_error[k] * 1.0001 * scales[i]);
            unscale(image, scales[i]);
            draw_expect_same(plain, image, what);
            mns_image_destroy(image);
            mns_field_destroy(field);
        }
        mns_image_destroy(plain);
    }
}

/* Lights stand, absorption dims and occlusion reaches in scene units. */
static void effects_are_in_scene_units(void **state)
{
    draw_fixture *d = *state;
    static const double scales[] = {1, 0x1p-66, 0x1p66, 0x1p900};
    mns_image *plain = NULL;
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        double s = scales[i];
        const mns_light lights[2] = {
            {.kind = MNS_LIGHT_POINT, .position = {2 * s, 3 * s, 2 * s}},
            {.kind = MNS_LIGHT_AREA, .position = {-2 * s, 1 * s, 2 * s}, .radius = 0.5 * s}};
        mns_look look = {.lights = lights,
                         .light_count = 2,
                         .effects = {.shadows = true,
                                     .shadow_samples = 2,
                                     .reflections = 1,
                                     .refractions = 2,
                                     .index = 1.3,
                                     .transmission = 0.5,
                                     .absorption = {1 / s, 2 / s, 0.5 / s},
                                     .occlusion_rays = 4,
                                     .occlusion_reach = 0.3 * s}};
        mns_field *field = cloud(s);
        mns_view view = view_of(s);
        view.width = 24, view.height = 18;
        mns_image *image = draw_image(d, field, &view, &look, &(mns_options){.method = MNS_METHOD_REFERENCE});
        size_t pixels = 24 * 18, met = 0;
        for (size_t k = 0; k < pixels; k++) {
            image->mirror_t[k] = (float)((double)image->mirror_t[k] * image->t_unit / s);
            image->refract_t[k] = (float)((double)image->refract_t[k] * image->t_unit / s);
            met += isfinite(image->refract_t[k]) != 0;
        }
        unscale(image, s);
        assert_true(met > 20);
        if (plain) {
            draw_expect_same(plain, image, "effects");
            assert_memory_equal(plain->mirror_t, image->mirror_t, pixels * sizeof(float));
            assert_memory_equal(plain->refract_t, image->refract_t, pixels * sizeof(float));
            assert_memory_equal(plain->shadow, image->shadow, pixels * sizeof(float));
            assert_memory_equal(plain->occlusion, image->occlusion, pixels * sizeof(float));
            mns_image_destroy(image);
        } else {
            plain = image;
        }
        mns_field_destroy(field);
    }
    mns_image_destroy(plain);
}

static void a_hosts_depth_is_in_scene_units(void **state)
{
    draw_fixture *d = *state;
    static const double scales[] = {1, 0x1p-66, 0x1p66};
    host_pixels *first = NULL;
    host h = host_make(d, false);
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        double s = scales[i];
        mns_field *field = cloud(s);
        mns_view view = view_of(s);
        view.width = VIEW_WIDE, view.height = VIEW_HIGH;
        mns_target target = {.framebuffer = h.framebuffer, .x = 23, .y = 17, .near = 0.1 * s, .far = 10 * s};
        host_paint(d, &h, host_rectangle, 1.5 * s, target.near, target.far);
        host_draw_on(d, field, &view, &target);
        host_pixels *got = host_read(d, &h);
        if (first) {
            assert_memory_equal(first->color, got->color, sizeof got->color);
            for (int k = 0; k < HOST_PIXELS; k++) assert_true(fabsf(first->depth[k] - got->depth[k]) < 1e-6f);
            free(got);
        } else {
            first = got;
        }
        mns_field_destroy(field);
    }
    free(first);
    host_free(d, &h);
}

/* Floats of scene units would all be 0 there. */
static void distances_no_file_holds_are_not_written(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = cloud(0x1p-1000);
    mns_view view = view_of(0x1p-1000);
    mns_image *image = draw_image(d, field, &view, NULL, NULL);
    mns_error error;
    char exr[80], png[80];
    snprintf(exr, sizeof exr, "lengths-%ld.exr", (long)getpid());
    snprintf(png, sizeof png, "lengths-%ld.png", (long)getpid());
    assert_int_equal(mns_image_write(image, exr, &error), MNS_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.text, "write a .png, or scale the input"));
    assert_int_not_equal(access(exr, F_OK), 0);
    assert_int_equal(mns_image_write(image, png, &error), MNS_OK);
    assert_int_equal(unlink(png), 0);
    mns_image_destroy(image);
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_power_of_two_changes_nothing_but_distances),
        cmocka_unit_test(effects_are_in_scene_units),
        cmocka_unit_test(a_hosts_depth_is_in_scene_units),
        cmocka_unit_test(distances_no_file_holds_are_not_written),
    };
    return cmocka_run_group_tests_name("gl_lengths", tests, draw_fixture_setup, draw_fixture_teardown);
}
