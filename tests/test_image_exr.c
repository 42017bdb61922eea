/* EXR files: what is written comes back bit for bit, and what is damaged is refused. */
#include "image/image.h"
#include "support/image_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <OpenEXR/openexr.h>
#include <cmocka.h>

static void write_image(const mns_image *image, const char *path)
{
    mns_error error = {0};
    if (mns_image_write(image, path, &error) != MNS_OK) fail_msg("%s", error.text);
}

static void assert_same_bits(const mns_image *a, const mns_image *b)
{
    size_t pixels = (size_t)a->width * (size_t)a->height;
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_memory_equal(a->rgba, b->rgba, 4 * pixels * sizeof(float));
    assert_memory_equal(a->t, b->t, pixels * sizeof(float));
    assert_memory_equal(a->t_lo, b->t_lo, pixels * sizeof(float));
    assert_memory_equal(a->normal, b->normal, 3 * pixels * sizeof(float));
    assert_memory_equal(a->certain, b->certain, pixels * sizeof(float));
}

static void round_trip(const mns_image *image, const char *path)
{
    mns_image *back = NULL;
    mns_error error = {0};
    write_image(image, path);
    if (mns_image_read(path, &back, &error) != MNS_OK) fail_msg("%s", error.text);
    assert_same_bits(image, back);
    mns_image_destroy(back);
}

static void values_come_back_bit_for_bit(void **state)
{
    /* rows in a ZIP chunk: 16; so one short of it, exactly it, past it, and single rows and columns */
    static const int sizes[][2] = {{1, 1}, {1, 40}, {40, 1}, {37, 15}, {37, 16}, {37, 17}, {130, 101}};
    char path[IMAGE_FIXTURE_PATH_MAX];
    image_fixture_path(path, *state, "noise.exr");
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        mns_image *image = image_fixture_noise(sizes[i][0], sizes[i][1]);
        round_trip(image, path);
        mns_image_destroy(image);
    }
    assert_int_equal(image_fixture_count(*state), 1);
}

static void even_images_compress(void **state)
{
    enum { SIDE = 256 };
    char path[IMAGE_FIXTURE_PATH_MAX];
    size_t size = 0;
    mns_image *image = image_fixture_noise(SIDE, SIDE);
    for (int i = 0; i < SIDE * SIDE; i++) {
        image->t[i] = 2.5f, image->t_lo[i] = 0, image->certain[i] = 1;
        for (int c = 0; c < 4; c++) image->rgba[4 * i + c] = 1;
        for (int c = 0; c < 3; c++) image->normal[3 * i + c] = c == 2;
    }
    round_trip(image, image_fixture_path(path, *state, "even.exr"));
    free(image_fixture_load(path, &size));
    assert_true(size < SIDE * SIDE * 40 / 20);
    mns_image_destroy(image);
}

static void same_image_gives_the_same_bytes(void **state)
{
    char a[IMAGE_FIXTURE_PATH_MAX], b[IMAGE_FIXTURE_PATH_MAX];
    size_t size_a = 0, size_b = 0;
    mns_image *image = image_fixture_noise(50, 40);
    write_image(image, image_fixture_path(a, *state, "a.exr"));
    write_image(image, image_fixture_path(b, *state, "b.EXR"));
    unsigned char *bytes_a = image_fixture_load(a, &size_a), *bytes_b = image_fixture_load(b, &size_b);
    assert_int_equal(size_a, size_b);
    assert_memory_equal(bytes_a, bytes_b, size_a);
    free(bytes_a);
    free(bytes_b);
    mns_image_destroy(image);
}

/* Reading `path` fails with `status`, and the message names the path and holds `expected`. */
static void assert_refused(const char *path, mns_status status, const char *expected)
{
    mns_image *image = NULL;
    mns_error error = {0};
    mns_status got = mns_image_read(path, &image, &error);
    assert_null(image);
    if (got != status || error.status != status || !strstr(error.text, path) || !strstr(error.text, expected))
        fail_msg("status %d, expected %d and \"%s\", got: %s", got, status, expected, error.text);
}

