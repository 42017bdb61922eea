/* The balls' outlines, once a frame for all its tiles. */
#include "base/memory.h"
#include "base/status.h"
#include "tile/tile.h"

#include <stdlib.h>

static mns_status reserve(tile_bins *bins, size_t count, mns_error *error)
{
    if (bins->ball_capacity >= count && bins->outline) return MNS_OK;
    free(bins->outline);
    bins->outline = memory_array(count, sizeof *bins->outline);
    bins->ball_capacity = bins->outline ? count : 0;
    return bins->outline ? MNS_OK : status_no_memory(error, "while outlining the balls");
}

/* Outlines the balls [first, past) of the order. Returns the largest sum of coordinates among them. */
static float outline_stretch(tile_bins *bins, const list_order *order, const mns_field *field, size_t first,
                             size_t past)
{
    tile_block block = {0};
    float most = 0;
    for (size_t i = first; i < past; i++) {
        const list_ball *ball = list_ball_at(order, i);
        float size = 0;
        for (int axis = 0; axis < 3; axis++) {
            block.at[axis][i - first] = ball->position[axis];
            size += fabsf(ball->position[axis]);
        }
        block.radius[i - first] = (float)field_radius(field, ball->index);
        if (size > most) most = size;
    }
    tile_outline_block(&bins->lens, &block, past - first, bins->outline + first);
    for (size_t i = first; i < past; i++) {
        if (!isinf(bins->outline[i].reach)) continue;
        const list_ball *ball = list_ball_at(order, i);
        bins->outline[i] = tile_outline_of(&bins->lens, ball->position, field_radius(field, ball->index));
    }
    return most;
}

mns_status tile_outlines_make(tile_bins *bins, const list_order *order, const mns_field *field,
                              const mns_plan *plan, mns_error *error)
{
    mns_status status = reserve(bins, order->count, error);
    if (status) return status;
    bins->lens = tile_lens_of(plan);
    bins->fits = false; /* lists of what was before */
    size_t blocks = (order->count + TILE_BLOCK - 1) / TILE_BLOCK;
    float most = 0;
#pragma omp parallel for reduction(max : most) if (order->count > ORDER_ALONE)
    for (size_t block = 0; block < blocks; block++) {
        size_t first = block * TILE_BLOCK, past = first + TILE_BLOCK;
        float size = outline_stretch(bins, order, field, first, past < order->count ? past : order->count);
        if (size > most) most = size;
    }
    bins->slack = (float)tile_slack(&bins->lens, most);
    return MNS_OK;
}

bool tile_outlines_serve(const tile_bins *bins, const mns_plan *plan)
{
    return bins->outline && bins->lens.margin == tile_lens_of(plan).margin;
}
