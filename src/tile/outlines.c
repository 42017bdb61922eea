/* The balls' outlines, once a frame for all its tiles. */
#include "base/memory.h"
#include "base/status.h"
#include "tile/tile.h"

#include <stdlib.h>

static mns_status reserve(tile_bins *bins, size_t count, mns_error *error)
{
    if (bins->ball_capacity >= count && bins->outline) return MNS_OK;
    tile_outline *outline = memory_resize(bins->outline, count, sizeof *outline);
    if (!outline) return status_no_memory(error, "while outlining the balls");
    bins->outline = outline;
    bins->ball_capacity = count;
    return MNS_OK;
}

void tile_block_fill(tile_block *block, const list_order *order, const mns_field *field, size_t first,
                     size_t past)
{
    for (size_t i = first; i < past; i++) {
        const list_ball *ball = list_ball_at(order, i);
        for (int axis = 0; axis < 3; axis++) block->at[axis][i - first] = ball->position[axis];
        block->radius[i - first] = (float)field_radius(field, ball->index);
    }
}

/* Outlines the balls [first, past) of the order. */
static void outline_stretch(tile_bins *bins, const list_order *order, const mns_field *field, size_t first,
                            size_t past)
{
    tile_block block = {0};
    tile_block_fill(&block, order, field, first, past);
    tile_outline_block(&bins->lens, &block, past - first, bins->outline + first);
    for (size_t i = first; i < past; i++) {
        if (!isinf(bins->outline[i].reach)) continue;
        const list_ball *ball = list_ball_at(order, i);
        bins->outline[i] = tile_outline_of(&bins->lens, ball->position, field_radius(field, ball->index));
    }
}

mns_status tile_outlines_go_on(tile_bins *bins, const list_order *order, const mns_field *field,
                               mns_error *error)
{
    size_t begin = bins->outlined, balls = order->sorted - begin;
    mns_status status = reserve(bins, order->sorted, error);
    if (status) return status;
    size_t blocks = (balls + TILE_BLOCK - 1) / TILE_BLOCK;
#pragma omp parallel for if (balls > ORDER_ALONE)
    for (size_t block = 0; block < blocks; block++) {
        size_t first = begin + block * TILE_BLOCK, past = first + TILE_BLOCK;
        outline_stretch(bins, order, field, first, past < order->sorted ? past : order->sorted);
    }
    bins->outlined = order->sorted;
    return MNS_OK;
}

mns_status tile_outlines_make(tile_bins *bins, const list_order *order, const mns_field *field,
                              const mns_plan *plan, mns_error *error)
{
    bins->lens = tile_lens_of(plan);
    bins->slack = (float)tile_slack(&bins->lens, order->size);
    bins->fits = false; /* lists of what was before */
    bins->outlined = 0;
    return tile_outlines_go_on(bins, order, field, error);
}

bool tile_outlines_serve(const tile_bins *bins, const mns_plan *plan)
{
    return bins->outline && bins->lens.margin == tile_lens_of(plan).margin;
}
