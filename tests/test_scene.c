/* Scene files: every key, and what is said of the wrong ones. */
#include "scene/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define FULL MNS_SOURCE_DIR "/tests/data/scene/full.json"

static mns_scene *parse(const char *text)
{
    mns_scene *scene = NULL;
    mns_error error;
    if (scene_parse(text, strlen(text), "dir/s.json", &scene, &error)) fail_msg("%s", error.text);
    return scene;
}

static void refuse(const char *text, mns_status status, const char *expected)
{
    mns_scene *scene = NULL;
    mns_error error = {0};
    assert_int_equal(scene_parse(text, strlen(text), "s.json", &scene, &error), status);
    assert_null(scene);
    assert_string_equal(error.text, expected);
}

static void near(double value, double expected)
{
    if (!(value > expected - 1e-12 && value < expected + 1e-12))
        fail_msg("%.17g, expected %.17g", value, expected);
}

static void near3(const double v[3], double x, double y, double z)
{
    near(v[0], x), near(v[1], y), near(v[2], z);
}

static void every_key_reaches_its_member(void **state)
{
    (void)state;
    mns_scene *s = NULL;
    mns_error error;
    if (mns_scene_load(FULL, &s, &error)) fail_msg("%s", error.text);
    assert_int_equal(s->field.kernel, MNS_KERNEL_WYVILL);
    near3((double[]){s->field.iso, s->field.radius, s->field.radius_scale}, 0.5, 2, 1.5);
    assert_int_equal(s->view.set, MNS_VIEW_EYE | MNS_VIEW_LOOK_AT);
    near3(s->view.eye, 1, 2, 3.5);
    near3(s->view.look_at, 0, -1, 0);
    near3(s->view.up, 0, 0, 1);
    near(s->view.fov, 30);
    assert_int_equal(s->view.width, 640);
    assert_int_equal(s->view.height, 480);
    const mns_look *look = &s->look;
    assert_int_equal(look->set, MNS_LOOK_COLOR | MNS_LOOK_BACKGROUND | MNS_LOOK_RANGE | MNS_LOOK_AMBIENT |
                                    MNS_LOOK_DIFFUSE | MNS_LOOK_SPECULAR | MNS_LOOK_LIGHT);
    assert_int_equal(look->light, MNS_LIGHT_DIRECTIONAL);
    near3(look->light_direction, 1, 1, 0);
    near3(look->color, 1, 128 / 255.0, 0);
    assert_string_equal(look->color_by, "speed");
    assert_int_equal(look->color_map, MNS_COLOR_MAP_MAGMA);
    near3((double[]){look->range[0], look->range[1], look->shininess}, -1, 4, 12);
    near3((double[]){look->ambient, look->diffuse, look->specular}, 0, 0.5, 0.75);
    assert_int_equal(look->shading, MNS_SHADING_CEL);
    assert_int_equal(look->cel_bands, 4);
    near3(look->background, 0.25, 0.5, 0.75);
    near(look->background[3], 0.5);
    mns_scene_destroy(s);
}

static void files_lie_beside_the_scene_and_generators_stay(void **state)
{
    (void)state;
    mns_scene *s = NULL;
    mns_error error;
    if (mns_scene_load(FULL, &s, &error)) fail_msg("%s", error.text);
    assert_int_equal(s->input_count, 4);
    assert_string_equal(s->inputs[0], MNS_SOURCE_DIR "/tests/data/scene/a.csv");
    assert_string_equal(s->inputs[1], MNS_SOURCE_DIR "/tests/data/scene/sub/b.csv");
    assert_string_equal(s->inputs[2], "/abs/c.csv");
    assert_string_equal(s->inputs[3], "tornado:4000:7:3");
    mns_scene_destroy(s);
    s = parse("{\"input\": \"one:x.csv\"}");
    assert_int_equal(s->input_count, 1);
    assert_string_equal(s->inputs[0], "dir/one:x.csv");
    mns_scene_destroy(s);
    if (scene_parse("{\"input\": \"x.csv\"}", 18, "s.json", &s, &error)) fail_msg("%s", error.text);
    assert_string_equal(s->inputs[0], "x.csv");
    mns_scene_destroy(s);
}

