/* The list renderer's picture against the oracle: no missed, no invented and no later root, distances and
 * normals to the last digits of a float, for every kernel, from every kind of place, whatever way the lists
 * take. */
#include "render/render.h"
#include "support/exact.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ---- Every kernel ---- */

static void scattered_balls_are_exact_with_every_kernel(void **state)
{
    mns_view view = exact_view();
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel += exact_kernel_step(*state))
        exact_expect_cloud(*state, NULL, "scattered", &cloud_plain, (mns_kernel)kernel, &view);
}

static void dense_balls_are_exact_with_every_kernel(void **state)
{
    mns_view view = draw_view((const double[3]){1, 0.9, 2.6}, (const double[3]){1, 0.25, 0.5}, 40, EXACT_WIDE,
                              EXACT_HIGH);
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel += exact_kernel_step(*state)) {
        mns_field *field = draw_generated("dense:700", (mns_kernel)kernel);
        brute_report r = exact_expect(*state, NULL, "dense", field, &view);
        assert_true(r.hits > r.rays / 4);
        mns_field_destroy(field);
    }
}

static void strengths_of_both_signs_are_exact(void **state)
{
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY3, MNS_KERNEL_WYVILL, MNS_KERNEL_PERLIN};
    mns_view view = exact_view();
    for (size_t i = 0; i < 3; i++)
        exact_expect_cloud(*state, NULL, "strengths of both signs", &cloud_signs, kernels[i], &view);
}

static void radii_over_a_decade_are_exact(void **state)
{
    mns_view view = exact_view();
    exact_expect_cloud(*state, NULL, "mixed radii", &cloud_radii, MNS_KERNEL_POLY3, &view);
    exact_expect_cloud(*state, NULL, "mixed radii", &cloud_radii, MNS_KERNEL_WENDLAND, &view);
}

/* ---- Every kind of place ---- */

static void an_eye_inside_a_ball_but_outside_the_surface_is_exact(void **state)
{
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY3, MNS_KERNEL_PERLIN};
    for (size_t i = 0; i < 2; i++) {
        mns_field *field = cloud_field(&cloud_plain, kernels[i]);
        mns_view view = exact_view();
        view.fov = 90;
        exact_eye(field, false, view.eye);
        brute_report r = exact_expect(*state, NULL, "eye inside a ball", field, &view);
        assert_true(r.hits > r.rays / 2);
        mns_field_destroy(field);
    }
}

static void an_eye_inside_the_surface_sees_the_way_out(void **state)
{
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY2, MNS_KERNEL_WENDLAND};
    static const cloud *const clouds[] = {&cloud_plain, &cloud_signs};
    for (size_t i = 0; i < 2; i++) {
        mns_field *field = cloud_field(clouds[i], kernels[i]);
        mns_view view = exact_view();
        view.fov = 90;
        exact_eye(field, true, view.eye);
        brute_report r = exact_expect(*state, NULL, "eye inside the surface", field, &view);
        assert_true(r.hits == r.rays); /* there is always a way out */
        mns_field_destroy(field);
    }
}

/* At 10^5 radii a float holds t to a hundredth of a radius only: t and its low word together hold far more.
 */
static void a_far_eye_is_exact_to_a_small_part_of_a_radius(void **state)
{
    static const struct {
        double radii_away;
        const cloud *cloud;
        mns_kernel kernel;
    } cases[] = {{1e4, &cloud_plain, MNS_KERNEL_POLY3},
                 {1e5, &cloud_plain, MNS_KERNEL_WENDLAND},
                 {1e5, &cloud_signs, MNS_KERNEL_POLY3}};
    for (size_t i = 0; i < 3; i++) {
        mns_field *field = cloud_field(cases[i].cloud, cases[i].kernel);
        double distance = cases[i].radii_away * cloud_plain.radius_low;
        mns_view view = exact_view();
        for (int a = 0; a < 3; a++) view.eye[a] = 0.5 + distance * (const double[3]){0.48, 0.6, 0.64}[a];
        view.fov = 2 * atan(0.8 / distance) * 180 / 3.14159265358979323846;
        brute_report r = exact_expect(*state, NULL, "far eye", field, &view);
        assert_true(r.hits > r.rays / 4);
        double error = r.t_p999 * distance / cloud_plain.radius_low;
        if (error > 1e-4)
            fail_msg("%g radii away: t is off by %g of a radius at p99.9", cases[i].radii_away, error);
        mns_field_destroy(field);
    }
}

