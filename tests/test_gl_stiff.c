/* The gate of the stiff suite: the exact solver holds in every case inside the stated domain. */
#include "compare/suite.h"
#include "support/draw_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct gate {
    size_t lines, gated;
} gate;

static void see(void *context, const suite_line *line)
{
    gate *g = context;
    g->lines++;
    g->gated += line->gated;
    if (line->gated && line->verdict != SUITE_HOLDS)
        fprintf(stderr, "%s, %s: %s\n", line->which->name, line->run->spec.name, line->note);
}

/* Runs the cases that match; the suite's JSON, for the caller. */
static json_t *run(draw_fixture *d, const char *runs, const char *only, mns_kernel kernel, gate *g,
                   size_t *failures)
{
    mns_error error;
    run_spec *specs;
    json_t *suite;
    suite_options options = {
        .renderer = d->renderer, .only = only, .kernel = kernel, .quick = true, .seen = see, .context = g};
    *g = (gate){0};
    if (run_parse(runs, &specs, &options.run_count, &error)) fail_msg("%s", error.text);
    options.runs = specs;
    if (suite_run(&options, &suite, failures, &error)) fail_msg("%s", error.text);
    free(specs);
    draw_fixture_check(d);
    return suite;
}

/* Both back ends have the same rasteriser behind them, and compiling the variants takes longest: all cases of
 * the default kernel through the one, of one that is no polynomial along a ray through the other.
 * "meniscus compare --suite stiff" runs them all. */
static void the_exact_solver_holds_inside_the_domain(void **state)
{
    draw_fixture *d = *state;
    const bool second = d->gl.backend == MNS_BACKEND_OSMESA;
    gate g;
    size_t failures;
    json_decref(run(d, "list:exact", NULL, second ? MNS_KERNEL_WENDLAND : MNS_KERNEL_POLY3, &g, &failures));
    assert_true(g.gated >= (second ? 12 : 40));
    assert_int_equal(failures, 0);
}

/* Of the trees, one case of each kind that was hard for them: tiny balls far from the tree's middle, crowds
 * that only leaps get through, walks that take many dispatches, rays that begin within. */
static void the_trees_hold_too(void **state)
{
    draw_fixture *d = *state;
    static const struct {
        const char *name, *runs;
        mns_kernel kernel;
        size_t gated;
    } cases[] = {{"ratio-1e6-near", "fbvh:exact,bvh:exact", MNS_KERNEL_POLY3, 2},
                 {"nearly-coincident", "bvh:exact", MNS_KERNEL_POLY3, 1},
                 {"active-1000", "fbvh:exact", MNS_KERNEL_POLY3, 1},
                 {"line-3000", "fbvh:exact", MNS_KERNEL_POLY3, 1},
                 {"eye-inside", "bvh:exact", MNS_KERNEL_POLY3, 1},
                 {"eye-in-ball/perlin", "fbvh:exact", MNS_KERNEL_PERLIN, 1},
                 {"carving/wyvill", "bvh:exact", MNS_KERNEL_WYVILL, 1},
                 {"far-eye-1e5", "fbvh:exact", MNS_KERNEL_POLY3, 1}};
    size_t count = d->gl.backend == MNS_BACKEND_OSMESA ? 1 : sizeof cases / sizeof *cases;
    for (size_t i = 0; i < count; i++) {
        gate g;
        size_t failures;
        json_decref(run(d, cases[i].runs, cases[i].name, cases[i].kernel, &g, &failures));
        assert_int_equal(g.gated, cases[i].gated);
        assert_int_equal(failures, 0);
    }
}

static void a_model_that_fails_is_shown_and_not_gated(void **state)
{
    gate g;
    size_t failures;
    json_t *suite = run(*state, "list:exact,list:cubic", "silhouettes", MNS_KERNEL_DEFAULT, &g, &failures);
    assert_int_equal(failures, 0);
    assert_int_equal(g.lines, 2);
    json_t *one = json_array_get(json_object_get(suite, "cases"), 0);
    json_t *runs = json_object_get(one, "runs"), *cubic = json_array_get(runs, 1);
    assert_string_equal(json_string_value(json_object_get(one, "name")), "silhouettes");
    assert_true(json_is_true(json_object_get(one, "inside")) &&
                json_is_true(json_object_get(one, "touches")));
    assert_int_equal(json_array_size(json_object_get(one, "limits")), 0);
    assert_string_equal(json_string_value(json_object_get(json_array_get(runs, 0), "verdict")), "holds");
    assert_string_equal(json_string_value(json_object_get(cubic, "name")), "list:cubic");
    assert_string_equal(json_string_value(json_object_get(cubic, "verdict")), "fails");
    assert_true(json_integer_value(json_object_get(cubic, "missed")) +
                    json_integer_value(json_object_get(cubic, "invented")) >
                0);
    assert_non_null(strstr(json_string_value(json_object_get(cubic, "note")), "invented"));
    assert_int_equal(json_integer_value(json_object_get(cubic, "pixels")), 96 * 72);
    assert_true(json_is_number(json_object_get(cubic, "ms")));
    json_decref(suite);
}

