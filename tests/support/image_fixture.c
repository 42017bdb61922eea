#include "support/image_fixture.h"

#include "image/image.h"

#include <dirent.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

int image_fixture_setup(void **state)
{
    const char *base = getenv("TMPDIR");
    char *folder = malloc(IMAGE_FIXTURE_PATH_MAX);
    if (!folder) return -1;
    snprintf(folder, IMAGE_FIXTURE_PATH_MAX, "%s/meniscus-test-XXXXXX", base && *base ? base : "/tmp");
    *state = folder;
    return mkdtemp(folder) ? 0 : -1;
}

int image_fixture_teardown(void **state)
{
    char path[IMAGE_FIXTURE_PATH_MAX];
    DIR *listing = opendir(*state);
    struct dirent *entry;
    while (listing && (entry = readdir(listing))) {
        if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..")) continue;
        remove(image_fixture_path(path, *state, entry->d_name));
    }
    if (listing) closedir(listing);
    int failed = rmdir(*state);
    free(*state);
    return failed;
}

const char *image_fixture_path(char buffer[IMAGE_FIXTURE_PATH_MAX], const char *folder, const char *name)
{
    int length = snprintf(buffer, IMAGE_FIXTURE_PATH_MAX, "%s/%s", folder, name);
    assert_in_range(length, 1, IMAGE_FIXTURE_PATH_MAX - 1);
    return buffer;
}

int image_fixture_count(const char *folder)
{
    int count = 0;
    DIR *listing = opendir(folder);
    assert_non_null(listing);
    while (readdir(listing)) count++;
    closedir(listing);
    return count - 2;
}

static uint32_t next(uint32_t *seed)
{
    *seed ^= *seed << 13, *seed ^= *seed >> 17, *seed ^= *seed << 5;
    return *seed;
}

static void fill(float *values, size_t count, uint32_t seed)
{
    static const float odd[] = {INFINITY, 0.0f, -0.0f, FLT_MAX, -FLT_MAX, FLT_MIN, 1e-42f, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        uint32_t bits = next(&seed);
        values[i] = bits % 7 ? (float)((double)bits / 4294967296.0) : odd[bits / 7 % 8];
    }
}

mns_image *image_fixture_noise(int width, int height)
{
    mns_image *image = NULL;
    mns_error error = {0};
    size_t pixels = (size_t)width * (size_t)height;
    if (image_create(width, height, &image, &error) != MNS_OK) fail_msg("%s", error.text);
    fill(image->rgba, 4 * pixels, 1);
    fill(image->t, pixels, 2);
    fill(image->t_lo, pixels, 3);
    fill(image->normal, 3 * pixels, 4);
    for (size_t i = 0; i < pixels; i++) image->rgba[4 * i + 3] = 1, image->certain[i] = i % 3 != 0;
    return image;
}

unsigned char *image_fixture_load(const char *path, size_t *size)
{
    struct stat status;
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fstat(fileno(file), &status), 0);
    *size = (size_t)status.st_size;
    unsigned char *bytes = malloc(*size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

void image_fixture_save(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}
