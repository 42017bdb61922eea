/* The program without a GL context: usage, failures, help, info, the plan. */
#include "support/cli.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

static int setup(void **state)
{
    cli *c = malloc(sizeof *c);
    assert_non_null(c);
    cli_setup(c, MNS_PROGRAM);
    cli_write(c, "two.csv", "x,y,z,r,speed\n0,0,0,1,3\n1,0,0,0.5,7\n");
    cli_write(c, "bare.csv", "0,0,0\n1,0,0\n3,0,0\n");
    *state = c;
    return 0;
}

static int teardown(void **state)
{
    cli_teardown(*state);
    free(*state);
    return 0;
}

/* What no command takes, and a word of what is said then. */
static const struct {
    const char *arguments, *word;
} wrong_usage[] = {
    {"", "no command"},
    {"draw", "unknown command draw"},
    {"--foo", "unknown option --foo"},
    {"render -o x.png", "no input"},
    {"render two.csv", "nothing to write"},
    {"render two.csv -o x.png --quux", "unknown option --quux; "},
    {"render two.csv -o x.png --sise 3x4", "unknown option --sise: expected --size; "},
    {"render two.csv -o x.png --methdo=list", "unknown option --methdo=list: expected --method; "},
    {"render two.csv -o x.png --shadows 8", "--shadows 8: expected --shadows=8, or ./8 "},
    {"render two.csv -o x.png --mesh box.obj:blu", "there is no such file, and blu is no opaque colour"},
    {"render two.csv -o x.png --mesh two.csv:blu", "there is no such file, and blu is no opaque colour"},
    {"render two.csv -o", "-o: expected a value"},
    {"render two.csv -o x.png --moving=1", "--moving: takes no value"},
    {"render two.csv -o x.jpg", "unknown ending"},
    {"render two.csv -o x", "unknown ending"},
    {"render two.csv -o x.png --aov y.png", "FILE.exr"},
    {"render two.csv -o x.exr --aov x.exr", "both x.exr"},
    {"render two.csv -o x.png --stats two.csv", "is an input"},
    {"render two.csv -o 'x%s.png'", "'%'"},
    {"render two.csv -o 'x%d%d.png'", "'%'"},
    {"render two.csv -o 'x%04i.png'", "'%'"},
    {"render two.csv -o 'x%.png'", "'%'"},
    {"render two.csv -o 'x%9999999999d.png'", "'%'"},
    {"render two.csv -o x.png --size 10", "--size 10: expected WxH"},
    {"render two.csv -o x.png --size 0x10", "expected WxH"},
    {"render two.csv -o x.png --size 65537x10", "expected WxH"},
    {"render two.csv -o x.png --eye 1,2", "--eye 1,2: expected X,Y,Z"},
    {"render two.csv -o x.png --eye 1,2,nan", "expected X,Y,Z"},
    {"render two.csv -o x.png --up 0,0,0", "--up 0,0,0"},
    {"render two.csv -o x.png --eye 1,2,3 --look-at 1,2,3", "eye and look-at"},
    {"render two.csv -o x.png --up 0,0,1", "up 0,0,1 lies along the view"},
    {"render two.csv -o x.png --fov 180", "--fov 180"},
    {"render two.csv -o x.png --kernel poly5", "--kernel poly5: expected one of poly2"},
    {"render two.csv -o x.png --iso 0", "--iso 0: expected a number above 0"},
    {"render two.csv -o x.png --iso -1", "--iso -1"},
    {"render two.csv -o x.png --radius 0", "--radius 0"},
    {"render two.csv -o x.png --radius-scale inf", "--radius-scale inf"},
    {"render two.csv -o x.png --method tile --gather paper", "tiles are not gathered"},
    {"render two.csv -o x.png --method fbvh --gather paper", "a tree is not gathered"},
    {"render two.csv -o x.png --method bvh --solver cubic", "take exact or secant"},
    {"render two.csv -o x.png --method bvh --tree no-fit,hurry", "\"hurry\": expected fbvh, bvh"},
    {"render two.csv -o x.png --method list --tree no-fit", "list builds no tree without rays beyond"},
    {"render two.csv -o x.png --method reference --tree no-fit", "reference has a tree of its own"},
    {"render two.csv -o x.png --method tile --counters", "only fbvh and bvh count"},
    {"render two.csv -o x.png --secant-steps 0", "--secant-steps 0"},
    {"render two.csv -o x.png --method reference --solver cubic", "reference has one solver: exact"},
    {"render two.csv -o x.png --look mud", "no preset \"mud\""},
    {"render two.csv -o x.png --light 0,0,0", "--light 0,0,0: expected head"},
    {"render two.csv -o x.png --mesh :1,0,0", "--mesh :1,0,0: expected FILE or FILE:COLOR"},
    {"render two.csv -o x.png --light point:1,2", "--light point:1,2: expected head"},
    {"render two.csv -o x.png --light area:1,2,3,0", "expected head"},
    {"render two.csv -o x.png --light head@0", "expected head"},
    {"render two.csv -o x.png --light head@1@#fff", "expected head"},
    {"render two.csv -o x.png --light head@1@#ffffff@2", "expected head"},
    {"render two.csv -o x.png --shadows=-1", "--shadows -1: expected a whole number"},
    {"render two.csv -o x.png --reflections 9", "--reflections 9: expected a whole number from 0 to 8"},
    {"render two.csv -o x.png --refractions 17", "from 0 to 16"},
    {"render two.csv -o x.png --mirror 1.5", "--mirror 1.5: expected a number from 0 to 1"},
    {"render two.csv -o x.png --transmission -1", "--transmission -1"},
    {"render two.csv -o x.png --index 0.5", "--index 0.5: expected a number from 1 to 100"},
    {"render two.csv -o x.png --absorption 1,2", "--absorption 1,2: expected R,G,B"},
    {"render two.csv -o x.png --blend-by ''", "--blend-by: expected the name of a column, or none"},
    {"render molecule:10 -o x.png --blend-by heat",
     "no column \"heat\" to blend materials by; the input has element"},
    {"render molecule:10 -o x.png --blend-by element", "column \"element\" holds labels"},
    {"render molecule:10 -o x.png --blend-mirror 0", "no column to blend it by"},
    {"render two.csv -o x.png --blend-range 2:1", "--blend-range 2:1: expected LO:HI"},
    {"render two.csv -o x.png --blend-color 1,1,1,0.5", "--blend-color 1,1,1,0.5: expected an opaque colour"},
    {"render two.csv -o x.png --blend-mirror 2", "--blend-mirror 2: expected a number from 0 to 1"},
    {"render two.csv -o x.png --blend-transmission x", "--blend-transmission x"},
    {"render two.csv -o x.png --blend-absorption -1,0,0", "--blend-absorption -1,0,0: expected R,G,B"},
    {"render two.csv -o x.png --occlusion 8:0", "--occlusion 0: expected a number above 0"},
    {"render two.csv -o x.png --occlusion :2", "--occlusion : expected a whole number"},
    {"render two.csv -o x.png --environment ''", "FILE.png or none"},
    {"render two.csv -o x.png --seed 4294967296", "--seed 4294967296"},
    {"render two.csv -o x.png --method foo", "expected one of auto list reference tile fbvh bvh"},
    {"render two.csv -o x.png --solver foo", "expected one of exact cubic cubic-monomial secant"},
    {"render two.csv -o x.png --gather foo", "expected one of early-z paper"},
    {"render two.csv -o x.png --backend foo", "expected one of auto egl osmesa glfw"},
    {"render two.csv -o x.png --aa 65", "from 1 to 64"},
    {"render two.csv -o x.png --shading foo", "expected one of smooth cel"},
    {"render two.csv -o x.png --cel-bands 0", "--cel-bands 0"},
    {"render two.csv -o x.png --light 0,0,0", "--light 0,0,0: expected head"},
    {"render two.csv -o x.png --color 2,0,0", "--color: colour \"2,0,0\""},
    {"render two.csv -o x.png --color transparent", "an opaque colour"},
    {"render two.csv -o x.png --color-map jet", "expected one of viridis"},
    {"render two.csv -o x.png --color-range 3:3", "--color-range 3:3"},
    {"render two.csv -o x.png --background '#12'", "--background: colour"},
    {"render two.csv -o x.png --ambient -1", "--ambient -1"},
    {"render two.csv -o x.png --shininess 0", "--shininess 0"},
    {"render two.csv -o x.png --threads 0", "--threads 0"},
    {"render two.csv -o x.png --repeat 0", "--repeat 0"},
    {"render two.csv -o x.png --repeat 3.5", "--repeat 3.5"},
    {"render two.csv -o x.png --frame 3:1", "--frame 3:1"},
    {"render two.csv -o x.png --frame 0:1:0", "--frame 0:1:0"},
    {"render two.csv -o x.png --frame 1", "--frame 1: the input has 1 frame"},
    {"render two.csv bare.csv -o x.png --frame 0:1", "one name for 2 frames"},
    {"render two.csv bare.csv --aov y.exr -o 'x%d.png'", "one name for 2 frames"},
    {"render a.json b.json -o x.png", "two scenes"},
    {"render nosuchgenerator:100 -o x.png", "nosuchgenerator"},
    {"info", "no input"},
    {"info --gl two.csv", "--gl"},
    {"info two.csv --frame 1", "--frame"},
};

