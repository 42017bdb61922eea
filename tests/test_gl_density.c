/* glsl/density.glsl is one text: the C compiler and the driver's compiler must give the same values, as float
 * and as double; and its slopes, bounds and core radii must agree with its values. */
#include "field/kernel.h"
#include "gl/context.h"
#include "support/gl_compute.h"
#include "support/gl_fixture.h"

#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { ARGUMENTS = 4096, GROUP = 64 };
enum { VALUE, SLOPE_OVER_V, SLOPE, SLOPE_BOUND, CORE, OVER_CUBE, FUNCTIONS };

static const char *const function_names[FUNCTIONS] = {"value",       "slope_over_v", "slope",
                                                      "slope_bound", "core",         "over_cube"};

/* Units in the last place by which GLSL may differ from C, as llvmpipe does at most over these arguments. 0:
 * both compilers keep the order of the text, and +, -, *, / and sqrt are correctly rounded in either (a GPU
 * may divide with 2.5 ulp). The others are products with a constant in them, which GLSL may multiply in
 * another order where nothing is `precise`: the polynomial kernels stay at 0 there too, perlin and wendland,
 * of four to seven factors, do not. */
static const int ulps_float[FUNCTIONS] = {0, 2, 2, 2, 0, 4};
static const int ulps_double[FUNCTIONS] = {0, 2, 3, 2, 0, 4};
/* A card may take a product and a sum in one rounding, its roots and quotients are off by up to 2.5, and what
 * underflows on the way is lost. The core of a level near the peak is a small difference of such roots; no
 * shader asks for one. */
static const int ulps_card[FUNCTIONS] = {24, 24, 24, 24, 1 << 30, 24};

static const char compute_main[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 0) readonly buffer Arguments { REAL argument[]; };\n"
    "layout(std430, binding = 1) writeonly buffer Results { REAL result[]; };\n"
    "void main()\n"
    "{\n"
    "    uint i = gl_GlobalInvocationID.x;\n"
    "    REAL u = argument[i];\n"
    "    result[6u * i] = density_value(KERNEL, u);\n"
    "    result[6u * i + 1u] = density_slope_over_v(KERNEL, u);\n"
    "    result[6u * i + 2u] = density_slope(KERNEL, u);\n"
    "    result[6u * i + 3u] = density_slope_bound(KERNEL, u);\n"
    "    result[6u * i + 4u] = density_core(KERNEL, u);\n"
    "    result[6u * i + 5u] = density_over_cube(KERNEL, u);\n"
    "}\n";

static uint64_t random_next(uint64_t *state) /* splitmix64 */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static double random_unit(uint64_t *state)
{
    return (double)(random_next(state) >> 11) * 0x1p-53;
}

/* Edges first; then a third spread evenly, a third crowded to 0, a third crowded to 1. */
static void fill_arguments(double *argument, bool single)
{
    const double edges[] = {0,     1,     single ? FLT_TRUE_MIN : DBL_TRUE_MIN, single ? FLT_MIN : DBL_MIN,
                            1e-30, 1e-20, single ? 1 - 0x1p-24 : 1 - 0x1p-53,   0.5,
                            0.25,  0.75,  single ? 0x1p-24 : 0x1p-53,           1e-13};
    const size_t edge_count = sizeof edges / sizeof *edges;
    uint64_t seed = 7;
    for (size_t i = 0; i < ARGUMENTS; i++) {
        double x = random_unit(&seed);
        if (i % 3 == 1) x = exp2(-40 * x);
        if (i % 3 == 2) x = 1 - exp2(-1 - (single ? 23 : 52) * x);
        argument[i] = i < edge_count ? edges[i] : single ? (float)x : x;
    }
}

/* Runs the functions of one kernel on the driver: `argument` and `result` are floats where `single`, else
 * doubles. */
