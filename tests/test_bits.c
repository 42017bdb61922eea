/* The same input gives the same bits: over runs, over numbers of threads of the driver and of ours, and with
 * the lists in a random order. Files are compared byte for byte, so nothing of the day is in them either. */
#include "support/cli.h"
#include "support/gl_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* More balls than one thread culls and sorts alone, and rays enough for every tile of the driver's. */
static const char scene[] = "dense:6000";

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

static void render(cli *c, const char *options, const char *name)
{
    cli_run(c, "render %s --size 200x150 %s -o %s", scene, options, name);
    cli_expect(c, 0);
}

static void expect_same_file(const cli *c, const char *a, const char *b, const char *what)
{
    size_t size_a, size_b;
    char *bytes_a = cli_read(c, a, &size_a), *bytes_b = cli_read(c, b, &size_b);
    assert_true(size_a > 50000);
    if (size_a != size_b || memcmp(bytes_a, bytes_b, size_a) != 0) fail_msg("%s: the files differ", what);
    free(bytes_a);
    free(bytes_b);
}

static void ten_runs_write_the_same_file(void **state)
{
    cli *c = *state;
    render(c, "--method list", "first.exr");
    for (int run = 2; run <= 10; run++) {
        render(c, "--method list", "again.exr");
        expect_same_file(c, "first.exr", "again.exr", "another run");
    }
    render(c, "--method list", "a.png"); /* the smaller file holds no date either */
    render(c, "--method list", "b.png");
    size_t size;
    char *a = cli_read(c, "a.png", &size), *b = cli_read(c, "b.png", &size);
    assert_memory_equal(a, b, size);
    free(a);
    free(b);
}

static void any_number_of_threads_writes_the_same_file(void **state)
{
    cli *c = *state;
    static const char *const drivers[] = {"0", "1", "2"}, *const ours[] = {"1", "2", "3"};
    render(c, "--method list", "first.exr");
    for (size_t i = 0; i < 3; i++) {
        char what[64];
        snprintf(what, sizeof what, "LP_NUM_THREADS=%s OMP_NUM_THREADS=%s", drivers[i], ours[i]);
        assert_int_equal(setenv("LP_NUM_THREADS", drivers[i], 1) | setenv("OMP_NUM_THREADS", ours[i], 1), 0);
        render(c, "--method list", "again.exr");
        expect_same_file(c, "first.exr", "again.exr", what);
    }
    unsetenv("LP_NUM_THREADS");
    unsetenv("OMP_NUM_THREADS");
}

static void shuffled_lists_write_the_same_file(void **state)
{
    cli *c = *state;
    render(c, "--method list", "first.exr");
    render(c, "--method list --shuffle 1", "again.exr");
    expect_same_file(c, "first.exr", "again.exr", "--shuffle 1");
    assert_int_equal(setenv("LP_NUM_THREADS", "1", 1), 0);
    render(c, "--method list --shuffle 77", "again.exr");
    expect_same_file(c, "first.exr", "again.exr", "--shuffle 77");
    unsetenv("LP_NUM_THREADS");
}

/* The tiles' lists come from threads of ours, not of the driver. */
static void tiles_write_the_same_file_every_time(void **state)
{
    cli *c = *state;
    static const char *const drivers[] = {"0", "1", "2"}, *const ours[] = {"1", "2", "3"};
    render(c, "--method tile", "first.exr");
    for (int run = 2; run <= 10; run++) {
        char what[64];
        const char *driver = drivers[run % 3], *own = ours[run / 3 % 3];
        snprintf(what, sizeof what, "tile, LP_NUM_THREADS=%s OMP_NUM_THREADS=%s", driver, own);
        assert_int_equal(setenv("LP_NUM_THREADS", driver, 1) | setenv("OMP_NUM_THREADS", own, 1), 0);
        render(c, "--method tile", "again.exr");
        expect_same_file(c, "first.exr", "again.exr", what);
    }
    unsetenv("LP_NUM_THREADS");
    unsetenv("OMP_NUM_THREADS");
}

int main(void)
{
    gl_fixture fixture; /* ends the program where there is nothing to draw with */
    gl_fixture_begin(&fixture);
    gl_fixture_end(&fixture);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(ten_runs_write_the_same_file, setup, teardown),
        cmocka_unit_test_setup_teardown(any_number_of_threads_writes_the_same_file, setup, teardown),
        cmocka_unit_test_setup_teardown(tiles_write_the_same_file_every_time, setup, teardown),
        cmocka_unit_test_setup_teardown(shuffled_lists_write_the_same_file, setup, teardown),
    };
    return cmocka_run_group_tests_name("bits", tests, NULL, NULL);
}