static void what_is_no_file_is_refused(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    assert_refused(image_fixture_path(path, *state, "absent.exr"), MNS_ERROR_IO, "No such file");
    assert_refused(*state, MNS_ERROR_IO, "Is a directory");
    assert_refused("/dev/null", MNS_ERROR_IO, "not a regular file");
}

static void what_is_no_exr_is_refused(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    image_fixture_save(image_fixture_path(path, *state, "empty.exr"), "", 0);
    assert_refused(path, MNS_ERROR_INPUT, "not an EXR file");
    image_fixture_save(image_fixture_path(path, *state, "text.exr"), "x,y,z\n1,2,3\n", 12);
    assert_refused(path, MNS_ERROR_INPUT, "76 2f 31 01");
    image_fixture_save(image_fixture_path(path, *state, "magic.exr"), "\x76\x2f\x31\x01", 4);
    assert_refused(path, MNS_ERROR_INPUT, "not a whole EXR file");
}

static void every_truncation_is_refused(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    size_t size = 0;
    mns_image *image = image_fixture_noise(9, 35);
    write_image(image, image_fixture_path(path, *state, "whole.exr"));
    unsigned char *bytes = image_fixture_load(path, &size);
    image_fixture_path(path, *state, "cut.exr");
    for (size_t cut = 4; cut < size; cut += cut < 700 ? 1 : 53) {
        image_fixture_save(path, bytes, cut);
        assert_refused(path, MNS_ERROR_INPUT, "not a whole EXR file");
    }
    image_fixture_save(path, bytes, size - 1);
    assert_refused(path, MNS_ERROR_INPUT, "not a whole EXR file");
    free(bytes);
    mns_image_destroy(image);
}

/* A byte changed anywhere may be refused or read as another picture, but nothing worse. */
static void changed_bytes_do_no_harm(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    size_t size = 0;
    uint32_t seed = 12345;
    mns_image *image = image_fixture_noise(9, 19);
    write_image(image, image_fixture_path(path, *state, "whole.exr"));
    unsigned char *bytes = image_fixture_load(path, &size);
    image_fixture_path(path, *state, "changed.exr");
    for (size_t at = 4; at < size; at += at < 700 ? 1 : 41) {
        unsigned char before = bytes[at];
        seed = seed * 1664525u + 1013904223u;
        bytes[at] ^= (unsigned char)(1 + (seed >> 24) % 255);
        image_fixture_save(path, bytes, size);
        bytes[at] = before;
        mns_image *back = NULL;
        mns_error error = {0};
        mns_status status = mns_image_read(path, &back, &error);
        assert_true((status == MNS_OK) == (back != NULL));
        if (status != MNS_OK) assert_non_null(strstr(error.text, path));
        mns_image_destroy(back);
    }
    free(bytes);
    mns_image_destroy(image);
}

/* Where the data of an attribute begin in a header. */
static unsigned char *find_attribute(unsigned char *bytes, size_t size, const char *name, const char *type)
{
    size_t name_size = strlen(name) + 1, type_size = strlen(type) + 1;
    for (size_t i = 0; i + name_size + type_size + 4 < size; i++)
        if (!memcmp(bytes + i, name, name_size) && !memcmp(bytes + i + name_size, type, type_size))
            return bytes + i + name_size + type_size + 4;
    fail_msg("no attribute %s", name);
    return NULL;
}

static void huge_sizes_are_refused_before_allocating(void **state)
{
    static const int32_t corners[][2] = {{INT32_MAX, INT32_MAX}, {1000000, 1000000}, {99999, 99999},
                                         {8, 1000000},           {1000000, 18},      {-5, 3}};
    char path[IMAGE_FIXTURE_PATH_MAX];
    size_t size = 0;
    mns_image *image = image_fixture_noise(9, 19);
    write_image(image, image_fixture_path(path, *state, "huge.exr"));
    unsigned char *bytes = image_fixture_load(path, &size);
    unsigned char *window = find_attribute(bytes, size, "dataWindow", "box2i");
    for (size_t i = 0; i < sizeof corners / sizeof *corners; i++) {
        memcpy(window + 8, corners[i], 8); /* the far corner, x and y */
        image_fixture_save(path, bytes, size);
        assert_refused(path, MNS_ERROR_INPUT, "");
    }
    free(bytes);
    mns_image_destroy(image);
}

