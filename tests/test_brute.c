/* The oracle against closed forms, and against dense sampling, which may see less than it but never more. */
#include "field/field.h"
#include "support/brute.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

enum { BALLS = 40 };

/* A field by hand, so that nothing of the library runs here. */
typedef struct scene {
    double axis[3][BALLS], radius[BALLS], strength[BALLS];
    struct mns_field field;
} scene;

static void scene_add(scene *s, double x, double y, double z, double radius, double strength)
{
    size_t i = s->field.p.count++;
    s->axis[0][i] = x, s->axis[1][i] = y, s->axis[2][i] = z;
    s->radius[i] = radius, s->strength[i] = strength;
}

static void scene_begin(scene *s, mns_kernel kernel, double iso)
{
    s->field = (struct mns_field){.kernel = kernel, .iso = iso};
    for (int a = 0; a < 3; a++) s->field.p.axis[a] = s->axis[a];
    s->field.p.radius = s->radius;
    s->field.p.strength = s->strength;
}

static brute_ray ray_towards(const double from[3], const double to[3])
{
    brute_ray ray;
    long double length = 0;
    for (int a = 0; a < 3; a++) {
        ray.origin[a] = from[a];
        ray.direction[a] = (long double)to[a] - from[a];
        length += ray.direction[a] * ray.direction[a];
    }
    for (int a = 0; a < 3; a++) ray.direction[a] /= sqrtl(length);
    return ray;
}

static brute_hit first_hit(const scene *s, const double from[3], const double to[3])
{
    brute *oracle = brute_create(&s->field);
    assert_non_null(oracle);
    brute_ray ray = ray_towards(from, to);
    brute_limits limits = {.tau = 0x1p-40, .reference = {from[0], from[1], from[2]}};
    brute_hit hit = brute_first_hit(oracle, &ray, &limits);
    brute_destroy(oracle);
    return hit;
}

#define V(...) ((const double[3]){__VA_ARGS__})

static void assert_close(long double a, long double b, long double tolerance)
{
    if (!(fabsl(a - b) <= tolerance)) fail_msg("%.21Lg is not %.21Lg within %.3Lg", a, b, tolerance);
}

/* Where a lone ball of strength q has its surface, as a fraction of R: the v with q k(v) = L. */
static long double inverse(mns_kernel kernel, long double level)
{
    if (kernel >= MNS_KERNEL_POLY2 && kernel <= MNS_KERNEL_POLY4)
        return sqrtl(1 - powl(level, 1.0L / (kernel - MNS_KERNEL_POLY2 + 2)));
    long double lo = 0, hi = 1, unused;
    for (int i = 0; i < 100; i++) {
        long double v = (lo + hi) / 2;
        if (brute_kernel(kernel, v * v, &unused) > level)
            lo = v;
        else
            hi = v;
    }
    return hi;
}

static void kernelsHaveTheSlopeAndTheBoundsThatTheyAnnounce(void **state)
{
    (void)state;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        long double slope_most = 0, curvature_most = 0, w, w0, w1, e = 1e-6L;
        assert_close(brute_kernel(k, 0, &w), 1, 0);
        assert_close(brute_kernel(k, 1, &w), 0, 0);
        for (long double v = e; v < 1 - e; v += 1e-4L) {
            long double f0 = brute_kernel(k, (v - e) * (v - e), &w0),
                        f1 = brute_kernel(k, (v + e) * (v + e), &w1);
            brute_kernel(k, v * v, &w);
            assert_true(f1 < f0);
            assert_close(w * v, (f1 - f0) / (2 * e), 1e-9L);
            long double second = (w1 * (v + e) - w0 * (v - e)) / (2 * e);
            slope_most = fmaxl(slope_most, fabsl(w * v));
            curvature_most = fmaxl(curvature_most, fmaxl(fabsl(second), fabsl(w)));
        }
        assert_true(slope_most <= brute_kernel_slope_bound(k) &&
                    slope_most > 0.99L * brute_kernel_slope_bound(k));
        assert_true(curvature_most <= brute_kernel_curvature_bound(k));
        assert_true(curvature_most > 0.99L * brute_kernel_curvature_bound(k));
    }
}

static void oneBallIsASphereOfEveryKernel(void **state)
{
    (void)state;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        scene s;
        scene_begin(&s, k, 0.2);
        scene_add(&s, 3, 0, 0, 1.5, 0.7);
        long double radius = 1.5L * inverse(k, (long double)s.field.iso / (long double)s.strength[0]);
        for (int i = 0; i < 8; i++) {
            double away = 0.25 * i; /* of the sphere's radius, up to past it */
            double y = away * (double)radius;
            brute_hit hit = first_hit(&s, V(-1, y, 0), V(3, y, 0));
            if (i == 4) continue; /* tangent: its own test */
            assert_false(hit.near);
            assert_int_equal(hit.hit, i < 4);
            if (!hit.hit) continue;
            long double half = sqrtl(radius * radius - (long double)y * y);
            assert_close(hit.t, 4 - half, 1e-17L);
            assert_close(hit.normal[0], -half / radius, 1e-17L);
            assert_close(hit.normal[1], y / radius, 1e-17L);
            assert_close(hit.radius, 1.5, 0);
        }
    }
}