static void empty_scene_leaves_every_default(void **state)
{
    (void)state;
    mns_scene *s = parse("{}");
    mns_scene zero = {.inputs = s->inputs};
    assert_memory_equal(s, &zero, sizeof zero);
    mns_scene_destroy(s);
}

static void light_with_a_direction_alone_is_directional(void **state)
{
    (void)state;
    mns_scene *s = parse("{\"light\": {\"direction\": [0, 1, 0]}}");
    assert_int_equal(s->look.light, MNS_LIGHT_DIRECTIONAL);
    mns_scene_destroy(s);
    s = parse("{\"light\": {\"direction\": [0, 1, 0], \"kind\": \"head\"}}");
    assert_int_equal(s->look.light, MNS_LIGHT_HEAD);
    mns_scene_destroy(s);
}

static void lights_say_what_they_are(void **state)
{
    (void)state;
    mns_scene *s = parse("{\"lights\": [{}, {\"direction\": [0, 1, 0], \"strength\": 0.5}, "
                         "{\"position\": [1, 2, 3], \"color\": \"#ff0000\"}, "
                         "{\"kind\": \"area\", \"position\": [4, 5, 6], \"radius\": 0.25}]}");
    const mns_light *light = s->look.lights;
    assert_int_equal(s->look.light_count, 4);
    assert_int_equal(s->look.set, MNS_LOOK_LIGHT);
    assert_int_equal(light[0].kind, MNS_LIGHT_HEAD);
    assert_int_equal(light[1].kind, MNS_LIGHT_DIRECTIONAL);
    near3(light[1].direction, 0, 1, 0);
    near(light[1].strength, 0.5);
    assert_int_equal(light[2].kind, MNS_LIGHT_POINT);
    near3(light[2].position, 1, 2, 3);
    near3(light[2].color, 1, 0, 0);
    assert_int_equal(light[3].kind, MNS_LIGHT_AREA);
    near3((double[]){light[3].position[0], light[3].position[2], light[3].radius}, 4, 6, 0.25);
    mns_scene_destroy(s);
}

static void meshes_have_files_and_colours(void **state)
{
    (void)state;
    mns_scene *s = parse("{\"meshes\": [\"floor.obj\", {\"file\": \"/abs/box.ply\", \"color\": [0, 0, 1]}]}");
    assert_int_equal(s->look.mesh_count, 2);
    assert_string_equal(s->look.meshes[0].file, "dir/floor.obj");
    assert_false(s->look.meshes[0].has_color);
    assert_string_equal(s->look.meshes[1].file, "/abs/box.ply");
    assert_true(s->look.meshes[1].has_color);
    near3(s->look.meshes[1].color, 0, 0, 1);
    mns_scene_destroy(s);
    refuse("{\"meshes\": \"floor.obj\"}", MNS_ERROR_INPUT,
           "s.json: meshes: \"floor.obj\": expected a list of at most 256 meshes");
    refuse("{\"meshes\": [\"a.obj\", 3]}", MNS_ERROR_INPUT,
           "s.json: meshes[1]: 3: expected a file's name, or an object with a file");
    refuse("{\"meshes\": [{\"color\": [0, 0, 1]}]}", MNS_ERROR_INPUT,
           "s.json: meshes[0]: an object: expected an object with a file");
    refuse("{\"meshes\": [{\"file\": \"a.obj\", \"size\": 2}]}", MNS_ERROR_INPUT,
           "s.json: meshes[0].size: unknown key; known: file, color");
}

