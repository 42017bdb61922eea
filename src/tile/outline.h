/* What a ball covers of the frame, as binning needs it: a box of pixels around its effective sphere, and a
 * disc of pixels within its core that is surely behind no farther than some depth. */
#ifndef MNS_TILE_OUTLINE_H
#define MNS_TILE_OUTLINE_H

#include "list/order.h"

/* Pixel centres lie at whole numbers here: pixel (x, y), y from the bottom as in GL, is at (x, y). */
typedef struct tile_outline {
    float low[2], high[2];  /* box around every ray that meets the ball */
    float centre[2], reach; /* and a circle */
    float near;             /* effective distance: no ray enters the ball before */
} tile_outline;

typedef struct tile_core {
    float centre[2], reach; /* every ray through this circle has entered the core by `depth` */
    float depth;
} tile_core;

/* The view in the numbers that outlines are made from. */
typedef struct tile_lens {
    view_frame frame;
    vec3 eye;         /* relative to the coordinates' origin */
    double pixels;    /* a unit across at depth 1 */
    double middle[2]; /* the frame's centre */
    double plane_depth, reach;
    double margin; /* pixels that samples beside the centre may be off */
} tile_lens;

tile_lens tile_lens_of(const mns_plan *plan);

/* `at` is relative to the origin. */
tile_outline tile_outline_of(const tile_lens *lens, const float at[3], double radius);

/* False where the core is too small or too near to hide anything. */
bool tile_core_of(const tile_lens *lens, const float at[3], double radius, tile_core *core);

#endif