static void twoBallsAddUpInTheirMiddlePlane(void **state)
{
    (void)state;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        scene s;
        scene_begin(&s, k, 0.2);
        scene_add(&s, -0.25, 0, 0, 1, 1);
        scene_add(&s, 0.25, 0, 0, 1, 1);
        long double v = inverse(k, (long double)s.field.iso / 2);
        brute_hit hit = first_hit(&s, V(0, 0, 5), V(0, 0, 0));
        assert_true(hit.hit && !hit.near);
        assert_close(hit.t, 5 - sqrtl(v * v - 0.0625L), 1e-17L);
        assert_close(hit.normal[2], 1, 1e-17L);
    }
}

static void aTangentIsToldAsFarAsItsRoundingAllows(void **state)
{
    (void)state;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        scene s;
        scene_begin(&s, k, 0.2);
        scene_add(&s, 0, 0, 0, 1, 1);
        double v = (double)inverse(k, s.field.iso);
        for (double gap = 1e-2; gap > 1e-10; gap *= 0.1) {
            double inside = v * (1 - gap), outside = v * (1 + gap);
            brute_hit hit = first_hit(&s, V(inside, 0, 4), V(inside, 0, 0));
            brute_hit miss = first_hit(&s, V(outside, 0, 4), V(outside, 0, 0));
            assert_true(hit.hit && !hit.near);
            assert_true(!miss.hit && !miss.near);
            assert_true(miss.steps < 500);
        }
        assert_true(first_hit(&s, V(v, 0, 4), V(v, 0, 0)).near);
        assert_true(first_hit(&s, V(v * (1 - 1e-14), 0, 4), V(v * (1 - 1e-14), 0, 0)).near);
    }
}

static void theGapOfAMissIsMeasured(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, MNS_KERNEL_POLY3, 0.2);
    scene_add(&s, 0, 0, 0, 1, 1);
    double x = (double)inverse(MNS_KERNEL_POLY3, s.field.iso) * (1 + 1e-6);
    brute_hit miss = first_hit(&s, V(x, 0, 4), V(x, 0, 0));
    long double unused, below = s.field.iso - brute_kernel(MNS_KERNEL_POLY3, (long double)x * x, &unused);
    long double scale = 1 + brute_kernel_slope_bound(MNS_KERNEL_POLY3) * sqrtl(16 + (long double)x * x);
    assert_close(miss.gap * scale, below, 1e-12L);
    assert_true(first_hit(&s, V(0.99, 0, 4), V(0.99, 0, 0)).gap == 1);
}

static void anEyeInsideSeesTheExit(void **state)
{
    (void)state;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        scene s;
        scene_begin(&s, k, 0.2);
        scene_add(&s, 0.125, 0, 0, 1, 1);
        brute_hit hit = first_hit(&s, V(0, 0, 0), V(1, 0, 0));
        assert_true(hit.hit && !hit.near);
        assert_close(hit.t, 0.125L + inverse(k, s.field.iso), 1e-17L);
        assert_close(hit.normal[0], 1, 1e-17L);
    }
}

static void anEyeOnTheSurfaceTakesTheSignJustAfter(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, MNS_KERNEL_POLY3, 0.125);
    scene_add(&s, 0.5, 0.5, 0, 1, 1); /* (1 - 1/2)^3 = 1/8 at the origin, without rounding */
    brute_hit inwards = first_hit(&s, V(0, 0, 0), V(1, 1, 0));
    assert_true(inwards.hit && !inwards.near);
    assert_close(inwards.t, sqrtl(2), 1e-17L);
    brute_hit outwards = first_hit(&s, V(0, 0, 0), V(-1, -1, 0));
    assert_true(!outwards.hit && !outwards.near);
    assert_true(first_hit(&s, V(0, 0, 0), V(1, -1, 0)).near); /* along the surface */
}

static void aNegativeBallCarves(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, MNS_KERNEL_POLY2, 0.25);
    scene_add(&s, 0, 0, 0, 1, 1);
    scene_add(&s, 0, 0, 1, 0.75, -1); /* covers the side towards the eye, from z = 0.25 on */
    brute_hit front = first_hit(&s, V(0, 0, 4), V(0, 0, 0)), back = first_hit(&s, V(0, 0, -4), V(0, 0, 0));
    assert_true(front.hit && back.hit && !front.near);
    assert_close(back.t, 4 - sqrtl(0.5L), 1e-17L); /* 1 - z^2 = 1/2 */
    long double z = 4 - front.t, own = 1 - z * z, carved = 1 - (1 - z) * (1 - z) / (0.75L * 0.75L);
    assert_close(own * own - carved * carved, 0.25L, 1e-17L);
    assert_true(z < sqrtl(0.5L));
    scene_add(&s, 0, 0, 0, 1, -1); /* nothing is left */
    assert_false(first_hit(&s, V(0, 0, 4), V(0, 0, 0)).hit);
}

