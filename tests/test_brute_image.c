/* The comparison finds exactly the errors that were planted in an image drawn by the oracle itself. */
#include "field/field.h"
#include "support/brute_image.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { WIDE = 40, HIGH = 30, PIXELS = WIDE * HIGH };

static double axis_x[2] = {-0.5, 0.5}, axis_y[2] = {0, 0.25}, axis_z[2] = {0, 0.5};

static struct mns_field two_balls(void)
{
    return (struct mns_field){.p = {.count = 2, .axis = {axis_x, axis_y, axis_z}},
                              .uniform_radius = 1,
                              .kernel = MNS_KERNEL_POLY3,
                              .iso = 0.2};
}

static const mns_view view = {.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT,
                              .eye = {0, 1, 4},
                              .up = {0, 1, 0},
                              .fov = 30,
                              .width = WIDE,
                              .height = HIGH};

typedef struct planes {
    float t[PIXELS], t_lo[PIXELS], normal[3 * PIXELS], certain[PIXELS];
    mns_image image;
    size_t hits;
} planes;

static planes *draw(const brute *oracle)
{
    planes *p = calloc(1, sizeof *p);
    assert_non_null(p);
    p->image = (mns_image){.width = WIDE,
                           .height = HIGH,
                           .t = p->t,
                           .t_lo = p->t_lo,
                           .normal = p->normal,
                           .certain = p->certain};
    brute_limits limits = {.tau = 0x1p-40, .reference = {0, 1, 4}};
    for (int i = 0; i < PIXELS; i++) {
        brute_ray ray = brute_pixel_ray(&view, i % WIDE, i / WIDE);
        brute_hit hit = brute_first_hit(oracle, &ray, &limits);
        p->certain[i] = 1;
        p->t[i] = hit.hit ? (float)hit.t : INFINITY;
        p->t_lo[i] = hit.hit ? (float)(hit.t - p->t[i]) : 0;
        for (int a = 0; a < 3; a++) p->normal[3 * i + a] = (float)hit.normal[a];
        p->hits += hit.hit;
    }
    return p;
}

static brute_report compare(const brute *oracle, const planes *p, size_t rays)
{
    brute_tally *tally = brute_tally_create();
    assert_non_null(tally);
    assert_true(brute_tally_add(tally, oracle, &view, &p->image, rays, 0x1p-40, 5));
    brute_report report = brute_tally_report(tally);
    brute_tally_destroy(tally);
    return report;
}

static int nth(const planes *p, int n, bool hit)
{
    for (int i = 0; i < PIXELS; i++)
        if (isfinite(p->t[i]) == hit && n-- == 0) return i;
    fail_msg("too few pixels");
    return 0;
}

static void aPixelsRayGoesThroughItsCentre(void **state)
{
    (void)state;
    mns_view v = {
        .eye = {1, 2, 3}, .look_at = {1, 2, -5}, .up = {0, 1, 0}, .fov = 90, .width = 4, .height = 2};
    brute_ray ray =
        brute_pixel_ray(&v, 3, 0); /* at z = -1 the frame is 4 by 2, this pixel's centre (1.5, 0.5) */
    long double length = sqrtl(1.5L * 1.5L + 0.5L * 0.5L + 1), want[3] = {1.5L, 0.5L, -1};
    for (int a = 0; a < 3; a++) {
        assert_true(ray.origin[a] == a + 1);
        assert_true(fabsl(ray.direction[a] - want[a] / length) < 1e-18L);
    }
}

static void theOraclesOwnImageHasNoErrors(void **state)
{
    (void)state;
    struct mns_field field = two_balls();
    brute *oracle = brute_create(&field);
    planes *p = draw(oracle);
    brute_report r = compare(oracle, p, PIXELS);
    assert_int_equal(r.rays, PIXELS);
    assert_int_equal(r.hits, p->hits);
    assert_int_equal(r.compared, p->hits);
    assert_int_equal(r.missed + r.invented + r.later + r.undecided + r.near, 0);
    assert_true(r.t_max < 1e-13 && r.normal_max < 1e-4);
    r = compare(oracle, p, 100);
    assert_int_equal(r.rays, 100);
    assert_int_equal(r.hits, 60);
    free(p);
    brute_destroy(oracle);
}

static void plantedErrorsAreCountedByKind(void **state)
{
    (void)state;
    struct mns_field field = two_balls();
    brute *oracle = brute_create(&field);
    planes *p = draw(oracle);
    int missed = nth(p, 10, true), later = nth(p, 20, true), off = nth(p, 30, true),
        turned = nth(p, 40, true);
    int invented = nth(p, 10, false), undecided = nth(p, 20, false);
    p->t[missed] = INFINITY;
    p->t[invented] = 3;
    p->t[later] += 0.11f;
    p->t[off] *= 1.001f, p->t_lo[off] = 0;
    for (int a = 0; a < 3; a++) p->normal[3 * turned + a] *= -1;
    p->certain[undecided] = 0, p->t[undecided] = 3;
    brute_report r = compare(oracle, p, PIXELS);
    assert_int_equal(r.missed, 1);
    assert_int_equal(r.invented, 1);
    assert_int_equal(r.later, 1);
    assert_int_equal(r.undecided, 1);
    assert_int_equal(r.near, 0);
    assert_int_equal(r.compared, p->hits - 2);
    assert_true(fabs(r.t_max - 1e-3) < 1e-6 && r.t_median < 1e-13);
    assert_true(r.normal_max > 179.9 && r.normal_p999 <= r.normal_max);
    free(p);
    brute_destroy(oracle);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(aPixelsRayGoesThroughItsCentre),
        cmocka_unit_test(theOraclesOwnImageHasNoErrors),
        cmocka_unit_test(plantedErrorsAreCountedByKind),
    };
    return cmocka_run_group_tests_name("brute_image", tests, NULL, NULL);
}
