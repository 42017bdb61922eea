/* The pictures of fbvh and bvh against the oracle, as tests/test_gl_list.c holds the list's, and against the
 * list's pixel by pixel; rays along the axes and in the faces of boxes; trees that are built in other ways.
 */
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

static const mns_options methods[] = {{.method = MNS_METHOD_FBVH}, {.method = MNS_METHOD_BVH}};
enum { METHODS = sizeof methods / sizeof *methods };

static void expect_cloud(draw_fixture *d, const char *what, const cloud *c, mns_kernel kernel,
                         const mns_view *view)
{
    for (int i = 0; i < METHODS; i++) exact_expect_cloud(d, &methods[i], what, c, kernel, view);
}

/* By both trees; `least` of the rays hit. */
static void expect_field(draw_fixture *d, const char *what, const mns_field *field, const mns_view *view,
                         double least)
{
    for (int i = 0; i < METHODS; i++) {
        brute_report r = exact_expect(d, &methods[i], what, field, view);
        if ((double)r.hits < least * (double)r.rays)
            fail_msg("%s: only %zu of %zu rays hit", what, r.hits, r.rays);
    }
}

/* Of so many variants, those that a back end is tested with: through the second one, which has the same
 * rasteriser behind it, the first alone (see exact_kernel_step). */
static size_t of_variants(const draw_fixture *d, size_t count)
{
    return d->gl.backend == MNS_BACKEND_OSMESA ? 1 : count;
}

/* ---- Every kernel ---- */

static void scattered_balls_are_exact_with_every_kernel(void **state)
{
    mns_view view = exact_view();
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel += exact_kernel_step(*state))
        expect_cloud(*state, "scattered", &cloud_plain, (mns_kernel)kernel, &view);
}

static void dense_balls_are_exact(void **state)
{
    mns_view view = draw_view((const double[3]){1, 0.9, 2.6}, (const double[3]){1, 0.25, 0.5}, 40, EXACT_WIDE,
                              EXACT_HIGH);
    const int step = of_variants(*state, 2) > 1 ? 4 : 8;
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel += step) {
        mns_field *field = draw_generated("dense:700", (mns_kernel)kernel);
        expect_field(*state, "dense", field, &view, 0.25);
        mns_field_destroy(field);
    }
}

static void strengths_of_both_signs_are_exact(void **state)
{
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY3, MNS_KERNEL_WYVILL, MNS_KERNEL_PERLIN};
    mns_view view = exact_view();
    for (size_t i = 0; i < of_variants(*state, 3); i++)
        expect_cloud(*state, "strengths of both signs", &cloud_signs, kernels[i], &view);
}

static void radii_over_a_decade_are_exact(void **state)
{
    mns_view view = exact_view();
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY3, MNS_KERNEL_WENDLAND};
    for (size_t i = 0; i < of_variants(*state, 2); i++)
        expect_cloud(*state, "mixed radii", &cloud_radii, kernels[i], &view);
}

/* ---- Every kind of place ---- */

static void an_eye_inside_a_ball_but_outside_the_surface_is_exact(void **state)
{
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY3, MNS_KERNEL_PERLIN};
    for (size_t i = 0; i < of_variants(*state, 2); i++) {
        mns_field *field = cloud_field(&cloud_plain, kernels[i]);
        mns_view view = exact_view();
        view.fov = 90;
        exact_eye(field, false, view.eye);
        expect_field(*state, "eye inside a ball", field, &view, 0.5);
        mns_field_destroy(field);
    }
}

static void an_eye_inside_the_surface_sees_the_way_out(void **state)
{
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY2, MNS_KERNEL_WENDLAND, MNS_KERNEL_POLY3};
    static const cloud *const clouds[] = {&cloud_plain, &cloud_signs, &cloud_radii};
    for (size_t i = 0; i < of_variants(*state, 3); i++) {
        mns_field *field = cloud_field(clouds[i], kernels[i]);
        mns_view view = exact_view();
        view.fov = 90;
        exact_eye(field, true, view.eye);
        expect_field(*state, "eye inside the surface", field, &view, 1); /* there is always a way out */
        mns_field_destroy(field);
    }
}

