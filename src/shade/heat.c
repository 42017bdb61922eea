/* Counts of work as a picture, as Forcier & Wang 2017 show the iterations of a solver. */
#include "base/memory.h"
#include "base/status.h"
#include "image/image.h"
#include "shade/palette.h"
#include "shade/shade.h"

#include <math.h>
#include <string.h>

static int ascending(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The count that one pixel in a thousand passes; at least 1. */
static mns_status find_most(const mns_image *image, mns_work count, double *most, mns_error *error)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    float *sorted = memory_array(pixels, sizeof *sorted);
    if (!sorted) return status_no_memory(error, "drawing a heat map");
    for (size_t i = 0; i < pixels; i++) sorted[i] = image->work[i * MNS_WORK_COUNT + (size_t)count];
    qsort(sorted, pixels, sizeof *sorted, ascending);
    *most = fmax(1, (double)sorted[pixels - 1 - pixels / 1000]);
    free(sorted);
    return MNS_OK;
}

static void paint(double place, mns_color_map map, float rgba[4])
{
    const uint32_t *anchor = palette_map(map);
    double at = fmin(fmax(place, 0), 1) * (PALETTE_ANCHORS - 1);
    int low = at < PALETTE_ANCHORS - 2 ? (int)at : PALETTE_ANCHORS - 2;
    for (int c = 0; c < 3; c++) {
        int shift = 16 - 8 * c;
        double a = anchor[low] >> shift & 255, b = anchor[low + 1] >> shift & 255;
        rgba[c] = shade_linear((a + (b - a) * (at - low)) / 255);
    }
    rgba[3] = 1;
}

mns_status mns_image_heat(const mns_image *image, mns_work count, mns_color_map map, mns_image **heat,
                          double *most, mns_error *error)
{
    double top = 1;
    mns_image *made = NULL;
    if (!image || !heat || !image->work || (unsigned)count >= MNS_WORK_COUNT ||
        (unsigned)map >= MNS_COLOR_MAP_COUNT)
        return status_fail(error, MNS_ERROR_USAGE,
                           "heat map: the image has no counts of work; draw with counters");
    mns_status status = find_most(image, count, &top, error);
    if (!status) status = image_create(image->width, image->height, &made, error);
    if (status) return status;
    size_t pixels = (size_t)image->width * (size_t)image->height;
    memcpy(made->t, image->t, pixels * sizeof *made->t);
    memset(made->t_lo, 0, pixels * sizeof *made->t_lo);
    memset(made->normal, 0, 3 * pixels * sizeof *made->normal);
    made->t_unit = image->t_unit;
    memcpy(made->certain, image->certain, pixels * sizeof *made->certain);
    for (size_t i = 0; i < pixels; i++)
        paint((double)image->work[i * MNS_WORK_COUNT + (size_t)count] / top, map, made->rgba + 4 * i);
    if (most) *most = top;
    *heat = made;
    return MNS_OK;
}