static void run(const GladGLContext *gl, int kernel, bool single, const void *argument, void *result)
{
    const size_t size = ARGUMENTS * (single ? sizeof(float) : sizeof(double));
    char head[128];
    snprintf(head, sizeof head, "#version 430 core\n#define KERNEL %d\n%s", kernel,
             single ? "" : "#define MNS_DOUBLE 1\n");
    const char *const text[] = {head, gl_compute_embedded("real.glsl"), gl_compute_embedded("density.glsl"),
                                compute_main};
    gl_compute_run(gl, gl_compute_program(gl, text, 4), ARGUMENTS / GROUP, argument, size, result,
                   FUNCTIONS * size);
}

static double in_c(int function, int kernel, double u)
{
    switch (function) {
    case VALUE:
        return density_value(kernel, u);
    case SLOPE_OVER_V:
        return density_slope_over_v(kernel, u);
    case SLOPE:
        return density_slope(kernel, u);
    case SLOPE_BOUND:
        return density_slope_bound(kernel, u);
    case CORE:
        return density_core(kernel, u);
    default:
        return density_over_cube(kernel, u);
    }
}

static float in_c_float(int function, int kernel, float u)
{
    switch (function) {
    case VALUE:
        return density_value_f(kernel, u);
    case SLOPE_OVER_V:
        return density_slope_over_v_f(kernel, u);
    case SLOPE:
        return density_slope_f(kernel, u);
    case SLOPE_BOUND:
        return density_slope_bound_f(kernel, u);
    case CORE:
        return density_core_f(kernel, u);
    default:
        return density_over_cube_f(kernel, u);
    }
}

/* Steps of the number type from a to b; -0 and 0 are one. */
static double ulps_between(double a, double b, bool single)
{
    if (a == b) return 0;
    if (!isfinite(a) || !isfinite(b)) return INFINITY;
    double least = single ? FLT_TRUE_MIN : DBL_TRUE_MIN, larger = fmax(fabs(a), fabs(b));
    int exponent;
    frexp(larger, &exponent);
    double unit = fmax(ldexp(1, exponent - (single ? 24 : 53)), least);
    return fabs(a - b) / unit;
}

static double flushed(double x, bool single)
{
    return fabs(x) < (single ? FLT_MIN : DBL_MIN) ? 0 : x;
}

/* GL may read and write subnormal numbers as zeros: either answer will do. */
static double difference(int function, int kernel, double u, double got, bool single)
{
    double best = INFINITY;
    const double read[] = {u, flushed(u, single)};
    for (int i = 0; i < 2; i++) {
        double want = single ? in_c_float(function, kernel, (float)read[i]) : in_c(function, kernel, read[i]);
        best = fmin(best, ulps_between(got, want, single));
        best = fmin(best, ulps_between(got, flushed(want, single), single));
    }
    return best;
}

static void compare(gl_fixture *fixture, bool single)
{
    static double argument[ARGUMENTS], result[FUNCTIONS * ARGUMENTS];
    static float argument_f[ARGUMENTS], result_f[FUNCTIONS * ARGUMENTS];
    double worst[FUNCTIONS] = {0};
    const char *renderer = (const char *)fixture->gl.GetString(GL_RENDERER);
    const bool software = context_renderer_is_software(renderer);
    const int *allowed = !software ? ulps_card : single ? ulps_float : ulps_double;
    fill_arguments(argument, single);
    for (int i = 0; i < ARGUMENTS; i++) argument_f[i] = (float)argument[i];
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++) {
        run(&fixture->gl, kernel, single, single ? (const void *)argument_f : argument,
            single ? (void *)result_f : result);
        for (int i = 0; i < FUNCTIONS * ARGUMENTS; i++) {
            int function = i % FUNCTIONS;
            double u = argument[i / FUNCTIONS], got = single ? (double)result_f[i] : result[i];
            double off = difference(function, kernel, u, got, single);
            double least = 16 * (single ? FLT_MIN : DBL_MIN);
            if (!software && fabs(got) < least && fabs(in_c(function, kernel, u)) < least) off = 0;
            worst[function] = fmax(worst[function], off);
            if (kernel <= MNS_KERNEL_WYVILL && software) assert_true(off == 0);
            if (off > allowed[function])
                print_error("%s, density_%s(%.17g): GLSL %.17g, %g ulp from C\n",
                            mns_kernel_name((mns_kernel)kernel), function_names[function], u, got, off);
        }
    }
    for (int function = 0; function < FUNCTIONS; function++)
        printf("%s, %s: %g ulp\n", single ? "floats" : "doubles", function_names[function], worst[function]);
    for (int function = 0; function < FUNCTIONS; function++)
        assert_true(worst[function] <= allowed[function]);
    gl_fixture_check(fixture);
}