static void a_far_eye_is_exact_to_a_small_part_of_a_radius(void **state)
{
    static const struct {
        double radii_away;
        const cloud *cloud;
        mns_kernel kernel;
    } cases[] = {{1e4, &cloud_plain, MNS_KERNEL_POLY3},
                 {1e5, &cloud_plain, MNS_KERNEL_WENDLAND},
                 {1e5, &cloud_signs, MNS_KERNEL_POLY3}};
    for (size_t i = 0; i < of_variants(*state, 3) * METHODS; i++) {
        size_t k = i / METHODS;
        mns_field *field = cloud_field(cases[k].cloud, cases[k].kernel);
        double distance = cases[k].radii_away * cloud_plain.radius_low;
        mns_view view = exact_view();
        for (int a = 0; a < 3; a++) view.eye[a] = 0.5 + distance * (const double[3]){0.48, 0.6, 0.64}[a];
        view.fov = 2 * atan(0.8 / distance) * 180 / 3.14159265358979323846;
        brute_report r = exact_expect(*state, &methods[i % METHODS], "far eye", field, &view);
        assert_true(r.hits > r.rays / 4);
        double error = r.t_p999 * distance / cloud_plain.radius_low;
        if (error > 1e-4)
            fail_msg("%g radii away: t is off by %g of a radius at p99.9", cases[k].radii_away, error);
        mns_field_destroy(field);
    }
}

static void a_field_far_from_zero_is_exact(void **state)
{
    mns_view view = exact_view();
    for (int a = 0; a < 3; a++) view.eye[a] += cloud_moved.offset, view.look_at[a] += cloud_moved.offset;
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY3, MNS_KERNEL_PERLIN};
    for (size_t i = 0; i < of_variants(*state, 2); i++)
        expect_cloud(*state, "offset 1e6", &cloud_moved, kernels[i], &view);
}

static void a_very_wide_field_of_view_is_exact(void **state)
{
    mns_view view = draw_view((const double[3]){0.5, 0.5, 1.3}, (const double[3]){0.5, 0.5, 0.5}, 150,
                              EXACT_WIDE, EXACT_HIGH);
    mns_field *field = cloud_field(&cloud_plain, MNS_KERNEL_POLY3);
    expect_field(*state, "150 degrees", field, &view, 0.05);
    mns_field_destroy(field);
}

/* Of an odd frame the middle row and column run along planes of the axes, and the middle pixel along one:
 * directions with zeros, and balls in a lattice, whose boxes' faces lie in those very planes. */
static void rays_along_axes_and_in_faces_are_exact(void **state)
{
    enum { SIDE = 5 };
    static double position[3 * SIDE * SIDE * SIDE];
    size_t count = 0;
    for (int x = 0; x < SIDE; x++)
        for (int y = 0; y < SIDE; y++)
            for (int z = 0; z < SIDE; z++, count++) {
                position[3 * count] = x - 2;
                position[3 * count + 1] = y - 2;
                position[3 * count + 2] = z - 2;
            }
    static const double eyes[][3] = {{0, 0, 12}, {0.5, 0.5, 12}, {12, 0, 0}, {0, -12, 0.5}};
    for (int wide = 0; wide < 2; wide++) {
        mns_field *field = draw_field(count, position, NULL, wide ? 1.6 : 0.6, NULL, MNS_KERNEL_POLY3);
        for (size_t i = 0; i < sizeof eyes / sizeof *eyes; i++) {
            double at[3] = {eyes[i][0], eyes[i][1], eyes[i][2]};
            for (int a = 0; a < 3; a++)
                if (fabs(at[a]) == 12) at[a] = 0;
            mns_view view = draw_view(eyes[i], at, 30, 121, 91);
            if (i == 3) view.up[1] = 0, view.up[2] = 1;
            expect_field(*state, "a lattice along its axes", field, &view, 0.1);
        }
        mns_field_destroy(field);
    }
}

/* ---- Few balls, and none ---- */

static void one_ball_is_a_sphere(void **state)
{
    static const double centre[3] = {0.2, -0.1, 0.3};
    mns_view view = draw_view((const double[3]){0, 1, 3}, centre, 45, EXACT_WIDE, EXACT_HIGH);
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel += 4) {
        mns_field *field = draw_field(1, centre, NULL, 1, NULL, (mns_kernel)kernel);
        expect_field(*state, "one ball", field, &view, 0.25);
        mns_field_destroy(field);
    }
}

/* So many on one point that they outgrow the slots, and that no tree can part them. */
static void coincident_balls_add_up(void **state)
{
    enum { MANY = 300 };
    double position[3 * MANY], strength[MANY];
    for (size_t i = 0; i < MANY; i++) {
        position[3 * i] = 0.2, position[3 * i + 1] = -0.1, position[3 * i + 2] = 0.3;
        strength[i] = i % 2 ? -0.5 : 0.75;
    }
    mns_view view = draw_view((const double[3]){0, 1, 3}, position, 45, EXACT_WIDE, EXACT_HIGH);
    for (int signed_too = 0; signed_too < 2; signed_too++) {
        mns_field *field =
            draw_field(MANY, position, NULL, 1, signed_too ? strength : NULL, MNS_KERNEL_POLY3);
        expect_field(*state, "coincident balls", field, &view, 0.25);
        assert_true(((draw_fixture *)*state)->stats.fallbacks.active_overflow > 0);
        mns_field_destroy(field);
    }
}

