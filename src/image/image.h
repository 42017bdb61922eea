/* Planes in memory, and the file formats they are written to. */
#ifndef MNS_IMAGE_IMAGE_H
#define MNS_IMAGE_IMAGE_H

#include "base/status.h"

#include <math.h>
#include <stdio.h>

enum { IMAGE_SIDE_MAX = 1 << 20 }; /* pixels; keeps the bytes of a row within an int */

/* An image whose planes are allocated and hold no values yet. Errors: USAGE (a side out of range), MEMORY. */
mns_status image_create(int width, int height, mns_image **image, mns_error *error);

/* The distance at a pixel in scene units, INFINITY on a miss. */
static inline double image_distance(const mns_image *image, size_t pixel)
{
    double t = (double)image->t[pixel];
    if (!isfinite(t)) return INFINITY;
    return (t + (double)image->t_lo[pixel]) * (image->t_unit > 0 ? image->t_unit : 1);
}

/* Write the whole file to `file`, which starts at its beginning; `path` is for messages. Errors: USAGE, IO,
 * MEMORY. */
mns_status image_write_png(const mns_image *image, FILE *file, const char *path, mns_error *error);
mns_status image_write_exr(const mns_image *image, FILE *file, const char *path, mns_error *error);

#endif
