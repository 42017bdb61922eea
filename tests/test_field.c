/* Fields: how radii, level and kernel are resolved, what is measured, and what a host may not pass. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "field/field.h"
#include "field/kernel.h"

static particles make_particles(size_t count, const double (*at)[3])
{
    particles p = {.count = count, .format = "csv"};
    for (int k = 0; k < 3; k++) {
        p.axis[k] = malloc((count + 1) * sizeof(double));
        for (size_t i = 0; i < count; i++) p.axis[k][i] = at[i][k];
    }
    return p;
}

static void give_radii(particles *p, double first, double step)
{
    p->radius = malloc(p->count * sizeof(double));
    for (size_t i = 0; i < p->count; i++) p->radius[i] = first + step * (double)i;
}

static const double row[4][3] = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {7, 0, 0}};

static void names_go_both_ways(void **state)
{
    (void)state;
    for (int k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++)
        assert_int_equal(mns_kernel_by_name(mns_kernel_name((mns_kernel)k)), k);
    assert_string_equal(mns_kernel_name(MNS_KERNEL_DEFAULT), "poly3");
    assert_int_equal(mns_kernel_by_name("poly5"), MNS_KERNEL_COUNT);
    assert_int_equal(mns_kernel_by_name(NULL), MNS_KERNEL_COUNT);
    assert_null(mns_kernel_name(MNS_KERNEL_COUNT));
}

static void radius_defaults_to_twice_the_median_spacing(void **state)
{
    (void)state;
    mns_field *f = NULL;
    mns_error error;
    particles p = make_particles(4, row); /* nearest: 1 1 2 4, median 1.5 */
    assert_int_equal(field_from_particles(&p, NULL, "file", &f, &error), MNS_OK);
    mns_field_info info;
    mns_field_get_info(f, &info);
    assert_true(info.radius_is_uniform);
    assert_true(info.radius_median == 3.0 && info.radius_min == 3.0 && info.radius_max == 3.0);
    assert_string_equal(info.radius_source, "default spacing");
    assert_string_equal(info.format, "csv");
    assert_true(info.lo[0] == 0 && info.hi[0] == 7 && info.effective_lo[0] == -3 &&
                info.effective_hi[0] == 10);
    assert_true(info.effective_lo[1] == -3 && info.effective_hi[2] == 3);
    assert_true(info.iso == 0.2 && info.kernel == MNS_KERNEL_POLY3 && !info.has_strength);
    assert_true(f->positive_sum_bound == 4);
    mns_field_destroy(f);
}

static void lone_and_coincident_balls_get_radius_one(void **state)
{
    (void)state;
    static const double same[3][3] = {{2, 3, 4}, {2, 3, 4}, {2, 3, 4}};
    for (size_t count = 0; count <= 3; count++) {
        mns_field *f = NULL;
        particles p = make_particles(count, same);
        assert_int_equal(field_from_particles(&p, NULL, "file", &f, NULL), MNS_OK);
        assert_true(field_radius(f, 0) == 1);
        mns_field_destroy(f);
    }
}

static void options_override_and_scale(void **state)
{
    (void)state;
    mns_field *f = NULL;
    particles p = make_particles(4, row);
    give_radii(&p, 1, 1);
    mns_input_options scale = {.radius_scale = 2, .kernel = MNS_KERNEL_PERLIN, .iso = 0.5};
    assert_int_equal(field_from_particles(&p, &scale, "file", &f, NULL), MNS_OK);
    assert_null(p.axis[0]);
    assert_true(f->radius_min == 2 && f->radius_max == 8 && f->radius_median == 5 && field_radius(f, 3) == 8);
    assert_string_equal(f->radius_source, "file");
    assert_true(f->kernel == MNS_KERNEL_PERLIN && f->iso == 0.5);
    mns_field_destroy(f);

    p = make_particles(4, row);
    give_radii(&p, 1, 1);
    mns_input_options fixed = {.radius = 5, .radius_scale = 0.5};
    assert_int_equal(field_from_particles(&p, &fixed, "file", &f, NULL), MNS_OK);
    assert_true(!f->p.radius && f->uniform_radius == 2.5);
    assert_string_equal(f->radius_source, "option");
    mns_field_destroy(f);
}

