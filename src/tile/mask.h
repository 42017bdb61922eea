/* The cells of a tile that cores hide: pixels of a tile up to 8 pixels wide, a 64th of a larger one. */
#ifndef MNS_TILE_MASK_H
#define MNS_TILE_MASK_H

#include "tile/tile.h"

/* Cells a side. */
static inline int mask_cells(const tile_bins *bins)
{
    return bins->shift < 3 ? 1 << bins->shift : 8;
}

/* A cell is 1 << mask_shift pixels wide. */
static inline int mask_shift(const tile_bins *bins)
{
    return bins->shift < 3 ? 0 : bins->shift - 3;
}

static inline uint64_t mask_full(int cells)
{
    return cells == 8 ? ~(uint64_t)0 : ((uint64_t)1 << cells * cells) - 1;
}

/* Cells [x0, x1] x [y0, y1] of a tile. */
static inline uint64_t mask_box(int cells, int x0, int x1, int y0, int y1)
{
    uint64_t row = (((uint64_t)1 << (x1 - x0 + 1)) - 1) << x0, mask = 0;
    for (int y = y0; y <= y1; y++) mask |= row << y * cells;
    return mask;
}

/* Opens the band's tiles; cells beside the region count as hidden. */
void mask_open(tile_bins *bins, const tile_band *band);

/* Hides the cells of the band that lie wholly within the core's circle. */
void mask_hide(tile_bins *bins, const tile_band *band, const tile_core *core);

/* The cores that wait until every ball which begins before their depth is in its lists. push: false: out of
 * memory. */
bool mask_wait(tile_band *band, const tile_core *core);
/* Hides what the waiting cores up to `depth` do. */
void mask_hide_until(tile_bins *bins, tile_band *band, float depth);

#endif
