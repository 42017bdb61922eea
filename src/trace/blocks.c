#include "trace/blocks.h"

#include "base/memory.h"
#include "base/status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The boxes ---- */

/* Some thousand boxes follow a surface closely enough, and are projected in a fraction of a millisecond. */
enum { BOXES_MOST = 4096 };

static trace_box box_of(const fbvh_node *node)
{
    trace_box box;
    memcpy(box.lo, node->lo, sizeof box.lo);
    memcpy(box.hi, node->hi, sizeof box.hi);
    return box;
}

/* Puts nodes' children in their place where they have some. Returns how many nodes there are then, or 0 where
 * they are more than BOXES_MOST, or as many as before. */
static size_t descend(const fbvh_tree *tree, const uint32_t *node, size_t count, uint32_t *below)
{
    size_t past = 0;
    for (size_t i = 0; i < count; i++) {
        const fbvh_node *n = &tree->node[node[i]];
        if (past + 2 > BOXES_MOST) return 0;
        below[past++] = n->count ? node[i] : n->first;
        if (!n->count) below[past++] = n->first + 1;
    }
    return past > count ? past : 0;
}

mns_status trace_blocks_take(trace_blocks *blocks, const fbvh_tree *tree, mns_error *error)
{
    uint32_t nodes[2][BOXES_MOST] = {{0}};
    size_t count = tree->node_count ? 1 : 0, more;
    int now = 0;
    while (count && (more = descend(tree, nodes[now], count, nodes[1 - now])) > 0) {
        count = more;
        now = 1 - now;
    }
    if (count > blocks->box_capacity) {
        trace_box *larger = memory_resize(blocks->box, BOXES_MOST, sizeof *larger);
        if (!larger) return status_no_memory(error, "while sending a tree");
        blocks->box = larger;
        blocks->box_capacity = BOXES_MOST;
    }
    for (size_t i = 0; i < count; i++) blocks->box[i] = box_of(&tree->node[nodes[now][i]]);
    blocks->box_count = count;
    memcpy(blocks->origin, tree->origin, sizeof blocks->origin);
    return MNS_OK;
}

/* ---- The blocks ---- */

/* Pixels low to high in which a box may be seen; low > high where it is behind the eye, all there are where
 * only a part of it is. */
typedef struct box_image {
    double low[2], high[2];
} box_image;

static box_image image_of(const trace_box *box, vec3 eye, const view_frame *f)
{
    box_image image = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    const double pixels = f->height / (2 * f->tan_half), middle[2] = {0.5 * f->width, 0.5 * f->height};
    int behind = 0;
    for (int corner = 0; corner < 8; corner++) {
        vec3 c = {(double)(corner & 1 ? box->hi : box->lo)[0] - eye.x,
                  (double)(corner & 2 ? box->hi : box->lo)[1] - eye.y,
                  (double)(corner & 4 ? box->hi : box->lo)[2] - eye.z};
        double z = vec3_dot(c, f->forward), off[2] = {vec3_dot(c, f->right), vec3_dot(c, f->up)};
        if (!(z > 1e-9 * vec3_length(c))) {
            behind++;
            continue;
        }
        for (int axis = 0; axis < 2; axis++) {
            double at = middle[axis] + off[axis] / z * pixels;
            image.low[axis] = fmin(image.low[axis], at);
            image.high[axis] = fmax(image.high[axis], at);
        }
    }
    if (behind > 0 && behind < 8) return (box_image){{-INFINITY, -INFINITY}, {INFINITY, INFINITY}};
    return image;
}

/* Samples lie within half a pixel of centres; the rest is for rounding. */
#define IMAGE_MARGIN 1.0

/* The blocks [first, past) along one axis that hold low to high, `from` being where the region begins. */
static void blocks_along(double low, double high, int from, int size, int *first, int *past)
{
    const int side = 1 << TRACE_BLOCK_SHIFT, most = (size + side - 1) >> TRACE_BLOCK_SHIFT;
    double begin = floor((low - IMAGE_MARGIN - from) / side),
           end = floor((high + IMAGE_MARGIN - from) / side) + 1;
    *first = (int)fmin(fmax(begin, 0), most);
    *past = (int)fmin(fmax(end, 0), most);
}

/* What lies behind the eye touches nothing: its image is empty, and so its blocks are. */
static void touch(trace_blocks *blocks, const box_image *image, list_region region, int across)
{
    int x0, x1, y0, y1;
    blocks_along(image->low[0], image->high[0], region.x, region.width, &x0, &x1);
    blocks_along(image->low[1], image->high[1], region.y, region.height, &y0, &y1);
    for (int y = y0; y < y1 && x0 < x1; y++)
        memset(blocks->touched + (size_t)y * (size_t)across + (size_t)x0, 1, (size_t)(x1 - x0));
}

static mns_status reserve(trace_blocks *blocks, size_t count, mns_error *error)
{
    if (count <= blocks->touched_capacity) return MNS_OK;
    free(blocks->touched), free(blocks->list);
    blocks->touched = memory_array(count, sizeof *blocks->touched);
    blocks->list = memory_array(count + 1, sizeof *blocks->list);
    blocks->touched_capacity = blocks->touched && blocks->list ? count : 0;
    return blocks->touched_capacity ? MNS_OK : status_no_memory(error, "while sending a tree");
}

mns_status trace_blocks_list(trace_blocks *blocks, const mns_plan *plan, list_region region, mns_error *error)
{
    const int side = 1 << TRACE_BLOCK_SHIFT;
    int across = (region.width + side - 1) >> TRACE_BLOCK_SHIFT,
        down = (region.height + side - 1) >> TRACE_BLOCK_SHIFT;
    size_t all = (size_t)across * (size_t)down;
    mns_status status = reserve(blocks, all, error);
    if (status) return status;
    vec3 eye = vec3_sub(plan->frame.eye, vec3_load(blocks->origin));
    /* Of what is to be counted every ray is, those that miss too. */
    memset(blocks->touched, plan->features & FEATURE_COUNTERS ? 1 : 0, all);
    for (size_t i = 0; i < blocks->box_count; i++) {
        box_image image = image_of(&blocks->box[i], eye, &plan->frame);
        touch(blocks, &image, region, across);
    }
    uint32_t count = 0;
    for (int y = 0; y < down; y++)
        for (int x = 0; x < across; x++)
            if (blocks->touched[(size_t)y * (size_t)across + (size_t)x])
                blocks->list[1 + count++] = (uint32_t)x | (uint32_t)y << 16;
    blocks->list[0] = count;
    return MNS_OK;
}

void trace_blocks_free(trace_blocks *blocks)
{
    free(blocks->box), free(blocks->touched), free(blocks->list);
    *blocks = (trace_blocks){0};
}