static void a_field_without_surface_is_background(void **state)
{
    static const double one[3] = {0, 0, 0}, below = 0.1;
    mns_field *fields[] = {draw_field(0, NULL, NULL, 1, NULL, MNS_KERNEL_POLY3),
                           draw_field(1, one, NULL, 1, &below, MNS_KERNEL_POLY3)};
    mns_view view = exact_view();
    for (size_t k = 0; k < 2 * METHODS; k++) {
        mns_image *image = draw_image(*state, fields[k / METHODS], &view, NULL, &methods[k % METHODS]);
        assert_int_equal(draw_count_hits(image), 0);
        for (size_t i = 0; i < (size_t)EXACT_WIDE * EXACT_HIGH; i++) {
            assert_true(image->t[i] > 0 && image->t_lo[i] == 0 && image->certain[i] == 1);
            for (size_t c = 0; c < 4; c++) assert_true(image->rgba[4 * i + c] == 1);
        }
        mns_image_destroy(image);
    }
    for (size_t i = 0; i < 2; i++) mns_field_destroy(fields[i]);
    draw_fixture_check(*state);
}

/* ---- Ways that must not matter ---- */

static void expect_same_hits(const char *what, const mns_image *a, const mns_image *b)
{
    size_t hits = 0;
    for (size_t i = 0; i < (size_t)a->width * (size_t)a->height; i++) {
        if (isfinite(a->t[i]) != isfinite(b->t[i]) || a->certain[i] != b->certain[i])
            fail_msg("%s: pixel %zu: t %g and %g", what, i, (double)a->t[i], (double)b->t[i]);
        if (!isfinite(a->t[i])) continue;
        hits++;
        if (fabsf(a->t[i] - b->t[i]) > 1e-5f * a->t[i])
            fail_msg("%s: pixel %zu: t %.9g and %.9g", what, i, (double)a->t[i], (double)b->t[i]);
    }
    assert_true(hits > 1000);
}

