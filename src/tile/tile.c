#include "tile/tile.h"

#include "base/memory.h"
#include "base/status.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* Cells a side of a tile's mask: pixels in a small tile, a 64th of a large one. */
static int cells_of(const tile_bins *bins)
{
    return bins->shift < 3 ? 1 << bins->shift : 8;
}

static int cell_shift(const tile_bins *bins)
{
    return bins->shift < 3 ? 0 : bins->shift - 3;
}

static uint64_t full_mask(int cells)
{
    return cells == 8 ? ~(uint64_t)0 : ((uint64_t)1 << cells * cells) - 1;
}

/* Cells [x0, x1] x [y0, y1] of a tile. */
static uint64_t box_mask(int cells, int x0, int x1, int y0, int y1)
{
    uint64_t row = (((uint64_t)1 << (x1 - x0 + 1)) - 1) << x0, mask = 0;
    for (int y = y0; y <= y1; y++) mask |= row << y * cells;
    return mask;
}

/* ---- Cores
 * ----------------------------------------------------------------------------------------------------------
 */

/* Hides the cells [x0, x1] of one row of cells of the region. */
static void hide_row(tile_bins *bins, int row, int x0, int x1)
{
    int cells = cells_of(bins), tile_row = row / cells, line = row % cells;
    uint64_t *mask = bins->mask + (size_t)tile_row * (size_t)bins->across;
    for (int tile = x0 / cells; tile <= x1 / cells; tile++) {
        int from = x0 - tile * cells, to = x1 - tile * cells;
        if (from < 0) from = 0;
        if (to > cells - 1) to = cells - 1;
        mask[tile] |= box_mask(cells, from, to, line, line);
    }
}

/* Hides the cells of the band that lie wholly within the core's circle. */
static void hide_core(tile_bins *bins, const tile_band *band, const tile_core *core)
{
    int shift = cell_shift(bins), size = 1 << shift;
    float x = core->centre[0] - (float)bins->region.x, y = core->centre[1] - (float)bins->region.y;
    int first = (int)fmaxf(ceilf(y - core->reach), (float)(band->first << bins->shift)) >> shift;
    int last = (int)fminf(floorf(y + core->reach), (float)((band->past << bins->shift) - 1)) >> shift;
    for (int row = first; row <= last; row++) {
        float below = fabsf((float)(row << shift) - y), above = fabsf((float)((row << shift) + size - 1) - y);
        float off = fmaxf(below, above), square = core->reach * core->reach - off * off;
        if (!(square > 0)) continue;
        float half = sqrtf(square);
        float low = fmaxf(ceilf(x - half), 0),
              high = fminf(floorf(x + half), (float)((bins->across << bins->shift) - 1));
        if (low > high) continue;
        int x0 = ((int)low + size - 1) >> shift, x1 = (((int)high + 1) >> shift) - 1;
        if (x0 <= x1) hide_row(bins, row, x0, x1);
    }
}

/* ---- Balls
 * ----------------------------------------------------------------------------------------------------------
 */

static bool band_reserve(tile_band *band, size_t more)
{
    if (band->count + more <= band->capacity) return true;
    size_t wanted = 2 * (band->count + more) + 1024;
    tile_pair *pair = memory_resize(band->pair, wanted, sizeof *pair);
    if (!pair) return false;
    band->pair = pair;
    band->capacity = wanted;
    return true;
}

/* The outline in pixels of the region. */
typedef struct tile_reach {
    int x0, x1, y0, y1;
    float x, y, reach;
} tile_reach;

static bool reach_of(const tile_bins *bins, const tile_outline *o, tile_reach *r)
{
    float width = (float)(bins->region.width - 1), height = (float)(bins->region.height - 1);
    float x = (float)bins->region.x, y = (float)bins->region.y;
    float x0 = fmaxf(ceilf(o->low[0] - x), 0), x1 = fminf(floorf(o->high[0] - x), width);
    float y0 = fmaxf(ceilf(o->low[1] - y), 0), y1 = fminf(floorf(o->high[1] - y), height);
    if (!(x0 <= x1 && y0 <= y1)) return false;
    *r = (tile_reach){(int)x0, (int)x1, (int)y0, (int)y1, o->centre[0] - x, o->centre[1] - y, o->reach};
    return true;
}