static void absent_channel_is_named(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    size_t size = 0;
    mns_image *image = image_fixture_noise(9, 19);
    write_image(image, image_fixture_path(path, *state, "lacks.exr"));
    unsigned char *bytes = image_fixture_load(path, &size);
    unsigned char *list = find_attribute(bytes, size, "channels", "chlist");
    unsigned char *entry = memmem(list, 300, "certain", 8);
    assert_non_null(entry);
    entry[0] = 'd'; /* still in the order of names */
    image_fixture_save(path, bytes, size);
    assert_refused(path, MNS_ERROR_INPUT, "channel certain");
    free(bytes);
    mns_image_destroy(image);
}

static int64_t write_to_file(exr_const_context_t context, void *file, const void *bytes, uint64_t size,
                             uint64_t offset, exr_stream_error_func_ptr_t report)
{
    (void)context, (void)report;
    assert_int_equal(fseeko(file, (off_t)offset, SEEK_SET), 0);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    return (int64_t)size;
}

/* Writes a file of another program's making, without pixels: to a stream, as OpenEXR itself would remove it
 * at the end. */
static void write_foreign(const char *path, exr_storage_t storage, exr_compression_t compression,
                          exr_pixel_type_t type)
{
    static const char *const names[] = {"A", "B", "G", "N.X", "N.Y", "N.Z", "R", "certain", "t", "t.lo"};
    exr_context_t context = NULL;
    int part = 0;
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    initializer.write_fn = write_to_file;
    initializer.user_data = file;
    assert_int_equal(exr_start_write(&context, path, EXR_WRITE_FILE_DIRECTLY, &initializer), EXR_ERR_SUCCESS);
    assert_int_equal(exr_add_part(context, "foreign", storage, &part), EXR_ERR_SUCCESS);
    assert_int_equal(exr_initialize_required_attr_simple(context, part, 4, 4, compression), EXR_ERR_SUCCESS);
    if (storage == EXR_STORAGE_TILED)
        assert_int_equal(
            exr_set_tile_descriptor(context, part, 4, 4, EXR_TILE_ONE_LEVEL, EXR_TILE_ROUND_DOWN), 0);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        assert_int_equal(exr_add_channel(context, part, names[i], type, EXR_PERCEPTUALLY_LINEAR, 1, 1), 0);
    assert_int_equal(exr_write_header(context), EXR_ERR_SUCCESS);
    exr_finish(&context);
    assert_int_equal(fclose(file), 0);
}

static void foreign_layouts_are_refused(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    image_fixture_path(path, *state, "foreign.exr");
    write_foreign(path, EXR_STORAGE_SCANLINE, EXR_COMPRESSION_PIZ, EXR_PIXEL_FLOAT);
    assert_refused(path, MNS_ERROR_INPUT, "expected ZIP");
    write_foreign(path, EXR_STORAGE_SCANLINE, EXR_COMPRESSION_ZIP, EXR_PIXEL_HALF);
    assert_refused(path, MNS_ERROR_INPUT, "float32");
    write_foreign(path, EXR_STORAGE_TILED, EXR_COMPRESSION_ZIP, EXR_PIXEL_FLOAT);
    assert_refused(path, MNS_ERROR_INPUT, "scan lines");
    write_foreign(path, EXR_STORAGE_SCANLINE, EXR_COMPRESSION_ZIP, EXR_PIXEL_FLOAT);
    assert_refused(path, MNS_ERROR_INPUT, "not a whole EXR file");
}

int main(void)
{
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, image_fixture_setup, image_fixture_teardown)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(values_come_back_bit_for_bit),    IN_FOLDER(even_images_compress),
        IN_FOLDER(same_image_gives_the_same_bytes), IN_FOLDER(what_is_no_file_is_refused),
        IN_FOLDER(what_is_no_exr_is_refused),       IN_FOLDER(every_truncation_is_refused),
        IN_FOLDER(changed_bytes_do_no_harm),        IN_FOLDER(huge_sizes_are_refused_before_allocating),
        IN_FOLDER(absent_channel_is_named),         IN_FOLDER(foreign_layouts_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
