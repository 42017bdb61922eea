/* Lengths at what numbers hold: the field's own unit, and that nobody outside sees it. */
#include "plan/plan.h"
#include "support/reference_fixture.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static const double corner[12] = {0, 0, 0, 1, 0, 0, 0, 1.5, 0, 0.25, 0.5, -2},
                    radii[4] = {1, 0.5, 0.75, 1.25};
static const double scales[] = {0x1p-1000, 0x1p-600, 0x1p-66, 0x1p-30, 1, 0x1p20, 0x1p66, 0x1p600, 0x1p990};
enum { SCALES = sizeof scales / sizeof *scales };

/* The four balls, all lengths times `scale`; without radii they get the default. */
static mns_field *scaled(double scale, bool with_radii)
{
    double position[12], radius[4];
    mns_field *field;
    mns_error error;
    for (int i = 0; i < 12; i++) position[i] = corner[i] * scale;
    for (int i = 0; i < 4; i++) radius[i] = radii[i] * scale;
    mns_field_desc desc = {
        .count = 4, .position = {.data = position}, .radius = {.data = with_radii ? radius : NULL}};
    if (mns_field_create(&desc, &field, &error)) fail_msg("%g: %s", scale, error.text);
    return field;
}

static mns_view scaled_view(double scale)
{
    mns_view view = {.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT, .up = {0, 1, 0}, .width = 40, .height = 30};
    view.eye[2] = 9 * scale, view.look_at[0] = 0.25 * scale;
    return view;
}

static void a_field_tells_its_lengths_in_scene_units(void **state)
{
    (void)state;
    for (int i = 0; i < SCALES; i++) {
        double s = scales[i];
        mns_field *field = scaled(s, true);
        mns_field_info info;
        mns_field_get_info(field, &info);
        assert_true(info.lo[2] == -2 * s && info.hi[1] == 1.5 * s && info.effective_lo[0] == -1 * s &&
                    info.effective_hi[1] == 2.25 * s);
        assert_true(info.radius_min == 0.5 * s && info.radius_max == 1.25 * s &&
                    info.radius_median == 0.875 * s);
        assert_true(mns_field_radius(field, 2) == 0.75 * s);
        int exponent;
        assert_true(frexp(field_unit(field), &exponent) == 0.5); /* a power of two, */
        assert_true((field_unit(field) == 1) == (s >= 0x1p-30 && s <= 0x1p20));
        assert_true(field->radius_min > 1e-10 && field->radius_max < 1e9); /* which floats can square */
        mns_field_destroy(field);
    }
}

static void default_radii_come_from_spacings_of_any_size(void **state)
{
    (void)state;
    mns_field *plain = scaled(1, false);
    for (int i = 0; i < SCALES; i++) {
        mns_field *field = scaled(scales[i], false);
        assert_true(mns_field_radius(field, 0) == mns_field_radius(plain, 0) * scales[i]);
        mns_field_destroy(field);
    }
    mns_field_destroy(plain);
}

static void the_truth_is_told_in_scene_units(void **state)
{
    (void)state;
    mns_field *plain = scaled(1, true);
    mns_reference *base = fixture_reference(plain);
    for (int i = 0; i < SCALES; i++) {
        double s = scales[i];
        mns_field *field = scaled(s, true);
        mns_reference *reference = fixture_reference(field);
        for (int k = -20; k <= 20; k++) {
            const double from[3] = {0, 0.1, 9}, way[3] = {0.005 * k, 0.007 * k, -1};
            const double there[3] = {from[0] * s, from[1] * s, from[2] * s};
            mns_hit a = fixture_trace(base, from, way), b = fixture_trace(reference, there, way);
            assert_true(a.hit == b.hit && a.certain && b.certain && a.ball == b.ball);
            assert_true(a.hit ? fabs(b.t - a.t * s) <= b.t_error + a.t_error * s : b.t == INFINITY);
            assert_true(b.t_error <= 1e-10 * s);
            double here[3] = {0.3 * s, 0.2 * s, 0.1 * s}, slope[3], value, plain_slope[3];
            value = mns_reference_value(base, (const double[3]){0.3, 0.2, 0.1}, plain_slope, NULL);
            assert_true(fabs(mns_reference_value(reference, here, slope, NULL) - value) < 1e-14);
            if (s > 0x1p-900) assert_true(fabs(slope[1] * s - plain_slope[1]) < 1e-13);
        }
        mns_reference_destroy(reference);
        mns_field_destroy(field);
    }
    mns_reference_destroy(base);
    mns_field_destroy(plain);
}

/* The radii keep some fifteen bits. */
static void subnormal_radii_are_drawn_as_far_as_they_go(void **state)
{
    (void)state;
    const double s = 0x1p-1058;
    mns_field *field = scaled(s, true);
    mns_reference *reference = fixture_reference(field);
    mns_hit hit = fixture_trace(reference, (const double[3]){0, 0, 9 * s}, (const double[3]){0, 0, -1});
    assert_true(hit.hit && hit.certain && hit.t > 7 * s && hit.t < 9 * s && hit.t_error <= 0x1p-1072);
    mns_reference_destroy(reference);
    mns_field_destroy(field);
}

