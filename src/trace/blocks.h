/* Which blocks of 8x8 pixels a tree's boxes can touch: rays of all others miss, and are not traced. */
#ifndef MNS_TRACE_BLOCKS_H
#define MNS_TRACE_BLOCKS_H

#include "fbvh/fbvh.h"
#include "list/passes.h"

enum { TRACE_BLOCK_SHIFT = 3 }; /* as in glsl/fbvh.glsl */

typedef struct trace_box {
    float lo[3], hi[3]; /* from the tree's origin */
} trace_box;

/* Zeroed is empty. */
typedef struct trace_blocks {
    trace_box *box; /* of the tree's upper nodes: together they hold the surface */
    size_t box_count, box_capacity;
    double origin[3];
    uint8_t *touched; /* a block of the region */
    size_t touched_capacity;
    uint32_t *list; /* how many blocks, then of each its column and, 16 bits up, its row */
    size_t list_capacity;
} trace_blocks;

/* Takes the boxes of a tree, which may go then. Errors: MEMORY. */
mns_status trace_blocks_take(trace_blocks *blocks, const fbvh_tree *tree, mns_error *error);
/* Lists the blocks of a region that the boxes touch in a view, whatever its samples. Errors: MEMORY. */
mns_status trace_blocks_list(trace_blocks *blocks, const mns_plan *plan, list_region region,
                             mns_error *error);
void trace_blocks_free(trace_blocks *blocks);

#endif