/* Narrows [*x0, *x1] to the pixels of the rows [y0, y1] that the outline's circle meets. */
static bool narrow(const tile_reach *r, int y0, int y1, int *x0, int *x1)
{
    *x0 = r->x0, *x1 = r->x1;
    if (isinf(r->reach)) return true;
    float off = r->y < (float)y0 ? (float)y0 - r->y : r->y > (float)y1 ? r->y - (float)y1 : 0;
    float square = r->reach * r->reach - off * off;
    if (square < 0) return false;
    float half = sqrtf(square);
    if (r->x - half > (float)*x0) *x0 = (int)ceilf(r->x - half);
    if (r->x + half < (float)*x1) *x1 = (int)floorf(r->x + half);
    return *x0 <= *x1;
}

/* Puts a ball into the band's tiles in which it meets an open cell. */
static bool put_ball(tile_bins *bins, tile_band *band, uint32_t ball, const tile_reach *r)
{
    int shift = bins->shift, cells = cells_of(bins), cell = cell_shift(bins), size = 1 << shift;
    uint64_t full = full_mask(cells);
    int row = r->y0 >> shift, last = r->y1 >> shift;
    if (row < band->first) row = band->first;
    if (last >= band->past) last = band->past - 1;
    for (; row <= last; row++) {
        int top = row << shift, y0 = r->y0 > top ? r->y0 : top,
            y1 = r->y1 < top + size - 1 ? r->y1 : top + size - 1;
        int x0, x1;
        if (!narrow(r, y0, y1, &x0, &x1)) continue;
        if (!band_reserve(band, (size_t)(x1 >> shift) - (size_t)(x0 >> shift) + 1)) return false;
        uint32_t base = (uint32_t)row * (uint32_t)bins->across;
        for (int column = x0 >> shift; column <= x1 >> shift; column++) {
            uint64_t hidden = bins->mask[base + (uint32_t)column];
            if (hidden == full) continue;
            if (hidden) {
                int left = column << shift, from = x0 > left ? x0 - left : 0,
                    to = x1 < left + size ? x1 - left : size - 1;
                uint64_t box =
                    box_mask(cells, from >> cell, to >> cell, (y0 - top) >> cell, (y1 - top) >> cell);
                if (!(box & ~hidden)) continue;
            }
            band->pair[band->count++] = (tile_pair){base + (uint32_t)column, ball};
            bins->length[base + (uint32_t)column]++;
        }
    }
    return true;
}

/* ---- Bands
 * ----------------------------------------------------------------------------------------------------------
 */

/* Cells beside the region count as hidden. */
static void open_masks(tile_bins *bins, const tile_band *band)
{
    int cells = cells_of(bins), shift = cell_shift(bins);
    for (int row = band->first; row < band->past; row++)
        for (int column = 0; column < bins->across; column++) {
            int wide = bins->region.width - (column << bins->shift),
                high = bins->region.height - (row << bins->shift);
            int last_x = (wide - 1) >> shift, last_y = (high - 1) >> shift;
            uint64_t inside = box_mask(cells, 0, last_x < cells ? last_x : cells - 1, 0,
                                       last_y < cells ? last_y : cells - 1);
            size_t tile = (size_t)row * (size_t)bins->across + (size_t)column;
            bins->mask[tile] = full_mask(cells) & ~inside;
            bins->length[tile] = 0;
        }
}

static void bin_band(tile_bins *bins, tile_band *band, size_t balls)
{
    size_t next = 0;
    int low = (band->first << bins->shift) + bins->region.y,
        high = (band->past << bins->shift) - 1 + bins->region.y;
    band->count = 0;
    open_masks(bins, band);
    for (size_t ball = 0; ball < balls && !band->failed; ball++) {
        if (bins->rows[2 * ball] > high || bins->rows[2 * ball + 1] < low) continue;
        const tile_outline *o = &bins->outline[ball];
        for (; next < bins->core_count; next++) {
            const tile_core *core = &bins->core[(uint32_t)bins->key[next]];
            if (core->depth > o->near) break;
            hide_core(bins, band, core);
        }
        tile_reach r;
        if (reach_of(bins, o, &r) && !put_ball(bins, band, (uint32_t)ball, &r)) band->failed = true;
    }
}

/* About one to two balls' images wide, within what a mask can tell apart. */
static int choose_shift(const tile_bins *bins, size_t balls)
{
    double sum = 0;
    size_t step = balls / 1024 + 1, count = 0;
    for (size_t i = 0; i < balls; i += step) {
        const tile_outline *o = &bins->outline[i];
        if (!isfinite(o->reach)) continue;
        sum += 2 * o->reach;
        count++;
    }
    double wide = count ? sum / (double)count : 64;
    return wide < 8 ? 2 : wide < 64 ? 3 : wide < 256 ? 4 : 5;
}