static void floats_are_the_same_in_c_and_glsl(void **state)
{
    compare(*state, true);
}

static void doubles_are_the_same_in_c_and_glsl(void **state)
{
    compare(*state, false);
}

static void a_kernel_falls_from_one_to_zero(void **state)
{
    (void)state;
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++) {
        assert_true(density_value(kernel, 0) == 1 && density_value(kernel, 1) == 0);
        assert_true(density_value_f(kernel, 0) == 1 && density_value_f(kernel, 1) == 0);
        assert_true(density_slope(kernel, 0) == 0 && density_slope(kernel, 1) == 0);
        for (int i = 1; i <= 1000; i++)
            assert_true(density_value(kernel, i / 1000.0) < density_value(kernel, (i - 1) / 1000.0));
    }
}

/* Each formula as its author wrote it; cancellation near 1 is why the module has another. */
static void values_are_the_published_formulas(void **state)
{
    (void)state;
    for (int i = 0; i <= 1000; i++) {
        double v = i / 1000.0, u = v * v, rest = 1 - v;
        assert_true(fabs(density_value(MNS_KERNEL_POLY2, u) - pow(1 - u, 2)) < 1e-15);
        assert_true(fabs(density_value(MNS_KERNEL_POLY3, u) - pow(1 - u, 3)) < 1e-15);
        assert_true(fabs(density_value(MNS_KERNEL_POLY4, u) - pow(1 - u, 4)) < 1e-15);
        double wyvill = 1 - 22 * u / 9 + 17 * u * u / 9 - 4 * u * u * u / 9;
        assert_true(fabs(density_value(MNS_KERNEL_WYVILL, u) - wyvill) < 2e-15);
        double perlin = 1 - v * v * v * (v * (6 * v - 15) + 10);
        assert_true(fabs(density_value(MNS_KERNEL_PERLIN, u) - perlin) < 4e-15);
        assert_true(fabs(density_value(MNS_KERNEL_WENDLAND, u) - pow(rest, 4) * (1 + 4 * v)) < 1e-15);
    }
}

/* A central difference over 2h errs by h^2/6 of the third derivative (below 250 for every kernel) and by
 * 1e-16/h. */
static void slope_is_the_derivative_of_the_value(void **state)
{
    (void)state;
    const double h = 1e-5;
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++)
        for (int i = 1; i < 1000; i++) {
            double v = i / 1000.0, above = v + h, below = v - h;
            double slope =
                (density_value(kernel, above * above) - density_value(kernel, below * below)) / (2 * h);
            assert_true(fabs(density_slope(kernel, v * v) - slope) < 1e-8);
            assert_true(fabs(density_slope_over_v(kernel, v * v) * v - density_slope(kernel, v * v)) < 1e-14);
        }
}

static void over_cube_is_the_value_over_the_chord_cubed(void **state)
{
    (void)state;
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++)
        for (int i = 0; i < 1000; i++) {
            double u = i / 1000.0, want = density_value(kernel, u) / pow(1 - u, 1.5);
            assert_true(fabs(density_over_cube(kernel, u) - want) < 1e-14);
        }
}