static void wrong_usage_exits_2_with_one_line(void **state)
{
    cli *c = *state;
    for (size_t i = 0; i < sizeof wrong_usage / sizeof *wrong_usage; i++) {
        cli_run(c, "%s", wrong_usage[i].arguments);
        cli_expect_error(c, 2, wrong_usage[i].word);
        assert_int_equal(cli_count_files(c), 2);
    }
}

static void failures_exit_1_with_one_line_and_leave_nothing(void **state)
{
    cli *c = *state;
    cli_write(c, "bad.csv", "0,0,0\n1,nan,0\n");
    cli_write(c, "bad.json", "{\"light\": {\"knd\": 1}}");
    cli_write(c, "broken.json", "{\n \"size\": [1,\n");
    static const struct {
        const char *arguments, *word;
    } failing[] = {
        {"render absent.csv -o x.png", "absent.csv"},
        {"render bad.csv -o x.png --stats s.json --aov x.exr", "bad.csv"},
        {"render bad.json -o x.png", "bad.json: light.knd: unknown key"},
        {"render broken.json -o x.png", "broken.json:"},
        {"render absent.json -o x.png", "absent.json: cannot open"},
        {"render two.csv -o nowhere/x.png", "nowhere/"},
        {"render two.csv -o x.png --stats nowhere/s.json", "nowhere/"},
        {"render two.csv -o x.png --aov nowhere/x.exr", "nowhere/"},
        {"render . -o x.png", "meniscus: "},
        {"info absent.csv", "absent.csv"},
        {"info bad.csv", "bad.csv"},
    };
    for (size_t i = 0; i < sizeof failing / sizeof *failing; i++) {
        cli_run(c, "%s", failing[i].arguments);
        cli_expect_error(c, 1, failing[i].word);
        assert_int_equal(cli_count_files(c), 5);
    }
}