static void equal_radii_become_one_number(void **state)
{
    (void)state;
    mns_field *f = NULL;
    particles p = make_particles(4, row);
    give_radii(&p, 0.25, 0);
    p.strength = malloc(4 * sizeof(double));
    for (int i = 0; i < 4; i++) p.strength[i] = 1;
    assert_int_equal(field_from_particles(&p, NULL, "file", &f, NULL), MNS_OK);
    assert_null(f->p.radius);
    assert_null(f->p.strength);
    assert_true(f->uniform_radius == 0.25);
    mns_field_destroy(f);
}

static void surface_radii_divide_by_the_core(void **state)
{
    (void)state;
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++) {
        mns_field *f = NULL;
        particles p = make_particles(4, row);
        give_radii(&p, 1.2, 0.1);
        p.radius_is_surface = true;
        mns_input_options options = {.kernel = (mns_kernel)kernel, .iso = 0.3};
        assert_int_equal(field_from_particles(&p, &options, "van der Waals", &f, NULL), MNS_OK);
        assert_string_equal(f->radius_source, "van der Waals");
        for (size_t i = 0; i < 4; i++) { /* the field of ball i alone at its surface radius is L */
            double v = (1.2 + 0.1 * (double)i) / field_radius(f, i);
            assert_true(fabs(density_value(kernel, v * v) - 0.3) < 1e-12);
        }
        mns_field_destroy(f);
    }
}

static void surface_radii_need_a_level_below_one(void **state)
{
    (void)state;
    mns_field *f = NULL;
    mns_error error;
    particles p = make_particles(4, row);
    give_radii(&p, 1.2, 0.1);
    p.radius_is_surface = true;
    mns_input_options options = {.iso = 1};
    assert_int_equal(field_from_particles(&p, &options, "van der Waals", &f, &error), MNS_ERROR_USAGE);
    assert_non_null(strstr(error.text, "--iso"));
    assert_non_null(strstr(error.text, "van der Waals"));
    assert_true(p.count == 4 && p.axis[0] && p.radius[0] == 1.2); /* still the caller's */
    options.radius = 2;
    assert_int_equal(field_from_particles(&p, &options, "van der Waals", &f, &error), MNS_OK);
    mns_field_destroy(f);
}

static void senseless_options_are_usage_errors(void **state)
{
    (void)state;
    const mns_input_options bad[] = {{.iso = -1},          {.iso = NAN},
                                     {.radius = -2},       {.radius = INFINITY},
                                     {.radius_scale = -1}, {.kernel = MNS_KERNEL_COUNT}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        mns_field *f = NULL;
        mns_error error = {0};
        particles p = make_particles(4, row);
        assert_int_equal(field_from_particles(&p, &bad[i], "file", &f, &error), MNS_ERROR_USAGE);
        assert_true(error.text[0] && !f);
        particles_free(&p);
    }
}

static void numbers_beyond_doubles_are_refused(void **state)
{
    (void)state;
    mns_field *f = NULL;
    mns_error error;
    const double far[2][3] = {{0, 0, 0}, {0, 1e301, 0}};
    particles p = make_particles(2, far);
    assert_int_equal(field_from_particles(&p, NULL, "file", &f, &error), MNS_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.text, "particle 1: y = 1e+301"));
    p.axis[1][1] = 1;
    mns_input_options tiny = {.radius = 1e-200, .radius_scale = 1e-200};
    assert_int_equal(field_from_particles(&p, &tiny, "file", &f, &error), MNS_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.text, "a radius comes to 0"));
    tiny.radius_scale = 1;
    assert_int_equal(field_from_particles(&p, &tiny, "file", &f, &error), MNS_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.text, "radii from 1e-200 and lengths to 1"));
    p.strength = malloc(2 * sizeof *p.strength);
    p.strength[0] = 1, p.strength[1] = -1e31;
    assert_int_equal(field_from_particles(&p, NULL, "file", &f, &error), MNS_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.text, "particle 1: strength -1e+31"));
    particles_free(&p);
}

