/* The squares that hold a frame's listed tiles: pixels outside them are not cast at all.
 *
 * A software rasteriser runs a shader for eight pixels together and goes the way of every branch, so that a
 * pixel without a list costs about as much as one whose list is short. Squares grow where all of their four
 * quarters are listed, so that a filled frame takes few.
 */
#include "tile/tile.h"

#include "base/memory.h"
#include "base/status.h"

#include <stdlib.h>

enum { SQUARE_SHIFT_LEAST = 3 };

typedef enum square_state { SQUARE_EMPTY, SQUARE_PART, SQUARE_FULL } square_state;

static void put(tile_bins *bins, int x, int y, int shift)
{
    bins->square[bins->square_count++] = (tile_square){(uint16_t)x, (uint16_t)y, (uint16_t)(1 << shift), 0};
}

/* Whether any tile of the square at pixel (x, y) has a list. */
static bool any_listed(const tile_bins *bins, int x, int y, int shift)
{
    int tiles = shift > bins->shift ? 1 << (shift - bins->shift) : 1;
    int column = x >> bins->shift, row = y >> bins->shift;
    for (int r = row; r < row + tiles && r < bins->down; r++)
        for (int c = column; c < column + tiles && c < bins->across; c++)
            if (bins->length[(size_t)r * (size_t)bins->across + (size_t)c]) return true;
    return false;
}

/* Puts the listed squares within one; what lies beyond the region counts as listed. */
static square_state cover(tile_bins *bins, int x, int y, int shift, int least)
{
    if (x >= bins->region.width || y >= bins->region.height) return SQUARE_FULL;
    if (shift == least) {
        if (!any_listed(bins, x, y, shift)) return SQUARE_EMPTY;
        put(bins, x, y, shift);
        return SQUARE_FULL;
    }
    int half = 1 << (shift - 1), empty = 0, full = 0;
    size_t before = bins->square_count;
    for (int i = 0; i < 4; i++) {
        square_state state = cover(bins, x + (i & 1) * half, y + (i >> 1) * half, shift - 1, least);
        empty += state == SQUARE_EMPTY;
        full += state == SQUARE_FULL;
    }
    if (full < 4) return empty == 4 ? SQUARE_EMPTY : SQUARE_PART;
    bins->square_count = before;
    put(bins, x, y, shift);
    return SQUARE_FULL;
}

mns_status tile_squares_make(tile_bins *bins, mns_error *error)
{
    int least = bins->shift > SQUARE_SHIFT_LEAST ? bins->shift : SQUARE_SHIFT_LEAST;
    size_t across = ((size_t)bins->region.width >> least) + 1,
           down = ((size_t)bins->region.height >> least) + 1;
    bins->square_count = 0;
    if (bins->square_capacity < across * down) {
        free(bins->square);
        bins->square = memory_array(across * down, sizeof *bins->square);
        bins->square_capacity = bins->square ? across * down : 0;
        if (!bins->square) return status_no_memory(error, "while binning the balls");
    }
    for (int y = 0; y < bins->region.height; y += SQUARE_MOST)
        for (int x = 0; x < bins->region.width; x += SQUARE_MOST) cover(bins, x, y, SQUARE_SHIFT_MOST, least);
    return MNS_OK;
}
