/* The program drawing: files, the line of each, statistics, sequences, scenes. */
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
    cli_write(c, "two.csv", "x,y,z,r,speed\n0,0,0,1,3\n1,0,0,0.5,7\n");
    cli_write(c, "bare.csv", "0,0,0\n1,0,0\n2,0,0\n");
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

/* The object holds exactly these keys, each a number of 0 or more. */
static void expect_numbers(const json_t *object, const char *const *key, size_t count)
{
    assert_int_equal(json_object_size(object), count);
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_object_get(object, key[i]);
        if (!json_is_number(value) || json_number_value(value) < 0)
            fail_msg("%s is no number of 0 or more", key[i]);
    }
}

static const char *const PHASE[] = {"load",    "sort",  "bin",      "upload", "core_depth",
                                    "gather",  "build", "cast",     "normal", "trace",
                                    "effects", "shade", "readback", "encode", "total"};

static void expect_text(const json_t *root, const char *key, const char *expected)
{
    const char *text = json_string_value(json_object_get(root, key));
    if (!text || !*text) fail_msg("%s is no text", key);
    if (expected) assert_string_equal(text, expected);
}

static void one_frame_prints_one_line_and_writes_its_files(void **state)
{
    cli *c = *state;
    cli_run(c, "render two.csv -o x.png --aov x.exr --size 40x30 --method list --backend %s", backend());
    cli_expect(c, 0);
    assert_int_equal(strncmp(c->out, "x.png: 40x30, 2 particles, list, exact, ", 40), 0);
    assert_string_equal(c->out + strlen(c->out) - 4, " ms\n");
    assert_ptr_equal(strchr(c->out, '\n'), c->out + strlen(c->out) - 1);
    assert_string_equal(c->err, "");
    assert_int_equal(cli_count_files(c), 4);
    size_t size;
    char *png = cli_read(c, "x.png", &size), *exr = cli_read(c, "x.exr", &size);
    assert_memory_equal(png, "\x89PNG", 4);
    assert_memory_equal(exr, "\x76\x2f\x31\x01", 4);
    free(png);
    free(exr);
}

static void statistics_hold_every_key_of_the_design(void **state)
{
    static const char *const count_key[] = {
        "balls",        "balls_in_view",     "pixels",     "pixels_hit",     "pixels_undecided",
        "effects_rays", "effects_undecided", "list_nodes", "tiles",          "passes",
        "programs",     "programs_kept",     "buffers",    "driver_messages"};
    static const char *const list_key[] = {"mean", "p99", "max"};
    static const char *const fallback_key[] = {"pool_grown",      "tiled",    "lists_sorted",
                                               "active_overflow", "root_cap", "undecided_float"};
    static const char *const memory_key[] = {"peak_rss_bytes"};
    static const char *const noise_key[] = {"shadow", "occlusion"};
    cli *c = *state;
    cli_run(c,
            "render two.csv -o x.png --size 40x30 --method list --stats s.json --backend %s --solver cubic",
            backend());
    cli_expect(c, 0);
    json_t *root = load(c, "s.json");
    assert_int_equal(json_integer_value(json_object_get(root, "schema")), 1);
    expect_text(root, "method", "list");
    expect_text(root, "method_reason", "asked for");
    expect_text(root, "solver", "cubic");
    expect_text(root, "renderer", NULL);
    expect_numbers(json_object_get(root, "ms"), PHASE, sizeof PHASE / sizeof *PHASE);
    json_t *counts = json_object_get(root, "counts");
    expect_numbers(counts, count_key, sizeof count_key / sizeof *count_key);
    expect_numbers(json_object_get(root, "lists"), list_key, 3);
    expect_numbers(json_object_get(root, "memory"), memory_key, 1);
    expect_numbers(json_object_get(root, "fallbacks"), fallback_key, 6);
    expect_numbers(json_object_get(root, "noise"), noise_key, 2);
    assert_true(json_number_value(json_object_get(json_object_get(root, "memory"), "peak_rss_bytes")) > 1e6);
    assert_true(json_number_value(json_object_get(json_object_get(root, "ms"), "total")) > 0);
    assert_int_equal(json_integer_value(json_object_get(counts, "balls")), 2);
    assert_int_equal(json_integer_value(json_object_get(counts, "pixels")), 1200);
    assert_int_equal(json_integer_value(json_object_get(counts, "driver_messages")), 0);
    assert_true(json_integer_value(json_object_get(counts, "pixels_hit")) > 100);
    json_t *left_out = json_object_get(root, "left_out"), *part;
    assert_true(json_array_size(left_out) > 0);
    size_t i;
    json_array_foreach(left_out, i, part)
    {
        expect_text(part, "part", NULL);
        expect_text(part, "reason", NULL);
    }
    assert_true(json_is_null(json_object_get(root, "color")));
    assert_null(json_object_get(root, "frames"));
    assert_null(json_object_get(root, "repeat"));
    json_decref(root);
}