static void effects_reach_their_members(void **state)
{
    (void)state;
    mns_scene *s =
        parse("{\"look\": \"water\", \"effects\": {\"shadows\": 4, \"reflections\": 2, \"refractions\": 3, "
              "\"mirror\": 0, \"index\": 1.5, \"transmission\": 0.5, \"absorption\": [1, 2, 3], "
              "\"occlusion\": {\"rays\": 8, \"reach\": 0.5}, \"environment\": \"sky.exr\", "
              "\"seed\": 4294967295}}");
    const mns_effects *e = &s->look.effects;
    assert_string_equal(s->look.preset, "water");
    assert_int_equal(s->look.set, MNS_LOOK_SHADOWS | MNS_LOOK_REFLECTIONS | MNS_LOOK_REFRACTIONS |
                                      MNS_LOOK_MIRROR | MNS_LOOK_INDEX | MNS_LOOK_TRANSMISSION |
                                      MNS_LOOK_ABSORPTION | MNS_LOOK_OCCLUSION | MNS_LOOK_ENVIRONMENT);
    assert_true(e->shadows);
    assert_int_equal(e->shadow_samples, 4);
    assert_int_equal(e->reflections, 2);
    assert_int_equal(e->refractions, 3);
    near3((double[]){e->mirror, e->index, e->transmission}, 0, 1.5, 0.5);
    near3(e->absorption, 1, 2, 3);
    assert_int_equal(e->occlusion_rays, 8);
    near(e->occlusion_reach, 0.5);
    assert_string_equal(e->environment, "dir/sky.exr");
    assert_true(e->seed == UINT32_MAX);
    mns_scene_destroy(s);
    s = parse("{\"effects\": {\"shadows\": false, \"occlusion\": 0, \"environment\": \"sky\"}}");
    assert_false(s->look.effects.shadows);
    assert_string_equal(s->look.effects.environment, "sky");
    mns_scene_destroy(s);
}

static void wrong_lights_and_effects_are_named(void **state)
{
    (void)state;
    refuse("{\"lights\": []}", MNS_ERROR_INPUT, "s.json: lights: a list: expected a list of 1 to 256 lights");
    refuse("{\"lights\": [{}, {\"kind\": \"sun\"}]}", MNS_ERROR_INPUT,
           "s.json: lights[1].kind: \"sun\": expected one of head directional point area");
    refuse("{\"lights\": [{\"kind\": \"point\"}]}", MNS_ERROR_INPUT,
           "s.json: lights[0]: an object: expected a light of this kind to have a position");
    refuse("{\"lights\": [{\"kind\": \"area\", \"position\": [0, 0, 0]}]}", MNS_ERROR_INPUT,
           "s.json: lights[0]: an object: expected an area light to have a radius");
    refuse("{\"effects\": {\"reflections\": 9}}", MNS_ERROR_INPUT,
           "s.json: effects.reflections: 9: expected a whole number from 0 to 8");
    refuse("{\"effects\": {\"index\": 0.5}}", MNS_ERROR_INPUT,
           "s.json: effects.index: 0.5: expected a number from 1 to 100, or 0");
    refuse("{\"effects\": {\"occlusion\": {\"ray\": 1}}}", MNS_ERROR_INPUT,
           "s.json: effects.occlusion.ray: unknown key; known: rays, reach");
    refuse("{\"effects\": {\"shadows\": 0.5}}", MNS_ERROR_INPUT,
           "s.json: effects.shadows: 0.5: expected true, false, or a whole number of samples from 1 to 4096");
    refuse("{\"look\": \"mud\"}", MNS_ERROR_INPUT,
           "s.json: look: \"mud\": expected one of plain clay water molecule glass");
}

static void a_second_material_reaches_its_members(void **state)
{
    (void)state;
    mns_scene *s =
        parse("{\"blend\": {\"by\": \"heat\", \"range\": [-1, 3], \"color\": \"#000000\", \"mirror\": 0, "
              "\"transmission\": 0.5, \"absorption\": [1, 2, 3]}}");
    const mns_blend *b = &s->look.blend;
    assert_string_equal(b->by, "heat");
    assert_int_equal(b->set, MNS_LOOK_COLOR | MNS_LOOK_MIRROR | MNS_LOOK_TRANSMISSION | MNS_LOOK_ABSORPTION);
    near3((double[]){b->range[0], b->range[1], b->transmission}, -1, 3, 0.5);
    near3(b->absorption, 1, 2, 3);
    assert_int_equal(s->look.set, 0);
    mns_scene_destroy(s);
    refuse("{\"blend\": {\"mirror\": 1}}", MNS_ERROR_INPUT,
           "s.json: blend: an object: expected the column to blend by, under by");
    refuse("{\"blend\": {\"by\": \"\"}}", MNS_ERROR_INPUT,
           "s.json: blend.by: \"\": expected a string that is not empty");
    refuse("{\"blend\": {\"by\": \"heat\", \"range\": [1, 1]}}", MNS_ERROR_INPUT,
           "s.json: blend.range: a list: expected a list of two numbers, the lower first");
    refuse("{\"blend\": {\"by\": \"heat\", \"index\": 1.5}}", MNS_ERROR_INPUT,
           "s.json: blend.index: unknown key; known: by, range, color, mirror, transmission, absorption");
}

