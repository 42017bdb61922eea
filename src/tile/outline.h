/* What a ball covers of the frame, as binning needs it: the pixels around its effective sphere, and a disc
 * of pixels within its core that is surely behind no farther than some depth. */
#ifndef MNS_TILE_OUTLINE_H
#define MNS_TILE_OUTLINE_H

#include "list/order.h"

/* Pixel centres lie at whole numbers here: pixel (x, y), y from the bottom as in GL, is at (x, y). */
typedef struct tile_outline {
    uint16_t low[2], high[2]; /* box of the frame's pixels whose rays meet the ball; low > high: none */
    float centre[2], reach;   /* and a circle around them; reach INFINITY: the box alone */
} tile_outline;

typedef struct tile_core {
    float centre[2], reach; /* every ray through this circle has entered the core by `depth` */
    float depth;            /* as effective distances are: beyond the plane where rays begin */
} tile_core;

/* The view in the numbers that outlines are made from. */
typedef struct tile_lens {
    view_frame frame;
    vec3 eye;         /* relative to the coordinates' origin */
    vec3 shift;       /* the origin from the eye, in the camera's axes */
    double pixels;    /* a unit across at depth 1 */
    double middle[2]; /* the frame's centre */
    double plane_depth, reach;
    double margin; /* pixels that samples beside the centre may be off */
} tile_lens;

tile_lens tile_lens_of(const mns_plan *plan);

/* What the rounding of positions, rays and chords to floats may amount to for balls whose coordinates from
 * the origin sum to `size`, as in glsl/billboard.vert.glsl. */
double tile_slack(const tile_lens *lens, double size);

/* `at` is relative to the origin. */
tile_outline tile_outline_of(const tile_lens *lens, const float at[3], double radius);

/* The same of `count` <= TILE_BLOCK balls, in floats; boxes may be wider by some percent. */
enum { TILE_BLOCK = 256 };
typedef struct tile_block {
    float at[3][TILE_BLOCK], radius[TILE_BLOCK];
} tile_block;
void tile_outline_block(const tile_lens *lens, const tile_block *block, size_t count, tile_outline *outline);

/* False where the core is too small or too near to hide anything. */
bool tile_core_of(const tile_lens *lens, const float at[3], double radius, tile_core *core);

#endif
