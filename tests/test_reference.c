/* The certified tracer against the long-double oracle: every kernel, strengths of one sign and of both,
 * fields of four kinds; and rays that are hard by construction. */
#include "field/field.h"
#include "support/brute.h"
#include "support/reference_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef enum crowd { SCATTERED, DENSE, MIXED, COINCIDENT, CROWDS } crowd;
enum { RAYS = 150 };

#define V(...) ((const double[3]){__VA_ARGS__})

static void crowd_make(fixture_balls *b, crowd kind, bool mixed_signs, fixture_numbers *r)
{
    b->count = 0;
    for (int i = 0; i < FIXTURE_BALLS; i++) {
        double p[3], radius = 0.2, q = 1;
        for (int a = 0; a < 3; a++) p[a] = fixture_random(r);
        if (kind == DENSE) radius = 0.6;
        if (kind == MIXED) radius = 0.5 * pow(100, -fixture_random(r));
        if (kind == COINCIDENT) { /* five places, each taken by twelve balls or nearly so */
            for (int a = 0; a < 3; a++)
                p[a] = 0.1 + 0.2 * ((i * (a + 2)) % 5) + (i % 2 ? 1e-9 * fixture_random(r) : 0);
            radius = i % 3 ? 0.2 : 0.21;
        }
        if (mixed_signs) q = (fixture_random(r) < 0.35 ? -1 : 1) * (0.2 + 1.5 * fixture_random(r));
        fixture_add(b, p[0], p[1], p[2], radius, q);
    }
}

typedef struct tally {
    size_t rays, hits, undecided;
} tally;

/* One ray by both; what is certain must be the oracle's answer, within the bound that comes with it. */
static void compare_ray(const mns_reference *reference, const brute *oracle, const double from[3],
                        const double direction[3], const char *what, tally *count)
{
    mns_hit hit = fixture_trace(reference, from, direction);
    brute_ray ray;
    brute_limits limits = {.tau = 0x1p-40, .reference = {from[0], from[1], from[2]}};
    long double length = 0;
    for (int a = 0; a < 3; a++) {
        ray.origin[a] = from[a];
        ray.direction[a] = direction[a];
        length += ray.direction[a] * ray.direction[a];
    }
    for (int a = 0; a < 3; a++) ray.direction[a] /= sqrtl(length);
    count->rays++;
    count->hits += hit.hit;
    count->undecided += !hit.certain;
    if (!hit.certain) return;
    brute_hit truth = brute_first_hit(oracle, &ray, &limits);
    if (truth.near) return;
    if (hit.hit != truth.hit)
        fail_msg("%s: ray %zu: hit %d, truly %d", what, count->rays, hit.hit, truth.hit);
    if (!hit.hit) return;
    long double off = fabsl(hit.t - truth.t), cosine = 0;
    if (!(off <= 1.01L * hit.t_error + 0x1p-58L * truth.t))
        fail_msg("%s: ray %zu: t = %.17g, truly %.20Lg: off by %.3Lg, bound %.3g", what, count->rays, hit.t,
                 truth.t, off, hit.t_error);
    assert_true(hit.t_error < 1e-6);
    for (int a = 0; a < 3; a++) cosine += hit.normal[a] * truth.normal[a];
    if (hit.t_error < 1e-12 && !(cosine > 1 - 1e-9L)) fail_msg("%s: ray %zu: normal", what, count->rays);
}

