/* The oracle in ball arithmetic against closed forms, and against the long double one. */
#include "arb/rays.h"
#include "field/field.h"
#include "support/brute.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

#define V(...)                                                                                               \
    {                                                                                                        \
        __VA_ARGS__                                                                                          \
    }

typedef struct world {
    double axis[3][4], radius[4], strength[4];
    truth_scene scene;
} world;

static void begin(world *w, mns_kernel kernel, double iso)
{
    *w = (world){0};
    w->scene = (truth_scene){.axis = {w->axis[0], w->axis[1], w->axis[2]},
                             .radius = w->radius,
                             .strength = w->strength,
                             .kernel = kernel,
                             .iso = iso};
}

static void ball(world *w, double x, double radius, double strength)
{
    w->axis[0][w->scene.count] = x;
    w->radius[w->scene.count] = radius;
    w->strength[w->scene.count++] = strength;
}

static void assert_hit(const world *w, truth_ray ray, long double t, long double tolerance)
{
    truth_answer answer = truth_trace(&w->scene, &ray);
    assert_int_equal(answer.kind, TRUTH_HIT);
    long double off = fabsl((long double)answer.t + (long double)answer.t_rest - t);
    if (!(off <= tolerance)) fail_msg("%.21g is not %.21Lg", answer.t, t);
    assert_true(truth_distance(&answer, (double)t) <= (double)tolerance + 0x1p-52 * (double)t);
}

static truth_kind kind_of(const world *w, truth_ray ray)
{
    return truth_trace(&w->scene, &ray).kind;
}

/* (1 - u)^n = L at v = sqrt(1 - L^(1/n)). */
static void oneBallIsASphere(void **state)
{
    (void)state;
    for (int n = 2; n <= 4; n++) {
        world w;
        begin(&w, (mns_kernel)(MNS_KERNEL_POLY2 + n - 2), 0.3);
        ball(&w, 3, 1.5, 0.75);
        long double r = 1.5L * sqrtl(1 - powl((long double)w.scene.iso / 0.75L, 1.0L / n));
        assert_hit(&w, (truth_ray){V(-1, 0, 0), V(7, 0, 0)}, 4 - r, 1e-17L);
        assert_hit(&w, (truth_ray){V(3, 0, 0), V(0, 0, 0.125)}, r, 1e-17L); /* from inside */
        double y = 0.99 * (double)r;
        assert_hit(&w, (truth_ray){V(-1, y, 0), V(1, 0, 0)}, 4 - sqrtl(r * r - (long double)y * y), 1e-16L);
        assert_int_equal(kind_of(&w, (truth_ray){V(-1, 1.01 * (double)r, 0), V(1, 0, 0)}), TRUTH_MISS);
        assert_int_equal(kind_of(&w, (truth_ray){V(7, 0, 0), V(1, 0, 0)}), TRUTH_MISS); /* it lies behind */
    }
}

/* 2 k(v) = L in the middle plane: a kernel's value told by another ray, of twice the level. */
static void twoBallsAddUpInTheirMiddlePlane(void **state)
{
    (void)state;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        world one, two;
        begin(&one, k, 0.1);
        ball(&one, 0, 1, 1);
        truth_answer alone = truth_trace(&one.scene, &(truth_ray){V(0, 0, 5), V(0, 0, -1)});
        long double v = 5 - ((long double)alone.t + (long double)alone.t_rest), u = v * v, unused;
        assert_true(fabsl(brute_kernel(k, u, &unused) - (long double)one.scene.iso) < 1e-17L);
        begin(&two, k, 0.2);
        ball(&two, -0.25, 1, 1);
        ball(&two, 0.25, 1, 1);
        assert_hit(&two, (truth_ray){V(0, 0, 5), V(0, 0, -3)}, 5 - sqrtl(u - 0.0625L), 1e-17L);
    }
}

static void aTouchIsNamed(void **state)
{
    (void)state;
    world w;
    begin(&w, MNS_KERNEL_POLY2, 0.25); /* (1 - 1/2)^2 at the distance sqrt(1/2) */
    ball(&w, 0, 1, 1);
    truth_ray touch = {V(0.5, 0.5, 4), V(0, 0, -1)}, on = {V(0.5, 0.5, 0), V(1, 0, 0)},
              into = {V(0.5, 0.5, 0), V(-1, 0, 0)}, along = {V(0.5, 0.5, 0), V(0, 0, 1)};
    assert_int_equal(kind_of(&w, touch), TRUTH_TOUCH);
    assert_int_equal(kind_of(&w, along), TRUTH_TOUCH);
    assert_int_equal(kind_of(&w, on), TRUTH_MISS);
    assert_hit(&w, into, 1, 1e-18L); /* out again on the other side */
    touch.origin[0] = nextafter(0.5, 1);
    assert_int_equal(kind_of(&w, touch), TRUTH_MISS);
    touch.origin[0] = nextafter(0.5, 0);
    assert_int_equal(kind_of(&w, touch), TRUTH_HIT);
    touch.origin[0] = 0.5 + 0x1p-30; /* and how near: |1/4 - (1/2 - 2^-30)^2| over k + |k'| |p - o| */
    truth_answer miss = truth_trace(&w.scene, &touch);
    double v = sqrt(0.5), gap = 0x1p-30 / (0.25 + 4 * v * 0.5 * sqrt(16.5));
    assert_int_equal(miss.kind, TRUTH_MISS);
    double found = truth_gap(&w.scene, &touch, &miss);
    if (!(found > gap / 1.3 && found < gap * 1.01)) fail_msg("gap %g, expected about %g", found, gap);
}