static void distanceCostsNoPrecision(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, MNS_KERNEL_POLY3, 0.2);
    scene_add(&s, 0, 0, 0, 1, 1);
    brute_hit hit = first_hit(&s, V(0.25, 0, 1e5), V(0.25, 0, 0));
    long double v = inverse(MNS_KERNEL_POLY3, s.field.iso);
    assert_true(hit.hit);
    assert_close(hit.t, 1e5L - sqrtl(v * v - 0.0625L), 2e-14L);
}

static void anEmptyFieldIsMissed(void **state)
{
    (void)state;
    scene s;
    scene_begin(&s, MNS_KERNEL_POLY3, 0.2);
    assert_false(first_hit(&s, V(0, 0, 1), V(0, 0, 0)).hit);
    scene_add(&s, 0, 0, 0, 1, 0); /* a ball of no strength, seen from inside */
    assert_false(first_hit(&s, V(0, 0, 0.5), V(0, 0, 0)).hit);
}

static double random_unit(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static void random_scene(scene *s, mns_kernel kernel, uint64_t *seed)
{
    scene_begin(s, kernel, 0.2);
    for (int i = 0; i < BALLS; i++) {
        double x = random_unit(seed), y = random_unit(seed), z = random_unit(seed);
        double radius = 0.05 * pow(8, random_unit(seed)), strength = random_unit(seed) < 0.25 ? -0.8 : 1;
        scene_add(s, x, y, z, radius, strength);
    }
}

static bool is_inside(const brute *oracle, const brute_ray *ray, long double t)
{
    long double x[3];
    for (int a = 0; a < 3; a++) x[a] = ray->origin[a] + t * ray->direction[a];
    return brute_value(oracle, x) > 0.2;
}

/* The first change of sign that `count` samples see in (0, 4), or 4. */
static long double sampled_hit(const brute *oracle, const brute_ray *ray, int count)
{
    bool inside = is_inside(oracle, ray, 1e-9L);
    for (int i = 1; i <= count; i++)
        if (is_inside(oracle, ray, 4.0L * i / count) != inside) return 4.0L * i / count;
    return 4;
}

static void samplingNeverSeesAnEarlierChange(void **state)
{
    (void)state;
    uint64_t seed = 7;
    int hits = 0, rays = 0;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        scene s;
        random_scene(&s, k, &seed);
        brute *oracle = brute_create(&s.field);
        for (int i = 0; i < 60; i++, rays++) {
            double eye[3], to[3], out = i % 3 ? 2.0 : 0.0; /* every third from within the cube */
            for (int a = 0; a < 3; a++) eye[a] = random_unit(&seed), to[a] = random_unit(&seed);
            eye[2] += out;
            brute_ray ray = ray_towards(eye, to);
            brute_limits limits = {.tau = 0x1p-40, .reference = {eye[0], eye[1], eye[2]}};
            brute_hit hit = brute_first_hit(oracle, &ray, &limits);
            assert_false(hit.near);
            long double sampled = sampled_hit(oracle, &ray, 4000);
            if (!hit.hit) {
                assert_close(sampled, 4, 0);
                continue;
            }
            hits++;
            assert_true(sampled >= hit.t);
            assert_true(is_inside(oracle, &ray, hit.t - 1e-13L) != is_inside(oracle, &ray, hit.t + 1e-13L));
            assert_true(is_inside(oracle, &ray, hit.t - 1e-13L) == is_inside(oracle, &ray, 1e-9L));
        }
        brute_destroy(oracle);
    }
    assert_true(hits > rays / 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernelsHaveTheSlopeAndTheBoundsThatTheyAnnounce),
        cmocka_unit_test(oneBallIsASphereOfEveryKernel),
        cmocka_unit_test(twoBallsAddUpInTheirMiddlePlane),
        cmocka_unit_test(aTangentIsToldAsFarAsItsRoundingAllows),
        cmocka_unit_test(theGapOfAMissIsMeasured),
        cmocka_unit_test(anEyeInsideSeesTheExit),
        cmocka_unit_test(anEyeOnTheSurfaceTakesTheSignJustAfter),
        cmocka_unit_test(aNegativeBallCarves),
        cmocka_unit_test(distanceCostsNoPrecision),
        cmocka_unit_test(anEmptyFieldIsMissed),
        cmocka_unit_test(samplingNeverSeesAnEarlierChange),
    };
    return cmocka_run_group_tests_name("brute", tests, NULL, NULL);
}