static void agreesWithTheOracle(void **state)
{
    (void)state;
    static const char *const crowds[] = {"scattered", "dense", "mixed", "coincident"};
    fixture_numbers r = {0x9e3779b97f4a7c15};
    tally all = {0, 0, 0};
    for (mns_kernel kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++)
        for (int scene = 0; scene < 2 * CROWDS; scene++) {
            fixture_balls b;
            char what[80];
            crowd_make(&b, (crowd)(scene / 2), scene % 2, &r);
            snprintf(what, sizeof what, "%s, %s, %s strengths", mns_kernel_name(kernel), crowds[scene / 2],
                     scene % 2 ? "mixed" : "equal");
            mns_field *field = fixture_field(&b, kernel, 0.2);
            mns_reference *reference = fixture_reference(field);
            brute *oracle = brute_create(field);
            assert_non_null(oracle);
            for (int i = 0; i < RAYS; i++) {
                double from[3], way[3], out = i % 4 ? 3 : 1; /* every fourth eye is among the balls */
                for (int a = 0; a < 3; a++) {
                    from[a] = 0.5 + out * (fixture_random(&r) - 0.5);
                    way[a] = fixture_random(&r) - from[a];
                }
                compare_ray(reference, oracle, from, way, what, &all);
            }
            brute_destroy(oracle);
            mns_reference_destroy(reference);
            mns_field_destroy(field);
        }
    assert_true(2 * all.hits > all.rays);
    if (10000 * all.undecided > all.rays) fail_msg("%zu of %zu undecided", all.undecided, all.rays);
}

/* ---- Rays that are hard by construction ---- */

/* 9/16 = (1 - 1/4)^2: with poly2 a lone unit ball's surface lies at 1/2 from its centre, in doubles too. */
static const double NINE_16 = 0.5625;

static fixture_balls one_ball(double x, double y, double z, double radius)
{
    fixture_balls b = {.count = 0};
    fixture_add(&b, x, y, z, radius, 1);
    return b;
}

static void assert_certain_hit(mns_hit hit, double t, double tolerance)
{
    assert_true(hit.hit);
    assert_true(hit.certain);
    fixture_expect_close(hit.t, t, tolerance + hit.t_error);
}

static void assert_certain_miss(mns_hit hit)
{
    assert_false(hit.hit);
    assert_true(hit.certain);
    assert_true(isinf(hit.t) && hit.t_error == 0 && hit.ball == 0);
    assert_true(hit.normal[0] == 0 && hit.normal[1] == 0 && hit.normal[2] == 0);
}

static void anEmptyFieldIsMissed(void **state)
{
    (void)state;
    mns_error error;
    mns_field *field = NULL;
    mns_field_desc desc = {.count = 0};
    double gradient[3] = {1, 1, 1};
    size_t ball = 0;
    assert_int_equal(mns_field_create(&desc, &field, &error), MNS_OK);
    mns_reference *reference = fixture_reference(field);
    assert_certain_miss(fixture_trace(reference, V(0, 0, 0), V(1, 0, 0)));
    assert_true(mns_reference_value(reference, V(0, 0, 0), gradient, &ball) == 0);
    assert_true(gradient[0] == 0 && gradient[1] == 0 && gradient[2] == 0);
    assert_true(ball == SIZE_MAX);
    mns_reference_destroy(reference);
    mns_field_destroy(field);
}

static void aLoneBallIsASphere(void **state)
{
    (void)state;
    fixture_balls b = one_ball(3, 0, 0, 1);
    mns_hit hit = fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0, 0, 0), V(7, 0, 0));
    assert_certain_hit(hit, 2.5, 1e-15);
    assert_true(hit.t_error < 3e-14);
    fixture_expect_close(hit.normal[0], -1, 1e-14);
    assert_int_equal(hit.ball, 0);
    assert_certain_miss(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0, 0, 0), V(-1, 0, 0)));
    assert_certain_miss(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0, 0.51, 0), V(1, 0, 0)));
    assert_certain_miss(fixture_trace_once(&b, MNS_KERNEL_POLY2, 1.5, V(0, 0, 0), V(1, 0, 0)));
}

