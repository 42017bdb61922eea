#include "tile/mask.h"

#include "base/memory.h"

void mask_open(tile_bins *bins, const tile_band *band)
{
    int cells = mask_cells(bins), shift = mask_shift(bins);
    for (int row = band->first; row < band->past; row++)
        for (int column = 0; column < bins->across; column++) {
            int wide = bins->region.width - (column << bins->shift),
                high = bins->region.height - (row << bins->shift);
            int last_x = (wide - 1) >> shift, last_y = (high - 1) >> shift;
            uint64_t inside = mask_box(cells, 0, last_x < cells ? last_x : cells - 1, 0,
                                       last_y < cells ? last_y : cells - 1);
            size_t tile = (size_t)row * (size_t)bins->across + (size_t)column;
            bins->mask[tile] = mask_full(cells) & ~inside;
            bins->length[tile] = 0;
        }
}

/* Hides the cells [x0, x1] of one row of cells of the region. */
static void hide_row(tile_bins *bins, int row, int x0, int x1)
{
    int cells = mask_cells(bins), tile_row = row / cells, line = row % cells;
    uint64_t *mask = bins->mask + (size_t)tile_row * (size_t)bins->across;
    for (int tile = x0 / cells; tile <= x1 / cells; tile++) {
        int from = x0 - tile * cells, to = x1 - tile * cells;
        if (from < 0) from = 0;
        if (to > cells - 1) to = cells - 1;
        mask[tile] |= mask_box(cells, from, to, line, line);
    }
}

/* C's own, which heed what is not a number, are calls. */
static float larger(float a, float b)
{
    return a > b ? a : b;
}

static float smaller(float a, float b)
{
    return a < b ? a : b;
}

void mask_hide(tile_bins *bins, const tile_band *band, const tile_core *core)
{
    int shift = mask_shift(bins), size = 1 << shift;
    float x = core->centre[0] - (float)bins->region.x, y = core->centre[1] - (float)bins->region.y;
    int first = (int)larger(ceilf(y - core->reach), (float)(band->first << bins->shift)) >> shift;
    int last = (int)smaller(floorf(y + core->reach), (float)((band->past << bins->shift) - 1)) >> shift;
    for (int row = first; row <= last; row++) {
        float below = fabsf((float)(row << shift) - y), above = fabsf((float)((row << shift) + size - 1) - y);
        float off = larger(below, above), square = core->reach * core->reach - off * off;
        if (!(square > 0)) continue;
        float half = sqrtf(square);
        float low = larger(ceilf(x - half), 0),
              high = smaller(floorf(x + half), (float)((bins->across << bins->shift) - 1));
        if (low > high) continue;
        int x0 = ((int)low + size - 1) >> shift, x1 = (((int)high + 1) >> shift) - 1;
        if (x0 <= x1) hide_row(bins, row, x0, x1);
    }
}

bool mask_wait(tile_band *band, const tile_core *core)
{
    if (band->core_count == band->core_capacity) {
        size_t wanted = 2 * band->core_capacity + 64;
        tile_core *larger = memory_resize(band->core, wanted, sizeof *larger);
        if (!larger) return false;
        band->core = larger;
        band->core_capacity = wanted;
    }
    size_t at = band->core_count++;
    while (at > 0 && band->core[(at - 1) / 2].depth > core->depth) {
        band->core[at] = band->core[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    band->core[at] = *core;
    return true;
}

/* Takes the nearest core off the heap. */
static tile_core next_core(tile_band *band)
{
    tile_core top = band->core[0], last = band->core[--band->core_count];
    size_t at = 0, child;
    while ((child = 2 * at + 1) < band->core_count) {
        if (child + 1 < band->core_count && band->core[child + 1].depth < band->core[child].depth) child++;
        if (last.depth <= band->core[child].depth) break;
        band->core[at] = band->core[child];
        at = child;
    }
    band->core[at] = last;
    return top;
}

void mask_hide_until(tile_bins *bins, tile_band *band, float depth)
{
    while (band->core_count && band->core[0].depth <= depth) {
        tile_core core = next_core(band);
        mask_hide(bins, band, &core);
    }
}
