/* The stated domain: each limit alone, at its edge and beyond; the suite's cases against it. */
#include "compare/stiff.h"
#include "field/field.h"
#include "field/kernel.h"
#include "plan/plan.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* ---- Each limit ---- */

typedef struct input {
    const char *name;
    double place, radius[2], strength, iso,
        eye;           /* of two balls, the second at `place` along x; eye along z */
    const char *limit; /* what it breaks; "" inside */
} input;

static const input inputs[] = {
    {"ordinary", 1, {1, 1}, 1, 0.2, 5, ""},
    {"radii at the limit", 1, {1, 1e-6}, 1, 0.2, 5, ""},
    {"radii beyond", 1, {1, 0.99e-6}, 1, 0.2, 5, "radius-ratio"},
    {"far from zero at the limit", 1e9, {1, 1}, 1, 0.2, 5, ""},
    {"far from zero beyond", 1.01e9, {1, 1}, 1, 0.2, 5, "offset"},
    {"a far eye at the limit", 1, {1, 1}, 1, 0.2, 1e5, ""},
    {"a far eye beyond", 1, {1, 1}, 1, 0.2, 1.01e5, "far-eye"},
    {"strengths at the limit", 1, {1, 1}, 2e6, 0.2, 5, ""},
    {"strengths beyond", 1, {1, 1}, 2.01e6, 0.2, 5, "strength"},
    {"negative strengths beyond", 1, {1, 1}, -2.01e6, 0.2, 5, "strength"},
    {"a level below the limit", 1, {1, 1}, 1, 0.99e-7, 5, "strength"},
    {"small radii at the limit", 1e-30, {1e-30, 1e-30}, 1, 0.2, 5e-30, ""},
    {"small radii beyond", 1e-31, {0.99e-30, 0.99e-30}, 1, 0.2, 5e-30, "lengths"},
    {"distances at the limit", 1e37, {1e36, 1e36}, 1, 0.2, 9.5e37, ""},
    {"distances beyond", 1e37, {1e36, 1e36}, 1, 0.2, 1.01e38, "lengths"},
    {"two limits", 1, {1, 0.99e-6}, 1, 0.2, 1.01e5, "radius-ratio far-eye"},
};

static void make_field(const input *in, mns_field **field)
{
    mns_error error;
    double position[6] = {0, 0, 0, in->place, 0, 0}, strength[2] = {1, in->strength};
    mns_field_desc desc = {.count = 2,
                           .position = {.data = position},
                           .radius = {.data = in->radius},
                           .strength = {.data = strength},
                           .iso = in->iso};
    if (mns_field_create(&desc, field, &error)) fail_msg("%s: %s", in->name, error.text);
}

/* The names of the limits broken, separated by a space. */
static void names_of(const domain_report *report, char *text, size_t size)
{
    *text = '\0';
    for (size_t i = 0; i < report->count; i++) {
        size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%.*s", used ? " " : "", (int)strcspn(report->line[i], ":"),
                 report->line[i]);
    }
}

static void report_of(const mns_field *field, const mns_view *view, domain_report *report)
{
    view_frame frame;
    plan_facts facts;
    view_basis(view, &frame);
    const double unit = field_unit(field);
    frame.eye = vec3_make(frame.eye.x / unit, frame.eye.y / unit, frame.eye.z / unit);
    plan_facts_of(field, &frame, &facts);
    domain_check(field, facts.eye_distance, facts.farthest, report);
}

static void each_limit_is_told_beyond_it_and_not_at_it(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++) {
        const input *in = &inputs[i];
        mns_field *field;
        mns_error error;
        domain_report report;
        char names[200];
        make_field(in, &field);
        mns_view view = {.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT, .eye = {0, 0, in->eye}, .up = {0, 1, 0}};
        if (mns_view_resolve(&view, field, &view, &error)) fail_msg("%s: %s", in->name, error.text);
        report_of(field, &view, &report);
        names_of(&report, names, sizeof names);
        if (strcmp(names, in->limit) != 0)
            fail_msg("%s breaks \"%s\", not \"%s\"", in->name, names, in->limit);
        mns_field_destroy(field);
    }
}

