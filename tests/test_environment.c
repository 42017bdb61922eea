/* What stands around a scene: pictures of any maker read, and looked up by direction. */
#include "effects/environment.h"
#include "image/image.h"
#include "support/cli.h"
#include "support/reference_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 8, HEIGHT = 4 };

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

static void path_of(const cli *c, const char *name, char path[200])
{
    snprintf(path, 200, "%s/%s", c->folder, name);
}

/* A map whose texel (x, y) is (x, y, 1/2) / 8, written by ourselves. */
static void write_map(const char *path)
{
    mns_image *image;
    mns_error error;
    assert_int_equal(image_create(WIDTH, HEIGHT, &image, &error), MNS_OK);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const float rgba[4] = {(float)(i % WIDTH) / 8, (float)(i - i % WIDTH) / 64, 0.0625f, 1};
        memcpy(image->rgba + 4 * i, rgba, sizeof rgba);
        memset(image->normal + 3 * i, 0, 3 * sizeof(float));
        image->t[i] = image->t_lo[i] = image->certain[i] = 0;
    }
    if (mns_image_write(image, path, &error)) fail_msg("%s", error.text);
    mns_image_destroy(image);
}

static void pictures_are_read_as_linear_light(void **state)
{
    const char *const names[] = {"map.exr", "map.png"};
    for (int k = 0; k < 2; k++) {
        char path[200];
        mns_error error;
        image_picture picture;
        path_of(*state, names[k], path);
        write_map(path);
        if (image_picture_read(path, &picture, &error)) fail_msg("%s", error.text);
        assert_true(picture.width == WIDTH && picture.height == HEIGHT);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const double want[3] = {(i % WIDTH) / 8.0, (i - i % WIDTH) / 64.0, 0.0625};
            /* A step of 8-bit sRGB is at most 0.009 of linear light. */
            for (int c = 0; c < 3; c++)
                fixture_expect_close((double)picture.rgb[3 * i + c], want[c], k ? 0.005 : 0);
        }
        image_picture_free(&picture);
    }
}

static void refuse(const char *path, mns_status status, const char *word)
{
    image_picture picture = {.width = 7};
    mns_error error = {0};
    assert_int_equal(image_picture_read(path, &picture, &error), status);
    if (!strstr(error.text, word)) fail_msg("%s: not said: %s", error.text, word);
    assert_null(picture.rgb);
}

static void cut(const cli *c, const char *from, const char *to, size_t bytes)
{
    char path[200];
    size_t size;
    char *text = cli_read(c, from, &size);
    path_of(c, to, path);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, bytes < size ? bytes : size, file), bytes < size ? bytes : size);
    fclose(file);
    free(text);
}

static void other_files_are_refused(void **state)
{
    const cli *c = *state;
    char path[200];
    path_of(c, "none.exr", path);
    refuse(path, MNS_ERROR_IO, "No such file");
    refuse(c->folder, MNS_ERROR_IO, "not a file; expected a picture");
    cli_write(c, "text.exr", "hello");
    path_of(c, "text.exr", path);
    refuse(path, MNS_ERROR_INPUT, "neither an EXR nor a PNG");
    for (int k = 0; k < 2; k++) {
        const char *whole = k ? "a.png" : "a.exr", *part = k ? "b.png" : "b.exr";
        path_of(c, whole, path);
        write_map(path);
        const size_t lengths[] = {1, 4, 20, 40, 90};
        for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
            cut(c, whole, part, lengths[i]);
            path_of(c, part, path);
            refuse(path, MNS_ERROR_INPUT, part);
        }
    }
}

