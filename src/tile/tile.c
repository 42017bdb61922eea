#include "tile/tile.h"

#include "base/memory.h"
#include "base/status.h"
#include "field/kernel.h"
#include "tile/mask.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* ---- Balls ---- */

/* What a binning reads, and the entries that its bands have come to together. */
typedef struct tile_work {
    const list_order *order;
    const mns_field *field;
    const mns_plan *plan;
    size_t most; /* entries */
    size_t count;
} tile_work;

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

/* An outline's pixels of the band, counted from the region's corner. */
typedef struct tile_reach {
    int x0, x1, y0, y1;
    float x, y, reach;
} tile_reach;

static bool reach_of(const tile_bins *bins, const tile_band *band, const tile_outline *o, tile_reach *r)
{
    const list_region *region = &bins->region;
    int first = band->first << bins->shift, last = (band->past << bins->shift) - 1;
    if (last >= region->height) last = region->height - 1;
    int x0 = o->low[0] - region->x, x1 = o->high[0] - region->x;
    int y0 = o->low[1] - region->y, y1 = o->high[1] - region->y;
    *r = (tile_reach){.x0 = x0 > 0 ? x0 : 0,
                      .x1 = x1 < region->width ? x1 : region->width - 1,
                      .y0 = y0 > first ? y0 : first,
                      .y1 = y1 < last ? y1 : last,
                      .x = o->centre[0] - (float)region->x,
                      .y = o->centre[1] - (float)region->y,
                      .reach = o->reach};
    return r->x0 <= r->x1 && r->y0 <= r->y1;
}

/* Narrows [*x0, *x1] to the pixels of the rows [y0, y1] that the outline's circle meets. */
static bool narrow(const tile_reach *r, int y0, int y1, int *x0, int *x1)
{
    if (isinf(r->reach)) return true;
    float off = r->y < (float)y0 ? (float)y0 - r->y : r->y > (float)y1 ? r->y - (float)y1 : 0;
    float square = r->reach * r->reach - off * off;
    if (square < 0) return false;
    float half = sqrtf(square);
    if (r->x - half > (float)*x0) *x0 = (int)ceilf(r->x - half);
    if (r->x + half < (float)*x1) *x1 = (int)floorf(r->x + half);
    return *x0 <= *x1;
}

static bool all_hidden(const uint64_t *mask, int count, uint64_t full)
{
    for (int i = 0; i < count; i++)
        if (mask[i] != full) return false;
    return true;
}

/* Puts a ball into those tiles of one row in which the pixels [x0, x1] x [y0, y1] hold an open cell; there is
 * room for the pairs. */
static void put_row(tile_bins *bins, tile_band *band, uint32_t ball, int x0, int x1, int y0, int y1)
{
    int shift = bins->shift, cells = mask_cells(bins), cell = mask_shift(bins), size = 1 << shift;
    int row = y0 >> shift, top = row << shift;
    uint32_t base = (uint32_t)row * (uint32_t)bins->across;
    for (int column = x0 >> shift; column <= x1 >> shift; column++) {
        uint32_t tile = base + (uint32_t)column;
        int left = column << shift, from = x0 > left ? x0 - left : 0,
            to = x1 < left + size ? x1 - left : size - 1;
        uint64_t box = mask_box(cells, from >> cell, to >> cell, (y0 - top) >> cell, (y1 - top) >> cell);
        if (!(box & ~bins->mask[tile])) continue;
        band->pair[band->count++] = (tile_pair){tile, ball};
        bins->length[tile]++;
    }
}

/* Puts a ball into the band's tiles in which it meets an open cell. False: out of memory. */
static bool put_ball(tile_bins *bins, tile_band *band, uint32_t ball, const tile_reach *r)
{
    int shift = bins->shift, size = 1 << shift;
    uint64_t full = mask_full(mask_cells(bins));
    int across = (r->x1 >> shift) - (r->x0 >> shift) + 1;
    for (int row = r->y0 >> shift; row <= r->y1 >> shift; row++) {
        const uint64_t *mask = bins->mask + (size_t)row * (size_t)bins->across + (r->x0 >> shift);
        if (all_hidden(mask, across, full)) continue;
        int top = row << shift, y0 = r->y0 > top ? r->y0 : top,
            y1 = r->y1 < top + size - 1 ? r->y1 : top + size - 1;
        int x0 = r->x0, x1 = r->x1;
        if (!narrow(r, y0, y1, &x0, &x1)) continue;
        if (!band_reserve(band, (size_t)across)) return false;
        put_row(bins, band, ball, x0, x1, y0, y1);
    }
    return true;
}