static void no_slope_passes_its_bound(void **state)
{
    (void)state;
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++)
        for (int i = 0; i <= 400; i++) {
            double w = i / 400.0, bound = density_slope_bound(kernel, w);
            float bound_f = density_slope_bound_f(kernel, (float)w);
            for (int j = 0; j <= i; j++) { /* every u with 1 - u <= w */
                double u = 1 - j / 400.0;
                assert_true(fabs(density_slope(kernel, u)) <= bound * (1 + 4e-16));
                assert_true(fabsf(density_slope_f(kernel, (float)u)) <= bound_f * (1 + 4e-7f) + 1e-7f);
            }
        }
}

static void no_second_derivative_passes_its_bounds(void **state)
{
    (void)state;
    const double h = 1e-6, rounding = 1e-7;
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++) {
        double bound = density_curvature_bound(kernel, 1), rise = density_rise_bound(kernel, 1), highest = 0;
        assert_true(density_curvature_bound_f(kernel, 1) == bound && density_rise_bound_f(kernel, 1) == rise);
        for (int i = 1; i < 10000; i++) {
            double v = i / 10000.0, above = v + h, below = v - h;
            double along =
                (density_slope(kernel, above * above) - density_slope(kernel, below * below)) / (2 * h);
            double across = density_slope_over_v(kernel, v * v);
            assert_true(fabs(along) <= bound + rounding && fabs(across) <= bound + rounding);
            assert_true(along <= rise + rounding && across <= 0);
            double w = 1 - v * v, nearer = density_curvature_bound(kernel, w); /* grows with w */
            assert_true(fmax(fabs(along), fabs(across)) <= nearer + rounding && nearer <= bound);
            assert_true(along <= density_rise_bound(kernel, w) + rounding);
            highest = fmax(highest, along);
        }
        assert_true(density_slope_over_v(kernel, 0) >= -bound);
        assert_true(highest > 0.9 * rise); /* and the bound is worth its name */
    }
}

/* The core's u is that of the value within a few steps of u and of the value, whichever is coarser there. */
static void core_inverts_the_value(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++) {
        assert_true(density_core(kernel, 1) == 0 && density_core(kernel, 5) == 0 &&
                    density_core_f(kernel, 1) == 0);
        for (int i = 0; i < 3000; i++) {
            double x = random_unit(&seed), ratio = i % 3 == 0   ? x
                                                   : i % 3 == 1 ? exp2(-60 * x)
                                                                : 1 - exp2(-52 * x - 1);
            double v = density_core(kernel, ratio), u = v * v, step = 4 * DBL_EPSILON;
            assert_true(v >= 0 && v <= 1);
            assert_true(density_value(kernel, fmax(u - step, 0)) >= ratio - step);
            assert_true(density_value(kernel, fmin(u + step, 1)) <= ratio + step);
            float ratio_f = fmaxf((float)ratio, FLT_MIN), v_f = density_core_f(kernel, ratio_f),
                  u_f = v_f * v_f;
            float step_f = 4 * FLT_EPSILON;
            assert_true(density_value_f(kernel, fmaxf(u_f - step_f, 0)) >= ratio_f - step_f);
            assert_true(density_value_f(kernel, fminf(u_f + step_f, 1)) <= ratio_f + step_f);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_are_the_same_in_c_and_glsl),
        cmocka_unit_test(doubles_are_the_same_in_c_and_glsl),
        cmocka_unit_test(a_kernel_falls_from_one_to_zero),
        cmocka_unit_test(values_are_the_published_formulas),
        cmocka_unit_test(slope_is_the_derivative_of_the_value),
        cmocka_unit_test(over_cube_is_the_value_over_the_chord_cubed),
        cmocka_unit_test(no_slope_passes_its_bound),
        cmocka_unit_test(no_second_derivative_passes_its_bounds),
        cmocka_unit_test(core_inverts_the_value),
    };
    return cmocka_run_group_tests_name("density", tests, gl_fixture_setup, gl_fixture_teardown);
}