static void repeats_report_first_and_median(void **state)
{
    cli *c = *state;
    cli_run(c, "render two.csv -o x.png --size 40x30 --stats s.json --repeat 3 --moving --backend %s",
            backend());
    cli_expect(c, 0);
    assert_non_null(strstr(c->out, "first "));
    assert_non_null(strstr(c->out, "median of 3 "));
    json_t *root = load(c, "s.json"), *repeat = json_object_get(root, "repeat");
    assert_int_equal(json_integer_value(json_object_get(repeat, "n")), 3);
    static const char *const which[] = {"first", "median"};
    for (size_t i = 0; i < 2; i++) {
        json_t *ms = json_object_get(json_object_get(repeat, which[i]), "ms");
        expect_numbers(ms, PHASE, sizeof PHASE / sizeof *PHASE);
        assert_true(json_number_value(json_object_get(ms, "total")) > 0);
    }
    json_decref(root);
}

static void colors_by_a_column_come_with_a_legend(void **state)
{
    cli *c = *state;
    cli_run(c, "render two.csv --stats s.json --size 40x30 --color-by speed --color-map magma --backend %s",
            backend());
    cli_expect(c, 0);
    json_t *root = load(c, "s.json"), *color = json_object_get(root, "color"),
           *range = json_object_get(color, "range");
    expect_text(color, "by", "speed");
    expect_text(color, "map", "magma");
    assert_true(json_number_value(json_array_get(range, 0)) == 3 &&
                json_number_value(json_array_get(range, 1)) == 7);
    json_decref(root);
    cli_run(c, "render two.csv -o x.png --color-by mass --size 40x30 --backend %s", backend());
    cli_expect_error(c, 2, "mass");
    assert_false(cli_exists(c, "x.png"));
}

static void sequences_are_numbered_by_the_inputs_index(void **state)
{
    cli *c = *state;
    cli_run(c, "render drop:200:1:6 -o 'f.%%04d.png' --frame 1:5:2 --size 16x12 --stats s.json --backend %s",
            backend());
    cli_expect(c, 0);
    assert_true(cli_exists(c, "f.0001.png") && cli_exists(c, "f.0003.png") && cli_exists(c, "f.0005.png"));
    assert_int_equal(cli_count_files(c), 6);
    assert_null(strchr(c->err, '\r'));
    json_t *root = load(c, "s.json"), *frames = json_object_get(root, "frames");
    assert_int_equal(json_array_size(frames), 3);
    assert_int_equal(json_integer_value(json_object_get(json_array_get(frames, 1), "frame")), 3);
    assert_int_equal(json_integer_value(json_object_get(root, "frame")), 5);
    json_decref(root);
    /* without --frame a numbered name means all of them, and a plain one the first */
    cli_run(c, "render two.csv two.csv -o 'g%%d.png' --size 16x12 --backend %s", backend());
    cli_expect(c, 0);
    assert_true(cli_exists(c, "g0.png") && cli_exists(c, "g1.png"));
    cli_run(c, "render two.csv two.csv -o h.png --size 16x12 --backend %s", backend());
    cli_expect(c, 0);
    assert_true(cli_exists(c, "h.png"));
    assert_int_equal(cli_count_files(c), 9);
}

