/* The regression renders: every scene of tests/images by its methods, against the truth that is kept beside
 * it. What differs leaves the page of `meniscus compare` under images/ in the build's folder. */
#include "field/field.h"
#include "support/draw_fixture.h"
#include "support/image_table.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#define FOLDER MNS_SOURCE_DIR "/tests/images"

typedef struct fixture {
    draw_fixture *draw;
    image_table table;
} fixture;

#define CARD_PSNR 70.0 /* decibels */

static int setup(void **state)
{
    static fixture f;
    void *draw;
    if (draw_fixture_setup(&draw)) return -1;
    f.draw = draw;
    f.table = image_table_load(FOLDER);
    *state = &f;
    return 0;
}

static int teardown(void **state)
{
    fixture *f = *state;
    void *draw = f->draw;
    image_table_free(&f->table);
    return draw_fixture_teardown(&draw);
}

/* ---- What a failure leaves ---- */

/* "BUILD/images/NAME/BACKEND-METHOD" and an ending. */
static void report_path(char path[IMAGE_PATH], const char *name, const char *method, const char *ending)
{
    const char *backend = getenv("MNS_TEST_BACKEND");
    const char *end = strrchr(MNS_PROGRAM, '/');
    int length = snprintf(path, IMAGE_PATH, "%.*s/images/%s/%s-%s%s", (int)(end - MNS_PROGRAM), MNS_PROGRAM,
                          name, backend ? backend : "auto", method, ending);
    assert_in_range(length, 1, IMAGE_PATH - 1);
}

/* What an earlier failure left is no longer so. */
static void forget_report(const char *name, const char *method)
{
    char path[IMAGE_PATH], command[IMAGE_PATH + 16];
    report_path(path, name, method, ".exr");
    if (access(path, F_OK) != 0) return;
    unlink(path);
    report_path(path, name, method, "");
    snprintf(command, sizeof command, "rm -rf '%s'", path);
    assert_int_equal(system(command), 0);
}

/* Keeps the image and writes its page. */
static void report(const image_row *row, const char *method, const mns_image *image, const char *why)
{
    char folder[IMAGE_PATH], drawn[IMAGE_PATH], truth[IMAGE_PATH], command[5 * IMAGE_PATH];
    mns_error error;
    report_path(folder, row->name, method, "");
    report_path(drawn, row->name, method, ".exr");
    image_path(truth, FOLDER, row->name, "exr");
    snprintf(command, sizeof command, "mkdir -p '%.*s'", (int)(strrchr(folder, '/') - folder), folder);
    assert_int_equal(system(command), 0);
    if (mns_image_write(image, drawn, &error)) fail_msg("%s", error.text);
    snprintf(command, sizeof command, "'%s' compare '%s' '%s' -o '%s' >'%s.txt' 2>&1", MNS_PROGRAM, truth,
             drawn, folder, folder);
    (void)!system(command); /* 1: they differ, as is known */
    print_error("%s by %s: %s\n  look at %s/index.html, and if the new one is right: ./run accept %s\n",
                row->name, method, why, folder, row->name);
}

/* ---- Drawn by each method ---- */

static mns_method method_by_name(const char *name)
{
    static const struct {
        const char *name;
        mns_method method;
    } known[] = {{"list", MNS_METHOD_LIST},
                 {"tile", MNS_METHOD_TILE},
                 {"fbvh", MNS_METHOD_FBVH},
                 {"bvh", MNS_METHOD_BVH},
                 {"reference", MNS_METHOD_REFERENCE}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i].name, name) == 0) return known[i].method;
    fail_msg("no method \"%s\"", name);
    return MNS_METHOD_AUTO;
}

/* Both back ends have the same rasteriser behind them, and compiling variants takes longest: through the
 * second one, what the list does not draw is drawn with one kernel. */
static bool is_wanted(const fixture *f, const image_row *row, const image_scene *s, const char *method)
{
    bool thin = f->draw->gl.backend == MNS_BACKEND_OSMESA && strcmp(method, "list") != 0;
    if (thin && s->field->kernel != MNS_KERNEL_POLY3) return false;
    for (size_t i = 0; i < row->method_count; i++)
        if (strcmp(row->method[i], method) == 0) return true;
    return false;
}

/* Draws a row's scene, with what the caller changed in it; free by mns_image_destroy. */
static mns_image *draw_scene(fixture *f, const image_scene *s)
{
    return draw_image(f->draw, s->field, &s->view, &s->scene->look, &s->options);
}

