#include "compare/pictures.h"

#include "base/memory.h"
#include "base/status.h"
#include "compare/metrics.h"
#include "compare/png_memory.h"
#include "image/image.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct color {
    unsigned char r, g, b;
} color;

/* Told apart by lightness too. */
const char *const PICTURES_MASK_COLOR[METRICS_MASK_COUNT] = {
    [METRICS_MASK_NONE] = "#ffffff",      [METRICS_MASK_BOTH] = "#c9d3dc",
    [METRICS_MASK_MISSED] = "#d1242f",    [METRICS_MASK_INVENTED] = "#0969da",
    [METRICS_MASK_UNDECIDED] = "#e3b341",
};

static const color NOTHING = {0xd8, 0xd8, 0xd8}; /* where there is no difference to show */

static color color_of(const char *hex)
{
    unsigned value = (unsigned)strtoul(hex + 1, NULL, 16);
    return (color){(unsigned char)(value >> 16), (unsigned char)(value >> 8), (unsigned char)value};
}

static unsigned char level(double linear)
{
    double v = fmin(fmax(linear, 0), 1); /* IEC 61966-2-1 */
    return (unsigned char)lround(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055));
}

/* What the page shows behind the surface where it is not opaque is white. */
static color shaded(const float rgba[4])
{
    double white = fmin(fmax(1 - rgba[3], 0), 1);
    return (color){level(rgba[0] + white), level(rgba[1] + white), level(rgba[2] + white)};
}

/* From blue over white to red as v goes from -1 to 1. */
static color diverging(double v)
{
    const double end[2][3] = {{33, 102, 172}, {178, 24, 43}};
    double weight = fmin(fabs(v), 1), part[3];
    for (int c = 0; c < 3; c++) part[c] = 247 + weight * (end[v > 0][c] - 247);
    return (color){(unsigned char)lround(part[0]), (unsigned char)lround(part[1]),
                   (unsigned char)lround(part[2])};
}

/* -1 to 1: the signed difference on a scale that is logarithmic beyond a hundredth of the range. */
static double depth_position(const truth_planes *truth, double t, double true_t)
{
    const double knee = 100 / PICTURES_DEPTH_RANGE;
    double unit = truth->has_view ? metrics_footprint(&truth->view, true_t) : 1e-3 * true_t;
    return asinh((t - true_t) / unit * knee) / asinh(PICTURES_DEPTH_RANGE * knee);
}

static color depth_color(const truth_planes *truth, const mns_image *image, size_t i)
{
    if (metrics_mask_of(truth, image, i) != METRICS_MASK_BOTH) return NOTHING;
    return diverging(depth_position(truth, image_distance(image, i), truth->t[i]));
}

static color mask_color(const truth_planes *truth, const mns_image *image, size_t i)
{
    return color_of(PICTURES_MASK_COLOR[metrics_mask_of(truth, image, i)]);
}

static color image_color(const truth_planes *truth, const mns_image *image, size_t i)
{
    return shaded((image ? image->rgba : truth->rgba) + 4 * i);
}

typedef color pixel_color(const truth_planes *truth, const mns_image *image, size_t i);

static mns_status add(picture_list *list, const char *run, const char *kind, const truth_planes *truth,
                      const mns_image *image, pixel_color *of, mns_error *error)
{
    size_t pixels = (size_t)truth->width * (size_t)truth->height;
    if (list->count == list->capacity) {
        size_t capacity = 2 * list->capacity + 8;
        page_picture *bigger = memory_resize(list->picture, capacity, sizeof *bigger);
        if (!bigger) return status_no_memory(error, "making pictures");
        list->picture = bigger;
        list->capacity = capacity;
    }
    color *rgb = memory_array(pixels, sizeof *rgb);
    if (!rgb) return status_no_memory(error, "making pictures");
    for (size_t i = 0; i < pixels; i++) rgb[i] = of(truth, image, i);
    unsigned char *png;
    size_t size;
    mns_status status = png_encode(&rgb->r, truth->width, truth->height, &png, &size, error);
    free(rgb);
    if (!status) list->picture[list->count++] = (page_picture){run, kind, png, size};
    return status;
}

mns_status pictures_add(picture_list *list, const char *run, const truth_planes *truth,
                        const mns_image *image, mns_error *error)
{
    mns_status status = MNS_OK;
    if (image ? image->rgba != NULL : truth->rgba != NULL)
        status = add(list, run, "image", truth, image, image_color, error);
    if (!status && image) status = add(list, run, "depth", truth, image, depth_color, error);
    if (!status && image) status = add(list, run, "mask", truth, image, mask_color, error);
    return status;
}

void pictures_free(picture_list *list)
{
    for (size_t i = 0; i < list->count; i++) free((void *)list->picture[i].png);
    free(list->picture);
    *list = (picture_list){0};
}
