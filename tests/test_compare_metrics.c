/* Every figure of docs/errors.md against planes made by hand, whose errors are known. */
#include "compare/images.h"
#include "compare/run.h"
#include "compare/truth_cache.h"
#include "support/planes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static metrics measure(const planes *p)
{
    metrics m;
    mns_error error;
    if (metrics_measure(p->truth, p->image, NULL, 1, &m, &error)) fail_msg("%s", error.text);
    return m;
}

static void near(double value, double expected, double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%.17g, expected %.17g", value, expected);
}

static void equal_planes_have_no_error(void **state)
{
    (void)state;
    planes p = planes_make(3, 2);
    for (size_t i = 0; i < 5; i++) planes_hit(&p, i, 2 + (double)i, 0);
    metrics m = measure(&p);
    assert_int_equal(m.pixels, 6);
    assert_int_equal(m.hits, 5);
    assert_int_equal(m.compared, 5);
    assert_int_equal(m.missed + m.invented + m.wrong_root + m.undecided, 0);
    assert_true(m.t.max == 0 && m.t.rms == 0 && m.normal.max == 0 && isnan(m.footprint.max));
    assert_true(m.psnr == METRICS_PSNR_MOST);
    assert_true(isnan(m.residual.max));
    assert_int_equal(m.worst_count, 0);
    planes_free(&p);
}

static void no_hit_in_common_leaves_no_figures(void **state)
{
    (void)state;
    planes p = planes_make(2, 1);
    metrics m = measure(&p);
    assert_int_equal(m.hits + m.compared, 0);
    assert_true(isnan(m.t.median) && isnan(m.t.max) && isnan(m.normal.rms) && isnan(m.footprint.p99));
    planes_free(&p);
}

static void masks_are_counted_apart_from_the_undecided(void **state)
{
    (void)state;
    planes p = planes_make(7, 1);
    planes_hit(&p, 0, 1, 0); /* both */
    planes_hit(&p, 1, 1, 0); /* missed */
    p.image->t[1] = INFINITY;
    p.image->t[2] = 1;       /* invented */
    planes_hit(&p, 3, 1, 0); /* missed, the truth undecided */
    p.image->t[3] = INFINITY, p.truth->certain[3] = 0;
    p.image->t[4] = 1, p.image->certain[4] = 0; /* invented, the image undecided */
    planes_hit(&p, 5, 1, 0.5);                  /* both, far apart, the image undecided */
    p.image->certain[5] = 0;
    metrics m = measure(&p);
    assert_int_equal(m.hits, 4);
    assert_int_equal(m.missed, 2);
    assert_int_equal(m.missed_decided, 1);
    assert_int_equal(m.invented, 2);
    assert_int_equal(m.invented_decided, 1);
    assert_int_equal(m.undecided, 2);
    assert_int_equal(m.compared, 1);
    assert_int_equal(m.wrong_root, 0);
    const metrics_mask expected[7] = {METRICS_MASK_BOTH,      METRICS_MASK_MISSED,    METRICS_MASK_INVENTED,
                                      METRICS_MASK_UNDECIDED, METRICS_MASK_UNDECIDED, METRICS_MASK_UNDECIDED,
                                      METRICS_MASK_NONE};
    for (size_t i = 0; i < 7; i++) assert_int_equal(metrics_mask_of(p.truth, p.image, i), expected[i]);
    assert_int_equal(images_mask_errors(p.truth, p.image, &m), 4);
    planes_free(&p);
}

static void distances_are_taken_over_the_larger_of_t_and_radius(void **state)
{
    (void)state;
    planes p = planes_make(2, 1);
    planes_hit(&p, 0, 4, 0.5); /* R is 1: 0.5 / 4 */
    planes_hit(&p, 1, 0.25, -0.125);
    p.truth->radius[1] = 2; /* 0.125 / 2 */
    metrics m = measure(&p);
    near(m.t.max, 0.125, 0);
    near(m.t.median, 0.0625, 0);
    near(m.t.rms, sqrt((0.125 * 0.125 + 0.0625 * 0.0625) / 2), 1e-15);
    planes_free(&p);
}

/* Planes of terms for a truth and an image, that agree: nothing met, all certain. */
typedef struct term_planes {
    float of[2][TRUTH_TERMS + 1][6];
} term_planes;