static void a_frame_is_the_same_picture_in_whatever_run(void **state)
{
    cli *c = *state;
    cli_write(c, "moved.csv", "x,y,z,r,speed\n0.5,0,0,1,1\n1,1,0,0.5,4\n");
    const char *look = "--size 32x24 --color-by speed";
    cli_run(c, "render two.csv moved.csv -o 'all%%d.png' %s --backend %s", look, backend());
    cli_expect(c, 0);
    cli_run(c, "render two.csv moved.csv -o one.png --frame 1 %s --backend %s", look, backend());
    cli_expect(c, 0);
    cli_run(c, "render moved.csv -o alone.png %s --backend %s", look, backend());
    cli_expect(c, 0);
    size_t size[3];
    char *all = cli_read(c, "all1.png", &size[0]), *one = cli_read(c, "one.png", &size[1]);
    char *alone = cli_read(c, "alone.png", &size[2]);
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(all, one, size[0]);
    assert_true(size[2] != size[0] || memcmp(all, alone, size[0]) != 0);
    free(all);
    free(one);
    free(alone);
}

static void scenes_are_drawn_and_options_prevail(void **state)
{
    cli *c = *state;
    cli_write(c, "s.json",
              "{\"input\": \"two.csv\", \"size\": [20, 10], \"material\": {\"color_by\": \"speed\", "
              "\"range\": [0, 10]}, \"background\": \"transparent\"}");
    cli_run(c, "render s.json -o x.png --stats t.json --backend %s", backend());
    cli_expect(c, 0);
    assert_int_equal(strncmp(c->out, "x.png: 20x10, 2 particles", 25), 0);
    json_t *root = load(c, "t.json"), *range = json_object_get(json_object_get(root, "color"), "range");
    assert_true(json_number_value(json_array_get(range, 1)) == 10);
    json_decref(root);
    cli_run(c, "render s.json -o x.png --size 30x20 --color 1,0,0 --stats t.json --backend %s", backend());
    cli_expect(c, 0);
    assert_int_equal(strncmp(c->out, "x.png: 30x20, 2 particles", 25), 0);
    root = load(c, "t.json");
    assert_true(json_is_null(json_object_get(root, "color")));
    json_decref(root);
}

/* speed is 3 and 7, r 1 and 0.5: within the scene's range no ball would have any of the second material by r.
 */
static void a_scenes_blend_range_is_its_own_columns(void **state)
{
    cli *c = *state;
    cli_write(c, "both.csv", "x,y,z,radius,speed,clay\n0,0,0,1,3,0\n1,0,0,1,7,1\n");
    cli_write(
        c, "s.json",
        "{\"input\": \"both.csv\", \"size\": [24, 16], \"blend\": {\"by\": \"speed\", \"range\": [2, 8], "
        "\"color\": \"#ff0000\"}}");
    cli_run(c, "render s.json -o own.png --blend-by clay --backend %s", backend());
    cli_expect(c, 0);
    cli_run(c, "render s.json -o same.png --blend-range 0:1 --blend-by clay --backend %s", backend());
    cli_expect(c, 0);
    cli_run(c, "render s.json -o other.png --blend-range 2:8 --blend-by clay --backend %s", backend());
    cli_expect(c, 0);
    size_t size[3];
    char *own = cli_read(c, "own.png", &size[0]), *same = cli_read(c, "same.png", &size[1]);
    char *other = cli_read(c, "other.png", &size[2]);
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(own, same, size[0]);
    assert_true(size[2] != size[0] || memcmp(own, other, size[0]) != 0);
    free(own);
    free(same);
    free(other);
}

static void what_comes_to_nothing_is_noted(void **state)
{
    cli *c = *state;
    static const struct {
        const char *options, *note;
    } noted[] = {{"--shadows", "meniscus: note: no shadows: a light at the eye casts none"},
                 {"--iso 50", "meniscus: note: no pixel sees the surface"},
                 {"--light 1,1,1 --shadows", NULL}};
    for (size_t i = 0; i < sizeof noted / sizeof *noted; i++) {
        cli_run(c, "render two.csv -o x.png --size 40x30 --radius 2 %s --backend %s", noted[i].options,
                backend());
        cli_expect(c, 0);
        if (noted[i].note)
            assert_non_null(strstr(c->err, noted[i].note));
        else
            assert_null(strstr(c->err, "note:"));
    }
}

