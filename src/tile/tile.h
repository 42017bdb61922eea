/* Lists a tile of pixels long, binned in order on the CPU: what a software rasteriser wants instead of a
 * billboard a ball.
 *
 * Balls are taken nearest first. Each tile keeps a mask of the cells that cores have hidden so far; a ball
 * goes to the tiles in which its outline meets a cell that is still open, so that lists end soon after the
 * first closed layer of cores. What is hidden itself hides nothing new: only balls that some tile takes lay
 * down their core.
 */
#ifndef MNS_TILE_TILE_H
#define MNS_TILE_TILE_H

#include "list/lengths.h"
#include "tile/outline.h"

/* A tile's list is the entries [first, past); both are 0 where it has none. */
typedef struct tile_head {
    uint32_t first, past;
} tile_head;

/* A square of pixels to be cast: its lower left corner, from the region's, and its side. */
typedef struct tile_square {
    uint16_t x, y, side, spare;
} tile_square;

/* More entries have no place in what a pixel to resolve keeps (glsl/resolve_entry.glsl). */
enum { TILE_ENTRIES_MOST = 1 << 30 };

/* Fewer balls are binned by one thread; see ORDER_ALONE. */
enum { BIN_ALONE = 16384 };

/* How many of a frame's balls are to be sorted and binned before what they hide is dropped. */
static inline size_t tile_near(size_t balls)
{
    return balls < 65536 ? balls : balls / 8 > 32768 ? balls / 8 : 32768;
}

typedef struct tile_pair {
    uint32_t tile, ball;
} tile_pair;

/* Rows of tiles that one thread bins at a time. */
typedef struct tile_band {
    int first, past;               /* rows */
    tile_pair *pair;               /* in the order of the balls */
    size_t count, capacity, begin; /* begin: of the band's entries in the lists */
    tile_core *core;               /* a heap, nearest depth first: of listed balls, not laid down yet */
    size_t core_count, core_capacity;
    bool failed; /* out of memory */
} tile_band;

typedef struct tile_bins {
    tile_lens lens;
    list_region region;
    int shift;        /* a tile is 1 << shift pixels wide and high */
    int across, down; /* tiles */
    size_t count;     /* entries of all lists */
    bool fits;        /* fewer than the plan allows; otherwise there are no lists, and count is but a bound */
    float slack;      /* no ray enters a ball before its effective distance less this */
    tile_outline *outline; /* of the order's balls that are sorted */
    size_t outlined, ball_capacity;
    uint32_t *place; /* of the order's balls, an entry; the lists begin with entry 1 */
    size_t place_capacity;
    uint64_t *mask;   /* a tile */
    uint32_t *length; /* a tile */
    tile_head *head;  /* a tile */
    uint32_t *
        open; /* tiles with an open cell in the rows and columns before, a row and a column more than tiles */
    size_t tile_capacity;
    tile_square *square; /* of tiles that have a list (plan SQUARES) */
    size_t square_count, square_capacity;
    tile_band *band;
    int band_count, band_capacity;
} tile_bins;

/* Outlines of the order's balls that are sorted, once a frame. Errors: MEMORY. */
mns_status tile_outlines_make(tile_bins *bins, const list_order *order, const mns_field *field,
                              const mns_plan *plan, mns_error *error);
/* Outlines of those that were sorted since. Errors: MEMORY. */
mns_status tile_outlines_go_on(tile_bins *bins, const list_order *order, const mns_field *field,
                               mns_error *error);
/* Whether the outlines that were made last are also this plan's, the order being the same. */
bool tile_outlines_serve(const tile_bins *bins, const mns_plan *plan);
/* The order's balls [first, past), at most TILE_BLOCK, as a block. */
void tile_block_fill(tile_block *block, const list_order *order, const mns_field *field, size_t first,
                     size_t past);
/* Drops from the order what is not sorted and lies wholly behind the cells that are hidden, the region being
 * the whole frame. */
void tile_sieve(const tile_bins *bins, list_order *order, const mns_field *field);
/* Bins an order over a region of the frame; see bins->fits. What the order has not sorted is sorted then, and
 * dropped from it where the nearer balls hide it. The same result for any number of threads. Errors: MEMORY.
 */
mns_status tile_bins_make(tile_bins *bins, list_order *order, const mns_field *field, const mns_plan *plan,
                          list_region region, mns_error *error);
/* The squares that hold every tile with a list. Errors: MEMORY. */
mns_status tile_squares_make(tile_bins *bins, mns_error *error);
/* Whether the bins that were made last are also this plan's of that region, the order being the same. */
bool tile_bins_serve(const tile_bins *bins, const mns_plan *plan, list_region region);
/* Notes every pixel's list's length. False: out of memory. */
bool tile_bins_lengths(const tile_bins *bins, list_lengths *lengths);
void tile_bins_free(tile_bins *bins);

#endif