static void control_bytes_in_a_name_do_not_break_the_line(void **state)
{
    cli *c = *state;
    cli_run(c, "render \"$(printf 'a\\nb\\033[2J')\" -o x.png");
    cli_expect_error(c, 1, "a?b?[2J");
}

static void a_folder_in_the_outputs_place_is_refused(void **state)
{
    cli *c = *state;
    cli_run(c, "--version; mkdir x.png; '%s' render two.csv -o x.png", c->program);
    cli_expect(c, 1);
    assert_non_null(strstr(c->err, "x.png: is not a regular file"));
}

static void version_and_help_are_printed(void **state)
{
    cli *c = *state;
    cli_run(c, "--version");
    cli_expect(c, 0);
    assert_int_equal(strncmp(c->out, "meniscus 0.1.0", 14), 0);
    cli_run(c, "--help");
    cli_expect(c, 0);
    assert_non_null(strstr(c->out, "render"));
    assert_non_null(strstr(c->out, "info"));
    assert_string_equal(c->err, "");
}

static void help_of_render_lists_every_option(void **state)
{
    static const char *const option[] = {
        "-o, --output=FILE",
        "--size=WxH",
        "--eye=X,Y,Z",
        "--look-at=X,Y,Z",
        "--up=X,Y,Z",
        "--fov=DEG",
        "--kernel=NAME",
        "--iso=L",
        "--radius=R",
        "--radius-scale=S",
        "--method=NAME",
        "--solver=NAME",
        "--backend=NAME",
        "--aov=FILE.exr",
        "--stats=FILE.json",
        "--repeat=N",
        "--moving",
        "--frame=A[:B[:STEP]]",
        "--explain",
        "--gather=NAME",
        "--aa=N",
        "--shading=NAME",
        "--cel-bands=N",
        "--light=SPEC",
        "--mesh=FILE",
        "--look=NAME",
        "--shadows[=N]",
        "--reflections=N",
        "--refractions=N",
        "--mirror=X",
        "--index=X",
        "--transmission=X",
        "--absorption=R,G,B",
        "--occlusion=N[:REACH]",
        "--environment=sky|FILE",
        "--seed=N",
        "--blend-by=NAME",
        "--blend-range=LO:HI",
        "--blend-color=COLOR",
        "--blend-mirror=X",
        "--blend-transmission=X",
        "--blend-absorption=R,G,B",
        "--color=COLOR",
        "--color-by=NAME",
        "--color-map=NAME",
        "--color-range=LO:HI",
        "--background=COLOR",
        "--ambient=X",
        "--diffuse=X",
        "--specular=X",
        "--shininess=X",
        "--threads=N",
        "--pool=N",
        "--slots=N",
        "--root-steps=N",
        "--shuffle=SEED",
    };
    cli *c = *state;
    cli_run(c, "render --help");
    cli_expect(c, 0);
    for (size_t i = 0; i < sizeof option / sizeof *option; i++)
        if (!strstr(c->out, option[i])) fail_msg("%s is not in the help", option[i]);
    cli_run(c, "info --help");
    cli_expect(c, 0);
    assert_non_null(strstr(c->out, "--gl"));
    assert_non_null(strstr(c->out, "--json"));
}