static void give_terms(planes *p, term_planes *t)
{
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 6; i++) {
            t->of[k][TRUTH_SHADOW][i] = t->of[k][TRUTH_OCCLUSION][i] = t->of[k][TRUTH_TERMS][i] = 1;
            t->of[k][TRUTH_MIRROR][i] = t->of[k][TRUTH_REFRACTION][i] = INFINITY;
        }
    for (int i = 0; i < TRUTH_TERMS; i++) p->truth->term[i] = t->of[0][i];
    p->truth->effects_certain = t->of[0][TRUTH_TERMS];
    p->image->shadow = t->of[1][TRUTH_SHADOW];
    p->image->occlusion = t->of[1][TRUTH_OCCLUSION];
    p->image->mirror_t = t->of[1][TRUTH_MIRROR];
    p->image->refract_t = t->of[1][TRUTH_REFRACTION];
    p->image->effects_certain = t->of[1][TRUTH_TERMS];
}

static void take_terms(planes *p)
{
    for (int i = 0; i < TRUTH_TERMS; i++) p->truth->term[i] = NULL;
    p->truth->effects_certain = NULL;
    p->image->shadow = p->image->occlusion = p->image->mirror_t = p->image->refract_t = NULL;
    p->image->effects_certain = NULL;
}

static void wrong_terms_of_effects_are_counted(void **state)
{
    (void)state;
    term_planes t;
    char why[256];
    const images_tolerance none = {1, 1, 0}, some = {1, 1, 5};
    planes p = planes_make(6, 1);
    assert_false(measure(&p).effects.any);
    for (size_t i = 0; i < 5; i++) planes_hit(&p, i, 2, 0);
    give_terms(&p, &t);
    metrics m = measure(&p);
    assert_true(m.effects.any && m.effects.compared == 5 && m.effects.undecided == 0);
    assert_true(images_judge(&none, 0, &m, why, sizeof why));
    t.of[1][TRUTH_SHADOW][0] = 0.75F; /* one ray of four */
    t.of[1][TRUTH_OCCLUSION][1] = 1 - 1e-5F;
    t.of[1][TRUTH_MIRROR][0] = 3;                                  /* invented */
    t.of[0][TRUTH_MIRROR][1] = 3, t.of[1][TRUTH_MIRROR][1] = 3.2F; /* another surface: R is 1 */
    t.of[0][TRUTH_MIRROR][2] = 3, t.of[1][TRUTH_MIRROR][2] = 3.05F;
    t.of[0][TRUTH_REFRACTION][3] = 1;                          /* missed */
    t.of[1][TRUTH_SHADOW][4] = 0, t.of[1][TRUTH_TERMS][4] = 0; /* not certain */
    t.of[1][TRUTH_SHADOW][5] = 0;                              /* no hit */
    m = measure(&p);
    assert_int_equal(m.effects.compared, 4);
    assert_int_equal(m.effects.undecided, 1);
    const size_t wrong[TRUTH_TERMS] = {1, 0, 2, 1};
    for (int i = 0; i < TRUTH_TERMS; i++) assert_int_equal(m.effects.wrong[i], wrong[i]);
    assert_false(images_judge(&none, 0, &m, why, sizeof why));
    assert_non_null(strstr(why, "2 mirror"));
    assert_true(images_judge(&some, 0, &m, why, sizeof why));
    p.image->occlusion = NULL; /* a term that is not drawn is wrong everywhere */
    assert_int_equal(measure(&p).effects.wrong[TRUTH_OCCLUSION], 4);
    take_terms(&p);
    planes_free(&p);
}

static void the_low_word_of_t_counts(void **state)
{
    (void)state;
    planes p = planes_make(1, 1);
    planes_hit(&p, 0, 2, 0);
    p.image->t_lo[0] = 0x1p-40f;
    near(measure(&p).t.max, 0x1p-41, 0);
    planes_free(&p);
}

static void footprints_grow_with_distance_and_view(void **state)
{
    (void)state;
    planes p = planes_make(2, 10);
    p.truth->has_view = true;
    p.truth->view = (mns_view){.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT,
                               .look_at = {0, 0, -1},
                               .up = {0, 1, 0},
                               .fov = 90,
                               .width = 2,
                               .height = 10};
    planes_hit(&p, 7, 5, 2); /* a footprint is 5 * 2 tan 45 / 10 = 1 */
    near(measure(&p).footprint.max, 2, 1e-14);
    near(metrics_footprint(&p.truth->view, 20), 4, 1e-14);
    planes_free(&p);
}

