/* Pictures of a comparison, and the folder that its files lie in. */
#include "compare/folder.h"
#include "compare/metrics.h"
#include "compare/pictures.h"
#include "support/cli.h"
#include "support/planes.h"

#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

static int setup(void **state)
{
    cli *c = malloc(sizeof *c);
    assert_non_null(c);
    cli_setup(c, "");
    *state = c;
    return 0;
}

static int teardown(void **state)
{
    cli_teardown(*state);
    free(*state);
    return 0;
}

/* ---- Pictures ---- */

static const page_picture *find(const picture_list *list, const char *kind)
{
    for (size_t i = 0; i < list->count; i++)
        if (!strcmp(list->picture[i].run, "run") && !strcmp(list->picture[i].kind, kind))
            return &list->picture[i];
    fail_msg("no picture %s", kind);
    return NULL;
}

/* The picture's pixels, for the caller to free. */
static unsigned char *decode(const page_picture *picture, unsigned width, unsigned height)
{
    png_image about = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_memory(&about, picture->png, picture->size));
    assert_true(about.width == width && about.height == height);
    about.format = PNG_FORMAT_RGB;
    unsigned char *rgb = malloc(PNG_IMAGE_SIZE(about));
    assert_non_null(rgb);
    assert_true(png_image_finish_read(&about, NULL, rgb, 0, NULL));
    return rgb;
}

static void pictures_show_what_differs(void **state)
{
    (void)state;
    mns_error error;
    planes p = planes_make(6, 1);
    planes_hit(&p, 0, 1, 0);
    planes_hit(&p, 1, 1, 0.5);  /* farther */
    planes_hit(&p, 2, 1, -0.5); /* nearer */
    planes_hit(&p, 3, 1, 0);
    p.image->t[3] = INFINITY;
    p.image->t[4] = 1;
    for (int k = 0; k < 3; k++) p.image->rgba[k] = 0;
    picture_list list = {0};
    assert_int_equal(pictures_add(&list, "truth", p.truth, NULL, &error), MNS_OK);
    assert_int_equal(list.count, 1);
    assert_int_equal(pictures_add(&list, "run", p.truth, p.image, &error), MNS_OK);
    assert_int_equal(list.count, 4);
    unsigned char *image = decode(find(&list, "image"), 6, 1), *depth = decode(find(&list, "depth"), 6, 1);
    unsigned char *mask = decode(find(&list, "mask"), 6, 1);
    assert_true(image[0] == 0 && image[1] == 0 && image[3] == 255 && image[17] == 255);
    assert_true(depth[0] == 247 && depth[1] == 247 && depth[2] == 247);
    assert_true(depth[3] > 150 && depth[5] < 80); /* red */
    assert_true(depth[6] < 80 && depth[8] > 150); /* blue */
    assert_true(depth[9] == depth[10] && depth[9] == depth[15]);
    for (int i = 0; i < 6; i++) {
        char hex[8];
        const metrics_mask expected[6] = {METRICS_MASK_BOTH,   METRICS_MASK_BOTH,     METRICS_MASK_BOTH,
                                          METRICS_MASK_MISSED, METRICS_MASK_INVENTED, METRICS_MASK_NONE};
        snprintf(hex, sizeof hex, "#%02x%02x%02x", mask[3 * i], mask[3 * i + 1], mask[3 * i + 2]);
        assert_string_equal(hex, PICTURES_MASK_COLOR[expected[i]]);
    }
    free(image);
    free(depth);
    free(mask);
    pictures_free(&list);
    planes_free(&p);
}

/* ---- The folder ---- */

static void fill(const folder_output *output, const char *name, const char *text)
{
    char *path = folder_file(output, name);
    FILE *file = fopen(path, "wx");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    free(path);
}

static void a_folder_appears_whole_and_replaces_its_like(void **state)
{
    const cli *c = *state;
    char path[128];
    size_t size;
    mns_error error;
    snprintf(path, sizeof path, "%s/out/", c->folder);
    for (int round = 0; round < 2; round++) {
        folder_output output;
        assert_int_equal(folder_begin(&output, path, &error), MNS_OK);
        fill(&output, "results.csv", round ? "new" : "old");
        if (!round) fill(&output, "chart.svg", "old");
        assert_int_equal(cli_exists(c, "out"), round);
        assert_int_equal(folder_commit(&output, &error), MNS_OK);
        folder_discard(&output); /* after a commit: nothing */
        assert_int_equal(cli_count_files(c), 1);
    }
    char *text = cli_read(c, "out/results.csv", &size);
    assert_string_equal(text, "new");
    assert_false(cli_exists(c, "out/chart.svg"));
    free(text);
}

static void a_discarded_folder_leaves_nothing(void **state)
{
    const cli *c = *state;
    char path[128];
    mns_error error;
    folder_output output;
    snprintf(path, sizeof path, "%s/out", c->folder);
    assert_int_equal(folder_begin(&output, path, &error), MNS_OK);
    fill(&output, "results.csv", "x");
    folder_discard(&output);
    assert_int_equal(cli_count_files(c), 0);
}

static void other_folders_and_files_are_left_alone(void **state)
{
    const cli *c = *state;
    char path[128];
    mns_error error;
    folder_output output;
    snprintf(path, sizeof path, "%s/out", c->folder);
    mkdir(path, 0777);
    assert_int_equal(folder_check(path, &error), MNS_OK);
    cli_write(c, "out/results.csv", "");
    assert_int_equal(folder_check(path, &error), MNS_OK);
    cli_write(c, "out/thesis.tex", "");
    assert_int_equal(folder_begin(&output, path, &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "thesis.tex"));
    snprintf(path, sizeof path, "%s/out/thesis.tex", c->folder);
    assert_int_equal(folder_begin(&output, path, &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "is no folder"));
    snprintf(path, sizeof path, "%s/none/out", c->folder);
    assert_int_equal(folder_begin(&output, path, &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "No such file or directory"));
    assert_int_equal(cli_count_files(c), 1);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_show_what_differs),
        TEST(a_folder_appears_whole_and_replaces_its_like),
        TEST(a_discarded_folder_leaves_nothing),
        TEST(other_folders_and_files_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