static void expect_lines(const cli *c, const char *const *line, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!strstr(c->out, line[i])) fail_msg("no line \"%s\" in:\n%s", line[i], c->out);
}

static void info_says_what_was_read(void **state)
{
    cli *c = *state;
    static const char *const line[] = {
        "format: csv\n",
        "frames: 1 (this is 0)\n",
        "particles: 2\n",
        "box of the centres: x 0 to 1, y 0 to 0, z 0 to 0\n",
        "box of the effective spheres: x -1 to 1.5, y -1 to 1, z -1 to 1\n",
        "radii: 0.5 to 1, median ",
        "strengths: 1 (none in the input)\n",
        "kernel: poly3\nlevel: 0.2\n",
        "columns: 1\n  speed: 3 to 7\n",
        "rows skipped: 0\n",
    };
    cli_run(c, "info two.csv");
    cli_expect(c, 0);
    expect_lines(c, line, sizeof line / sizeof *line);
    static const char *const other[] = {"radii: 2 (option)\n", "kernel: wyvill\nlevel: 0.5\n",
                                        "frames: 2 (this is 1)\n", "particles: 3\n"};
    cli_run(c, "info two.csv bare.csv --frame 1 --kernel wyvill --iso 0.5 --radius 2");
    cli_expect(c, 0);
    expect_lines(c, other, sizeof other / sizeof *other);
}

