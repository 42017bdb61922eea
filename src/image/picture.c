/* Reads pictures of any maker: an OpenEXR of scan lines, or a PNG through libpng's simple face. */
#include "image/picture.h"

#include "base/color.h"
#include "base/memory.h"
#include "image/exr.h"

#include <errno.h>
#include <limits.h>
#include <png.h>
#include <string.h>
#include <sys/stat.h>

/* Pixels, at most: 16384 x 8192, a map as large as any that is sold. */
#define PIXELS_MOST ((uint64_t)1 << 27)

static mns_status take_size(image_picture *picture, const char *path, int width, int height, mns_error *error)
{
    if ((uint64_t)width * (uint64_t)height > PIXELS_MOST)
        return status_fail(error, MNS_ERROR_INPUT,
                           "%s: %d x %d pixels; at most 2^27 can be read, 16384 x 8192", path, width, height);
    picture->width = width, picture->height = height;
    picture->rgb = memory_array((size_t)width * (size_t)height, 3 * sizeof *picture->rgb);
    return picture->rgb ? MNS_OK : status_no_memory(error, "reading a picture");
}

/* ---- OpenEXR ---- */

static mns_status read_exr(const char *path, image_picture *picture, mns_error *error)
{
    enum { PIXEL_BYTES = 6 }; /* three halves */
    static const char *const names[3] = {"R", "G", "B"};
    image_reader reader = {.path = path, .error = error};
    const exr_attr_chlist_t *list = NULL;
    image_channels channels = {.count = 3};
    int width = 0, height = 0;
    mns_status status = image_exr_open(&reader, false);
    if (!status) status = image_exr_size(&reader, PIXEL_BYTES, &width, &height);
    if (!status && exr_get_channels(reader.context, 0, &list) != EXR_ERR_SUCCESS)
        status = image_exr_damaged(&reader, EXR_ERR_FILE_BAD_HEADER);
    for (int i = 0; i < 3 && !status; i++) {
        const exr_attr_chlist_entry_t *found = image_exr_entry(list, names[i]);
        if (!found || found->x_sampling != 1 || found->y_sampling != 1)
            status =
                status_fail(error, MNS_ERROR_INPUT, "%s: expected channels R, G and B of every pixel", path);
    }
    if (!status) status = take_size(picture, path, width, height, error);
    for (int i = 0; i < 3; i++) channels.channel[i] = (image_channel){names[i], picture->rgb, 3, i};
    if (!status) status = image_exr_rows(&reader, width, height, &channels);
    image_exr_close(&reader);
    return status;
}

/* ---- PNG ---- */

/* A PNG's size is believed only where the file can hold it: deflate makes at most 1032 bytes of one, and a
 * pixel has at least a bit. */
static mns_status check_png(const char *path, int64_t size, const png_image *png, mns_error *error)
{
    uint64_t pixels = (uint64_t)png->width * (uint64_t)png->height;
    if (png->width <= INT_MAX && png->height <= INT_MAX && pixels <= (uint64_t)size * 1032 * 8) return MNS_OK;
    return status_fail(error, MNS_ERROR_INPUT,
                       "%s: announces %lu x %lu pixels, which its %lld bytes cannot hold", path,
                       (unsigned long)png->width, (unsigned long)png->height, (long long)size);
}

static mns_status read_png(const char *path, int64_t size, image_picture *picture, mns_error *error)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    png_byte *levels = NULL;
    float linear[256];
    mns_status status = MNS_ERROR_INPUT;
    if (!png_image_begin_read_from_file(&png, path)) {
        status_fail(error, status, "%s: not a whole PNG: %s", path, png.message);
        goto done;
    }
    png.format = PNG_FORMAT_RGB; /* of 16-bit linear light libpng has but 8 bits' worth */
    status = check_png(path, size, &png, error);
    if (!status) status = take_size(picture, path, (int)png.width, (int)png.height, error);
    if (status) goto done;
    size_t count = (size_t)png.width * (size_t)png.height * 3;
    levels = memory_array(count, sizeof *levels);
    if (!levels) {
        status = status_no_memory(error, "reading a picture");
        goto done;
    }
    if (!png_image_finish_read(&png, &(png_color){0, 0, 0}, levels, 0, NULL)) {
        status = status_fail(error, MNS_ERROR_INPUT, "%s: not a whole PNG: %s", path, png.message);
        goto done;
    }
    for (int k = 0; k < 256; k++) linear[k] = (float)color_linear(k / 255.0);
    for (size_t i = 0; i < count; i++) picture->rgb[i] = linear[levels[i]];
done:
    free(levels);
    png_image_free(&png);
    return status;
}

/* ---- Either ---- */

/* The first byte tells the format; *size is the file's. */
static mns_status look_at(const char *path, int *first, int64_t *size, mns_error *error)
{
    struct stat about;
    bool there = stat(path, &about) == 0;
    if (there && !S_ISREG(about.st_mode)) /* a pipe would be waited for */
        return status_fail(error, MNS_ERROR_IO, "%s: not a file; expected a picture, EXR or PNG", path);
    FILE *file = there ? fopen(path, "rb") : NULL;
    if (!file)
        return status_fail(error, MNS_ERROR_IO, "%s: cannot open the picture: %s", path, strerror(errno));
    *first = fgetc(file);
    *size = about.st_size;
    fclose(file);
    return MNS_OK;
}

mns_status image_picture_read(const char *path, image_picture *picture, mns_error *error)
{
    int first = 0;
    int64_t size = 0;
    *picture = (image_picture){0};
    mns_status status = look_at(path, &first, &size, error);
    if (status) return status;
    if (first == 0x76)
        status = read_exr(path, picture, error);
    else if (first == 0x89)
        status = read_png(path, size, picture, error);
    else
        status = status_fail(error, MNS_ERROR_INPUT, "%s: neither an EXR nor a PNG by its first byte", path);
    if (status) image_picture_free(picture);
    return status;
}

void image_picture_free(image_picture *picture)
{
    free(picture->rgb);
    *picture = (image_picture){0};
}
