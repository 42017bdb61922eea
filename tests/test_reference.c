/* The certified tracer against the long-double oracle: every kernel, strengths of one sign and of both,
 * fields of four kinds; and rays that are hard by construction. */
#include "field/field.h"
#include "support/brute.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef enum crowd { SCATTERED, DENSE, MIXED, COINCIDENT, CROWDS } crowd;
enum { BALLS = 60, RAYS = 150 };

typedef struct random_numbers {
    uint64_t state;
} random_numbers;

static double random_next(random_numbers *r) /* in [0, 1); Marsaglia's xorshift */
{
    r->state ^= r->state << 13;
    r->state ^= r->state >> 7;
    r->state ^= r->state << 17;
    return (double)(r->state >> 11) * 0x1p-53;
}

/* Balls as arrays, as a host has them. */
typedef struct balls {
    double position[BALLS * 3], radius[BALLS], strength[BALLS];
    size_t count;
} balls;

static void balls_add(balls *b, double x, double y, double z, double radius, double strength)
{
    double *p = b->position + 3 * b->count;
    p[0] = x, p[1] = y, p[2] = z;
    b->radius[b->count] = radius;
    b->strength[b->count++] = strength;
}

static mns_field *field_of(const balls *b, mns_kernel kernel, double iso)
{
    mns_error error;
    mns_field *field = NULL;
    mns_field_desc desc = {.count = b->count,
                           .position = {.data = b->position},
                           .radius = {.data = b->radius},
                           .strength = {.data = b->strength},
                           .kernel = kernel,
                           .iso = iso};
    if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
    return field;
}

static mns_reference *reference_of(const mns_field *field)
{
    mns_error error;
    mns_reference *reference = NULL;
    if (mns_reference_create(field, &reference, &error)) fail_msg("%s", error.text);
    return reference;
}

static mns_hit trace(const mns_reference *reference, const double from[3], const double direction[3])
{
    mns_error error;
    mns_hit hit;
    if (mns_reference_trace(reference, from, direction, &hit, &error)) fail_msg("%s", error.text);
    return hit;
}

/* One ray through one field, made and destroyed. */
static mns_hit trace_once(const balls *b, mns_kernel kernel, double iso, const double from[3],
                          const double direction[3])
{
    mns_field *field = field_of(b, kernel, iso);
    mns_reference *reference = reference_of(field);
    mns_hit hit = trace(reference, from, direction);
    mns_reference_destroy(reference);
    mns_field_destroy(field);
    return hit;
}

#define V(...) ((const double[3]){__VA_ARGS__})

static void assert_close(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g within %.3g", a, b, tolerance);
}

static void crowd_make(balls *b, crowd kind, bool mixed_signs, random_numbers *r)
{
    b->count = 0;
    for (int i = 0; i < BALLS; i++) {
        double p[3], radius = 0.2, q = 1;
        for (int a = 0; a < 3; a++) p[a] = random_next(r);
        if (kind == DENSE) radius = 0.6;
        if (kind == MIXED) radius = 0.5 * pow(100, -random_next(r));
        if (kind == COINCIDENT) { /* five places, each taken by twelve balls or nearly so */
            for (int a = 0; a < 3; a++)
                p[a] = 0.1 + 0.2 * ((i * (a + 2)) % 5) + (i % 2 ? 1e-9 * random_next(r) : 0);
            radius = i % 3 ? 0.2 : 0.21;
        }
        if (mixed_signs) q = (random_next(r) < 0.35 ? -1 : 1) * (0.2 + 1.5 * random_next(r));
        balls_add(b, p[0], p[1], p[2], radius, q);
    }
}

typedef struct tally {
    size_t rays, hits, undecided;
} tally;

/* One ray by both; what is certain must be the oracle's answer, within the bound that comes with it. */
static void compare_ray(const mns_reference *reference, const brute *oracle, const double from[3],
                        const double direction[3], const char *what, tally *count)
{
    mns_hit hit = trace(reference, from, direction);
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
    random_numbers r = {0x9e3779b97f4a7c15};
    tally all = {0, 0, 0};
    for (mns_kernel kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++)
        for (int scene = 0; scene < 2 * CROWDS; scene++) {
            balls b;
            char what[80];
            crowd_make(&b, (crowd)(scene / 2), scene % 2, &r);
            snprintf(what, sizeof what, "%s, %s, %s strengths", mns_kernel_name(kernel), crowds[scene / 2],
                     scene % 2 ? "mixed" : "equal");
            mns_field *field = field_of(&b, kernel, 0.2);
            mns_reference *reference = reference_of(field);
            brute *oracle = brute_create(field);
            assert_non_null(oracle);
            for (int i = 0; i < RAYS; i++) {
                double from[3], way[3], out = i % 4 ? 3 : 1; /* every fourth eye is among the balls */
                for (int a = 0; a < 3; a++) {
                    from[a] = 0.5 + out * (random_next(&r) - 0.5);
                    way[a] = random_next(&r) - from[a];
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agreesWithTheOracle),
    };
    (void)assert_close, (void)trace_once;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