/* Whether a row is drawn as its truth: by its own tolerances, or by others. */
static bool draw_row(fixture *f, const image_row *row, image_scene *s, const char *method,
                     const images_tolerance *tolerance)
{
    char why[IMAGE_WHY];
    truth_planes *truth;
    mns_image_destroy(image_truth_load(FOLDER, row, &truth));
    s->options.method = method_by_name(method);
    forget_report(row->name, method);
    mns_image *image = draw_scene(f, s);
    image_row here = *row;
    /* between the passes colours are halves, which a card may round either way */
    if (!mns_renderer_limits(f->draw->renderer)->is_software) here.psnr = fmin(here.psnr, CARD_PSNR);
    bool same = image_judge(&here, tolerance, truth, image, why);
    if (same)
        print_message("%s by %s: %s\n", row->name, method, why);
    else
        report(row, method, image, why);
    mns_image_destroy(image);
    truth_destroy(truth);
    return same;
}

/* Whether this build reads what the scene asks for. */
static bool is_readable(const image_scene *s)
{
    return !s->scene->look.mesh_count || !strstr(mns_version(), "no assimp");
}

static void expect_all(fixture *f, const char *method)
{
    size_t drawn = 0, failed = 0;
    for (size_t i = 0; i < f->table.count; i++) {
        const image_row *row = &f->table.row[i];
        image_scene s = image_scene_load(FOLDER, row);
        if (is_readable(&s) && is_wanted(f, row, &s, method)) {
            failed += !draw_row(f, row, &s, method, NULL);
            drawn++;
        }
        image_scene_free(&s);
    }
    assert_true(drawn > 0);
    if (failed) fail_msg("%zu of %zu scenes by %s are not as their truth", failed, drawn, method);
}

static void list_draws_the_truth(void **state)
{
    expect_all(*state, "list");
}

static void tile_draws_the_truth(void **state)
{
    expect_all(*state, "tile");
}

static void fbvh_draws_the_truth(void **state)
{
    expect_all(*state, "fbvh");
}

static void bvh_draws_the_truth(void **state)
{
    expect_all(*state, "bvh");
}

/* What is kept is what the reference draws today: distances are two floats, normals and colours one. */
static void the_reference_still_draws_the_truth(void **state)
{
    fixture *f = *state;
    const images_tolerance rounding = {.t = 1e-12, .normal = 1e-4, .mask = 0};
    size_t failed = 0;
    for (size_t i = 0; i < f->table.count; i++) {
        image_scene s = image_scene_load(FOLDER, &f->table.row[i]);
        failed += is_readable(&s) && !draw_row(f, &f->table.row[i], &s, "reference", &rounding);
        image_scene_free(&s);
    }
    if (failed) fail_msg("%zu truths are not what the reference draws", failed);
}

/* ---- What is wrong is noticed ---- */

/* Draws what was made wrong in `s`, and expects to be told. */
static void expect_noticed(fixture *f, const image_row *row, const image_scene *s, const char *what)
{
    char why[IMAGE_WHY];
    truth_planes *truth;
    mns_image_destroy(image_truth_load(FOLDER, row, &truth));
    mns_image *image = draw_scene(f, s);
    if (image_judge(row, NULL, truth, image, why)) fail_msg("%s passes with %s: %s", row->name, what, why);
    mns_image_destroy(image);
    truth_destroy(truth);
}

/* Drawn by the reference, so that nothing but the eye is wrong. */
static void an_eye_a_little_forward_is_noticed(void **state)
{
    fixture *f = *state;
    for (size_t i = 0; i < f->table.count; i++) {
        image_scene s = image_scene_load(FOLDER, &f->table.row[i]);
        mns_field_info info;
        mns_field_get_info(s.field, &info);
        double forward[3], moved = 1e-4 * info.radius_max;
        s.options.method = MNS_METHOD_REFERENCE;
        mns_view_ray(&s.view, 0.5 * s.view.width, 0.5 * s.view.height, forward);
        for (int axis = 0; axis < 3; axis++) {
            s.view.eye[axis] += moved * forward[axis];
            s.view.look_at[axis] += moved * forward[axis];
        }
        if (is_readable(&s))
            expect_noticed(f, &f->table.row[i], &s, "an eye a ten thousandth of a radius forward");
        image_scene_free(&s);
    }
}

static void a_model_of_the_field_is_noticed(void **state)
{
    fixture *f = *state;
    const image_row *row = image_table_find(&f->table, "dense");
    assert_non_null(row);
    image_scene s = image_scene_load(FOLDER, row);
    s.options.solver = MNS_SOLVER_CUBIC;
    expect_noticed(f, row, &s, "the solver cubic");
    image_scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(list_draws_the_truth),
        cmocka_unit_test(tile_draws_the_truth),
        cmocka_unit_test(fbvh_draws_the_truth),
        cmocka_unit_test(bvh_draws_the_truth),
        cmocka_unit_test(the_reference_still_draws_the_truth),
        cmocka_unit_test(an_eye_a_little_forward_is_noticed),
        cmocka_unit_test(a_model_of_the_field_is_noticed),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
