/* The default spacing against brute force, on ordinary and on hostile arrangements. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "field/field.h"

static uint64_t state_of_random;

static double uniform(void)
{
    state_of_random = state_of_random * 6364136223846793005u + 1442695040888963407u;
    return (double)(state_of_random >> 11) * 0x1p-53;
}

static particles make(size_t count)
{
    particles p = {.count = count};
    for (int k = 0; k < 3; k++) p.axis[k] = malloc(count * sizeof(double));
    return p;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Median over all pairs, by sorting. */
static double brute_force(const particles *p)
{
    double *nearest = malloc(p->count * sizeof *nearest), median = 0;
    size_t found = 0;
    for (size_t i = 0; i < p->count; i++) {
        double best = INFINITY;
        for (size_t j = 0; j < p->count; j++) {
            double d = 0;
            for (int k = 0; k < 3; k++)
                d += (p->axis[k][i] - p->axis[k][j]) * (p->axis[k][i] - p->axis[k][j]);
            if (d > 0 && d < best) best = d;
        }
        if (isfinite(best)) nearest[found++] = sqrt(best);
    }
    qsort(nearest, found, sizeof *nearest, compare);
    if (found)
        median = found % 2 ? nearest[found / 2]
                           : nearest[found / 2 - 1] + (nearest[found / 2] - nearest[found / 2 - 1]) / 2;
    free(nearest);
    return median;
}

/* Arrangement `shape` of a point: cube, slab, line, lattice, clusters of very different density, doubled
 * points. */
static void place(particles *p, size_t i, int shape)
{
    double a = uniform(), b = uniform(), c = uniform(), scale = 1;
    switch (shape) {
    case 1:
        c = 0.25;
        break;
    case 2:
        b = a, c = -a;
        break;
    case 3:
        a = floor(a * 8), b = floor(b * 8), c = floor(c * 8);
        break;
    case 4:
        scale = ldexp(1, -(int)(i % 40));
        break;
    case 5:
        scale = pow(10, -6 * (double)(i % 2));
        break;
    }
    p->axis[0][i] = a * scale, p->axis[1][i] = b * scale, p->axis[2][i] = c * scale;
    if (shape == 6 && i % 3)
        for (int k = 0; k < 3; k++) p->axis[k][i] = p->axis[k][i - 1];
}

static void agrees_with_brute_force(void **state)
{
    (void)state;
    static const size_t counts[] = {2, 3, 9, 64, 1501};
    for (int shape = 0; shape <= 6; shape++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            state_of_random = 77 + (uint64_t)shape;
            particles p = make(counts[c]);
            for (size_t i = 0; i < p.count; i++) place(&p, i, shape);
            double median = -1;
            assert_int_equal(field_spacing(&p, &median, NULL), MNS_OK);
            double expected = brute_force(&p);
            if (median != expected)
                fail_msg("shape %d of %zu: %.17g, expected %.17g", shape, p.count, median, expected);
            particles_free(&p);
        }
}

static void no_distinct_pair_gives_zero(void **state)
{
    (void)state;
    double median = -1;
    particles p = make(100000);
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < p.count; i++) p.axis[k][i] = 3.5;
    assert_int_equal(field_spacing(&p, &median, NULL), MNS_OK);
    assert_true(median == 0);
    p.axis[0][77] = 5.5; /* one distinct centre: all of them have a neighbour 2 away */
    assert_int_equal(field_spacing(&p, &median, NULL), MNS_OK);
    assert_true(median == 2);
    p.count = 1;
    assert_int_equal(field_spacing(&p, &median, NULL), MNS_OK);
    assert_true(median == 0);
    particles_free(&p);
}

/* Crowds that a uniform grid would search pair by pair: hours, not seconds. The limit leaves room for
 * sanitizers. */
static void crowds_cost_no_square(void **state)
{
    (void)state;
    for (int shape = 0; shape <= 2; shape++) {
        particles p = make(200000);
        state_of_random = 5;
        for (size_t i = 0; i < p.count; i++) {
            place(&p, i, 0);
            double scale = shape == 0 ? 1 : shape == 1 && i > 9 ? 1e-9 : i % 2 ? 1 : 0;
            for (int k = 0; k < 3; k++) p.axis[k][i] *= scale;
        }
        double start = clock_ms(), median = 0;
        assert_int_equal(field_spacing(&p, &median, NULL), MNS_OK);
        assert_true(median > 0);
        assert_true(clock_ms() - start < 20000);
        particles_free(&p);
    }
}

static void medians_are_exact(void **state)
{
    (void)state;
    const double odd[] = {5, 1, 3}, even[] = {4, 1, 3, 2}, same[] = {7, 7, 7, 7},
                 mixed[] = {0, 1e-300, 1e300, 2};
    assert_true(field_median(odd, 3) == 3);
    assert_true(field_median(even, 4) == 2.5);
    assert_true(field_median(same, 4) == 7);
    assert_true(field_median(mixed, 3) == 1e-300);
    assert_true(field_median(mixed, 1) == 0);
    assert_true(field_median(odd, 0) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_brute_force),
        cmocka_unit_test(no_distinct_pair_gives_zero),
        cmocka_unit_test(crowds_cost_no_square),
        cmocka_unit_test(medians_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
