/* What `meniscus compare` and `meniscus verify` refuse, each in one line, before anything is drawn. */
#include "support/cli.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int setup(void **state)
{
    cli *c = malloc(sizeof *c);
    assert_non_null(c);
    cli_setup(c, MNS_PROGRAM);
    *state = c;
    return 0;
}

static int teardown(void **state)
{
    cli_teardown(*state);
    free(*state);
    return 0;
}

static void wrong_usage_is_refused(void **state)
{
    static const char *const wrong[][2] = {
        {"compare", "nothing to write: expected -o FOLDER"},
        {"compare scattered:10", "nothing to write: expected -o FOLDER"},
        {"compare -o x", "no input"},
        {"compare scattered:10 -o ''", "the folder for the results has no name"},
        {"compare scattered:10 -o x --frames 4", "--frames 4: expected a whole number from 5"},
        {"compare scattered:10 -o x --runs list", "no such METHOD:SOLVER"},
        {"compare scattered:10 -o x --runs list:exact:hurry=1", "unknown key hurry"},
        {"compare scattered:10 -o x --runs list:exact,list:exact", "twice"},
        {"compare scattered:10 -o x --tolerance-t 1", "expected two saved images"},
        {"compare scattered:10 -o x --case len*", "--case and --quick: expected --suite stiff"},
        {"compare scattered:10 -o x --quick", "--case and --quick: expected --suite stiff"},
        {"compare a.exr b.exr --runs list:exact", "--runs: expected something to draw"},
        {"compare a.exr b.exr --size 8x8", "--size: expected something to draw"},
        {"compare a.exr", "a.exr: an image: expected two of them, both .exr"},
        {"compare a.exr b.csv -o x", "a.exr: an image"},
        {"compare b.csv a.exr -o x", "a.exr: an image"},
        {"compare a.exr a.exr a.exr -o x", "a.exr: an image"},
        {"compare a.exr b.PNG", "b.PNG: an image"},
        {"compare scattered:10 -o x --tolerance-mask -1", "--tolerance-mask -1: expected a whole number"},
        {"compare scattered:10 -o x --fov 180", "--fov 180"},
        {"compare scattered:10 -o x --frame 3", "--frame: expected one frame below 1"},
        {"compare nothing:10 -o x", "nothing"},
        {"compare scattered:10 -o x --solver exact", "unknown option --solver"},
        {"compare --suite stiff scattered:10", "--suite stiff: expected no input"},
        {"compare --suite stiff --size 8x8", "--size: not beside --suite stiff"},
        {"compare --suite stiff --quick --frame 0", "--frame: not beside"},
        {"compare --suite stiff --runs list:exact --frames 5", "--frames: not beside"},
        {"compare --suite stiff --tolerance-t 1", "--tolerance-t: not beside"},
        {"compare --suite stiff --kernel poly2", "--kernel: not beside"},
        {"compare --suite stiff --fov 45", "--fov: not beside"},
        {"verify", "no input"},
        {"verify scattered:10 --rays 0", "--rays 0: expected a whole number from 1"},
        {"verify scattered:10 --seed x", "--seed x: expected a whole number from 0"},
        {"verify scattered:10 --solver quartic", "--solver quartic: expected"},
        {"verify scattered:10 -o x", "unknown option -o"},
    };
    cli *c = *state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        cli_run(c, "%s", wrong[i][0]);
        cli_expect_error(c, 2, wrong[i][1]);
        assert_int_equal(cli_count_files(c), 0);
    }
}

static void a_folder_of_something_else_is_refused_before_any_work(void **state)
{
    cli *c = *state;
    cli_write(c, "notes.txt", "mine");
    cli_run(c, "compare scattered:10000000 -o .");
    cli_expect_error(c, 1, "has notes.txt in it");
    cli_run(c, "compare scattered:10000000 -o notes.txt");
    cli_expect_error(c, 1, "notes.txt: is no folder");
    cli_run(c, "compare scattered:10000000 -o none/out/");
    cli_expect_error(c, 1, "none/out/: cannot write: No such file or directory");
    assert_int_equal(cli_count_files(c), 1);
}

static void missing_images_are_named(void **state)
{
    cli *c = *state;
    cli_run(c, "compare a.exr b.exr");
    cli_expect_error(c, 1, "a.exr: cannot read");
}

static void help_tells_every_option(void **state)
{
    static const char *const told[2][8] = {
        {"--output", "--runs", "--frames", "--no-cache", "--tolerance-mask", "A.exr B.exr", "gather",
         "--eye"},
        {"--rays", "--seed", "--solver", "2e-6", "2^-20", "--kernel", "Exit status 1", "--fov"},
    };
    cli *c = *state;
    for (int i = 0; i < 2; i++) {
        cli_run(c, "%s --help", i ? "verify" : "compare");
        cli_expect(c, 0);
        for (int k = 0; k < 8; k++)
            if (!strstr(c->out, told[i][k])) fail_msg("no \"%s\" in the help of %d", told[i][k], i);
    }
    cli_run(c, "--help");
    assert_non_null(strstr(c->out, "  compare "));
    assert_non_null(strstr(c->out, "  verify "));
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(wrong_usage_is_refused),
        TEST(a_folder_of_something_else_is_refused_before_any_work),
        TEST(missing_images_are_named),
        TEST(help_tells_every_option),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