static double core_radius(const tile_work *work, size_t index)
{
    const mns_field *field = work->field;
    double radius = field_radius(field, index), strength = field_strength(field, index);
    if (!(work->plan->features & FEATURE_CORE_RADII)) return work->plan->core_ratio * radius;
    return strength > field->iso ? radius * kernel_core_radius(field->kernel, field->iso / strength) : 0;
}

/* One ball of the band's: what lies before it is hidden first. */
static bool take_ball(tile_bins *bins, tile_band *band, const tile_work *work, uint32_t place)
{
    tile_reach r;
    if (!reach_of(bins, band, &bins->outline[place], &r)) return true;
    mask_hide_until(bins, band, list_key_distance(work->order->key[place]) - bins->slack);
    size_t before = band->count;
    if (!put_ball(bins, band, place, &r)) return false;
    if (band->count == before || !(work->plan->features & FEATURE_CORE)) return true;
    const list_ball *ball = list_ball_at(work->order, place);
    tile_core core;
    if (!tile_core_of(&bins->lens, ball->position, core_radius(work, ball->index), &core)) return true;
    return mask_wait(band, &core);
}

/* ---- Bands ---- */

enum { BAND_BLOCK = 1024 };

/* The places of [first, past) whose outlines meet the pixel rows [low, high], without a branch a ball. */
static size_t pick(const tile_outline *outline, size_t first, size_t past, int low, int high,
                   uint32_t place[BAND_BLOCK])
{
    size_t count = 0;
    for (size_t i = first; i < past; i++) {
        place[count] = (uint32_t)i;
        count += (outline[i].low[1] <= high) & (outline[i].high[1] >= low);
    }
    return count;
}

/* Bins the balls from `begin` on that are sorted. */
static void bin_band(tile_bins *bins, tile_band *band, tile_work *work, size_t begin)
{
    int low = (band->first << bins->shift) + bins->region.y,
        high = (band->past << bins->shift) - 1 + bins->region.y;
    size_t balls = work->order->sorted, all = 0;
    uint32_t place[BAND_BLOCK];
    for (size_t first = begin; first < balls && all < work->most; first += BAND_BLOCK) {
        size_t past = first + BAND_BLOCK < balls ? first + BAND_BLOCK : balls, before = band->count;
        size_t count = pick(bins->outline, first, past, low, high, place);
        for (size_t i = 0; i < count; i++)
            if (!take_ball(bins, band, work, place[i])) {
                band->failed = true;
                return;
            }
#pragma omp atomic capture
        all = work->count += band->count - before;
    }
}

/* About one to two balls' images wide, within what a mask can tell apart. */
static int choose_shift(const tile_bins *bins, const list_order *order, const mns_field *field)
{
    double sum = 0;
    size_t step = order->count / 1024 + 1, count = 0;
    for (size_t i = 0; i < order->count; i += step) {
        const list_ball *ball = list_ball_at(order, i);
        tile_outline o = tile_outline_of(&bins->lens, ball->position, field_radius(field, ball->index));
        if (isinf(o.reach)) continue;
        sum += 2 * (double)o.reach;
        count++;
    }
    double wide = count ? sum / (double)count : 64;
    return wide < 12 ? TILE_SHIFT_LEAST : wide < 64 ? 3 : wide < 256 ? 4 : 5;
}

