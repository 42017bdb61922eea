/* difference A.exr B.exr WINDOW.png SCALE: whether a window that shows the difference of two pictures has at
 * every pixel the colour that their distances ask for. Prints what it counted; exit status 1 where it has
 * not, or where they show too little to tell. */
#include "base/color.h"
#include "meniscus.h"

#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>

enum { LEVELS_OFF = 2, ENOUGH = 1000 };

typedef struct counts {
    size_t wrong, missed, alone, far, near; /* far and near: neither of them in full */
} counts;

/* Linear, as README says: red where B is farther, blue where it is nearer; yellow and magenta: A, B alone. */
static void expected(const mns_image *a, const mns_image *b, size_t i, double scale, double rgb[3], counts *c)
{
    static const double missed[3] = {0.05, 0.05, 0.05}, a_alone[3] = {0.9, 0.7, 0},
                        b_alone[3] = {0.8, 0, 0.6}, red[3] = {0.8, 0, 0}, blue[3] = {0, 0.1, 0.8};
    bool hit_a = isfinite(a->t[i]), hit_b = isfinite(b->t[i]);
    const double *end = !hit_a && !hit_b ? missed : hit_a ? a_alone : b_alone;
    double part = 1;
    if (hit_a && hit_b) {
        double apart = ((double)b->t[i] - a->t[i] + ((double)b->t_lo[i] - a->t_lo[i])) / scale;
        end = apart > 0 ? red : blue;
        part = fmin(fabs(apart), 1);
        if (part > 0.02 && part < 0.98) (*(apart > 0 ? &c->far : &c->near))++;
    } else {
        (*(hit_a || hit_b ? &c->alone : &c->missed))++;
    }
    for (int k = 0; k < 3; k++) rgb[k] = 0.9 + part * (end[k] - 0.9);
}

static counts compare(const mns_image *a, const mns_image *b, const unsigned char *window, double scale)
{
    counts c = {0};
    for (size_t i = 0; i < (size_t)a->width * (size_t)a->height; i++) {
        double rgb[3];
        bool good = true;
        expected(a, b, i, scale, rgb, &c);
        for (size_t k = 0; k < 3; k++) {
            int level = window[3 * i + k];
            good = good && rgb[k] >= color_linear(fmax(level - LEVELS_OFF, 0) / 255) - 1e-12 &&
                   rgb[k] <= color_linear((level + LEVELS_OFF) / 255.0);
        }
        if (!good) c.wrong++;
    }
    return c;
}

static unsigned char *read_window(const char *path, int width, int height)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&png, path)) return NULL;
    png.format = PNG_FORMAT_RGB;
    unsigned char *bytes = malloc(PNG_IMAGE_SIZE(png));
    bool fits = png.width == (unsigned)width && png.height == (unsigned)height;
    if (bytes && fits && png_image_finish_read(&png, NULL, bytes, 0, NULL)) return bytes;
    png_image_free(&png);
    free(bytes);
    return NULL;
}

int main(int argc, char **argv)
{
    mns_image *a = NULL, *b = NULL;
    mns_error error = {.text = "expected A.exr B.exr WINDOW.png SCALE"};
    int result = 1;
    if (argc != 5 || mns_image_read(argv[1], &a, &error) || mns_image_read(argv[2], &b, &error)) {
        fprintf(stderr, "difference: %s\n", error.text);
        goto fail;
    }
    unsigned char *window = read_window(argv[3], a->width, a->height);
    if (!window || b->width != a->width || b->height != a->height) {
        fprintf(stderr, "difference: %s: expected a picture of %dx%d\n", argv[3], a->width, a->height);
    } else {
        counts c = compare(a, b, window, strtod(argv[4], NULL));
        printf("%zu wrong; %zu missed, %zu hit alone, %zu farther, %zu nearer\n", c.wrong, c.missed, c.alone,
               c.far, c.near);
        result = c.wrong || c.missed < ENOUGH || c.far + c.near < ENOUGH;
    }
    free(window);
fail:
    mns_image_destroy(a);
    mns_image_destroy(b);
    return result;
}