static void background_can_be_written_in_each_way(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double rgba[4];
    } way[] = {
        {"\"transparent\"", {0, 0, 0, 0}},           {"\"#ff0080\"", {1, 0, 128 / 255.0, 1}},
        {"\"#FF008033\"", {1, 0, 128 / 255.0, 0.2}}, {"[0.5, 1, 0]", {0.5, 1, 0, 1}},
        {"[0, 1, 0, 0.5]", {0, 1, 0, 0.5}},          {"\"0.1,0.2,0.3\"", {0.1, 0.2, 0.3, 1}},
    };
    for (size_t i = 0; i < sizeof way / sizeof *way; i++) {
        char text[80];
        snprintf(text, sizeof text, "{\"background\": %s}", way[i].text);
        mns_scene *s = parse(text);
        assert_int_equal(s->look.set, MNS_LOOK_BACKGROUND);
        for (int k = 0; k < 4; k++) near(s->look.background[k], way[i].rgba[k]);
        mns_scene_destroy(s);
    }
}

static void how_it_is_drawn_can_be_said(void **state)
{
    (void)state;
    static const char text[] = "{\"frame\": 7, \"method\": \"fbvh\", \"solver\": \"secant\", \"samples\": 9}";
    mns_scene *s = parse(text);
    assert_int_equal(s->frame, 7);
    assert_int_equal(s->draw.method, MNS_METHOD_FBVH);
    assert_int_equal(s->draw.solver, MNS_SOLVER_SECANT);
    assert_int_equal(s->draw.samples, 9);
    mns_scene_destroy(s);
    refuse("{\"samples\": 65}", MNS_ERROR_INPUT, "s.json: samples: 65: expected a whole number from 1 to 64");
    refuse("{\"frame\": -1}", MNS_ERROR_INPUT,
           "s.json: frame: -1: expected a whole number from 0 to 2147483647");
    refuse("{\"method\": \"lists\"}", MNS_ERROR_INPUT,
           "s.json: method: \"lists\": expected one of auto list reference tile fbvh bvh");
}

static void unknown_keys_are_named_by_their_path(void **state)
{
    (void)state;
    refuse("{\"light\": {\"knd\": \"head\"}}", MNS_ERROR_INPUT,
           "s.json: light.knd: unknown key; known: kind, direction");
    refuse("{\"colour\": 1}", MNS_ERROR_INPUT,
           "s.json: colour: unknown key; known: field, input, inputs, camera, light, lights, meshes, look, "
           "effects, "
           "material, blend, background, "
           "size, frame, method, solver, samples");
    refuse("{\"camera\": {\"\": 1}}", MNS_ERROR_INPUT,
           "s.json: camera.: unknown key; known: eye, look_at, up, fov");
}