static mns_status reserve(tile_bins *bins, mns_error *error)
{
    size_t tiles = (size_t)bins->across * (size_t)bins->down;
    if (bins->tile_capacity < tiles) {
        free(bins->mask), free(bins->length);
        bins->mask = memory_array(tiles, sizeof *bins->mask);
        bins->length = memory_array(tiles, sizeof *bins->length);
        bins->tile_capacity = bins->mask && bins->length ? tiles : 0;
    }
    int wanted = 4 * omp_get_max_threads();
    bins->band_count = wanted < bins->down ? wanted : bins->down;
    if (bins->band_capacity < bins->band_count) {
        tile_band *band = memory_resize(bins->band, (size_t)bins->band_count, sizeof *band);
        if (band) {
            memset(band + bins->band_capacity, 0,
                   (size_t)(bins->band_count - bins->band_capacity) * sizeof *band);
            bins->band = band;
            bins->band_capacity = bins->band_count;
        }
    }
    if (bins->tile_capacity < tiles || bins->band_capacity < bins->band_count)
        return status_no_memory(error, "while binning the balls");
    return MNS_OK;
}

/* Where each band's entries begin; entry 0 is no list's. */
static void place_bands(tile_bins *bins)
{
    bins->count = 0;
    for (int i = 0; i < bins->band_count; i++) {
        bins->band[i].begin = bins->count + 1;
        bins->count += bins->band[i].count;
    }
}

mns_status tile_bins_make(tile_bins *bins, const list_order *order, list_region region, mns_error *error)
{
    bins->region = region;
    bins->shift = choose_shift(bins, order->count);
    bins->across = (region.width + (1 << bins->shift) - 1) >> bins->shift;
    bins->down = (region.height + (1 << bins->shift) - 1) >> bins->shift;
    mns_status status = reserve(bins, error);
    if (status) return status;
    bool failed = false;
#pragma omp parallel for schedule(dynamic, 1) reduction(|| : failed) if (order->count > 4096)
    for (int i = 0; i < bins->band_count; i++) {
        tile_band *band = &bins->band[i];
        band->first = (int)((long)bins->down * i / bins->band_count);
        band->past = (int)((long)bins->down * (i + 1) / bins->band_count);
        band->failed = false;
        bin_band(bins, band, order->count);
        failed = failed || band->failed;
    }
    if (failed) return status_no_memory(error, "while binning the balls");
    place_bands(bins);
    return MNS_OK;
}

void tile_bins_write(const tile_bins *bins, uint32_t *entry, uint32_t *head)
{
    entry[0] = TILE_LAST;
#pragma omp parallel for schedule(dynamic, 1) if (bins->count > ORDER_ALONE)
    for (int i = 0; i < bins->band_count; i++) {
        const tile_band *band = &bins->band[i];
        size_t first = (size_t)band->first * (size_t)bins->across,
               past = (size_t)band->past * (size_t)bins->across;
        uint32_t at = (uint32_t)band->begin;
        for (size_t tile = first; tile < past; tile++) {
            head[tile] = at;
            at += bins->length[tile];
        }
        /* head[tile] runs along the tile's list while it is filled, and is set back after. */
        for (size_t k = 0; k < band->count; k++) entry[head[band->pair[k].tile]++] = band->pair[k].ball;
        for (size_t tile = first; tile < past; tile++) {
            uint32_t length = bins->length[tile];
            if (length) entry[head[tile] - 1] |= TILE_LAST;
            head[tile] = length ? head[tile] - length : 0;
        }
    }
}

bool tile_bins_lengths(const tile_bins *bins, list_lengths *lengths)
{
    int side = 1 << bins->shift;
    for (int row = 0; row < bins->down; row++)
        for (int column = 0; column < bins->across; column++) {
            int wide = bins->region.width - column * side, high = bins->region.height - row * side;
            size_t pixels = (size_t)(wide < side ? wide : side) * (size_t)(high < side ? high : side);
            uint32_t length = bins->length[(size_t)row * (size_t)bins->across + (size_t)column];
            if (!list_lengths_share(lengths, length, pixels)) return false;
        }
    return true;
}

void tile_bins_free(tile_bins *bins)
{
    free(bins->outline), free(bins->rows), free(bins->core), free(bins->key), free(bins->scratch),
        free(bins->digits);
    free(bins->mask), free(bins->length);
    for (int i = 0; i < bins->band_capacity; i++) free(bins->band[i].pair);
    free(bins->band);
    *bins = (tile_bins){0};
}
