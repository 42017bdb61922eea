/* PNG files by libpng's own reader, and every way in which writing an image can fail. */
#include "image/image.h"
#include "support/image_fixture.h"

#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

typedef struct png_pixels {
    int width, height, channels;
    unsigned char *level;
} png_pixels;

static png_pixels load_png(const char *path)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&png, path)) fail_msg("%s: %s", path, png.message);
    bool alpha = png.format & PNG_FORMAT_FLAG_ALPHA;
    png.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    png_pixels pixels = {(int)png.width, (int)png.height, alpha ? 4 : 3, malloc(PNG_IMAGE_SIZE(png))};
    assert_non_null(pixels.level);
    if (!png_image_finish_read(&png, NULL, pixels.level, 0, NULL)) fail_msg("%s: %s", path, png.message);
    return pixels;
}

static mns_status write_to(const mns_image *image, const char *path, mns_error *error)
{
    *error = (mns_error){0};
    return mns_image_write(image, path, error);
}

static png_pixels write_and_load(const mns_image *image, const char *path)
{
    mns_error error;
    if (write_to(image, path, &error) != MNS_OK) fail_msg("%s", error.text);
    return load_png(path);
}

/* IEC 61966-2-1, written forwards here; the library searches its inverse. */
static int srgb_level(double linear)
{
    double c = linear < 0 ? 0 : linear > 1 ? 1 : linear;
    return (int)floor(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055) + 0.5);
}

static void levels_are_srgb_of_linear(void **state)
{
    enum { WIDTH = 1000 };
    char path[IMAGE_FIXTURE_PATH_MAX];
    mns_image *image = image_fixture_noise(WIDTH, 1);
    for (int x = 0; x < WIDTH; x++)
        for (int c = 0; c < 3; c++)
            image->rgba[4 * x + c] = (float)((x + c / 3.0) / (WIDTH - 1) * 1.02 - 0.01);
    png_pixels png = write_and_load(image, image_fixture_path(path, *state, "ramp.png"));
    assert_int_equal(png.width, WIDTH);
    assert_int_equal(png.height, 1);
    assert_int_equal(png.channels, 3);
    for (int x = 0; x < WIDTH; x++)
        for (int c = 0; c < 3; c++)
            assert_int_equal(png.level[3 * x + c], srgb_level(image->rgba[4 * x + c]));
    free(png.level);
    mns_image_destroy(image);
}

static void known_colors_have_known_levels(void **state)
{
    static const float linear[] = {0, 0.0031308f, 0.2140411f, 0.5f, 1, 7, -1, INFINITY, NAN, -INFINITY};
    static const int level[] = {0, 10, 127, 188, 255, 255, 0, 255, 0, 0};
    enum { COUNT = sizeof level / sizeof *level };
    char path[IMAGE_FIXTURE_PATH_MAX];
    mns_image *image = image_fixture_noise(COUNT, 1);
    for (int x = 0; x < COUNT; x++)
        for (int c = 0; c < 3; c++) image->rgba[4 * x + c] = linear[x];
    png_pixels png = write_and_load(image, image_fixture_path(path, *state, "known.png"));
    for (int x = 0; x < COUNT; x++) assert_int_equal(png.level[3 * x + 1], level[x]);
    free(png.level);
    mns_image_destroy(image);
}

static void rows_run_from_the_top(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    mns_image *image = image_fixture_noise(3, 2);
    for (int i = 0; i < 6; i++)
        for (int c = 0; c < 3; c++) image->rgba[4 * i + c] = i == 4;
    png_pixels png = write_and_load(image, image_fixture_path(path, *state, "rows.png"));
    assert_int_equal(png.width, 3);
    assert_int_equal(png.height, 2);
    for (int i = 0; i < 6; i++) assert_int_equal(png.level[3 * i], i == 4 ? 255 : 0);
    free(png.level);
    mns_image_destroy(image);
}

static void one_transparent_pixel_brings_alpha_and_straight_color(void **state)
{
    static const float premultiplied[4][4] = {
        {0.5f, 0.25f, 0, 1}, {0.25f, 0.125f, 0, 0.5f}, {0, 0, 0, 0}, {0.3f, 0.3f, 0.3f, 0.1f}};
    static const int level[4][4] = {
        {188, 137, 0, 255}, {188, 137, 0, 128}, {0, 0, 0, 0}, {255, 255, 255, 26}};
    char path[IMAGE_FIXTURE_PATH_MAX];
    mns_image *image = image_fixture_noise(2, 2);
    memcpy(image->rgba, premultiplied, sizeof premultiplied);
    png_pixels png = write_and_load(image, image_fixture_path(path, *state, "alpha.png"));
    assert_int_equal(png.channels, 4);
    for (int i = 0; i < 16; i++) assert_int_equal(png.level[i], level[i / 4][i % 4]);
    free(png.level);

    for (int i = 0; i < 4; i++) image->rgba[4 * i + 3] = 1; /* all opaque: the channel goes */
    png = write_and_load(image, path);
    assert_int_equal(png.channels, 3);
    free(png.level);
    mns_image_destroy(image);
}