static void wrong_values_are_named_with_what_was_expected(void **state)
{
    (void)state;
    static const struct {
        const char *text, *error;
    } bad[] = {
        {"[]", "a list: expected an object"},
        {"{\"field\": 3}", "field: 3: expected an object"},
        {"{\"field\": {\"iso\": \"big\"}}", "field.iso: \"big\": expected a number above 0"},
        {"{\"field\": {\"iso\": 0}}", "field.iso: 0: expected a number above 0"},
        {"{\"field\": {\"radius\": -1}}", "field.radius: -1: expected a number above 0"},
        {"{\"field\": {\"radius_scale\": null}}", "field.radius_scale: null: expected a number above 0"},
        {"{\"field\": {\"kernel\": \"poly5\"}}",
         "field.kernel: \"poly5\": expected one of poly2 poly3 poly4 wyvill perlin wendland"},
        {"{\"input\": [\"a\"]}", "input: a list: expected a file name or a generator; for several: inputs"},
        {"{\"inputs\": \"a\"}", "inputs: \"a\": expected a list of file names; for one: input"},
        {"{\"inputs\": []}", "inputs: a list: expected at least one name"},
        {"{\"inputs\": [\"a\", 3]}", "inputs[1]: 3: expected a string that is not empty"},
        {"{\"input\": \"a\", \"inputs\": [\"b\"]}", "inputs: expected either input or inputs, not both"},
        {"{\"camera\": {\"eye\": [1, 2]}}", "camera.eye: a list: expected a list of three numbers"},
        {"{\"camera\": {\"eye\": [1, 2, true]}}", "camera.eye[2]: true or false: expected a number"},
        {"{\"camera\": {\"up\": [0, 0, 0]}}", "camera.up: a list: expected three numbers that are not all 0"},
        {"{\"camera\": {\"fov\": 180}}",
         "camera.fov: 180: expected degrees between 0 and 180, both excluded"},
        {"{\"light\": {\"kind\": \"lamp\"}}", "light.kind: \"lamp\": expected one of head directional"},
        {"{\"material\": {\"shading\": 1}}", "material.shading: 1: expected one of smooth cel"},
        {"{\"material\": {\"color_map\": \"jet\"}}",
         "material.color_map: \"jet\": expected one of viridis magma inferno plasma cividis"},
        {"{\"material\": {\"color_by\": \"\"}}",
         "material.color_by: \"\": expected a string that is not empty"},
        {"{\"material\": {\"color\": \"transparent\"}}",
         "material.color: \"transparent\": expected a list of three numbers in [0, 1], or \"#rrggbb\""},
        {"{\"material\": {\"color\": [0, 0, 2]}}",
         "material.color: 2: expected a list of three numbers in [0, 1], or \"#rrggbb\""},
        {"{\"material\": {\"range\": [3, 3]}}",
         "material.range: a list: expected a list of two numbers, the lower first"},
        {"{\"material\": {\"ambient\": -0.1}}", "material.ambient: -0.1: expected a number of 0 or more"},
        {"{\"material\": {\"shininess\": 0}}", "material.shininess: 0: expected a number above 0"},
        {"{\"material\": {\"cel_bands\": 2.5}}",
         "material.cel_bands: 2.5: expected a whole number from 1 to 64"},
        {"{\"background\": \"#12345\"}",
         "background: \"#12345\": expected a list of three or four numbers in [0, 1], "
         "\"#rrggbb\", \"#rrggbbaa\" or \"transparent\""},
        {"{\"size\": [640]}",
         "size: a list: expected a list of two whole numbers from 1 to 65536, width and height"},
        {"{\"size\": [640, 0]}",
         "size: 0: expected a list of two whole numbers from 1 to 65536, width and height"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char expected[480];
        snprintf(expected, sizeof expected, "s.json: %s", bad[i].error);
        refuse(bad[i].text, MNS_ERROR_INPUT, expected);
    }
}

/* Refused as INPUT, with `start` first in the error's line. */
static void refuse_syntax(const char *text, size_t size, const char *start)
{
    mns_scene *scene = NULL;
    mns_error error = {0};
    assert_int_equal(scene_parse(text, size, "s.json", &scene, &error), MNS_ERROR_INPUT);
    assert_null(scene);
    error.text[strlen(start)] = '\0';
    assert_string_equal(error.text, start);
}

static void syntax_errors_carry_line_and_column(void **state)
{
    (void)state;
    refuse_syntax("{\n  \"size\": [1 2]\n}", 19, "s.json:2:14: expected JSON: ");
    refuse_syntax("", 0, "s.json:1:0: expected JSON: ");
    refuse_syntax("{\"size\": [1, 2], \"size\": [3, 4]}", 32, "s.json:1:23: expected JSON: duplicate");
    refuse_syntax("{\"field\": {\"iso\": 1e999}}", 25, "s.json:1:23: expected JSON: real number overflow");
    refuse_syntax("{\"input\": \"\xff\"}", 14, "s.json:1:");
    refuse_syntax("{}{}", 4, "s.json:1:3: expected JSON: ");
}

static void nesting_without_end_is_refused(void **state)
{
    (void)state;
    size_t size = (size_t)1 << 20;
    char *text = malloc(size);
    assert_non_null(text);
    memset(text, '[', size);
    refuse_syntax(text, size, "s.json:1:");
    static const char level[] = "{\"a\":";
    for (size_t i = 0; i < size; i++) text[i] = level[i % (sizeof level - 1)];
    refuse_syntax(text, size, "s.json:1:");
    free(text);
}

/* Writes `size` bytes of blanks behind `text` in a new file and gives its name in `path`. */
static void write_blank(char *path, const char *text, size_t size)
{
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "w");
    fputs(text, file);
    for (size_t i = 0; i < size; i++) putc(' ', file);
    assert_int_equal(fclose(file), 0);
}

