/* The table of the regression renders: its scenes cover every kernel, format and feature, its truths are the
 * reference's and small, and each of its tolerances fails what passes it. */
#include "support/image_table.h"
#include "support/scenes.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#define FOLDER MNS_SOURCE_DIR "/tests/images"

enum { TRUTHS_BYTES_MOST = 4000000 };

static int setup(void **state)
{
    static image_table table;
    table = image_table_load(FOLDER);
    *state = &table;
    return 0;
}

static int teardown(void **state)
{
    image_table_free(*state);
    return 0;
}

/* ---- What the scenes cover ---- */

/* Whether `word` is one of the words of the line of `text` that begins so. */
static bool has_word(const char *text, const char *line, const char *word)
{
    const char *from = strstr(text, line);
    assert_non_null(from);
    size_t length = strlen(word), rest = strcspn(from, "\n");
    for (const char *at = from; (at = strstr(at, word)) && at < from + rest; at += length)
        if (at[-1] == ' ' && (at[length] == ' ' || at[length] == '\n')) return true;
    return false;
}

static mns_plan *plan_of(const image_row *row, const image_scene *s)
{
    mns_plan *plan;
    mns_error error;
    mns_options options = s->options;
    if (options.method == MNS_METHOD_AUTO) options.method = MNS_METHOD_LIST; /* as the table's features are */
    if (mns_plan_create(s->field, &s->view, &s->scene->look, &options, &scene_llvmpipe, &plan, &error))
        fail_msg("%s: %s", row->name, error.text);
    return plan;
}

static void each_scene_has_the_features_it_is_there_for(void **state)
{
    const image_table *table = *state;
    for (size_t i = 0; i < table->count; i++) {
        const image_row *row = &table->row[i];
        image_scene s = image_scene_load(FOLDER, row);
        mns_plan *plan = plan_of(row, &s);
        char words[256], *rest = NULL;
        snprintf(words, sizeof words, "%s", row->features);
        for (char *word = strtok_r(words, " ", &rest); word; word = strtok_r(NULL, " ", &rest)) {
            bool wanted = *word != '!';
            if (has_word(mns_plan_text(plan), "features ", word + !wanted) != wanted)
                fail_msg("%s: expected %s in its plan:\n%s", row->name, word, mns_plan_text(plan));
        }
        mns_plan_destroy(plan);
        image_scene_free(&s);
    }
}

/* All that a scene can ask for; the rest are options for hosts, tests and measurements. */
#define OF_OPTIONS                                                                                           \
    (FEATURE_HOST | FEATURE_PAPER | FEATURE_SHUFFLE | FEATURE_COUNTERS | FEATURE_SOLVER | FEATURE_KERNEL |   \
     FEATURE_REFERENCE)

static uint64_t features_by(const image_row *row, image_scene *s, const char *method)
{
    static const char *const names[] = {"list", "tile", "fbvh", "bvh"};
    static const mns_method methods[] = {MNS_METHOD_LIST, MNS_METHOD_TILE, MNS_METHOD_FBVH, MNS_METHOD_BVH};
    size_t i = 0;
    while (i < 4 && strcmp(names[i], method) != 0) i++;
    if (i == 4) fail_msg("%s: no method \"%s\"", row->name, method);
    s->options.method = methods[i];
    mns_plan *plan = plan_of(row, s);
    uint64_t features = mns_plan_features(plan);
    mns_plan_destroy(plan);
    return features;
}

static void the_scenes_cover_kernels_and_features(void **state)
{
    const image_table *table = *state;
    uint64_t seen = 0;
    bool kernel[MNS_KERNEL_COUNT] = {false};
    assert_true(table->count >= 25);
    for (size_t i = 0; i < table->count; i++) {
        const image_row *row = &table->row[i];
        image_scene s = image_scene_load(FOLDER, row);
        for (size_t m = 0; m < row->method_count; m++) seen |= features_by(row, &s, row->method[m]);
        kernel[s.field->kernel] = true;
        image_scene_free(&s);
    }
    uint64_t all = (UINT64_C(1) << FEATURE_COUNT) - 1, missing = all & ~seen & ~OF_OPTIONS;
    if (missing) fail_msg("no scene has the features 0x%llx", (unsigned long long)missing);
    for (int k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++)
        if (!kernel[k]) fail_msg("no scene has the kernel %s", mns_kernel_name(k));
}