/* A PNG's header that announces 2^20 squared pixels, checked sum and all, and nothing behind it. */
static void a_size_is_not_believed(void **state)
{
    static const unsigned char bytes[] = {0x89, 'P',  'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0,
                                          0,    13,   'I', 'H', 'D',  'R',  0,    0x08, 0, 0,
                                          0,    0x08, 0,   0,   8,    2,    0,    0,    0};
    unsigned crc = 0xffffffffu;
    for (size_t i = 12; i < sizeof bytes; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    crc ^= 0xffffffffu;
    const unsigned char rest[] = {(unsigned char)(crc >> 24),
                                  (unsigned char)(crc >> 16),
                                  (unsigned char)(crc >> 8),
                                  (unsigned char)crc,
                                  0,
                                  0,
                                  0,
                                  0,
                                  'I',
                                  'D',
                                  'A',
                                  'T',
                                  0x35,
                                  0xaf,
                                  0x06,
                                  0x1e};
    char path[200];
    path_of(*state, "huge.png", path);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(bytes, 1, sizeof bytes, file);
    fwrite(rest, 1, sizeof rest, file);
    fclose(file);
    refuse(path, MNS_ERROR_INPUT, "huge.png");
}

static void expect_color(const environment *e, vec3 way, double x, double y)
{
    double color[3];
    environment_color(e, vec3_unit(way), color);
    fixture_expect_close(color[0], x / 8, 1e-6);
    fixture_expect_close(color[1], y / 8, 1e-6);
    fixture_expect_close(color[2], 0.0625, 1e-6);
}

/* Columns run from behind over the left, the middle straight ahead, to the right; rows from the top down. */
static void maps_are_the_right_way_up(void **state)
{
    const double ups[][3] = {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}};
    char path[200];
    path_of(*state, "map.exr", path);
    write_map(path);
    fixture_balls b = {.count = 0};
    fixture_add(&b, 0, 0, 0, 1, 1);
    mns_field *field = fixture_field(&b, MNS_KERNEL_POLY3, 0.2);
    for (size_t i = 0; i < sizeof ups / sizeof *ups; i++) {
        mns_view view = {.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT, .eye = {3, 4, 5}};
        mns_look look = {.effects = {.environment = path}};
        mns_options options = {.method = MNS_METHOD_REFERENCE};
        mns_plan *plan;
        mns_error error;
        environment e;
        memcpy(view.up, ups[i], sizeof view.up);
        if (mns_plan_create(field, &view, &look, &options, NULL, &plan, &error)) fail_msg("%s", error.text);
        if (environment_begin(&e, plan, &error)) fail_msg("%s", error.text);
        fixture_expect_close(vec3_dot(e.up, vec3_load(ups[i])), 1, 1e-15);
        fixture_expect_close(vec3_length(vec3_sub(vec3_cross(e.right, e.up), e.back)), 0, 1e-15);
        if (i == 0) {
            const double eighth = 0.41421356237309503; /* tangent of the eighth of a half turn */
            expect_color(&e, (vec3){eighth, 0, -1}, 4, 1.5);
            expect_color(&e, (vec3){-eighth, 0, -1}, 3, 1.5);
            expect_color(&e, (vec3){0, 0, -1}, 3.5, 1.5);
            expect_color(&e, (vec3){eighth, 0, 1}, 7, 1.5);
            expect_color(&e, (vec3){0, 0, 1}, 3.5, 1.5); /* between the last and the first */
            expect_color(&e, (vec3){-eighth, 0, 1}, 0, 1.5);
            expect_color(&e, (vec3){eighth, vec3_length((vec3){eighth, 0, -1}) * eighth, -1}, 4, 1);
        } else {
            double color[3];
            environment_color(&e, vec3_load(ups[i]), color);
            fixture_expect_close(color[1], 0, 1e-6);
        }
        environment_end(&e);
        mns_plan_destroy(plan);
    }
    mns_field_destroy(field);
}

static void the_sky_is_blue_above_and_bright_where_the_light_is(void **state)
{
    (void)state;
    const environment e = {.sky = true, .right = {1, 0, 0}, .up = {0, 1, 0}, .back = {0, 0, 1}};
    double up[3], down[3], ahead[3], light[3];
    environment_color(&e, (vec3){0, 1, 0}, up);
    environment_color(&e, (vec3){0, -1, 0}, down);
    environment_color(&e, (vec3){0, 0, -1}, ahead);
    environment_color(&e, vec3_unit((vec3){1, 2, 1.5}), light);
    assert_true(up[2] > 2 * up[0] && ahead[2] < 1.5 * ahead[0] && down[2] < ahead[2]);
    assert_true(light[0] > 4 && light[1] > 4);
    for (int c = 0; c < 3; c++) { /* no seam at the horizon */
        double above[3], below[3];
        environment_color(&e, vec3_unit((vec3){0.3, 1e-9, -1}), above);
        environment_color(&e, vec3_unit((vec3){0.3, -1e-9, -1}), below);
        fixture_expect_close(above[c], below[c], 1e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_read_as_linear_light),
        cmocka_unit_test(other_files_are_refused),
        cmocka_unit_test(a_size_is_not_believed),
        cmocka_unit_test(maps_are_the_right_way_up),
        cmocka_unit_test(the_sky_is_blue_above_and_bright_where_the_light_is),
    };
    return cmocka_run_group_tests_name("environment", tests, setup, teardown);
}
