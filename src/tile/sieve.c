/* Drops balls that the nearest hide, before they are sorted and outlined for good. */
#include "tile/mask.h"
#include "tile/tile.h"

#include <omp.h>
#include <string.h>

/* Sums the tiles with an open cell over all rows and columns before each. */
static void count_open(const tile_bins *bins)
{
    uint64_t full = mask_full(mask_cells(bins));
    size_t across = (size_t)bins->across, stride = across + 1;
    memset(bins->open, 0, stride * sizeof *bins->open);
    for (size_t row = 0; row < (size_t)bins->down; row++) {
        const uint32_t *above = bins->open + row * stride;
        uint32_t *sum = bins->open + (row + 1) * stride, so_far = 0;
        sum[0] = 0;
        for (size_t column = 0; column < across; column++) {
            so_far += bins->mask[row * across + column] != full;
            sum[column + 1] = above[column + 1] + so_far;
        }
    }
}

/* Whether some tile that the outline's box meets has an open cell. */
static bool is_open(const tile_bins *bins, const tile_outline *o)
{
    if (isinf(o->reach)) return true; /* nothing is known of it yet */
    if (o->low[0] > o->high[0] || o->low[1] > o->high[1]) return false;
    size_t stride = (size_t)bins->across + 1, x0 = o->low[0] >> bins->shift,
           x1 = (size_t)(o->high[0] >> bins->shift) + 1, y0 = o->low[1] >> bins->shift,
           y1 = (size_t)(o->high[1] >> bins->shift) + 1;
    const uint32_t *low = bins->open + y0 * stride, *high = bins->open + y1 * stride;
    return high[x1] - high[x0] != low[x1] - low[x0];
}

/* Moves the keys of what is open among [first, past) to `first`. Returns how many they are. */
static size_t sieve_stretch(const tile_bins *bins, list_order *order, const mns_field *field, size_t first,
                            size_t past)
{
    tile_block block = {0};
    tile_outline outline[TILE_BLOCK];
    size_t kept = first;
    for (size_t at = first; at < past; at += TILE_BLOCK) {
        size_t end = at + TILE_BLOCK < past ? at + TILE_BLOCK : past;
        tile_block_fill(&block, order, field, at, end);
        tile_outline_block(&bins->lens, &block, end - at, outline);
        for (size_t i = at; i < end; i++) {
            order->key[kept] = order->key[i];
            kept += is_open(bins, &outline[i - at]);
        }
    }
    return kept - first;
}

void tile_sieve(const tile_bins *bins, list_order *order, const mns_field *field)
{
    size_t kept[64], begin[64], parts = 1, from = order->sorted, balls = order->count - from;
    int threads = omp_get_max_threads() > 64 ? 64 : omp_get_max_threads();
    count_open(bins);
#pragma omp parallel num_threads(threads) if (balls > BIN_ALONE)
    {
        size_t self = (size_t)omp_get_thread_num(), all = (size_t)omp_get_num_threads();
        begin[self] = from + balls * self / all;
        kept[self] = sieve_stretch(bins, order, field, begin[self], from + balls * (self + 1) / all);
#pragma omp single nowait
        parts = all;
    }
    order->count = from;
    for (size_t part = 0; part < parts; part++) {
        memmove(order->key + order->count, order->key + begin[part], kept[part] * sizeof *order->key);
        order->count += kept[part];
    }
}