static void a_field_far_from_zero_is_exact(void **state)
{
    mns_view view = exact_view();
    for (int a = 0; a < 3; a++) view.eye[a] += cloud_moved.offset, view.look_at[a] += cloud_moved.offset;
    exact_expect_cloud(*state, NULL, "offset 1e6", &cloud_moved, MNS_KERNEL_POLY3, &view);
    exact_expect_cloud(*state, NULL, "offset 1e6", &cloud_moved, MNS_KERNEL_PERLIN, &view);
}

static void a_very_wide_field_of_view_is_exact(void **state)
{
    mns_view view = draw_view((const double[3]){0.5, 0.5, 1.3}, (const double[3]){0.5, 0.5, 0.5}, 150,
                              EXACT_WIDE, EXACT_HIGH);
    mns_field *field = cloud_field(&cloud_plain, MNS_KERNEL_POLY4);
    brute_report r = exact_expect(*state, NULL, "150 degrees", field, &view);
    assert_true(r.hits > 100);
    mns_field_destroy(field);
}

/* ---- Few balls, and none ---- */

static void one_ball_is_a_sphere(void **state)
{
    static const double centre[3] = {0.2, -0.1, 0.3};
    mns_view view = draw_view((const double[3]){0, 1, 3}, centre, 45, EXACT_WIDE, EXACT_HIGH);
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel += 4) {
        mns_field *field = draw_field(1, centre, NULL, 1, NULL, (mns_kernel)kernel);
        brute_report r = exact_expect(*state, NULL, "one ball", field, &view);
        assert_true(r.hits > r.rays / 4);
        mns_field_destroy(field);
    }
}

static void coincident_balls_add_up(void **state)
{
    double position[150], strength[50];
    for (size_t i = 0; i < 50; i++) {
        position[3 * i] = 0.2, position[3 * i + 1] = -0.1, position[3 * i + 2] = 0.3;
        strength[i] = i % 2 ? -0.5 : 0.75;
    }
    mns_view view = draw_view((const double[3]){0, 1, 3}, position, 45, EXACT_WIDE, EXACT_HIGH);
    for (int signed_too = 0; signed_too < 2; signed_too++) {
        mns_field *field = draw_field(50, position, NULL, 1, signed_too ? strength : NULL, MNS_KERNEL_WYVILL);
        brute_report r = exact_expect(*state, NULL, "coincident balls", field, &view);
        assert_true(r.hits > r.rays / 4);
        mns_field_destroy(field);
    }
}

static void an_empty_field_is_background(void **state)
{
    mns_view view = exact_view();
    mns_field *field = draw_field(0, NULL, NULL, 1, NULL, MNS_KERNEL_POLY3);
    mns_image *image = draw_image(*state, field, &view, NULL, NULL);
    assert_int_equal(draw_count_hits(image), 0);
    for (size_t i = 0; i < (size_t)EXACT_WIDE * EXACT_HIGH; i++) {
        assert_true(image->t[i] > 0 && image->t_lo[i] == 0 && image->certain[i] == 1);
        for (size_t c = 0; c < 4; c++) assert_true(image->rgba[4 * i + c] == 1);
        for (size_t c = 0; c < 3; c++) assert_true(image->normal[3 * i + c] == 0);
    }
    mns_image_destroy(image);
    mns_field_destroy(field);
    draw_fixture_check(*state);
}

static void balls_behind_the_eye_are_not_seen(void **state)
{
    draw_fixture *d = *state;
    mns_view view = exact_view();
    view.look_at[2] = 5; /* away from the cube */
    mns_field *field = cloud_field(&cloud_plain, MNS_KERNEL_POLY3);
    mns_image *image = draw_image(d, field, &view, NULL, NULL);
    assert_int_equal(draw_count_hits(image), 0);
    assert_int_equal(d->stats.balls_in_view, 0);
    mns_image_destroy(image);
    mns_field_destroy(field);
    view.eye[2] = 0.5, view.fov = 60; /* half the balls behind it */
    exact_expect_cloud(d, NULL, "half behind the eye", &cloud_plain, MNS_KERNEL_POLY3, &view);
}