static void aTangentRayIsNoCertainHit(void **state)
{
    (void)state;
    fixture_balls b = one_ball(3, 0, 0, 1);
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        long double unused, lo = 0, hi = 1;
        for (int i = 0; i < 100; i++) {
            long double v = (lo + hi) / 2;
            if (brute_kernel(k, v * v, &unused) > 0.2)
                lo = v;
            else
                hi = v;
        }
        mns_hit hit = fixture_trace_once(&b, k, 0.2, V(0, (double)hi, 0), V(1, 0, 0));
        assert_false(hit.hit && hit.certain);
        /* A billionth of a radius to either side there is nothing to doubt. */
        hit = fixture_trace_once(&b, k, 0.2, V(0, (double)hi - 1e-9, 0), V(1, 0, 0));
        assert_true(hit.hit && hit.certain);
        assert_certain_miss(fixture_trace_once(&b, k, 0.2, V(0, (double)hi + 1e-9, 0), V(1, 0, 0)));
    }
    mns_hit exact = fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0, 0.5, 0), V(1, 0, 0));
    assert_false(exact.hit && exact.certain);
}

/* Two unit balls 3/2 apart, poly2: half-way f has a saddle of 2 (7/16)^2 = 49/128. */
static void ballsThatJustTouchAreUndecidedAtTheNeckAlone(void **state)
{
    (void)state;
    fixture_balls b = one_ball(0, 0, 0, 1);
    fixture_add(&b, 1.5, 0, 0, 1, 1);
    const double saddle = 49.0 / 128;
    mns_hit across = fixture_trace_once(&b, MNS_KERNEL_POLY2, saddle, V(0.75, -3, 0), V(0, 1, 0));
    mns_hit along = fixture_trace_once(&b, MNS_KERNEL_POLY2, saddle, V(0, 0, 0), V(1, 0, 0));
    assert_false(across.certain && across.hit);
    assert_false(along.certain);
    /* L a billionth more: parted; less: joined. */
    double more = saddle * (1 + 1e-9), less = saddle * (1 - 1e-9);
    assert_certain_miss(fixture_trace_once(&b, MNS_KERNEL_POLY2, more, V(0.75, -3, 0), V(0, 1, 0)));
    across = fixture_trace_once(&b, MNS_KERNEL_POLY2, less, V(0.75, -3, 0), V(0, 1, 0));
    assert_true(across.hit && across.certain);
    fixture_expect_close(across.t, 3, 1e-4);
    along = fixture_trace_once(&b, MNS_KERNEL_POLY2, more, V(0, 0, 0), V(1, 0, 0));
    assert_true(along.hit && along.certain && along.t < 0.75);
    along = fixture_trace_once(&b, MNS_KERNEL_POLY2, less, V(0, 0, 0), V(1, 0, 0));
    assert_true(along.hit && along.certain && along.t > 1.5);
}

static void anEyeInsideSeesTheExit(void **state)
{
    (void)state;
    fixture_balls b = one_ball(1, 2, 3, 1);
    assert_certain_hit(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(1, 2, 3), V(0, 0, -2)), 0.5,
                       1e-15);
    assert_certain_hit(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(1.25, 2, 3), V(1, 0, 0)), 0.25,
                       1e-15);
    /* Inside the ball, outside the surface. */
    assert_certain_miss(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(1.75, 2, 3), V(1, 0, 0)));
    assert_certain_hit(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(1.75, 2, 3), V(-1, 0, 0)), 0.25,
                       1e-15);
}

static void anEyeOnTheSurfaceIsWhereItIsJustAfter(void **state)
{
    (void)state;
    fixture_balls b = one_ball(0, 0, 0, 1);
    assert_certain_miss(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0.5, 0, 0), V(1, 0, 0)));
    assert_certain_miss(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0.5, 0, 0), V(0.1, 1, 0)));
    assert_certain_hit(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0.5, 0, 0), V(-1, 0, 0)), 1,
                       1e-15);
    mns_hit tangent = fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0.5, 0, 0), V(0, 1, 0));
    assert_false(tangent.hit && tangent.certain);
    /* As near as doubles come, and yet beside it. */
    mns_hit beside =
        fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(nextafter(0.5, 1), 0, 0), V(-1, 0, 0));
    assert_false(beside.certain && fabs(beside.t - 1) < 0.5);
}