static void a_plan_warns_with_the_figure_and_the_limit(void **state)
{
    (void)state;
    mns_field *field;
    mns_plan *plan;
    mns_error error;
    size_t count;
    make_field(&inputs[2], &field);
    if (mns_plan_create(field, NULL, NULL, NULL, NULL, &plan, &error)) fail_msg("%s", error.text);
    const char *const *line = mns_plan_warnings(plan, &count);
    assert_int_equal(count, 1);
    assert_non_null(
        strstr(line[0], "radius-ratio: R_max / R_min is 1.01e+06; the stated domain ends at 1e+06"));
    assert_non_null(strstr(line[0], "docs/domain.md"));
    assert_non_null(strstr(mns_plan_text(plan), line[0]));
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

static void an_ordinary_plan_has_no_warnings(void **state)
{
    (void)state;
    mns_field *field;
    mns_plan *plan;
    mns_error error;
    size_t count = 1;
    make_field(&inputs[0], &field);
    if (mns_plan_create(field, NULL, NULL, NULL, NULL, &plan, &error)) fail_msg("%s", error.text);
    mns_plan_warnings(plan, &count);
    assert_int_equal(count, 0);
    assert_null(strstr(mns_plan_text(plan), "warnings"));
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

/* ---- The suite's cases ---- */

/* The limits that only a hit tells: balls around one point, and the sum of |q| k there, over a few hits. */
static void hit_limits(const mns_field *field, const mns_view *view, size_t *active, double *sum)
{
    enum { ACROSS = 7, DOWN = 5 };
    mns_reference *reference;
    mns_error error;
    if (mns_reference_create(field, &reference, &error)) fail_msg("%s", error.text);
    *active = 0, *sum = 0;
    for (int i = 0; i < ACROSS * DOWN; i++) {
        double way[3];
        mns_hit hit;
        int column = i % ACROSS, row = i / ACROSS;
        mns_view_ray(view, view->width * (column + 0.5) / ACROSS, view->height * (row + 0.5) / DOWN, way);
        if (mns_reference_trace(reference, view->eye, way, &hit, &error)) fail_msg("%s", error.text);
        if (!hit.hit) continue;
        size_t around = 0;
        double here = 0;
        for (size_t b = 0; b < field->p.count; b++) {
            double u = 0, unit = field_unit(field), r = mns_field_radius(field, b);
            for (int a = 0; a < 3; a++) {
                double d = (view->eye[a] + hit.t * way[a] - field->p.axis[a][b] * unit) / r;
                u += d * d;
            }
            if (u >= 1) continue;
            around++;
            here += fabs(field_strength(field, b)) * density_value((int)field->kernel, u);
        }
        *active = around > *active ? around : *active;
        *sum = fmax(*sum, here / field->iso);
    }
    mns_reference_destroy(reference);
}

static void add_name(char *text, size_t size, const char *name)
{
    size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", used ? " " : "", name);
}

static void the_suites_cases_break_what_their_table_says(void **state)
{
    (void)state;
    size_t count;
    const stiff_case *cases = stiff_cases(&count);
    for (size_t i = 0; i < count; i++) {
        mns_field *field;
        mns_view view;
        mns_error error;
        domain_report report;
        char names[200];
        if (stiff_build(&cases[i], &field, &view, &error)) fail_msg("%s: %s", cases[i].name, error.text);
        report_of(field, &view, &report);
        names_of(&report, names, sizeof names);
        size_t active = 0;
        double sum = 0;
        if (field->p.count <= 100000) hit_limits(field, &view, &active, &sum);
        if ((double)active > DOMAIN_ACTIVE_MOST) add_name(names, sizeof names, "active-balls");
        if (sum > DOMAIN_CANCEL_MOST) add_name(names, sizeof names, "cancellation");
        if (strcmp(names, cases[i].breaks) != 0)
            fail_msg("%s breaks \"%s\", not \"%s\" (%zu active, sum %g L)", cases[i].name, names,
                     cases[i].breaks, active, sum);
        mns_field_destroy(field);
    }
}

static void the_suites_names_differ_and_say_why(void **state)
{
    (void)state;
    size_t count;
    const stiff_case *cases = stiff_cases(&count);
    assert_true(count >= 60);
    for (size_t i = 0; i < count; i++) {
        assert_true(*cases[i].name && *cases[i].why);
        for (size_t k = 0; k < i; k++) assert_string_not_equal(cases[i].name, cases[k].name);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_limit_is_told_beyond_it_and_not_at_it),
        cmocka_unit_test(a_plan_warns_with_the_figure_and_the_limit),
        cmocka_unit_test(an_ordinary_plan_has_no_warnings),
        cmocka_unit_test(the_suites_cases_break_what_their_table_says),
        cmocka_unit_test(the_suites_names_differ_and_say_why),
    };
    return cmocka_run_group_tests_name("domain", tests, NULL, NULL);
}
