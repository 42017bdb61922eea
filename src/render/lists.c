/* Every pixel's list: gathered by the rasteriser, or its tile's, binned on the CPU. */
#include "base/status.h"
#include "render/draw.h"

#include <string.h>

/* ---- Gathered ---- */

static mns_status grow_pool(draw *d, size_t nodes, mns_error *error)
{
    list_passes *p = &d->r->passes;
    size_t most = d->plan->pool_most;
    d->stats->fallbacks.pool_grown++;
    mns_status status =
        gl_buffer_reserve(&d->r->device, &p->nodes, "node pool", nodes * LIST_NODE, most * LIST_NODE, error);
    if (!status) p->node_capacity = p->nodes.size / LIST_NODE < most ? p->nodes.size / LIST_NODE : most;
    return status;
}

static mns_status gather(draw *d, list_region region, bool *fits, mns_error *error)
{
    list_passes *p = &d->r->passes;
    gl_device *device = &d->r->device;
    size_t nodes = list_gather(p, device, d->plan, &d->r->order, d->program, region);
    *fits = nodes <= d->plan->pool_most;
    if (!*fits) return MNS_OK;
    if (nodes > p->node_capacity) {
        mns_status status = grow_pool(d, nodes, error);
        if (status) return status;
        nodes = list_gather(p, device, d->plan, &d->r->order, d->program, region);
    }
    draw_mark(d, MNS_PHASE_GATHER);
    d->stats->list_nodes += nodes - 1;
    if (d->plan->options.measure) {
        if (!list_lengths_add(&d->lengths, p, device, region, nodes))
            return status_no_memory(error, "while measuring the lists");
        draw_pause(d);
    }
    if (d->plan->features & FEATURE_SHUFFLE) list_shuffle(p, device, d->plan, d->program, region);
    return MNS_OK;
}

/* ---- Tiles ---- */

static mns_status upload_tiles(draw *d, mns_error *error)
{
    list_passes *p = &d->r->passes;
    const tile_bins *bins = &d->r->bins;
    const size_t most = d->plan->limits.max_storage_block;
    size_t tiles = (size_t)bins->across * (size_t)bins->down;
    mns_status status = gl_buffer_send(&d->r->device, &p->tile_heads, "tiles", bins->head,
                                       tiles * sizeof *bins->head, most, error);
    p->square_count = d->plan->features & FEATURE_SQUARES ? bins->square_count : 0;
    if (!status && p->square_count)
        status = gl_buffer_send(&d->r->device, &p->squares, "squares to be cast", bins->square,
                                p->square_count * sizeof *bins->square, most, error);
    if (status) return status;
    const int grid[4] = {bins->region.x, bins->region.y, bins->across, bins->shift};
    for (int i = 0; i < 4; i++) p->tile_grid[i] = grid[i];
    return draw_balls_send(d, error);
}

static mns_status bin(draw *d, list_region region, mns_error *error)
{
    mns_renderer *r = d->r;
    tile_bins *bins = &r->bins;
    mns_status status = MNS_OK;
    if (!r->binned || !tile_outlines_serve(bins, d->plan))
        status = tile_outlines_make(bins, &r->order, d->field, d->plan, error);
    r->binned = !status;
    if (!status) status = tile_bins_make(bins, &r->order, d->field, d->plan, region, error);
    draw_mark(d, MNS_PHASE_BIN);
    if (!status && bins->fits) status = upload_tiles(d, error);
    if (status) bins->fits = false;
    draw_mark(d, MNS_PHASE_UPLOAD);
    return status;
}

static mns_status bin_or_reuse(draw *d, list_region region, bool *fits, mns_error *error)
{
    tile_bins *bins = &d->r->bins;
    if (!d->r->binned || !tile_bins_serve(bins, d->plan, region)) {
        mns_status status = bin(d, region, error);
        if (status) return status;
    }
    *fits = bins->fits;
    if (!*fits) return MNS_OK;
    d->stats->list_nodes += bins->count;
    if (d->plan->options.measure) {
        if (!tile_bins_lengths(bins, &d->lengths))
            return status_no_memory(error, "while measuring the lists");
        draw_pause(d);
    }
    return MNS_OK;
}

mns_status draw_lists(draw *d, list_region region, bool *fits, mns_error *error)
{
    return d->plan->features & FEATURE_TILES ? bin_or_reuse(d, region, fits, error)
                                             : gather(d, region, fits, error);
}
