/* Which method the plan takes where nobody names one, and what it says of it. */
#include "support/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static const mns_limits gpu = {.max_storage_block = (size_t)1 << 31,
                               .max_texture_size = 32768,
                               .max_texture_buffer = 1 << 27,
                               .max_viewport = {32768, 32768},
                               .max_point_size = 2047,
                               .has_clip_control = true};

static mns_plan *plan_of(const mns_field *field, const mns_options *options, const mns_limits *limits,
                         bool host)
{
    mns_plan *plan = NULL;
    mns_error error;
    const mns_view view = {.width = 64, .height = 48};
    if (plan_make(field, &view, NULL, options, limits, host, &plan, &error)) fail_msg("%s", error.text);
    return plan;
}

static void expect_choice(const char *generator, mns_options options, const mns_limits *limits,
                          mns_method method, const char *reason)
{
    const scene s = {"choice", .generator = generator, .desc = {SCENE_UNIT}};
    const char *said;
    mns_field *field = scene_field(&s);
    for (int host = 0; host < 2; host++) { /* a host's framebuffer is for all of them */
        mns_plan *plan = plan_of(field, &options, limits, host);
        if (mns_plan_method(plan, &said) != method)
            fail_msg("method %d, expected %d (%s)", mns_plan_method(plan, NULL), method, said);
        assert_string_equal(said, reason);
        assert_non_null(strstr(mns_plan_text(plan), reason));
        mns_plan_destroy(plan);
    }
    mns_field_destroy(field);
}

static const char card[] = "auto: a card would have to sort the lists that it gathers";

static void the_driver_decides(void **state)
{
    (void)state;
    static const char *const generators[] = {NULL, "scattered:30000", "mixed:1000"};
    static const char software[] = "auto: a software renderer casts sooner than it rasterises";
    for (int i = 0; i < 3; i++)
        for (int moved = 0; moved < 2; moved++) {
            const mns_options options = {.moved = moved};
            expect_choice(generators[i], options, &scene_llvmpipe, MNS_METHOD_TILE, software);
            expect_choice(generators[i], options, &gpu, MNS_METHOD_TILE, card);
            expect_choice(generators[i], options, NULL, MNS_METHOD_TILE, card);
        }
}

/* Trees are no faster there (docs/decisions.md, Machines). */
static void fields_of_any_size_and_thickness_are_tiled(void **state)
{
    (void)state;
    static const char *const fields[] = {"dense:300000", "scattered:300000", "mixed:100", "dense:1000"};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        for (int moved = 0; moved < 2; moved++)
            expect_choice(fields[i], (mns_options){.moved = moved}, &scene_llvmpipe, MNS_METHOD_TILE,
                          "auto: a software renderer casts sooner than it rasterises");
}

static void what_one_method_alone_can_do_decides_first(void **state)
{
    (void)state;
    const mns_limits *const limits[] = {&scene_llvmpipe, &gpu};
    for (int i = 0; i < 2; i++) {
        expect_choice(NULL, (mns_options){.counters = true}, limits[i], MNS_METHOD_FBVH,
                      "auto: trees alone count a ray's work");
        expect_choice(NULL, (mns_options){.tree = "no-fit"}, limits[i], MNS_METHOD_FBVH,
                      "auto: it is said how a tree is built");
        expect_choice(NULL, (mns_options){.solver = MNS_SOLVER_SECANT}, limits[i], MNS_METHOD_FBVH,
                      "auto: the solver secant is the trees'");
        expect_choice(NULL, (mns_options){.gather = MNS_GATHER_PAPER}, limits[i], MNS_METHOD_LIST,
                      "auto: lists alone are gathered as published");
        expect_choice(NULL, (mns_options){.shuffle = 3}, limits[i], MNS_METHOD_LIST,
                      "auto: gathered lists alone are shuffled");
        expect_choice(NULL, (mns_options){.method = MNS_METHOD_BVH}, limits[i], MNS_METHOD_BVH, "asked for");
    }
    expect_choice(NULL, (mns_options){.solver = MNS_SOLVER_CUBIC}, &gpu, MNS_METHOD_TILE, card);
    expect_choice(NULL, (mns_options){.solver = MNS_SOLVER_CUBIC}, &scene_llvmpipe, MNS_METHOD_TILE,
                  "auto: a software renderer casts sooner than it rasterises");
}

static void what_no_method_can_do_together_is_refused(void **state)
{
    (void)state;
    static const mns_options wrong[] = {{.counters = true, .shuffle = 1},
                                        {.counters = true, .solver = MNS_SOLVER_CUBIC},
                                        {.solver = MNS_SOLVER_SECANT, .gather = MNS_GATHER_PAPER}};
    const scene s = {"wrong", .desc = {SCENE_UNIT}};
    mns_field *field = scene_field(&s);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        mns_plan *plan = NULL;
        mns_error error;
        assert_int_equal(mns_plan_create(field, NULL, NULL, &wrong[i], &gpu, &plan, &error), MNS_ERROR_USAGE);
        assert_null(plan);
    }
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_driver_decides),
        cmocka_unit_test(fields_of_any_size_and_thickness_are_tiled),
        cmocka_unit_test(what_one_method_alone_can_do_decides_first),
        cmocka_unit_test(what_no_method_can_do_together_is_refused),
    };
    return cmocka_run_group_tests_name("choose", tests, NULL, NULL);
}
