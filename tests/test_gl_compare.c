/* The program comparing and verifying: files, figures, exit statuses, on a scene where the models of the
 * field fail and `exact` does not. */
#include "compare/run.h"
#include "support/cli.h"
#include "support/gl_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#define SCENE "mixed:300 --size 64x48"

static const char *backend(void)
{
    const char *name = getenv("MNS_TEST_BACKEND");
    return name ? name : "auto";
}

static int setup(void **state)
{
    cli *c = malloc(sizeof *c);
    assert_non_null(c);
    cli_setup(c, MNS_PROGRAM);
    char cache[80];
    snprintf(cache, sizeof cache, "%s/cache", c->folder);
    setenv("XDG_CACHE_HOME", cache, 1);
    *state = c;
    return 0;
}

static int teardown(void **state)
{
    cli_teardown(*state);
    free(*state);
    return 0;
}

static json_t *load(const cli *c, const char *name)
{
    size_t size;
    char *text = cli_read(c, name, &size);
    json_t *root = json_loads(text, 0, NULL);
    free(text);
    assert_non_null(root);
    return root;
}

static long long integer_at(const json_t *run, const char *key)
{
    return json_integer_value(json_object_get(json_object_get(run, "errors"), key));
}

static double t_at(const json_t *run, const char *key)
{
    return json_real_value(json_object_get(json_object_get(json_object_get(run, "errors"), "t"), key));
}

/* ---- verify ---- */

static void verify_passes_what_is_exact(void **state)
{
    cli *c = *state;
    cli_run(c, "verify " SCENE " --backend %s", backend());
    cli_expect(c, 0);
    assert_string_equal(c->err, "");
    assert_non_null(strstr(c->out, "1000 pixels, "));
    assert_non_null(strstr(c->out, " 0 disagree (0 missed, 0 invented, 0 off)"));
    assert_non_null(strstr(c->out, "worst: pixel "));
}

static void verify_fails_what_is_not(void **state)
{
    cli *c = *state;
    cli_run(c, "verify " SCENE " --solver cubic --backend %s", backend());
    cli_expect(c, 1);
    assert_non_null(strstr(c->err, "meniscus: mixed:300: "));
    assert_non_null(strstr(c->err, "of 1000 pixels disagree with the truth\n"));
    assert_null(strstr(c->out, " 0 disagree"));
}

static void verify_takes_every_pixel_of_a_small_frame(void **state)
{
    cli *c = *state;
    cli_run(c, "verify mixed:300 --size 20x10 --rays 5000 --backend %s", backend());
    cli_expect(c, 0);
    assert_non_null(strstr(c->out, "\n200 pixels, "));
}

static void verify_draws_other_pixels_by_another_seed(void **state)
{
    cli *c = *state;
    char first[sizeof c->out];
    cli_run(c, "verify " SCENE " --rays 200 --backend %s", backend());
    memcpy(first, c->out, sizeof first);
    cli_run(c, "verify " SCENE " --rays 200 --backend %s", backend());
    assert_string_equal(c->out, first);
    cli_run(c, "verify " SCENE " --rays 200 --seed 1 --backend %s", backend());
    cli_expect(c, 0);
    assert_string_not_equal(c->out, first);
}

static void verify_agrees_that_nothing_is_seen(void **state)
{
    cli *c = *state;
    cli_run(c, "verify mixed:10 --eye 0,0,50 --look-at 0,0,90 --size 8x8 --rays 10 --backend %s", backend());
    cli_expect(c, 0);
    assert_non_null(strstr(c->out, "10 pixels, 0 hits: 10 agree"));
    assert_null(strstr(c->out, "worst"));
}

/* ---- compare ---- */