static void farEyesAndFarFieldsLoseNothing(void **state)
{
    (void)state;
    static const double away[] = {1e5, 1e7, 1e9, 1e12};
    for (size_t i = 0; i < sizeof away / sizeof *away; i++) {
        fixture_balls b = one_ball(0, 0, 0, 1);
        mns_hit hit = fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0, 0, away[i]), V(0, 0, -1));
        assert_certain_hit(hit, away[i] - 0.5, 0);
        assert_true(hit.t_error <= 1e-15 * away[i] + 1e-14);
        /* Past the ball by a millionth of its radius. */
        assert_certain_miss(
            fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0.500001, 0, away[i]), V(0, 0, -1)));
        b = one_ball(away[i], -away[i], away[i], 1);
        hit =
            fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(away[i], -away[i], away[i] + 4), V(0, 0, -1));
        assert_certain_hit(hit, 3.5, 1e-14);
    }
}

static void radiiMayBeTinyOrHuge(void **state)
{
    (void)state;
    static const double sizes[] = {1e-29, 1e-15, 1e-5, 1e15, 1e29};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
            double r = sizes[i];
            fixture_balls b = one_ball(0, 0, 0, r), unit = one_ball(0, 0, 0, 1);
            mns_hit hit = fixture_trace_once(&b, k, 0.2, V(3 * r, 0.1 * r, 0), V(-1, 0, 0));
            mns_hit same = fixture_trace_once(&unit, k, 0.2, V(3, 0.1, 0), V(-1, 0, 0));
            assert_certain_hit(hit, same.t * r, 1e-14 * r);
            assert_true(hit.t_error < 1e-13 * r);
        }
    /* A speck before a giant: 1e-9 of its size, seen and not seen. */
    fixture_balls b = one_ball(0, 0, 0, 1e6);
    fixture_add(&b, 0, 0, 2e6, 1e-3, 1);
    assert_certain_hit(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(0, 0, 3e6), V(0, 0, -1)),
                       1e6 - 5e-4, 0);
    assert_certain_hit(fixture_trace_once(&b, MNS_KERNEL_POLY2, NINE_16, V(1, 0, 3e6), V(0, 0, -1)),
                       3e6 - sqrt(25e10 - 1), 1e-9);
}

static void tenThousandBallsMayShareOnePlace(void **state)
{
    (void)state;
    enum { MANY = 10000 };
    mns_error error;
    fixture_numbers r = {12345};
    double *position = calloc(MANY, 3 * sizeof *position);
    assert_non_null(position);
    for (int spread = 0; spread < 2; spread++) {
        mns_field *field = NULL;
        for (int i = 0; spread && i < 3 * MANY; i++) position[i] = 2e-7 * (fixture_random(&r) - 0.5);
        mns_field_desc desc = {.count = MANY,
                               .position = {.data = position},
                               .uniform_radius = 1,
                               .kernel = MNS_KERNEL_POLY3,
                               .iso = 0.2};
        if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
        mns_reference *reference = fixture_reference(field);
        double surface = sqrt(1 - cbrt(0.2 / MANY));
        for (int i = 0; i < 5; i++) {
            double y = 0.9 * surface * i / 4;
            assert_certain_hit(fixture_trace(reference, V(-3, y, 0), V(1, 0, 0)),
                               3 - sqrt(surface * surface - y * y), spread ? 1e-6 : 1e-13);
        }
        assert_certain_hit(fixture_trace(reference, V(0, 0, 0), V(1, 1, 0)), surface, spread ? 1e-6 : 1e-13);
        assert_certain_miss(fixture_trace(reference, V(-3, surface * 1.00001, 0), V(1, 0, 0)));
        mns_reference_destroy(reference);
        mns_field_destroy(field);
    }
    free(position);
}