static bool ends_with(const char *text, const char *end)
{
    size_t length = strlen(text), tail = strlen(end);
    return length >= tail && strcmp(text + length - tail, end) == 0;
}

/* A format as info tells it, and how the name of a file of it ends. */
static const struct {
    const char *format, *ending;
} formats[] = {
    {"csv", ".csv"},       {"xyz", ".xyz"}, {"xyz", ".extxyz"},   {"lammps", ".lammpstrj"},
    {"lammps", ".gz"},     {"pdb", ".pdb"}, {"vtk", "/knot.vtk"}, {"vtk", "/knot-binary.vtk"},
    {"generator", ":400"},
};

static void the_scenes_cover_the_formats(void **state)
{
    const image_table *table = *state;
    enum { FORMATS = sizeof formats / sizeof *formats };
    bool seen[FORMATS] = {false};
    for (size_t i = 0; i < table->count; i++) {
        image_scene s = image_scene_load(FOLDER, &table->row[i]);
        mns_field_info info;
        mns_field_get_info(s.field, &info);
        for (size_t k = 0; k < FORMATS; k++)
            if (strcmp(info.format, formats[k].format) == 0 &&
                ends_with(s.scene->inputs[0], formats[k].ending))
                seen[k] = true;
        image_scene_free(&s);
    }
    for (size_t k = 0; k < FORMATS; k++)
        if (!seen[k]) fail_msg("no scene reads %s of a name *%s", formats[k].format, formats[k].ending);
}

/* ---- The truths ---- */

static void the_truths_are_small_and_all_in_the_table(void **state)
{
    const image_table *table = *state;
    size_t bytes = 0, files = 0;
    DIR *folder = opendir(FOLDER);
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder));) {
        if (!ends_with(entry->d_name, ".exr")) continue;
        char path[IMAGE_PATH], name[64];
        struct stat about;
        snprintf(name, sizeof name, "%.*s", (int)strcspn(entry->d_name, "."), entry->d_name);
        if (!image_table_find(table, name)) fail_msg("%s is in no row of the table", entry->d_name);
        assert_int_equal(stat(image_path(path, FOLDER, name, "exr"), &about), 0);
        bytes += (size_t)about.st_size;
        files++;
    }
    closedir(folder);
    assert_int_equal(files, table->count);
    assert_in_range(bytes, 1, TRUTHS_BYTES_MOST);
}

/* Every truth holds hits, bounds on their errors (only the reference gives those), and what it is sure of. */
static void the_truths_are_the_references(void **state)
{
    const image_table *table = *state;
    for (size_t i = 0; i < table->count; i++) {
        const image_row *row = &table->row[i];
        truth_planes *truth;
        image_scene s = image_scene_load(FOLDER, row);
        mns_image *image = image_truth_load(FOLDER, row, &truth);
        if (!image->t_error) fail_msg("%s was not made by the reference", row->name);
        assert_int_equal(image->width, s.view.width);
        assert_int_equal(image->height, s.view.height);
        assert_true(truth->hits > 0);
        /* from an eye on the surface every ray that leaves begins with a touch */
        if (truth->undecided && !strstr(row->features, "eye_on"))
            fail_msg("%s: %zu pixels of the truth are undecided", row->name, truth->undecided);
        mns_image_destroy(image);
        truth_destroy(truth);
        image_scene_free(&s);
    }
}

/* ---- The tolerances ---- */

/* Pixels that the truth is sure of: the first hit and the first miss. False where there is none. */
static bool find_pixel(const mns_image *image, bool hit, size_t *pixel)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++)
        if (image->certain[i] > 0.5f && (isfinite(image->t[i]) != 0) == hit) return *pixel = i, true;
    return false;
}

