/* The balls' outlines and cores, once a frame for all its tiles. */
#include "base/memory.h"
#include "base/status.h"
#include "field/kernel.h"
#include "list/pack.h"
#include "tile/tile.h"

#include <stdlib.h>
#include <string.h>

static mns_status reserve(tile_bins *bins, size_t count, mns_error *error)
{
    if (bins->ball_capacity >= count && bins->outline) return MNS_OK;
    free(bins->outline), free(bins->rows), free(bins->core), free(bins->key), free(bins->scratch),
        free(bins->digits);
    bins->outline = memory_array(count, sizeof *bins->outline);
    bins->rows = memory_array(count, 2 * sizeof *bins->rows);
    bins->core = memory_array(count, sizeof *bins->core);
    bins->key = memory_array(count, sizeof *bins->key);
    bins->scratch = memory_array(count, sizeof *bins->scratch);
    bins->digits = memory_array(RADIX_THREADS * RADIX_DIGITS, sizeof *bins->digits);
    bins->ball_capacity = count;
    if (bins->outline && bins->rows && bins->core && bins->key && bins->scratch && bins->digits)
        return MNS_OK;
    bins->ball_capacity = 0;
    return status_no_memory(error, "while outlining the balls");
}

static uint16_t row_of(float y, int height)
{
    return y < 0 ? 0 : y > (float)(height - 1) ? (uint16_t)(height - 1) : (uint16_t)y;
}

static double core_radius(const mns_field *field, const mns_plan *plan, size_t index)
{
    double radius = field_radius(field, index);
    if (!(plan->features & FEATURE_CORE_RADII)) return plan->core_ratio * radius;
    return radius * kernel_core_radius(field->kernel, field->iso / field_strength(field, index));
}

/* A positive float's bits are in its order; before the eye no core hides. */
static uint32_t depth_key(float depth)
{
    uint32_t bits;
    float positive = depth > 0 ? depth : 0;
    memcpy(&bits, &positive, sizeof bits);
    return bits;
}

/* Puts the cores together, nearest depth first; `alone` says which balls have one. */
static void gather_cores(tile_bins *bins, size_t count, bool sorted)
{
    size_t cores = 0;
    for (size_t place = 0; place < count; place++)
        if (bins->core[place].reach > 0) bins->core[cores++] = bins->core[place];
    bins->core_count = cores;
    if (sorted) return;
    for (size_t i = 0; i < cores; i++) bins->key[i] = (uint64_t)depth_key(bins->core[i].depth) << 32 | i;
    list_radix_sort(bins->key, bins->scratch, bins->digits, cores);
}

mns_status tile_outlines_make(tile_bins *bins, const list_order *order, const mns_field *field,
                              const mns_plan *plan, mns_error *error)
{
    mns_status status = reserve(bins, order->count, error);
    if (status) return status;
    tile_lens lens = tile_lens_of(plan);
    bool cores = plan->features & FEATURE_CORE;
#pragma omp parallel for if (order->count > ORDER_ALONE)
    for (size_t place = 0; place < order->count; place++) {
        const list_ball *ball = list_ball_at(order, place);
        tile_outline *o = &bins->outline[place];
        *o = tile_outline_of(&lens, ball->position, field_radius(field, ball->index));
        bins->rows[2 * place] = row_of(ceilf(o->low[1]), plan->frame.height);
        bins->rows[2 * place + 1] = row_of(floorf(o->high[1]), plan->frame.height);
        bins->core[place].reach = 0;
        if (!cores ||
            !tile_core_of(&lens, ball->position, core_radius(field, plan, ball->index), &bins->core[place]))
            bins->core[place].reach = 0;
    }
    /* Balls of one core radius: the cores are in order as the balls are. */
    bool alike = !(plan->features & (FEATURE_RADII | FEATURE_CORE_RADII));
    gather_cores(bins, order->count, alike);
    if (alike)
        for (size_t i = 0; i < bins->core_count; i++) bins->key[i] = i;
    return MNS_OK;
}
