/* The balls of a frame on their way to the GPU. */
#include "render/draw.h"

#include "list/pack.h"
#include "shade/ball_colors.h"

#include <string.h>

/* Features that change which balls are sent, how they are ordered and what is sent of each. */
#define BALL_FEATURES                                                                                        \
    (FEATURE_RADII | FEATURE_STRENGTHS | FEATURE_CORE_RADII | FEATURE_POINTS | FEATURE_QUADS | FEATURE_FAR | \
     FEATURE_TILES)
/* And, among tiles, what drops hidden balls from the order: samples beside the centre may see them. */
#define TILE_FEATURES (BALL_FEATURES | FEATURE_SAMPLES)

static uint64_t ball_features(const mns_plan *plan)
{
    return plan->features & (plan->features & FEATURE_TILES ? TILE_FEATURES : BALL_FEATURES);
}

render_colors draw_colors_of(const mns_plan *plan)
{
    render_colors colors = {.features = plan->features & (FEATURE_BLENDS | FEATURE_LABELS)};
    if (plan->features & FEATURE_COLORS) {
        colors.column = plan->color_column;
        memcpy(colors.range, plan->color_range, sizeof colors.range);
    }
    if (plan->features & FEATURE_MATERIALS) {
        colors.blend_column = plan->blend_column;
        memcpy(colors.blend_range, plan->look.blend.range, sizeof colors.blend_range);
    }
    return colors;
}

static bool same_balls(const draw *d)
{
    const render_last *last = &d->r->last;
    const mns_plan *plan = d->plan;
    const render_colors colors = draw_colors_of(plan);
    return !plan->options.moved && last->field == d->field && last->stamp == d->field->stamp &&
           last->features == ball_features(plan) &&
           memcmp(&last->frame, &plan->frame, sizeof plan->frame) == 0 &&
           memcmp(last->origin, plan->origin, sizeof last->origin) == 0 &&
           memcmp(&last->colors, &colors, sizeof colors) == 0;
}

static void remember(draw *d)
{
    const mns_plan *plan = d->plan;
    render_last *last = &d->r->last;
    *last = (render_last){
        .field = d->field, .stamp = d->field->stamp, .features = ball_features(plan), .frame = plan->frame};
    memcpy(last->origin, plan->origin, sizeof last->origin);
    last->colors = draw_colors_of(plan);
}

/* What is sent of each ball. */
typedef enum ball_part { PART_HIGH, PART_LOW, PART_CORES, PART_COLORS } ball_part;

/* Fills a buffer, `size` bytes a ball. Tiles' lists hold their balls' records themselves; record 0 is no
 * list's. */
static void pack(const draw *d, ball_part part, size_t size, char *out)
{
    const list_order *order = &d->r->order;
    bool tiles = d->plan->features & FEATURE_TILES;
    list_chosen chosen = {NULL, order->count};
    if (tiles) {
        chosen = (list_chosen){d->r->bins.place + 1, d->r->bins.count};
        memset(out, 0, size);
        out += size;
    }
    switch (part) {
    case PART_HIGH:
        list_pack_high(order, chosen, d->field, d->plan, (float *)(void *)out);
        if (!tiles) list_pack_quads(order, d->plan, (float *)(void *)out);
        break;
    case PART_LOW:
        list_pack_low(order, chosen, d->field, d->plan, (float *)(void *)out);
        break;
    case PART_CORES:
        list_pack_cores(order, d->field, (float *)(void *)out);
        break;
    case PART_COLORS:
        list_pack_colors(order, chosen, d->field, d->plan, out);
        break;
    }
}

/* Maps a buffer of `floats` floats a ball and fills it. */
static mns_status upload(draw *d, gl_buffer *buffer, const char *what, size_t floats, ball_part part,
                         mns_error *error)
{
    gl_device *device = &d->r->device;
    const list_order *order = &d->r->order;
    size_t records = order->count + (part == PART_HIGH ? order->quads : 0);
    if (d->plan->features & FEATURE_TILES) records = d->r->bins.count + 1;
    size_t size = (records ? records : 1) * floats * sizeof(float);
    void *data;
    do {
        mns_status status =
            gl_buffer_reserve(device, buffer, what, size, d->plan->limits.max_storage_block, error);
        if (!status) status = gl_buffer_map(device, buffer, size, &data, error);
        if (status) return status;
        pack(d, part, floats * sizeof(float), data);
    } while (!gl_buffer_unmap(device, buffer));
    return MNS_OK;
}

mns_status draw_balls_send(draw *d, mns_error *error)
{
    list_passes *p = &d->r->passes;
    bool cores = d->plan->features & FEATURE_CORE_RADII && !(d->plan->features & FEATURE_TILES);
    d->r->last.low = false;
    mns_status status = upload(d, &p->balls, "balls", d->plan->ball_floats, PART_HIGH, error);
    if (!status && cores) status = upload(d, &p->cores, "core radii", 1, PART_CORES, error);
    if (!status && d->plan->features & FEATURE_BLENDS)
        status = upload(d, &p->colors, "colours", ball_colors_words(d->plan), PART_COLORS, error);
    return status;
}

/* The indices that draw points farthest first; they change only when there are more balls than ever. */
static mns_status count_backwards(draw *d, mns_error *error)
{
    gl_device *device = &d->r->device;
    gl_buffer *buffer = &d->r->passes.backwards;
    size_t size = d->r->order.count * sizeof(uint32_t);
    uint32_t *index;
    if (buffer->id && buffer->size >= size) return MNS_OK;
    mns_status status = gl_buffer_reserve(device, buffer, "indices", size, 0, error);
    do {
        if (!status) status = gl_buffer_map(device, buffer, buffer->size, (void **)&index, error);
        if (status) return status;
        size_t count = buffer->size / sizeof *index;
        for (size_t i = 0; i < count; i++) index[i] = (uint32_t)(count - 1 - i);
    } while (!gl_buffer_unmap(device, buffer));
    return MNS_OK;
}

mns_status draw_balls_upload(draw *d, mns_error *error)
{
    if (same_balls(d)) return MNS_OK;
    d->r->last = (render_last){0};
    d->r->binned = false;
    bool tiles = d->plan->features & FEATURE_TILES; /* whose balls go up with the lists */
    bool hides = tiles && d->plan->features & FEATURE_CORE;
    size_t count = d->field->p.count;
    mns_status status =
        list_order_make(&d->r->order, d->field, d->plan, hides ? tile_near(count) : count, error);
    draw_mark(d, MNS_PHASE_SORT);
    if (!status && !tiles) status = draw_balls_send(d, error);
    if (!status && d->plan->features & FEATURE_POINTS) status = count_backwards(d, error);
    draw_mark(d, MNS_PHASE_UPLOAD);
    if (!status) remember(d);
    return status;
}

mns_status draw_wide_view(draw *d, mns_error *error)
{
    list_passes *p = &d->r->passes;
    mns_status status = gl_buffer_reserve(&d->r->device, &p->view_wide, "view", sizeof d->wide, 0, error);
    if (!status) draw_send(d, &p->view_wide, d->wide, sizeof d->wide);
    return status;
}

mns_status draw_low_upload(draw *d, mns_error *error)
{
    list_passes *p = &d->r->passes;
    mns_status status = draw_wide_view(d, error);
    if (status) return status;
    if (d->r->last.low) return MNS_OK;
    draw_mark(d, MNS_PHASE_CAST);
    status = upload(d, &p->balls_low, "balls", d->plan->ball_floats, PART_LOW, error);
    d->r->last.low = !status;
    draw_mark(d, MNS_PHASE_UPLOAD);
    return status;
}