static void compare_writes_every_method_of_the_build(void **state)
{
    cli *c = *state;
    cli_run(c, "compare " SCENE " -o out --backend %s", backend());
    cli_expect(c, 0);
    static const char *const files[] = {"out/results.csv", "out/results.json", "out/index.html",
                                        "out/chart.dat", "out/chart.gp"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (!cli_exists(c, files[i])) fail_msg("no %s", files[i]);
    json_t *root = load(c, "out/results.json"), *runs = json_object_get(root, "runs");
    run_spec *wanted;
    size_t count;
    mns_error error;
    assert_int_equal(run_parse(NULL, &wanted, &count, &error), MNS_OK);
    free(wanted);
    assert_int_equal(json_array_size(runs), count);
    const json_t *exact = json_array_get(runs, 0), *cubic = json_array_get(runs, 1);
    assert_string_equal(json_string_value(json_object_get(exact, "name")), "list:exact");
    assert_int_equal(json_integer_value(json_object_get(exact, "frames")), 5);
    assert_int_equal(integer_at(exact, "pixels"), 64 * 48);
    assert_true(integer_at(exact, "hits") > 300);
    assert_int_equal(integer_at(exact, "missed_decided"), 0);
    assert_int_equal(integer_at(exact, "invented_decided"), 0);
    assert_int_equal(integer_at(exact, "wrong_root"), 0);
    assert_true(t_at(exact, "p99") > 0 && t_at(exact, "p99") < 2e-6);
    assert_true(integer_at(cubic, "wrong_root") > 0 && t_at(cubic, "p99") > 1e-4);
    const json_t *residual = json_object_get(json_object_get(exact, "errors"), "residual");
    double off = json_real_value(json_object_get(residual, "median"));
    assert_true(off > 0 && off < 1e-4);
    assert_true(json_real_value(json_object_get(json_object_get(exact, "errors"), "psnr")) > 60);
    const json_t *ms = json_object_get(exact, "ms");
    double least = json_real_value(json_object_get(ms, "min")),
           most = json_real_value(json_object_get(ms, "max"));
    double median = json_real_value(json_object_get(ms, "median"));
    assert_true(least > 0 && least <= median && median <= most);
    assert_true(json_real_value(json_object_get(json_object_get(ms, "phases"), "cast")) > 0);
    assert_int_equal(integer_at(exact, "hits"),
                     json_integer_value(json_object_get(json_object_get(root, "truth"), "hits")));
    assert_int_equal(
        strncmp(json_string_value(json_object_get(root, "command")), "meniscus compare mixed:300 ", 27), 0);
    json_decref(root);
}

static void compare_takes_the_truth_from_the_cache_the_second_time(void **state)
{
    cli *c = *state;
    cli_run(c, "compare " SCENE " -o out --runs list:exact --backend %s", backend());
    cli_expect(c, 0);
    assert_null(strstr(c->out, "kept from an earlier time"));
    cli_run(c, "compare " SCENE " -o out --runs list:cubic:gather=paper --frames 6 --backend %s", backend());
    cli_expect(c, 0);
    assert_non_null(strstr(c->out, "kept from an earlier time"));
    json_t *root = load(c, "out/results.json"), *run = json_array_get(json_object_get(root, "runs"), 0);
    assert_true(json_is_true(json_object_get(json_object_get(root, "truth"), "cached")));
    assert_int_equal(json_array_size(json_object_get(root, "runs")), 1); /* the first result is replaced */
    assert_int_equal(json_integer_value(json_object_get(run, "frames")), 6);
    assert_string_equal(json_string_value(json_object_get(json_object_get(run, "settings"), "gather")),
                        "paper");
    json_decref(root);
    assert_int_equal(cli_count_files(c), 2); /* out, cache */
}

static void compare_of_the_reference_finds_nothing(void **state)
{
    cli *c = *state;
    cli_run(c, "compare " SCENE " -o out --runs reference:exact --no-cache --backend %s", backend());
    cli_expect(c, 0);
    json_t *root = load(c, "out/results.json"), *run = json_array_get(json_object_get(root, "runs"), 0);
    assert_true(t_at(run, "max") < 1e-13); /* t and its low word */
    assert_true(json_real_value(json_object_get(json_object_get(run, "errors"), "psnr")) == 200);
    assert_false(cli_exists(c, "cache/meniscus"));
    json_decref(root);
}

/* ---- Two saved images ---- */

static void saved_images_are_told_apart_by_their_tolerances(void **state)
{
    cli *c = *state;
    cli_run(c, "render " SCENE " -o truth.exr --method reference --backend %s", backend());
    cli_expect(c, 0);
    cli_run(c, "render " SCENE " -o exact.exr --backend %s", backend());
    cli_expect(c, 0);
    cli_run(c, "render " SCENE " -o cubic.exr --solver cubic --backend %s", backend());
    cli_expect(c, 0);
    cli_run(c, "compare truth.exr exact.exr");
    cli_expect(c, 0);
    assert_int_equal(strncmp(c->out, "exact.exr: ", 11), 0);
    assert_non_null(strstr(c->out, " 0 missed, 0 invented, 0 wrong root, 0 undecided, t p99 "));
    cli_run(c, "compare truth.exr cubic.exr -o out");
    cli_expect(c, 1);
    assert_non_null(strstr(c->err, "meniscus: cubic.exr: "));
    assert_true(cli_exists(c, "out/index.html")); /* a failure leaves its page */
    cli_run(c, "compare truth.exr cubic.exr --tolerance-mask 3072 --tolerance-t 1 --tolerance-normal 180");
    cli_expect(c, 0);
    cli_run(c, "compare truth.exr exact.exr --tolerance-t 0");
    cli_expect(c, 1);
    assert_non_null(strstr(c->err, "t is off by "));
}

static void saved_images_of_two_sizes_are_refused(void **state)
{
    cli *c = *state;
    cli_run(c, "render mixed:10 --size 8x8 -o a.exr --backend %s", backend());
    cli_run(c, "render mixed:10 --size 8x9 -o b.exr --backend %s", backend());
    cli_run(c, "compare a.exr b.exr");
    cli_expect_error(c, 1, "a.exr is 8x8, b.exr is 8x9: expected the same size");
}

int main(void)
{
    char shaders[] = "/tmp/meniscus-shaders-XXXXXX";
    gl_fixture probe = {0}; /* skips where there is no such back end */
    gl_fixture_begin(&probe);
    gl_fixture_end(&probe);
    if (!mkdtemp(shaders)) return 1;
    setenv("MESA_SHADER_CACHE_DIR", shaders, 1); /* it lies in XDG_CACHE_HOME otherwise, anew for each test */
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(verify_passes_what_is_exact),
        TEST(verify_fails_what_is_not),
        TEST(verify_takes_every_pixel_of_a_small_frame),
        TEST(verify_draws_other_pixels_by_another_seed),
        TEST(verify_agrees_that_nothing_is_seen),
        TEST(compare_writes_every_method_of_the_build),
        TEST(compare_takes_the_truth_from_the_cache_the_second_time),
        TEST(compare_of_the_reference_finds_nothing),
        TEST(saved_images_are_told_apart_by_their_tolerances),
        TEST(saved_images_of_two_sizes_are_refused),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    char command[80];
    snprintf(command, sizeof command, "rm -r '%s'", shaders);
    return system(command) ? 1 : failed;
}