/* ---- Ways that must not matter ---- */

/* The paper's pass lets in fewer of the balls that lie behind a core, so that a sum may be taken in another
 * order: the same hits, and all but a few of them the same bits. */
static void expect_same_hits(const mns_image *a, const mns_image *b)
{
    size_t hits = 0, different = 0;
    for (size_t i = 0; i < (size_t)EXACT_WIDE * EXACT_HIGH; i++) {
        assert_int_equal(isfinite(a->t[i]) != 0, isfinite(b->t[i]) != 0);
        assert_true(a->certain[i] == b->certain[i]);
        if (!isfinite(a->t[i])) continue;
        hits++;
        different += a->t[i] != b->t[i];
        assert_true(fabsf(a->t[i] - b->t[i]) <= 1e-6f * a->t[i]);
    }
    assert_true(hits > 1000 && different < hits / 100);
}

static void the_papers_gathering_gives_the_same_picture(void **state)
{
    draw_fixture *d = *state;
    static const cloud *const clouds[] = {&cloud_plain, &cloud_radii};
    mns_view view = exact_view();
    for (size_t i = 0; i < 2; i++) {
        mns_field *field = cloud_field(clouds[i], MNS_KERNEL_POLY3);
        mns_image *early = draw_image(d, field, &view, NULL, NULL);
        mns_image *paper = draw_image(d, field, &view, NULL, &(mns_options){.gather = MNS_GATHER_PAPER});
        assert_string_equal(d->stats.gather, "paper");
        expect_same_hits(early, paper);
        mns_image_destroy(early);
        mns_image_destroy(paper);
        mns_field_destroy(field);
    }
    draw_fixture_check(d);
}

/* A ball has 3 to 5 floats, each with a texel's layout of its own. */
static void reading_by_texels_or_by_storage_blocks_gives_the_same_bits(void **state)
{
    draw_fixture *d = *state;
    static const cloud *const clouds[] = {&cloud_plain, &cloud_radii, &cloud_signs};
    int texels = d->renderer->device.limits.max_texture_buffer;
    mns_view view = exact_view();
    for (size_t i = 0; i < 3; i++) {
        mns_field *field = cloud_field(clouds[i], MNS_KERNEL_POLY3);
        mns_options few = {.max_pool_nodes = 1 << 19};
        mns_image *by_texels = draw_image(d, field, &view, NULL, &few);
        assert_true(mns_plan_features(mns_frame_plan(d->frame)) & FEATURE_TEXELS);
        d->renderer->device.limits.max_texture_buffer = 1;
        mns_image *by_blocks = draw_image(d, field, &view, NULL, &few);
        assert_false(mns_plan_features(mns_frame_plan(d->frame)) & FEATURE_TEXELS);
        d->renderer->device.limits.max_texture_buffer = texels;
        draw_expect_same(by_texels, by_blocks, "texels");
        mns_image_destroy(by_texels);
        mns_image_destroy(by_blocks);
        mns_field_destroy(field);
    }
    draw_fixture_check(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scattered_balls_are_exact_with_every_kernel),
        cmocka_unit_test(dense_balls_are_exact_with_every_kernel),
        cmocka_unit_test(strengths_of_both_signs_are_exact),
        cmocka_unit_test(radii_over_a_decade_are_exact),
        cmocka_unit_test(an_eye_inside_a_ball_but_outside_the_surface_is_exact),
        cmocka_unit_test(an_eye_inside_the_surface_sees_the_way_out),
        cmocka_unit_test(a_far_eye_is_exact_to_a_small_part_of_a_radius),
        cmocka_unit_test(a_field_far_from_zero_is_exact),
        cmocka_unit_test(a_very_wide_field_of_view_is_exact),
        cmocka_unit_test(one_ball_is_a_sphere),
        cmocka_unit_test(coincident_balls_add_up),
        cmocka_unit_test(an_empty_field_is_background),
        cmocka_unit_test(balls_behind_the_eye_are_not_seen),
        cmocka_unit_test(the_papers_gathering_gives_the_same_picture),
        cmocka_unit_test(reading_by_texels_or_by_storage_blocks_gives_the_same_bits),
    };
    return cmocka_run_group_tests_name("list", tests, draw_fixture_setup, draw_fixture_teardown);
}