static void png_names_its_software(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    size_t size = 0;
    mns_error error;
    mns_image *image = image_fixture_noise(4, 4);
    assert_int_equal(write_to(image, image_fixture_path(path, *state, "named.png"), &error), MNS_OK);
    unsigned char *bytes = image_fixture_load(path, &size);
    assert_non_null(memmem(bytes, size, "tEXtSoftware\0meniscus ", 22));
    assert_non_null(memmem(bytes, size, "sRGB", 4));
    free(bytes);
    mns_image_destroy(image);
}

/* Writing to folder/name fails with `status` and a message that names the path and holds `expected`; the
 * folder keeps `left` entries. */
static void assert_fails(const char *folder, const char *name, mns_status status, const char *expected,
                         int left)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    mns_error error;
    mns_image *image = image_fixture_noise(64, 64);
    image_fixture_path(path, folder, name);
    mns_status got = write_to(image, path, &error);
    mns_image_destroy(image);
    if (got != status || error.status != status || !strstr(error.text, path) || !strstr(error.text, expected))
        fail_msg("status %d, expected %d and \"%s\", got: %s", got, status, expected, error.text);
    assert_int_equal(image_fixture_count(folder), left);
}

static void unknown_endings_are_usage_errors(void **state)
{
    static const char *const names[] = {"a.jpg", "a", "a.png.gz", "png", ".png"};
    for (size_t i = 0; i < 4; i++) assert_fails(*state, names[i], MNS_ERROR_USAGE, ".png or .exr", 0);
    mns_error error;
    mns_image *image = image_fixture_noise(1, 1);
    assert_int_equal(write_to(image, "", &error), MNS_ERROR_USAGE);
    assert_int_equal(write_to(image, names[4], &error), MNS_ERROR_USAGE);
    mns_image_destroy(image);
}

static void absent_folder_is_told(void **state)
{
    assert_fails(*state, "absent/a.png", MNS_ERROR_IO, "No such file or directory", 0);
    assert_fails(*state, "absent/a.exr", MNS_ERROR_IO, "No such file or directory", 0);
}

static void file_as_folder_is_told(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    image_fixture_save(image_fixture_path(path, *state, "plain"), "x", 1);
    assert_fails(*state, "plain/a.png", MNS_ERROR_IO, "Not a directory", 1);
}

static void folder_as_target_is_told_and_kept(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    assert_int_equal(mkdir(image_fixture_path(path, *state, "taken.png"), 0777), 0);
    assert_fails(*state, "taken.png", MNS_ERROR_IO, "Is a directory", 1);
    assert_int_equal(rmdir(path), 0);
}

static void special_file_as_target_is_told_and_kept(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    struct stat there;
    assert_int_equal(symlink("/dev/full", image_fixture_path(path, *state, "full.exr")), 0);
    assert_fails(*state, "full.exr", MNS_ERROR_IO, "not a regular file", 1);
    assert_int_equal(lstat(path, &there), 0);
    assert_true(S_ISLNK(there.st_mode));
}

static void read_only_folder_is_told(void **state)
{
    const uid_t me = geteuid(), somebody = 65534;
    assert_int_equal(chmod(*state, 0555), 0);
    if (!me) assert_int_equal(seteuid(somebody), 0); /* nothing is read-only to root */
    mns_error error;
    char path[IMAGE_FIXTURE_PATH_MAX];
    mns_image *image = image_fixture_noise(4, 4);
    mns_status status = write_to(image, image_fixture_path(path, *state, "a.png"), &error);
    mns_image_destroy(image);
    if (!me) assert_int_equal(seteuid(me), 0);
    assert_int_equal(chmod(*state, 0755), 0);
    assert_int_equal(status, MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "Permission denied"));
    assert_int_equal(image_fixture_count(*state), 0);
}

/* A full disk, played by a limit on the size of files: in the midst of writing, and when the buffer leaves at
 * closing. */