static void guessed_radii_are_noted(void **state)
{
    cli *c = *state;
    cli_run(c, "render bare.csv -o x.png --size 16x12 --backend %s", backend());
    cli_expect(c, 0);
    assert_non_null(strstr(c->err, "meniscus: note: bare.csv: no radii in it; each is 2,"));
    cli_run(c, "render bare.csv -o x.png --size 16x12 --radius 1 --backend %s", backend());
    cli_expect(c, 0);
    assert_string_equal(c->err, "");
    /* of a sequence every frame's are its own; nothing is said where they are given */
    cli_run(c, "render bare.csv bare.csv -o x.%%d.png --size 16x12 --backend %s", backend());
    cli_expect(c, 0);
    assert_non_null(strstr(c->err, "every frame has the radius of its own spacing"));
    cli_run(c, "render two.csv two.csv -o x.%%d.png --size 16x12 --backend %s", backend());
    cli_expect(c, 0);
    assert_string_equal(c->err, "");
}

static void a_frame_that_fails_leaves_the_ones_before_it_whole(void **state)
{
    cli *c = *state;
    cli_write(c, "bad.csv", "x,y,z,r,speed\n0,0,0,1,nan\n");
    cli_run(c, "render two.csv bad.csv -o 'f%%d.png' --stats s.json --size 16x12 --backend %s", backend());
    cli_expect(c, 1);
    assert_non_null(strstr(c->err, "bad.csv"));
    assert_false(cli_exists(c, "f1.png") || cli_exists(c, "s.json"));
    assert_true(cli_count_files(c) == 3 || (cli_count_files(c) == 4 && cli_exists(c, "f0.png")));
}

static void a_terminal_gets_a_progress_line(void **state)
{
    cli *c = *state;
    cli_run(
        c,
        "--version; script -qec \"'%s' render two.csv two.csv -o 'p%%d.png' --size 16x12 --backend %s\" log",
        c->program, backend());
    cli_expect(c, 0);
    size_t size;
    char *text = cli_read(c, "log", &size);
    assert_non_null(strstr(text, "\rframe 0/2"));
    assert_non_null(strstr(text, "\rframe 2/2, "));
    assert_non_null(strstr(text, " a second, 0:00:00 left"));
    free(text);
}

/* Ends the program with 77 where the back end starts no context. */
static void skip_without_context(void)
{
    gl_fixture fixture = {0};
    gl_fixture_begin(&fixture);
    gl_fixture_end(&fixture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(one_frame_prints_one_line_and_writes_its_files, setup, teardown),
        cmocka_unit_test_setup_teardown(statistics_hold_every_key_of_the_design, setup, teardown),
        cmocka_unit_test_setup_teardown(repeats_report_first_and_median, setup, teardown),
        cmocka_unit_test_setup_teardown(colors_by_a_column_come_with_a_legend, setup, teardown),
        cmocka_unit_test_setup_teardown(sequences_are_numbered_by_the_inputs_index, setup, teardown),
        cmocka_unit_test_setup_teardown(a_frame_is_the_same_picture_in_whatever_run, setup, teardown),
        cmocka_unit_test_setup_teardown(scenes_are_drawn_and_options_prevail, setup, teardown),
        cmocka_unit_test_setup_teardown(a_scenes_blend_range_is_its_own_columns, setup, teardown),
        cmocka_unit_test_setup_teardown(guessed_radii_are_noted, setup, teardown),
        cmocka_unit_test_setup_teardown(what_comes_to_nothing_is_noted, setup, teardown),
        cmocka_unit_test_setup_teardown(a_frame_that_fails_leaves_the_ones_before_it_whole, setup, teardown),
        cmocka_unit_test_setup_teardown(a_terminal_gets_a_progress_line, setup, teardown),
    };
    skip_without_context();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