static void host_arrays_are_copied_by_stride(void **state)
{
    (void)state;
    struct __attribute__((packed)) ball {
        char pad;
        float at[3];
        double radius, strength, speed;
    } balls[3] = {{0, {1, 2, 3}, 0.5, 2, 10}, {0, {4, 5, 6}, 1.5, -1, 30}, {0, {7, 8, 9}, 1.0, 4, 20}};
    const size_t stride = sizeof *balls;
    mns_column_desc speed = {"speed", {(char *)balls + offsetof(struct ball, speed), stride, false}};
    mns_field_desc desc = {
        .count = 3,
        .position = {(char *)balls + offsetof(struct ball, at), stride, true},
        .radius = {(char *)balls + offsetof(struct ball, radius), stride, false},
        .strength = {(char *)balls + offsetof(struct ball, strength), stride, false},
        .columns = &speed,
        .column_count = 1,
    };
    mns_field *f = NULL;
    mns_error error;
    assert_int_equal(mns_field_create(&desc, &f, &error), MNS_OK);
    memset(balls, 0xff, sizeof balls);
    mns_field_info info;
    mns_field_get_info(f, &info);
    assert_true(info.count == 3 && info.lo[1] == 2 && info.hi[2] == 9);
    assert_true(info.radius_min == 0.5 && info.radius_median == 1 && info.radius_max == 1.5);
    assert_true(info.has_strength && info.strength_min == -1 && info.strength_max == 4);
    assert_true(f->positive_sum_bound == 6);
    assert_string_equal(info.radius_source, "host");
    assert_string_equal(info.format, "host");
    assert_string_equal(info.rows_skipped_why, "");
    mns_column_info column;
    assert_true(mns_field_get_column(f, 0, &column));
    assert_string_equal(column.name, "speed");
    assert_true(!column.is_label && column.min == 10 && column.max == 30 && f->p.column[0].value[1] == 30);
    assert_false(mns_field_get_column(f, 1, &column));
    mns_field_destroy(f);
    mns_field_destroy(NULL);
}

static void an_empty_host_field_is_legal(void **state)
{
    (void)state;
    mns_field_desc desc = {0};
    mns_field *f = NULL;
    assert_int_equal(mns_field_create(&desc, &f, NULL), MNS_OK);
    mns_field_info info;
    mns_field_get_info(f, &info);
    assert_true(info.count == 0 && info.lo[0] == 0 && info.effective_hi[0] == 0);
    mns_field_destroy(f);
}

static void expect_usage(const mns_field_desc *desc, const char *words)
{
    mns_field *f = NULL;
    mns_error error = {0};
    assert_int_equal(mns_field_create(desc, &f, &error), MNS_ERROR_USAGE);
    assert_null(f);
    if (!strstr(error.text, words)) fail_msg("'%s' lacks '%s'", error.text, words);
}

static void host_arrays_are_checked(void **state)
{
    (void)state;
    const double at[2][3] = {{0, 0, 0}, {1, NAN, 0}}, fine[2][3] = {{0, 0, 0}, {1, 1, 0}}, zero[2] = {1, 0};
    mns_column_desc twice[2] = {{"a", {zero, 0, false}}, {"a", {zero, 0, false}}},
                    unnamed = {"", {zero, 0, false}};
    expect_usage(&(mns_field_desc){.count = 2}, "position");
    expect_usage(&(mns_field_desc){.count = 2, .position = {at, 0, false}}, "particle 1 is nan");
    mns_field_desc desc = {.count = 2, .position = {fine, 0, false}};
    mns_field_desc bad = desc;
    bad.position.stride = 3;
    expect_usage(&bad, "a stride of 3 bytes");
    bad = desc, bad.radius.data = zero;
    expect_usage(&bad, "the radius of particle 1 is 0");
    bad = desc, bad.uniform_radius = -1;
    expect_usage(&bad, "uniform_radius is -1");
    bad = desc, bad.columns = twice, bad.column_count = 2;
    expect_usage(&bad, "'a'");
    bad = desc, bad.columns = &unnamed, bad.column_count = 1;
    expect_usage(&bad, "no name");
    bad = desc, bad.iso = -0.5;
    expect_usage(&bad, "iso");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_go_both_ways),
        cmocka_unit_test(radius_defaults_to_twice_the_median_spacing),
        cmocka_unit_test(lone_and_coincident_balls_get_radius_one),
        cmocka_unit_test(options_override_and_scale),
        cmocka_unit_test(equal_radii_become_one_number),
        cmocka_unit_test(surface_radii_divide_by_the_core),
        cmocka_unit_test(surface_radii_need_a_level_below_one),
        cmocka_unit_test(senseless_options_are_usage_errors),
        cmocka_unit_test(numbers_beyond_doubles_are_refused),
        cmocka_unit_test(host_arrays_are_copied_by_stride),
        cmocka_unit_test(an_empty_host_field_is_legal),
        cmocka_unit_test(host_arrays_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