static void what_the_truth_leaves_open_is_no_error(void **state)
{
    (void)state;
    planes p = planes_make(2, 1);
    planes_hit(&p, 0, 2, 0.25);
    p.truth->t_error[0] = 0.5;
    metrics m = measure(&p);
    assert_true(m.t.max == 0);
    assert_int_equal(m.wrong_root, 0);
    p.truth->t_error[0] = 0.0625;
    near(measure(&p).t.max, 0.1875 / 2, 0);
    planes_free(&p);
}

static void a_wrong_root_is_off_by_a_tenth_of_the_radius(void **state)
{
    (void)state;
    const double limit = 0.1 * 3 + 0x1p-20 * 8;
    planes p = planes_make(2, 1);
    p.truth->radius[0] = p.truth->radius[1] = 3;
    planes_hit(&p, 0, 8, 0.9999 * limit);
    planes_hit(&p, 1, 8, 1.0001 * limit);
    p.truth->radius[0] = p.truth->radius[1] = 3;
    metrics m = measure(&p);
    assert_int_equal(m.wrong_root, 1);
    assert_int_equal(m.worst[0].kind, METRICS_WRONG_ROOT);
    assert_int_equal(m.worst[0].x, 1);
    assert_int_equal(m.worst[1].kind, METRICS_DEPTH);
    planes_free(&p);
}

static void quantiles_are_values_that_occur(void **state)
{
    (void)state;
    double value[1000];
    for (int i = 0; i < 1000; i++) value[i] = 1000 - i;
    metrics_spread s = metrics_spread_of(value, 1000);
    assert_true(s.median == 500 && s.p99 == 990 && s.p999 == 999 && s.max == 1000);
    near(s.rms, sqrt(1001.0 * 2001 / 6), 1e-14);
    double one[1] = {7};
    s = metrics_spread_of(one, 1);
    assert_true(s.median == 7 && s.p99 == 7 && s.p999 == 7 && s.max == 7 && s.rms == 7);
}

static void normals_differ_by_an_angle(void **state)
{
    (void)state;
    const double small = 1e-4; /* radians: an arc cosine in floats would see none */
    planes p = planes_make(4, 1);
    for (size_t i = 0; i < 4; i++) planes_hit(&p, i, 1, 0);
    float other[4][3] = {{0, 0, 1}, {0, 1, 0}, {(float)sin(small), 0, (float)cos(small)}, {0, 0, 0}};
    memcpy(p.image->normal, other, sizeof other);
    metrics m = measure(&p);
    near(m.normal.max, 180, 0);
    near(m.normal.median, small * 180 / 3.14159265358979, 1e-4);
    memset(p.image->normal + 9, 0, 2 * sizeof(float));
    p.image->normal[11] = 1;
    near(measure(&p).normal.max, 90, 1e-14);
    planes_free(&p);
}

static void psnr_is_of_srgb(void **state)
{
    (void)state;
    const float ninety = (float)pow((0.9 + 0.055) / 1.055, 2.4); /* 0.9 once encoded */
    planes p = planes_make(2, 2);
    for (size_t i = 0; i < 16; i++) p.truth->rgba[i] = 1, p.image->rgba[i] = i % 4 == 3 ? 0 : ninety;
    near(measure(&p).psnr, 20, 1e-6);
    for (size_t i = 4; i < 16; i++) p.image->rgba[i] = 1;
    near(measure(&p).psnr, 20 + 10 * log10(4), 1e-6);
    free(p.truth->rgba);
    p.truth->rgba = NULL;
    assert_true(isnan(measure(&p).psnr));
    planes_free(&p);
}