static void farther(const image_row *row, mns_image *image, size_t pixel)
{
    double t = ((double)image->t[pixel] + (double)image->t_lo[pixel]) * (1 + 1.01 * row->tolerance.t);
    image->t[pixel] = (float)t;
    image->t_lo[pixel] = (float)(t - (double)image->t[pixel]);
}

static void turned(const image_row *row, mns_image *image, size_t pixel)
{
    float *n = image->normal + 3 * pixel;
    int least = fabsf(n[0]) < fabsf(n[1]) ? 0 : 1, next = (least + 1) % 3, last = (least + 2) % 3;
    double across = hypot((double)n[next], (double)n[last]),
           angle = 1.1 * row->tolerance.normal * acos(-1) / 180;
    double moved = tan(angle) / across, a = (double)n[next], b = (double)n[last];
    n[next] = (float)(a - moved * b);
    n[last] = (float)(b + moved * a);
}

static void missed(const image_row *row, mns_image *image, size_t pixel)
{
    (void)row;
    image->t[pixel] = INFINITY;
    image->t_lo[pixel] = 0;
    memset(image->normal + 3 * pixel, 0, 3 * sizeof(float));
}

static void invented(const image_row *row, mns_image *image, size_t pixel)
{
    (void)row;
    image->t[pixel] = image->normal[3 * pixel] = 1;
}

static void unsure(const image_row *row, mns_image *image, size_t pixel)
{
    (void)row;
    image->certain[pixel] = 0;
}

static void darker(const image_row *row, mns_image *image, size_t pixel)
{
    (void)pixel;
    size_t count = 4 * (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) image->rgba[i] *= (float)(1 - 40 * pow(10, -row->psnr / 20));
}

static const struct {
    const char *what;
    void (*apply)(const image_row *row, mns_image *image, size_t pixel);
    bool at_hit;
} faults[] = {
    {"a hit a little farther", farther, true},
    {"a normal turned a little", turned, true},
    {"a hit missed", missed, true},
    {"a hit invented", invented, false},
    {"a pixel left undecided", unsure, true},
    {"colours a little darker", darker, true},
};

static void no_tolerance_lets_a_fault_pass(void **state)
{
    const image_table *table = *state;
    char why[IMAGE_WHY];
    for (size_t i = 0; i < table->count; i++)
        for (size_t k = 0; k < sizeof faults / sizeof *faults; k++) {
            const image_row *row = &table->row[i];
            size_t pixel;
            truth_planes *truth;
            mns_image *image = image_truth_load(FOLDER, row, &truth);
            if (!image_judge(row, NULL, truth, image, why)) fail_msg("%s is not itself: %s", row->name, why);
            if (find_pixel(image, faults[k].at_hit, &pixel)) {
                faults[k].apply(row, image, pixel);
                if (image_judge(row, NULL, truth, image, why))
                    fail_msg("%s passes with %s: %s", row->name, faults[k].what, why);
            } else
                assert_false(faults[k].at_hit);
            mns_image_destroy(image);
            truth_destroy(truth);
        }
}

static void each_tolerance_has_its_reason(void **state)
{
    const image_table *table = *state;
    for (size_t i = 0; i < table->count; i++) {
        assert_true(strlen(table->row[i].why) > 20);
        assert_ptr_equal(image_table_find(table, table->row[i].name), &table->row[i]); /* no name twice */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_scene_has_the_features_it_is_there_for),
        cmocka_unit_test(the_scenes_cover_kernels_and_features),
        cmocka_unit_test(the_scenes_cover_the_formats),
        cmocka_unit_test(the_truths_are_small_and_all_in_the_table),
        cmocka_unit_test(the_truths_are_the_references),
        cmocka_unit_test(no_tolerance_lets_a_fault_pass),
        cmocka_unit_test(each_tolerance_has_its_reason),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
