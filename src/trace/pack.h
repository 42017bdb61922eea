/* A tree of fbvh_build in the form that glsl/tree.glsl reads. */
#ifndef MNS_TRACE_PACK_H
#define MNS_TRACE_PACK_H

#include "fbvh/fbvh.h"
#include "plan/plan.h"

/* Links and marks, as in glsl/tree.glsl. */
#define TRACE_LEAF 0x80000000u
#define TRACE_NONE 0xffffffffu

/* Two siblings: of each the box on the grid, the low plane of an axis in the lower half of a word, and a
 * link. */
typedef struct trace_pair {
    struct {
        uint32_t box[3], link;
    } child[2];
} trace_pair;

typedef struct trace_leaf {
    float lo[3];
    uint32_t first;
    float hi[3];
    uint32_t count;
} trace_leaf;

/* How the boxes of pairs are written: lo + step * cell. */
typedef struct trace_grid {
    float base[3], cell[3];
    uint32_t root;
    size_t pair_count, leaf_count;
} trace_grid;

trace_grid trace_grid_of(const fbvh_tree *tree);
/* Fill pair_count pairs, leaf_count leaves. */
void trace_pack_nodes(const fbvh_tree *tree, const trace_grid *grid, trace_pair *pair, trace_leaf *leaf);

/* The balls of `index` (into the field; the tree's order) as glsl/balls.glsl reads them, plan_tree_floats
 * floats each, relative to `origin`; what their floats left over; their colours. */
void trace_pack_balls(const fbvh_tree *tree, const mns_plan *plan, float *out);
void trace_pack_low(const uint32_t *index, size_t count, const mns_field *field, const mns_plan *plan,
                    float *out);
void trace_pack_colors(const uint32_t *index, size_t count, const mns_field *field, const mns_plan *plan,
                       void *out);

#endif
