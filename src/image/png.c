/* PNG: linear premultiplied float to 8-bit sRGB, with alpha where any pixel is not opaque. */
#include "base/color.h"
#include "base/memory.h"
#include "image/image.h"
#include "image/output.h"

#include <errno.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <string.h>

#define TEXT_OF(number)                   #number
#define VERSION_TEXT(major, minor, patch) TEXT_OF(major) "." TEXT_OF(minor) "." TEXT_OF(patch)

enum { LEVELS = 256 };

/* What libpng's call-backs share with the writer. */
typedef struct image_sink {
    FILE *file;
    int code;          /* errno of a failed write */
    char message[128]; /* libpng's own words */
} image_sink;

/* The linear value at which the rounded sRGB level becomes k, for k = 1..255: inverse transfer of (k - 1/2) /
 * 255. A search in it is the rounded transfer function itself, with no power a pixel. */
static void level_starts(double start[LEVELS])
{
    start[0] = -INFINITY;
    for (int k = 1; k < LEVELS; k++) start[k] = color_linear((k - 0.5) / 255);
}

/* The last level that starts at or below `linear`; 0 for a NaN. */
static png_byte level_of(const double start[LEVELS], double linear)
{
    int level = 0;
    for (int step = LEVELS / 2; step; step /= 2)
        if (linear >= start[level + step]) level += step;
    return (png_byte)level;
}

static png_byte alpha_level(float alpha)
{
    if (!(alpha > 0)) return 0;
    return alpha < 1 ? (png_byte)lround(255.0 * alpha) : 255;
}

static bool is_opaque(const mns_image *image)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++)
        if (alpha_level(image->rgba[4 * i + 3]) != 255) return false;
    return true;
}

static void encode_row(const mns_image *image, int y, bool opaque, const double start[LEVELS], png_byte *row)
{
    const float *pixel = image->rgba + (size_t)y * (size_t)image->width * 4;
    for (int x = 0; x < image->width; x++, pixel += 4) {
        double scale = pixel[3] > 0 ? 1.0 / pixel[3] : 0;
        for (int c = 0; c < 3; c++) *row++ = level_of(start, pixel[c] * scale);
        if (!opaque) *row++ = alpha_level(pixel[3]);
    }
}

static void on_error(png_structp png, png_const_charp message)
{
    image_sink *sink = png_get_error_ptr(png);
    snprintf(sink->message, sizeof sink->message, "%s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png, (void)message; /* the library does not print */
}

static void on_write(png_structp png, png_bytep bytes, size_t size)
{
    image_sink *sink = png_get_io_ptr(png);
    if (fwrite(bytes, 1, size, sink->file) == size) return;
    sink->code = errno ? errno : EIO;
    png_error(png, "write failed");
}

static void on_flush(png_structp png)
{
    (void)png; /* closing flushes, and its failure is seen there */
}

static void write_header(png_structp png, png_infop info, const mns_image *image, bool opaque)
{
    char key[] = "Software",
         text[] = "meniscus " VERSION_TEXT(MNS_VERSION_MAJOR, MNS_VERSION_MINOR, MNS_VERSION_PATCH);
    png_text software = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = key, .text = text};
    png_set_user_limits(png, IMAGE_SIDE_MAX, IMAGE_SIDE_MAX); /* libpng's own stop at a million */
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_text(png, info, &software, 1);
    png_write_info(png, info);
}

/* Everything that libpng may jump out of; false when it did. No local of this function changes after setjmp.
 */
static bool write_all(png_structp png, png_infop info, const mns_image *image, bool opaque, png_byte *row)
{
    double start[LEVELS];
    level_starts(start);
    if (setjmp(png_jmpbuf(png))) return false;
    write_header(png, info, image, opaque);
    for (int y = 0; y < image->height; y++) {
        encode_row(image, y, opaque, start, row);
        png_write_row(png, row);
    }
    png_write_end(png, info);
    return true;
}

mns_status image_write_png(const mns_image *image, FILE *file, const char *path, mns_error *error)
{
    image_sink sink = {.file = file};
    bool opaque = is_opaque(image);
    mns_status status = MNS_OK;
    png_infop info = NULL;
    png_byte *row = memory_array((size_t)image->width, opaque ? 3 : 4);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, on_error, on_warning);
    if (png) info = png_create_info_struct(png);
    if (!row || !info) {
        status = status_no_memory(error, "writing a PNG");
        goto done;
    }
    png_set_write_fn(png, &sink, on_write, on_flush);
    if (!write_all(png, info, image, opaque, row))
        status = sink.code
                     ? output_failed(path, sink.code, error)
                     : status_fail(error, MNS_ERROR_IO, "%s: cannot write: libpng: %s", path, sink.message);
done:
    png_destroy_write_struct(&png, &info);
    free(row);
    return status;
}