static void info_of_a_scene_and_of_a_generator(void **state)
{
    cli *c = *state;
    cli_write(c, "s.json", "{\"input\": \"two.csv\", \"field\": {\"kernel\": \"poly2\", \"iso\": 0.3}}");
    cli_run(c, "info s.json --iso 0.4");
    cli_expect(c, 0);
    static const char *const line[] = {"particles: 2\n", "kernel: poly2\nlevel: 0.4\n"};
    expect_lines(c, line, 2);
    cli_run(c, "info s.json bare.csv");
    cli_expect(c, 0);
    assert_non_null(strstr(c->out, "particles: 3\n"));
    cli_run(c, "info tornado:100:1:5");
    cli_expect(c, 0);
    static const char *const generated[] = {"format: generator\n", "frames: 5 (this is 0)\n",
                                            "particles: 100\n"};
    expect_lines(c, generated, 3);
}

static void info_as_json_can_be_parsed(void **state)
{
    cli *c = *state;
    cli_run(c, "info two.csv --json");
    cli_expect(c, 0);
    json_t *root = json_loads(c->out, 0, NULL), *columns = json_object_get(root, "columns");
    assert_string_equal(json_string_value(json_object_get(root, "format")), "csv");
    assert_int_equal(json_integer_value(json_object_get(root, "particles")), 2);
    assert_int_equal(json_integer_value(json_object_get(root, "frames")), 1);
    assert_true(json_number_value(json_object_get(json_object_get(root, "radii"), "min")) == 0.5);
    assert_string_equal(json_string_value(json_object_get(json_object_get(root, "radii"), "source")), "file");
    json_t *range = json_object_get(json_array_get(columns, 0), "range");
    assert_true(json_number_value(json_array_get(range, 0)) == 3 &&
                json_number_value(json_array_get(range, 1)) == 7);
    assert_true(json_is_null(json_object_get(root, "cell")));
    json_decref(root);
}

static void info_gl_names_every_back_end(void **state)
{
    cli *c = *state;
    cli_run(c, "info --gl");
    cli_expect(c, 0);
    static const char *const word[] = {"egl", "osmesa", "glfw"};
    expect_lines(c, word, 3);
}

static void full_disk_behind_standard_output_is_a_failure(void **state)
{
    cli *c = *state;
    cli_run(c, "info two.csv >/dev/full");
    cli_expect_error(c, 1, "standard output");
}

static void explain_prints_the_plan_and_draws_nothing(void **state)
{
    cli *c = *state;
    cli_run(c, "render two.csv -o x.png --stats s.json --explain");
    cli_expect(c, 0);
    assert_int_equal(strncmp(c->out, "limits: ", 8), 0);
    assert_non_null(strstr(c->out, "gather"));
    assert_int_equal(cli_count_files(c), 2);
    cli_run(c, "render two.csv --explain --eye 1,2,3 --look-at 1,2,3");
    cli_expect_error(c, 2, "eye and look-at");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(wrong_usage_exits_2_with_one_line, setup, teardown),
        cmocka_unit_test_setup_teardown(failures_exit_1_with_one_line_and_leave_nothing, setup, teardown),
        cmocka_unit_test_setup_teardown(control_bytes_in_a_name_do_not_break_the_line, setup, teardown),
        cmocka_unit_test_setup_teardown(a_folder_in_the_outputs_place_is_refused, setup, teardown),
        cmocka_unit_test_setup_teardown(version_and_help_are_printed, setup, teardown),
        cmocka_unit_test_setup_teardown(help_of_render_lists_every_option, setup, teardown),
        cmocka_unit_test_setup_teardown(info_says_what_was_read, setup, teardown),
        cmocka_unit_test_setup_teardown(info_of_a_scene_and_of_a_generator, setup, teardown),
        cmocka_unit_test_setup_teardown(info_as_json_can_be_parsed, setup, teardown),
        cmocka_unit_test_setup_teardown(info_gl_names_every_back_end, setup, teardown),
        cmocka_unit_test_setup_teardown(full_disk_behind_standard_output_is_a_failure, setup, teardown),
        cmocka_unit_test_setup_teardown(explain_prints_the_plan_and_draws_nothing, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