static void full_disk_is_told_and_the_old_file_kept(void **state)
{
    static const char *const names[] = {"a.png", "a.exr"};
    static const rlim_t limits[] = {0, 100, 5000};
    struct rlimit before;
    char path[IMAGE_FIXTURE_PATH_MAX];
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, SIG_IGN);
    for (size_t i = 0; i < 6; i++) {
        const char *name = names[i % 2];
        image_fixture_save(image_fixture_path(path, *state, name), "old", 3);
        const struct rlimit full = {limits[i / 2], before.rlim_max};
        mns_error error;
        mns_image *image = image_fixture_noise(64, 64);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &full), 0);
        mns_status status = write_to(image, path, &error);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
        mns_image_destroy(image);
        assert_int_equal(status, MNS_ERROR_IO);
        if (!strstr(error.text, path) || !strstr(error.text, "File too large")) fail_msg("%s", error.text);
        size_t size = 0;
        unsigned char *old = image_fixture_load(path, &size);
        assert_int_equal(size, 3);
        assert_memory_equal(old, "old", 3);
        free(old);
        assert_int_equal(image_fixture_count(*state), i ? 2 : 1);
    }
    signal(SIGXFSZ, SIG_DFL);
}

static void old_file_is_replaced_and_nothing_else_left(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    mns_image *image = image_fixture_noise(8, 8);
    image_fixture_save(image_fixture_path(path, *state, "a.png"), "old", 3);
    for (int i = 0; i < 3; i++) {
        png_pixels png = write_and_load(image, path);
        assert_int_equal(png.width, 8);
        free(png.level);
    }
    assert_int_equal(image_fixture_count(*state), 1);
    mns_image_destroy(image);
}

static void new_file_has_the_umask_and_the_longest_name_fits(void **state)
{
    char name[256], path[IMAGE_FIXTURE_PATH_MAX];
    struct stat status;
    mns_image *image = image_fixture_noise(8, 8);
    memset(name, 'n', 255);
    memcpy(name + 251, ".png", 5);
    mode_t before = umask(027);
    png_pixels png = write_and_load(image, image_fixture_path(path, *state, name));
    umask(before);
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(status.st_mode & 0777, 0640);
    free(png.level);
    mns_image_destroy(image);
}

static void images_that_make_no_sense_are_usage_errors(void **state)
{
    char png[IMAGE_FIXTURE_PATH_MAX], exr[IMAGE_FIXTURE_PATH_MAX];
    float rgba[4] = {1, 1, 1, 1};
    mns_error error;
    const mns_image colors_only = {.width = 1, .height = 1, .rgba = rgba}, no_pixels = {.rgba = rgba},
                    empty = {.width = 1, .height = 1};
    image_fixture_path(png, *state, "a.png");
    image_fixture_path(exr, *state, "a.exr");
    assert_int_equal(write_to(&colors_only, exr, &error), MNS_ERROR_USAGE);
    assert_non_null(strstr(error.text, "plane t"));
    assert_int_equal(write_to(&no_pixels, png, &error), MNS_ERROR_USAGE);
    assert_int_equal(write_to(&empty, png, &error), MNS_ERROR_USAGE);
    assert_int_equal(image_fixture_count(*state), 0);
    assert_int_equal(write_to(&colors_only, png, &error), MNS_OK);

    mns_image *made = NULL;
    assert_int_equal(image_create(0, 5, &made, &error), MNS_ERROR_USAGE);
    assert_int_equal(image_create(5, IMAGE_SIDE_MAX + 1, &made, &error), MNS_ERROR_USAGE);
    assert_null(made);
    mns_image_destroy(NULL);
}

int main(void)
{
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, image_fixture_setup, image_fixture_teardown)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(levels_are_srgb_of_linear),
        IN_FOLDER(known_colors_have_known_levels),
        IN_FOLDER(rows_run_from_the_top),
        IN_FOLDER(one_transparent_pixel_brings_alpha_and_straight_color),
        IN_FOLDER(png_names_its_software),
        IN_FOLDER(unknown_endings_are_usage_errors),
        IN_FOLDER(absent_folder_is_told),
        IN_FOLDER(file_as_folder_is_told),
        IN_FOLDER(folder_as_target_is_told_and_kept),
        IN_FOLDER(special_file_as_target_is_told_and_kept),
        IN_FOLDER(read_only_folder_is_told),
        IN_FOLDER(full_disk_is_told_and_the_old_file_kept),
        IN_FOLDER(old_file_is_replaced_and_nothing_else_left),
        IN_FOLDER(new_file_has_the_umask_and_the_longest_name_fits),
        IN_FOLDER(images_that_make_no_sense_are_usage_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