static mns_status reserve(tile_bins *bins, mns_error *error)
{
    size_t tiles = (size_t)bins->across * (size_t)bins->down;
    if (bins->tile_capacity < tiles) {
        free(bins->mask), free(bins->length), free(bins->head), free(bins->open);
        bins->mask = memory_array(tiles, sizeof *bins->mask);
        bins->length = memory_array(tiles, sizeof *bins->length);
        bins->head = memory_array(tiles, sizeof *bins->head);
        /* One more row and column are no more than twice as many, and two. */
        bins->open = memory_array(2 * tiles + 2, sizeof *bins->open);
        bins->tile_capacity = bins->mask && bins->length && bins->head && bins->open ? tiles : 0;
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

/* The lists of one band's tiles, from its pairs. */
static void write_band(tile_bins *bins, const tile_band *band)
{
    size_t first = (size_t)band->first * (size_t)bins->across,
           past = (size_t)band->past * (size_t)bins->across;
    uint32_t at = (uint32_t)band->begin;
    for (size_t tile = first; tile < past; tile++) {
        uint32_t length = bins->length[tile];
        bins->head[tile] = (tile_head){at, at}; /* `past` runs along the list while it is filled */
        at += length;
    }
    for (size_t k = 0; k < band->count; k++)
        bins->place[bins->head[band->pair[k].tile].past++] = band->pair[k].ball;
    for (size_t tile = first; tile < past; tile++)
        if (!bins->length[tile]) bins->head[tile] = (tile_head){0, 0};
}

/* False: out of memory. */
static bool write_lists(tile_bins *bins, size_t balls)
{
    size_t wanted = bins->count + 1;
    if (bins->place_capacity < wanted) {
        free(bins->place);
        wanted += wanted / 4;
        bins->place = memory_array(wanted, sizeof *bins->place);
        bins->place_capacity = bins->place ? wanted : 0;
        if (!bins->place) return false;
    }
    bins->place[0] = 0;
#pragma omp parallel for schedule(dynamic, 1) if (balls > BIN_ALONE)
    for (int i = 0; i < bins->band_count; i++) write_band(bins, &bins->band[i]);
    return true;
}

/* Shares the rows of tiles out, all open. */
static void open_bands(tile_bins *bins)
{
    for (int i = 0; i < bins->band_count; i++) {
        tile_band *band = &bins->band[i];
        band->first = (int)((long)bins->down * i / bins->band_count);
        band->past = (int)((long)bins->down * (i + 1) / bins->band_count);
        band->count = band->core_count = 0;
        band->failed = false;
        mask_open(bins, band);
    }
}

/* Outlines and bins what was sorted since `begin`. */
static mns_status bin_sorted(tile_bins *bins, tile_work *work, size_t begin, mns_error *error)
{
    bool failed = false;
    mns_status status = tile_outlines_go_on(bins, work->order, work->field, error);
    if (status) return status;
#pragma omp parallel for schedule(dynamic, 1) reduction(|| : failed) if (work->order->sorted > BIN_ALONE)
    for (int i = 0; i < bins->band_count; i++) {
        bin_band(bins, &bins->band[i], work, begin);
        failed = failed || bins->band[i].failed;
    }
    return failed ? status_no_memory(error, "while binning the balls") : MNS_OK;
}

mns_status tile_bins_make(tile_bins *bins, list_order *order, const mns_field *field, const mns_plan *plan,
                          list_region region, mns_error *error)
{
    tile_work work = {order, field, plan,
                      plan->pool_most < TILE_ENTRIES_MOST ? plan->pool_most : TILE_ENTRIES_MOST, 0};
    bool whole = region.width == plan->frame.width && region.height == plan->frame.height;
    bins->region = region;
    bins->fits = false;
    bins->shift = choose_shift(bins, order, field);
    bins->across = (region.width + (1 << bins->shift) - 1) >> bins->shift;
    bins->down = (region.height + (1 << bins->shift) - 1) >> bins->shift;
    mns_status status = reserve(bins, error);
    if (status) return status;
    if (!whole) list_order_finish(order); /* what a part hides may be seen in another */
    open_bands(bins);
    status = bin_sorted(bins, &work, 0, error);
    if (!status && order->sorted < order->count && work.count < work.most) {
        size_t begin = order->sorted;
        tile_sieve(bins, order, field);
        list_order_finish(order);
        status = bin_sorted(bins, &work, begin, error);
    }
    if (status) return status;
    place_bands(bins);
    if (bins->count >= work.most) return MNS_OK;
    if (!write_lists(bins, order->in_view)) return status_no_memory(error, "while binning the balls");
    if (plan->features & FEATURE_SQUARES) status = tile_squares_make(bins, error);
    bins->fits = !status;
    return status;
}

bool tile_bins_serve(const tile_bins *bins, const mns_plan *plan, list_region region)
{
    const list_region *last = &bins->region;
    return bins->fits && tile_outlines_serve(bins, plan) && bins->count < plan->pool_most &&
           last->x == region.x && last->y == region.y && last->width == region.width &&
           last->height == region.height;
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
    free(bins->outline), free(bins->mask), free(bins->length), free(bins->head), free(bins->place),
        free(bins->open), free(bins->square);
    for (int i = 0; i < bins->band_capacity; i++) free(bins->band[i].pair), free(bins->band[i].core);
    free(bins->band);
    *bins = (tile_bins){0};
}