static void files_that_are_no_scenes_are_refused(void **state)
{
    (void)state;
    mns_scene *scene = NULL;
    mns_error error = {0};
    assert_int_equal(mns_scene_load("/nowhere/s.json", &scene, &error), MNS_ERROR_IO);
    assert_string_equal(error.text, "/nowhere/s.json: cannot open the scene: No such file or directory");
    assert_int_equal(mns_scene_load("/tmp", &scene, &error), MNS_ERROR_IO);
    assert_string_equal(error.text, "/tmp: is a folder; expected a JSON scene file");

    char large[] = "/tmp/meniscus-scene-XXXXXX", fitting[] = "/tmp/meniscus-scene-XXXXXX";
    write_blank(large, "{}", (size_t)16 << 20);
    assert_int_equal(mns_scene_load(large, &scene, &error), MNS_ERROR_INPUT);
    assert_non_null(strstr(error.text, "more than 16 MiB"));
    assert_null(scene);
    write_blank(fitting, "{\"size\": [3, 4]}", 100000);
    assert_int_equal(mns_scene_load(fitting, &scene, &error), MNS_OK);
    assert_int_equal(scene->view.height, 4);
    mns_scene_destroy(scene);
    unlink(large);
    unlink(fitting);
}

static void colors_parse_or_stay(void **state)
{
    (void)state;
    static const char *const bad[] = {"",        "red", "1,2,3",      "0,0",     "0,0,0,",  "0,0,0,0,0", "#",
                                      "#12345g", "#12", "#123456789", "0,nan,0", "0 ,0,0x", "-0.1,0,0"};
    mns_error error;
    double rgba[4] = {9, 9, 9, 9};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(mns_color_parse(bad[i], rgba, &error), MNS_ERROR_USAGE);
        assert_true(rgba[0] == 9 && rgba[1] == 9 && rgba[2] == 9 && rgba[3] == 9);
    }
    assert_int_equal(mns_color_parse("1,0.5,0,0.25", rgba, &error), MNS_OK);
    near3(rgba, 1, 0.5, 0);
    near(rgba[3], 0.25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_key_reaches_its_member),
        cmocka_unit_test(files_lie_beside_the_scene_and_generators_stay),
        cmocka_unit_test(empty_scene_leaves_every_default),
        cmocka_unit_test(light_with_a_direction_alone_is_directional),
        cmocka_unit_test(lights_say_what_they_are),
        cmocka_unit_test(meshes_have_files_and_colours),
        cmocka_unit_test(effects_reach_their_members),
        cmocka_unit_test(wrong_lights_and_effects_are_named),
        cmocka_unit_test(a_second_material_reaches_its_members),
        cmocka_unit_test(background_can_be_written_in_each_way),
        cmocka_unit_test(how_it_is_drawn_can_be_said),
        cmocka_unit_test(unknown_keys_are_named_by_their_path),
        cmocka_unit_test(wrong_values_are_named_with_what_was_expected),
        cmocka_unit_test(syntax_errors_carry_line_and_column),
        cmocka_unit_test(nesting_without_end_is_refused),
        cmocka_unit_test(files_that_are_no_scenes_are_refused),
        cmocka_unit_test(colors_parse_or_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