/* A ball of radius 2 at the origin, poly3, seen from 0,0,5: at the centre f = 1, which is 4 L off L = 0.2. */
static void the_residual_is_of_the_field_at_the_hit(void **state)
{
    (void)state;
    mns_field *field;
    mns_reference *reference;
    mns_error error;
    const double centre[3] = {0, 0, 0};
    mns_field_desc desc = {.count = 1, .position = {.data = centre}, .uniform_radius = 2};
    assert_int_equal(mns_field_create(&desc, &field, &error), MNS_OK);
    assert_int_equal(mns_reference_create(field, &reference, &error), MNS_OK);
    planes p = planes_make(1, 1);
    p.truth->has_view = true;
    p.truth->view = (mns_view){.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT,
                               .eye = {0, 0, 5},
                               .up = {0, 1, 0},
                               .fov = 45,
                               .width = 1,
                               .height = 1};
    planes_hit(&p, 0, 5 - 2 * sqrt(1 - cbrt(0.2)), 0);
    metrics m;
    assert_int_equal(metrics_measure(p.truth, p.image, reference, 0.2, &m, &error), MNS_OK);
    assert_true(m.residual.max < 1e-6);
    p.image->t[0] = 5, p.image->t_lo[0] = 0;
    assert_int_equal(metrics_measure(p.truth, p.image, reference, 0.2, &m, &error), MNS_OK);
    near(m.residual.max, 4, 1e-14);
    p.truth->t[0] = INFINITY; /* an invented hit has a residual too */
    assert_int_equal(metrics_measure(p.truth, p.image, reference, 0.2, &m, &error), MNS_OK);
    near(m.residual.rms, 4, 1e-14);
    planes_free(&p);
    mns_reference_destroy(reference);
    mns_field_destroy(field);
}

static void the_worst_pixels_leave_room_for_each_kind(void **state)
{
    (void)state;
    planes p = planes_make(40, 3);
    for (size_t i = 0; i < 40; i++) {
        planes_hit(&p, i, 1, 1e-3 * (double)(i + 1)); /* row 0: off by more and more */
        planes_hit(&p, 40 + i, 1, 0);
        p.image->t[40 + i] = INFINITY; /* row 1: missed */
        p.image->t[80 + i] = 1;        /* row 2: invented */
    }
    metrics m = measure(&p);
    assert_int_equal(m.worst_count, METRICS_WORST);
    for (size_t i = 0; i < 5; i++) {
        assert_int_equal(m.worst[i].kind, METRICS_MISSED);
        assert_true(m.worst[i].y == 1 && isinf(m.worst[i].t) && m.worst[i].truth == 1 &&
                    isnan(m.worst[i].error));
        assert_int_equal(m.worst[5 + i].kind, METRICS_INVENTED);
        assert_true(m.worst[5 + i].y == 2 && isinf(m.worst[5 + i].truth));
    }
    for (size_t i = 10; i < 20; i++) {
        assert_true(m.worst[i].y == 0 && m.worst[i].x == 49 - (int)i);
        near(m.worst[i].error, 1e-3 * (double)(50 - i), 1e-4);
    }
    for (size_t i = 0; i < 80; i++) p.truth->certain[i] = 0; /* only the invented are left */
    m = measure(&p);
    assert_int_equal(m.worst_count, METRICS_WORST);
    for (size_t i = 0; i < METRICS_WORST; i++) assert_int_equal(m.worst[i].kind, METRICS_INVENTED);
    planes_free(&p);
}

/* Pixel 0 is looked at squarely, pixel 1 along the surface. */
static void a_missed_pixel_is_worse_when_seen_squarely(void **state)
{
    (void)state;
    planes p = planes_make(2, 1);
    p.truth->has_view = true;
    p.truth->view = (mns_view){.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT,
                               .look_at = {0, 0, -1},
                               .up = {0, 1, 0},
                               .fov = 10,
                               .width = 2,
                               .height = 1};
    planes_hit(&p, 0, 1, 0);
    planes_hit(&p, 1, 1, 0);
    p.truth->normal[2] = 0, p.truth->normal[0] = 1;
    p.image->t[0] = p.image->t[1] = INFINITY;
    metrics m = measure(&p);
    assert_int_equal(m.worst_count, 2);
    assert_int_equal(m.worst[0].x, 1);
    planes_free(&p);
}

static void sizes_must_be_the_same(void **state)
{
    (void)state;
    planes p = planes_make(3, 2);
    metrics m;
    mns_error error;
    p.image->width = 2, p.image->height = 3;
    assert_int_equal(metrics_measure(p.truth, p.image, NULL, 1, &m, &error), MNS_ERROR_USAGE);
    assert_non_null(strstr(error.text, "3x2 and 2x3"));
    planes_free(&p);
}