static void beyond_the_domain_is_refused_in_clear_words_or_shown(void **state)
{
    gate g;
    size_t failures;
    json_t *suite = run(*state, "list:exact", "lengths-1e-38-to-1e38", MNS_KERNEL_DEFAULT, &g, &failures);
    json_t *one = json_array_get(json_object_get(suite, "cases"), 0);
    json_t *line = json_array_get(json_object_get(one, "runs"), 0);
    assert_int_equal(failures, 0);
    assert_false(json_is_true(json_object_get(one, "inside")));
    assert_string_equal(json_string_value(json_array_get(json_object_get(one, "limits"), 2)), "lengths");
    assert_string_equal(json_string_value(json_object_get(line, "verdict")), "refused");
    assert_non_null(strstr(json_string_value(json_object_get(line, "note")), "take the method reference"));
    assert_true(json_is_null(json_object_get(line, "ms")));
    json_decref(suite);
}

/* No method and no context draws anything wrong of lengths at the ends of what numbers hold. */
static void lengths_at_every_end_hold(void **state)
{
    static const char *const names[] = {"lengths-1e38", "lengths-subnormal"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        gate g;
        size_t failures;
        json_t *suite = run(*state, "list:exact,tile:exact,fbvh:exact,bvh:exact,reference:exact", names[i],
                            MNS_KERNEL_DEFAULT, &g, &failures);
        json_t *runs = json_object_get(json_array_get(json_object_get(suite, "cases"), 0), "runs");
        assert_int_equal(json_array_size(runs), 5);
        for (size_t k = 0; k < 5; k++) {
            json_t *line = json_array_get(runs, k);
            if (strcmp(json_string_value(json_object_get(line, "verdict")), "holds") != 0)
                fail_msg("%s, %s: %s", names[i], json_string_value(json_object_get(line, "name")),
                         json_string_value(json_object_get(line, "note")));
        }
        json_decref(suite);
    }
}

/* What a run of the case comes to, made up. */
static suite_verdict judged(const char *breaks, unsigned flags, const char *solver, metrics errors,
                            bool *gated)
{
    stiff_case which = {.name = "made up", .why = "", .breaks = breaks, .flags = flags};
    run_result result = {.spec = {.solver = solver}, .errors = errors};
    suite_line line;
    suite_judge(&which, &result, &line);
    *gated = line.gated;
    return line.verdict;
}

static void verdicts_are_as_defined(void **state)
{
    (void)state;
    bool gated;
    assert_int_equal(judged("", 0, "exact", (metrics){.pixels = 10000, .undecided = 1}, &gated), SUITE_HOLDS);
    assert_true(gated);
    assert_int_equal(judged("", 0, "exact", (metrics){.pixels = 10000, .undecided = 2}, &gated), SUITE_FAILS);
    assert_int_equal(judged("", STIFF_TOUCHES, "exact", (metrics){.pixels = 100, .undecided = 50}, &gated),
                     SUITE_HOLDS);
    assert_int_equal(judged("", 0, "exact", (metrics){.pixels = 100, .missed = 3}, &gated), SUITE_HOLDS);
    assert_int_equal(judged("", 0, "exact", (metrics){.pixels = 100, .missed_decided = 1}, &gated),
                     SUITE_FAILS);
    assert_int_equal(judged("", 0, "cubic", (metrics){.pixels = 100, .invented_decided = 1}, &gated),
                     SUITE_FAILS);
    assert_false(gated);
    assert_int_equal(judged("", 0, "exact", (metrics){.pixels = 100, .wrong_root = 1}, &gated), SUITE_FAILS);
    assert_int_equal(judged("offset", 0, "exact", (metrics){.pixels = 100, .wrong_root = 1}, &gated),
                     SUITE_OUTSIDE);
    assert_false(gated);
    assert_int_equal(judged("offset", 0, "exact", (metrics){.pixels = 100}, &gated), SUITE_HOLDS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_exact_solver_holds_inside_the_domain),
        cmocka_unit_test(the_trees_hold_too),
        cmocka_unit_test(a_model_that_fails_is_shown_and_not_gated),
        cmocka_unit_test(beyond_the_domain_is_refused_in_clear_words_or_shown),
        cmocka_unit_test(lengths_at_every_end_hold),
        cmocka_unit_test(verdicts_are_as_defined),
    };
    return cmocka_run_group_tests_name("stiff", tests, draw_fixture_setup, draw_fixture_teardown);
}