static void plans_hang_on_no_unit(void **state)
{
    (void)state;
    mns_field *plain = scaled(1, true);
    mns_view view = scaled_view(1);
    mns_plan *base, *plan;
    mns_error error;
    if (mns_plan_create(plain, &view, NULL, NULL, NULL, &base, &error)) fail_msg("%s", error.text);
    for (int i = 0; i < SCALES; i++) {
        mns_field *field = scaled(scales[i], true);
        view = scaled_view(scales[i]);
        size_t warnings;
        if (mns_plan_create(field, &view, NULL, NULL, NULL, &plan, &error)) fail_msg("%s", error.text);
        mns_plan_warnings(plan, &warnings);
        bool inside = scales[i] > 1e-29 && scales[i] < 1e37;
        assert_true(mns_plan_features(plan) == mns_plan_features(base));
        assert_true(plan->view.eye[2] == 9 * scales[i]);
        assert_true(plan->frame.eye.z * plan->unit == 9 * scales[i]);
        assert_int_equal(warnings, !inside);
        assert_true(plan->t_unit == (inside ? 1 : plan->unit));
        assert_true((plan->unit != 1) == (strstr(mns_plan_text(plan), ", in units of ") != NULL));
        mns_plan_destroy(plan);
        mns_field_destroy(field);
    }
    mns_plan_destroy(base);
    mns_field_destroy(plain);
}

static mns_field *either_end(void)
{
    const double position[6] = {0, 0, 0, 0, 0, -2e38}, radius[2] = {1e-38, 1e38};
    mns_field_desc desc = {.count = 2, .position = {.data = position}, .radius = {.data = radius}};
    mns_field *field;
    mns_error error;
    if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
    return field;
}

static void what_floats_cannot_hold_is_the_references(void **state)
{
    (void)state;
    mns_field *field = either_end();
    mns_view view = {.set = MNS_VIEW_EYE, .eye = {0, 0, 3e-38}};
    mns_plan *plan;
    mns_error error;
    if (mns_plan_create(field, &view, NULL, NULL, NULL, &plan, &error)) fail_msg("%s", error.text);
    assert_non_null(strstr(mns_plan_text(plan), "method reference (auto: floats do not hold these lengths)"));
    mns_plan_destroy(plan);
    const mns_method asked[] = {MNS_METHOD_LIST, MNS_METHOD_TILE, MNS_METHOD_FBVH, MNS_METHOD_BVH};
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        mns_options options = {.method = asked[i]};
        assert_int_equal(mns_plan_create(field, &view, NULL, &options, NULL, &plan, &error),
                         MNS_ERROR_UNSUPPORTED);
        assert_non_null(strstr(error.text, "radii from 1e-38 and distances to 3.3"));
        assert_non_null(strstr(error.text, "take the method reference"));
    }
    mns_field_destroy(field);
}

/* Both balls in their places: the small one before the eye, the large one around it and beyond. */
static void the_reference_sees_both_ends_of_a_float(void **state)
{
    (void)state;
    mns_field *field = either_end();
    mns_reference *reference = fixture_reference(field);
    const double eye[3] = {0, 0, 3e-38}, surface = sqrt(1 - cbrt(0.2));
    mns_hit near = fixture_trace(reference, eye, (const double[3]){0, 0, -1});
    mns_hit far = fixture_trace(reference, eye, (const double[3]){0, 0.3, -1});
    assert_true(near.hit && near.certain && near.ball == 0);
    assert_true(fabs(near.t - (3 - surface) * 1e-38) <= near.t_error + 1e-52);
    assert_true(far.hit && far.certain && far.ball == 1 && far.t > 1e38 && far.t < 2.5e38);
    mns_reference_destroy(reference);
    mns_field_destroy(field);
}

/* From 1e40 away a radius of 1e-38 is less than what numbers of twice the length leave: nobody can tell. */
static void what_rounding_hides_is_undecided(void **state)
{
    (void)state;
    mns_field *field = either_end();
    mns_reference *reference = fixture_reference(field);
    const double eye[3] = {0, 0, 1e40};
    mns_hit hit = fixture_trace(reference, eye, (const double[3]){0, 0, -1});
    assert_true(!hit.certain && hit.hit && hit.ball == 1);
    mns_hit aside = fixture_trace(reference, eye, (const double[3]){0, 1, -1});
    assert_true(aside.certain && !aside.hit);
    mns_reference_destroy(reference);
    mns_field_destroy(field);
}

static void eyes_too_far_are_one_line(void **state)
{
    (void)state;
    static const double far[] = {1e39, 1e200, 1e308};
    mns_field *field = scaled(1, true);
    mns_plan *plan;
    mns_error error;
    for (int i = 0; i < 3; i++)
        for (int reference = 0; reference < 2; reference++) {
            mns_view view = {.set = MNS_VIEW_EYE, .eye = {0, 0, far[i]}};
            mns_options options = {.method = reference ? MNS_METHOD_REFERENCE : MNS_METHOD_AUTO};
            assert_int_equal(mns_plan_create(field, &view, NULL, &options, NULL, &plan, &error),
                             MNS_ERROR_UNSUPPORTED);
            assert_non_null(strstr(error.text, "expected it within 3.4"));
            assert_null(strchr(error.text, '\n'));
        }
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_field_tells_its_lengths_in_scene_units),
        cmocka_unit_test(default_radii_come_from_spacings_of_any_size),
        cmocka_unit_test(the_truth_is_told_in_scene_units),
        cmocka_unit_test(subnormal_radii_are_drawn_as_far_as_they_go),
        cmocka_unit_test(plans_hang_on_no_unit),
        cmocka_unit_test(what_floats_cannot_hold_is_the_references),
        cmocka_unit_test(the_reference_sees_both_ends_of_a_float),
        cmocka_unit_test(what_rounding_hides_is_undecided),
        cmocka_unit_test(eyes_too_far_are_one_line),
    };
    return cmocka_run_group_tests_name("lengths", tests, NULL, NULL);
}
