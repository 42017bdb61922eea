/* What --runs may say. */
#include "compare/run.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void runs_are_read(void **state)
{
    (void)state;
    run_spec *runs;
    size_t count;
    mns_error error;
    const char text[] = "list:cubic,list:exact:gather=paper:slots=8:shuffle=4294967295,reference:exact";
    assert_int_equal(run_parse(text, &runs, &count, &error), MNS_OK);
    assert_int_equal(count, 3);
    assert_string_equal(runs[0].name, "list:cubic");
    assert_int_equal(runs[0].options.solver, MNS_SOLVER_CUBIC);
    assert_int_equal(runs[0].setting_count, 0);
    assert_string_equal(runs[1].name, "list:exact:gather=paper:slots=8:shuffle=4294967295");
    assert_string_equal(runs[1].method, "list");
    assert_string_equal(runs[1].solver, "exact");
    assert_int_equal(runs[1].options.gather, MNS_GATHER_PAPER);
    assert_int_equal(runs[1].options.slots, 8);
    assert_int_equal(runs[1].options.shuffle, UINT32_MAX);
    assert_int_equal(runs[1].setting_count, 3);
    assert_string_equal(runs[1].setting[0].key, "gather");
    assert_string_equal(runs[1].setting[0].value, "paper");
    assert_int_equal(runs[2].options.method, MNS_METHOD_REFERENCE);
    free(runs);
}

static void default_runs_are_all_but_the_truth(void **state)
{
    (void)state;
    run_spec *runs;
    size_t count;
    bool seen[MNS_METHOD_BVH + 1][MNS_SOLVER_SECANT + 1] = {{false}};
    mns_error error;
    assert_int_equal(run_parse(NULL, &runs, &count, &error), MNS_OK);
    for (size_t i = 0; i < count; i++) {
        assert_int_not_equal(runs[i].options.method, MNS_METHOD_REFERENCE);
        seen[runs[i].options.method][runs[i].options.solver] = true;
    }
    static const mns_method methods[] = {MNS_METHOD_LIST, MNS_METHOD_TILE, MNS_METHOD_FBVH, MNS_METHOD_BVH};
    for (size_t m = 0; m < 4; m++)
        for (int solver = MNS_SOLVER_EXACT; solver <= MNS_SOLVER_SECANT; solver++) {
            bool of_trees = solver == MNS_SOLVER_SECANT, is_tree = methods[m] >= MNS_METHOD_FBVH;
            bool there = solver == MNS_SOLVER_EXACT || of_trees == is_tree;
            assert_int_equal(seen[methods[m]][solver], there);
        }
    free(runs);
}

static void wrong_runs_are_refused_in_one_line(void **state)
{
    static const char *const wrong[][2] = {
        {"", "no such METHOD:SOLVER"},
        {"list", "no such METHOD:SOLVER; known are list:exact"},
        {"list:quartic", "--runs list:quartic: no such"},
        {"grid:exact", "no such"},
        {"list:exact,", "no such"},
        {"list:exact:gather", "expected KEY=VALUE"},
        {"list:exact:steps=3", "unknown key steps; known are gather, slots"},
        {"list:exact:gather=late", "gather=late: expected early-z or paper"},
        {"list:exact:slots=0", "slots=0: expected a whole number from 1 to 1024"},
        {"list:exact:slots=1025", "from 1 to 1024"},
        {"list:exact:slots=8x", "from 1 to 1024"},
        {"list:exact:shuffle=4294967296", "from 1 to 4294967295"},
        {"list:exact:slots=8:slots=9", "slots stands in it twice"},
        {"list:exact,list:exact", "list:exact stands in it twice"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        run_spec *runs = NULL;
        size_t count;
        mns_error error;
        assert_int_equal(run_parse(wrong[i][0], &runs, &count, &error), MNS_ERROR_USAGE);
        if (!strstr(error.text, wrong[i][1])) fail_msg("\"%s\" does not say \"%s\"", error.text, wrong[i][1]);
        assert_null(strchr(error.text, '\n'));
        assert_null(runs);
    }
    char lengthy[300] = "list:exact:gather=";
    memset(lengthy + strlen(lengthy), 'x', 200);
    run_spec *runs;
    size_t count;
    mns_error error;
    assert_int_equal(run_parse(lengthy, &runs, &count, &error), MNS_ERROR_USAGE);
    assert_non_null(strstr(error.text, "expected fewer than"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_are_read),
        cmocka_unit_test(default_runs_are_all_but_the_truth),
        cmocka_unit_test(wrong_runs_are_refused_in_one_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