/* Pixel by pixel the list's picture, whatever way the tree is built. */
static void every_way_to_build_gives_the_lists_picture(void **state)
{
    draw_fixture *d = *state;
    static const char *const ways[] = {"",
                                       "no-fit",
                                       "no-tight",
                                       "no-discard",
                                       "cost-n",
                                       "leaf-least=64",
                                       "references=1",
                                       "middle-levels=4",
                                       "no-tight,no-discard,no-fit,cost-n"};
    static const cloud *const clouds[] = {&cloud_plain, &cloud_radii, &cloud_signs};
    mns_view view = exact_view();
    for (size_t c = 0; c < of_variants(d, 3); c++) {
        mns_field *field = cloud_field(clouds[c], MNS_KERNEL_POLY3);
        mns_image *list = draw_image(d, field, &view, NULL, NULL);
        for (size_t i = 0; i < METHODS * sizeof ways / sizeof *ways; i++) {
            mns_options options = methods[i % METHODS];
            options.tree = ways[i / METHODS];
            mns_image *tree = draw_image(d, field, &view, NULL, &options);
            expect_same_hits(*options.tree ? options.tree : "defaults", list, tree);
            mns_image_destroy(tree);
        }
        mns_image_destroy(list);
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
    for (size_t i = 0; i < of_variants(d, 3) * METHODS; i++) {
        const mns_options *options = &methods[i % METHODS];
        mns_field *field = cloud_field(clouds[i / METHODS], MNS_KERNEL_POLY3);
        mns_image *by_texels = draw_image(d, field, &view, NULL, options);
        assert_true(mns_plan_features(mns_frame_plan(d->frame)) & FEATURE_TEXELS);
        d->renderer->device.limits.max_texture_buffer = 1;
        mns_image *by_blocks = draw_image(d, field, &view, NULL, options);
        assert_false(mns_plan_features(mns_frame_plan(d->frame)) & FEATURE_TEXELS);
        d->renderer->device.limits.max_texture_buffer = texels;
        draw_expect_same(by_texels, by_blocks, "texels");
        mns_image_destroy(by_texels);
        mns_image_destroy(by_blocks);
        mns_field_destroy(field);
    }
    draw_fixture_check(d);
}

/* Blocks that hold no more than the balls: the tree is made smaller, the frame drawn in rows, the picture the
 * same. */
static void small_blocks_make_the_tree_smaller(void **state)
{
    draw_fixture *d = *state;
    size_t block = d->renderer->device.limits.max_storage_block;
    mns_view view = exact_view();
    for (int i = 0; i < METHODS; i++) {
        mns_field *field = cloud_field(&cloud_plain, MNS_KERNEL_POLY3);
        mns_image *large = draw_image(d, field, &view, NULL, &methods[i]);
        d->renderer->device.limits.max_storage_block = 600 * 16 + 64;
        mns_image *small = draw_image(d, field, &view, NULL, &methods[i]);
        assert_true(d->stats.tiles > 1);
        d->renderer->device.limits.max_storage_block = block;
        expect_same_hits("small blocks", large, small);
        mns_image_destroy(large);
        mns_image_destroy(small);
        mns_field_destroy(field);
    }
    draw_fixture_check(d);
}

/* Few slots, few steps: pixels go on in float over all references, or in doubles. */
static void slow_paths_give_the_same_picture(void **state)
{
    draw_fixture *d = *state;
    static const cloud *const clouds[] = {&cloud_plain, &cloud_signs};
    mns_view view = exact_view();
    for (size_t i = 0; i < of_variants(d, 2) * METHODS; i++) {
        mns_options options = methods[i % METHODS];
        mns_field *field = cloud_field(clouds[i / METHODS], MNS_KERNEL_POLY3);
        mns_image *usual = draw_image(d, field, &view, NULL, &options);
        options.slots = 2;
        options.root_steps = 1;
        mns_image *slow = draw_image(d, field, &view, NULL, &options);
        assert_true(d->stats.fallbacks.active_overflow > 100);
        expect_same_hits("slow paths", usual, slow);
        mns_image_destroy(usual);
        mns_image_destroy(slow);
        mns_field_destroy(field);
    }
    draw_fixture_check(d);
}

/* The published solver misses what rises and falls between two centres' projections, and takes a later root
 * where a bracket holds several: few pixels, and nothing else. */
static void secants_are_off_in_few_pixels(void **state)
{
    draw_fixture *d = *state;
    mns_view view = exact_view();
    mns_field *field = cloud_field(&cloud_plain, MNS_KERNEL_POLY3);
    for (int k = 0; k < METHODS; k++) {
        mns_options options = methods[k];
        size_t hits = 0, missed = 0, other = 0;
        mns_image *exact = draw_image(d, field, &view, NULL, &options);
        options.solver = MNS_SOLVER_SECANT;
        mns_image *secant = draw_image(d, field, &view, NULL, &options);
        for (size_t i = 0; i < (size_t)EXACT_WIDE * EXACT_HIGH; i++) {
            bool hit = isfinite(exact->t[i]);
            assert_true(hit || !isfinite(secant->t[i]));
            hits += hit;
            missed += hit && !isfinite(secant->t[i]);
            other += hit && fabsf(secant->t[i] - exact->t[i]) > 1e-5f * exact->t[i];
        }
        if (hits < 1000 || missed + other > hits / 100)
            fail_msg("%zu hits, %zu missed, %zu elsewhere", hits, missed, other);
        mns_image_destroy(exact);
        mns_image_destroy(secant);
    }
    mns_field_destroy(field);
    draw_fixture_check(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scattered_balls_are_exact_with_every_kernel),
        cmocka_unit_test(dense_balls_are_exact),
        cmocka_unit_test(strengths_of_both_signs_are_exact),
        cmocka_unit_test(radii_over_a_decade_are_exact),
        cmocka_unit_test(an_eye_inside_a_ball_but_outside_the_surface_is_exact),
        cmocka_unit_test(an_eye_inside_the_surface_sees_the_way_out),
        cmocka_unit_test(a_far_eye_is_exact_to_a_small_part_of_a_radius),
        cmocka_unit_test(a_field_far_from_zero_is_exact),
        cmocka_unit_test(a_very_wide_field_of_view_is_exact),
        cmocka_unit_test(rays_along_axes_and_in_faces_are_exact),
        cmocka_unit_test(one_ball_is_a_sphere),
        cmocka_unit_test(coincident_balls_add_up),
        cmocka_unit_test(a_field_without_surface_is_background),
        cmocka_unit_test(every_way_to_build_gives_the_lists_picture),
        cmocka_unit_test(reading_by_texels_or_by_storage_blocks_gives_the_same_bits),
        cmocka_unit_test(small_blocks_make_the_tree_smaller),
        cmocka_unit_test(slow_paths_give_the_same_picture),
        cmocka_unit_test(secants_are_off_in_few_pixels),
    };
    return cmocka_run_group_tests_name("fbvh", tests, draw_fixture_setup, draw_fixture_teardown);
}