static void valuesAreTheOracles(void **state)
{
    (void)state;
    fixture_numbers r = {77};
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        fixture_balls b;
        crowd_make(&b, MIXED, true, &r);
        mns_field *field = fixture_field(&b, k, 0.2);
        mns_reference *reference = fixture_reference(field);
        brute *oracle = brute_create(field);
        for (int i = 0; i < 200; i++) {
            double x[3], gradient[3], largest = 0;
            long double exact[3], slope[3], unused;
            size_t ball, best = SIZE_MAX;
            for (int a = 0; a < 3; a++) exact[a] = x[a] = 1.4 * fixture_random(&r) - 0.2;
            for (size_t j = 0; j < b.count; j++) {
                long double u = 0;
                for (int a = 0; a < 3; a++)
                    u += powl((exact[a] - b.position[3 * j + (size_t)a]) / b.radius[j], 2);
                double share = (double)(fabs(b.strength[j]) * brute_kernel(k, u, &unused));
                if (share > largest) largest = share, best = j;
            }
            double value = mns_reference_value(reference, x, gradient, &ball);
            fixture_expect_close(value, (double)brute_value(oracle, exact), 1e-13);
            brute_gradient(oracle, exact, slope);
            for (int a = 0; a < 3; a++) fixture_expect_close(gradient[a], (double)slope[a], 1e-9);
            assert_true(ball == best);
            assert_true(mns_reference_value(reference, x, NULL, NULL) == value);
        }
        brute_destroy(oracle);
        mns_reference_destroy(reference);
        mns_field_destroy(field);
    }
}

static void badRaysAreUsageErrors(void **state)
{
    (void)state;
    fixture_balls b = one_ball(0, 0, 0, 1);
    mns_field *field = fixture_field(&b, MNS_KERNEL_POLY3, 0.2);
    mns_reference *reference = fixture_reference(field);
    mns_hit hit = {.t = 42};
    mns_error error;
    assert_int_equal(mns_reference_trace(reference, V(0, 0, 0), V(0, 0, 0), &hit, &error), MNS_ERROR_USAGE);
    assert_int_equal(mns_reference_trace(reference, V(0, 0, 0), V(0, NAN, 1), &hit, &error), MNS_ERROR_USAGE);
    assert_int_equal(mns_reference_trace(reference, V(0, 0, 0), V(INFINITY, 0, 1), &hit, &error),
                     MNS_ERROR_USAGE);
    assert_int_equal(mns_reference_trace(reference, V(0, NAN, 0), V(0, 0, 1), &hit, &error), MNS_ERROR_USAGE);
    assert_int_equal(mns_reference_trace(reference, NULL, V(0, 0, 1), &hit, NULL), MNS_ERROR_USAGE);
    assert_int_equal(mns_reference_create(NULL, &reference, &error), MNS_ERROR_USAGE);
    assert_true(hit.t == 42);
    /* Any length but zero. */
    assert_certain_hit(fixture_trace(reference, V(0, 0, 3), V(0, 0, -1e-300)), 3 - sqrt(1 - cbrt(0.2)),
                       1e-14);
    assert_certain_hit(fixture_trace(reference, V(0, 0, 3), V(0, 0, -1e300)), 3 - sqrt(1 - cbrt(0.2)), 1e-14);
    mns_reference_destroy(reference);
    mns_reference_destroy(NULL);
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agreesWithTheOracle),
        cmocka_unit_test(anEmptyFieldIsMissed),
        cmocka_unit_test(aLoneBallIsASphere),
        cmocka_unit_test(aTangentRayIsNoCertainHit),
        cmocka_unit_test(ballsThatJustTouchAreUndecidedAtTheNeckAlone),
        cmocka_unit_test(anEyeInsideSeesTheExit),
        cmocka_unit_test(anEyeOnTheSurfaceIsWhereItIsJustAfter),
        cmocka_unit_test(farEyesAndFarFieldsLoseNothing),
        cmocka_unit_test(radiiMayBeTinyOrHuge),
        cmocka_unit_test(tenThousandBallsMayShareOnePlace),
        cmocka_unit_test(valuesAreTheOracles),
        cmocka_unit_test(badRaysAreUsageErrors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