static void aPlainHitHasNoGap(void **state)
{
    (void)state;
    world w;
    begin(&w, MNS_KERNEL_WENDLAND, 0.2);
    ball(&w, 0, 1, 1);
    ball(&w, 1.9, 1, 1);
    truth_ray ray = {V(-5, 0.1, 0), V(1, 0, 0)};
    truth_answer hit = truth_trace(&w.scene, &ray);
    assert_int_equal(hit.kind, TRUTH_HIT);
    assert_true(truth_gap(&w.scene, &ray, &hit) == 1);
}

static void aGradientIsThatOfTheValue(void **state)
{
    (void)state;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        world w;
        begin(&w, k, 0.2);
        ball(&w, 0, 1, 1.5);
        ball(&w, 0.5, 0.75, -0.5);
        double x[3] = {0.25, 0.125, -0.25}, gradient[3];
        truth_value(&w.scene, x, gradient);
        for (int a = 0; a < 3; a++) {
            double left[3] = {x[0], x[1], x[2]}, right[3] = {x[0], x[1], x[2]};
            left[a] -= 0x1p-18, right[a] += 0x1p-18;
            double slope = (truth_value(&w.scene, right, NULL) - truth_value(&w.scene, left, NULL)) * 0x1p17;
            assert_true(fabs(slope - gradient[a]) < 1e-9);
        }
    }
}

/* ---- The long double oracle on the same rays ---- */

static brute_hit brute_of(const rays_case *c)
{
    struct mns_field field = {.kernel = c->scene.kernel, .iso = c->scene.iso};
    field.p.count = c->scene.count;
    rays_case copy = *c; /* a field's arrays are not const */
    for (int a = 0; a < 3; a++) field.p.axis[a] = copy.axis[a];
    field.p.radius = copy.radius;
    field.p.strength = copy.strength;
    brute_ray ray;
    brute_limits limits = {.tau = 0x1p-40};
    long double length = 0;
    for (int a = 0; a < 3; a++) length += (long double)c->ray.direction[a] * c->ray.direction[a];
    for (int a = 0; a < 3; a++) {
        ray.origin[a] = c->ray.origin[a];
        ray.direction[a] = c->ray.direction[a] / sqrtl(length);
        limits.reference[a] = c->ray.origin[a];
    }
    brute *oracle = brute_create(&field);
    assert_non_null(oracle);
    brute_hit hit = brute_first_hit(oracle, &ray, &limits);
    brute_destroy(oracle);
    return hit;
}

static void bothOraclesSayTheSame(void **state)
{
    (void)state;
    size_t compared = 0, hits = 0;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++)
        for (uint64_t seed = 0; seed < 6; seed++)
            for (rays_kind kind = 0; kind < RAYS_OFFSET; kind++) {
                if (kind == RAYS_ON_SURFACE) continue; /* long double takes what is near L there for L */
                rays_case c;
                rays_make(kind, k, 1000 + seed, &c);
                brute_hit hit = brute_of(&c);
                truth_answer answer = truth_trace(&c.scene, &c.ray);
                if (hit.near) continue;
                bool same = answer.kind == (hit.hit ? TRUTH_HIT : TRUTH_MISS);
                if (same && hit.hit) same = fabsl(hit.t - answer.t) <= 1e-9L * (1 + hit.t);
                if (!same)
                    fail_msg(
                        "%s, kernel %d, seed %d: long double says hit %d, t %.21Lg, the balls %d, t %.17g",
                        rays_name(kind), (int)k, (int)seed, hit.hit, hit.t, (int)answer.kind, answer.t);
                compared++;
                hits += hit.hit;
            }
    assert_true(compared > 250 && hits > 80);
}

static int end_thread(void **state)
{
    (void)state;
    truth_thread_end();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(oneBallIsASphere),
        cmocka_unit_test(twoBallsAddUpInTheirMiddlePlane),
        cmocka_unit_test(aTouchIsNamed),
        cmocka_unit_test(aPlainHitHasNoGap),
        cmocka_unit_test(aGradientIsThatOfTheValue),
        cmocka_unit_test(bothOraclesSayTheSame),
    };
    return cmocka_run_group_tests(tests, NULL, end_thread);
}