static void images_are_judged_by_each_tolerance(void **state)
{
    (void)state;
    char why[200];
    planes p = planes_make(3, 1);
    planes_hit(&p, 0, 2, 0);
    planes_hit(&p, 1, 2, 0.25);
    images_tolerance tolerance = {.t = 0.125, .normal = 1};
    metrics m = measure(&p);
    assert_true(images_judge(&tolerance, 0, &m, why, sizeof why));
    tolerance.t = 0.124;
    assert_false(images_judge(&tolerance, 0, &m, why, sizeof why));
    assert_non_null(strstr(why, "t is off by 0.125 of the distance (at most 0.124), the worst at 1,0"));
    tolerance.t = 1;
    p.image->normal[0] = 1;
    m = measure(&p);
    assert_false(images_judge(&tolerance, 0, &m, why, sizeof why));
    assert_non_null(strstr(why, "45 degrees (at most 1)"));
    p.image->t[2] = 1;
    m = measure(&p);
    tolerance.normal = 50;
    size_t mask = images_mask_errors(p.truth, p.image, &m);
    assert_int_equal(mask, 1);
    assert_false(images_judge(&tolerance, mask, &m, why, sizeof why));
    assert_non_null(strstr(why, "1 invented"));
    tolerance.mask = 1;
    assert_true(images_judge(&tolerance, mask, &m, why, sizeof why));
    planes_free(&p);
}

static void a_saved_image_is_a_truth(void **state)
{
    (void)state;
    planes p = planes_make(2, 1);
    truth_planes *truth;
    mns_error error;
    planes_hit(&p, 0, 3, 0);
    float bound[2] = {0.5f, 0};
    p.image->t_error = bound;
    p.image->t_lo[0] = 0x1p-30f;
    p.image->certain[1] = 0;
    assert_int_equal(truth_from_image(p.image, &truth, &error), MNS_OK);
    assert_true(truth->t[0] == 3 + 0x1p-30 && isinf(truth->t[1]) && truth->t_error[0] == 0.5);
    assert_true(truth->certain[0] == 1 && truth->certain[1] == 0);
    assert_true(truth->hits == 1 && truth->undecided == 1 && !truth->radius && !truth->has_view);
    truth_destroy(truth);
    p.image->t_error = NULL;
    planes_free(&p);
}

static void the_front_holds_what_nothing_beats(void **state)
{
    (void)state;
    const double ms[] = {10, 20, 20, 30, 5, 10}, off[] = {1e-3, 1e-6, 1e-4, 1e-6, NAN, 1e-3};
    const bool front[] = {true, true, false, false, false, true};
    run_result run[7] = {{.status = MNS_OK}};
    for (int i = 0; i < 6; i++) run[i].ms.median = ms[i], run[i].errors.t.p99 = off[i];
    run[6].status = MNS_ERROR_UNSUPPORTED; /* zeros would beat all */
    run_mark_front(run, 7);
    for (int i = 0; i < 6; i++)
        if (run[i].pareto != front[i]) fail_msg("run %d: %d", i, run[i].pareto);
    assert_false(run[6].pareto);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_planes_have_no_error),
        cmocka_unit_test(no_hit_in_common_leaves_no_figures),
        cmocka_unit_test(masks_are_counted_apart_from_the_undecided),
        cmocka_unit_test(distances_are_taken_over_the_larger_of_t_and_radius),
        cmocka_unit_test(wrong_terms_of_effects_are_counted),
        cmocka_unit_test(the_low_word_of_t_counts),
        cmocka_unit_test(footprints_grow_with_distance_and_view),
        cmocka_unit_test(what_the_truth_leaves_open_is_no_error),
        cmocka_unit_test(a_wrong_root_is_off_by_a_tenth_of_the_radius),
        cmocka_unit_test(quantiles_are_values_that_occur),
        cmocka_unit_test(normals_differ_by_an_angle),
        cmocka_unit_test(psnr_is_of_srgb),
        cmocka_unit_test(the_residual_is_of_the_field_at_the_hit),
        cmocka_unit_test(the_worst_pixels_leave_room_for_each_kind),
        cmocka_unit_test(a_missed_pixel_is_worse_when_seen_squarely),
        cmocka_unit_test(sizes_must_be_the_same),
        cmocka_unit_test(images_are_judged_by_each_tolerance),
        cmocka_unit_test(a_saved_image_is_a_truth),
        cmocka_unit_test(the_front_holds_what_nothing_beats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
