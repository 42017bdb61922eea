/* What the bounds of law 4 take from a driver's arithmetic: in floats and in doubles, that sums and products
 * marked precise are rounded once, and that quotients and roots are off by no more than a few units in the
 * last place. GLSL promises so much of floats (4.30, section 4.7.1); of doubles it promises less than every
 * driver was seen to give. */
#include "support/gl_compute.h"
#include "support/gl_fixture.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { PAIRS = 8192, GROUP = 64 };
enum { SUM, PRODUCT, TWICE, QUOTIENT, FIFTH, ROOT, UNIT, ARRAY, OPERATIONS };

static const char *const names[OPERATIONS] = {"a + b", "a b",       "a b - b b",     "a / b",
                                              "a / 5", "root of a", "1 / root of a", "a kept in an array"};
/* Units in the last place, of the larger product where two are subtracted. */
static const double allowed[OPERATIONS] = {0, 0, 1, 2.5, 2.5, 4, 6, 0};

static const char compute_main[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 0) readonly buffer Pairs { REAL pair[]; };\n"
    "layout(std430, binding = 1) writeonly buffer Results { REAL result[]; };\n"
    "layout(location = 0) uniform uint result_turn;\n"
    "void main()\n"
    "{\n"
    "    uint i = gl_GlobalInvocationID.x;\n"
    "    REAL a = pair[2u * i], b = pair[2u * i + 1u];\n"
    "    precise REAL sum = a + b, product = a * b, twice = a * b - b * b;\n"
    "    result[8u * i] = sum;\n"
    "    result[8u * i + 1u] = product;\n"
    "    result[8u * i + 2u] = twice;\n"
    "    result[8u * i + 3u] = a / b;\n"
    "    result[8u * i + 4u] = a / NUM(5.0);\n"
    "    result[8u * i + 5u] = sqrt(a);\n"
    "    result[8u * i + 6u] = NUM(1.0) / sqrt(a);\n"
    "    KEPT array[8];\n"
    "    for (int k = 0; k < 8; k++) array[k] = keep(NUM(0.0));\n"
    "    kept_add(array[i & 7u], a);\n"
    "    result[8u * i + 7u] = kept(array[(i + result_turn) & 7u]);\n"
    "}\n";

static void run(const GladGLContext *gl, bool single, const void *pair, void *result)
{
    const size_t size = PAIRS * (single ? sizeof(float) : sizeof(double));
    const char *const text[] = {single ? "#version 430 core\n" : "#version 430 core\n#define MNS_DOUBLE 1\n",
                                gl_compute_embedded("real.glsl"), compute_main};
    gl_compute_run(gl, gl_compute_program(gl, text, 3), PAIRS / GROUP, pair, 2 * size, result,
                   OPERATIONS * size);
}

/* The answers, rounded once where C can; for floats from doubles. */
static double answer(int operation, double a, double b, bool single)
{
    double wanted[] = {a + b,       a * b, single ? (float)(a * b) - (double)(float)(b * b) : a * b - b * b,
                       a / b,       a / 5, sqrt(a),
                       1 / sqrt(a), a};
    return single ? (float)wanted[operation] : wanted[operation];
}

static double unit_of(double x, bool single)
{
    int exponent;
    frexp(x, &exponent);
    return ldexp(1, exponent - (single ? 24 : 53));
}

static void compare(gl_fixture *fixture, bool single)
{
    static double pair[2 * PAIRS], result[OPERATIONS * PAIRS];
    static float pair_f[2 * PAIRS], result_f[OPERATIONS * PAIRS];
    double worst[OPERATIONS] = {0};
    unsigned seed = 5;
    for (int i = 0; i < 2 * PAIRS; i++) { /* from 2^-8 to 2^8, of either parity of exponent */
        seed = seed * 1664525u + 1013904223u;
        double low = seed * 0x1p-32;
        seed = seed * 1664525u + 1013904223u;
        pair[i] = exp2(16 * (low * 0x1p-20 + seed * 0x1p-32) - 8);
        if (single) pair[i] = (float)pair[i];
        pair_f[i] = (float)pair[i];
    }
    run(&fixture->gl, single, single ? (const void *)pair_f : pair, single ? (void *)result_f : result);
    for (int i = 0; i < OPERATIONS * PAIRS; i++) {
        int operation = i % OPERATIONS;
        const double *of = &pair[2 * (i / OPERATIONS)];
        double got = single ? (double)result_f[i] : result[i], want = answer(operation, of[0], of[1], single);
        double size = operation == TWICE ? fmax(of[0] * of[1], of[1] * of[1]) : want;
        if (!isfinite(got)) fail_msg("%s of %g, %g is %g", names[operation], of[0], of[1], got);
        worst[operation] = fmax(worst[operation], fabs(got - want) / unit_of(size, single));
    }
    for (int operation = 0; operation < OPERATIONS; operation++)
        printf("%s, %s: %g ulp\n", single ? "floats" : "doubles", names[operation], worst[operation]);
    for (int operation = 0; operation < OPERATIONS; operation++)
        assert_true(worst[operation] <= allowed[operation]);
    gl_fixture_check(fixture);
}

static void floats_are_as_good_as_the_bounds_take_them_for(void **state)
{
    compare(*state, true);
}

static void doubles_are_as_good_as_the_bounds_take_them_for(void **state)
{
    compare(*state, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_are_as_good_as_the_bounds_take_them_for),
        cmocka_unit_test(doubles_are_as_good_as_the_bounds_take_them_for),
    };
    return cmocka_run_group_tests_name("arithmetic", tests, gl_fixture_setup, gl_fixture_teardown);
}
