/* Inside the builder: its arrays, which live from build to build. */
#ifndef MNS_FBVH_BUILDER_H
#define MNS_FBVH_BUILDER_H

#include "base/status.h"
#include "fbvh/work.h"

typedef struct builder_sort {
    uint64_t *key, *scratch;
    size_t key_capacity, scratch_capacity;
    uint32_t *digits;
} builder_sort;

/* A tree and what it owns; there are two, for one to be drawn while the other is built. */
typedef struct builder_slot {
    fbvh_tree tree;
    fbvh_node *node;
    uint32_t *reference;
    fbvh_ball *ball;
    float *strength;
    uint32_t *index;
    size_t node_capacity, reference_capacity, ball_capacity, strength_capacity, index_capacity;
} builder_slot;

struct fbvh_builder {
    builder_slot slot[2];
    int last;              /* the slot of the last build */
    const fbvh_tree *kept; /* builds leave its slot alone; NULL: none */
    builder_sort sort;
    work_crown crown;
    work_bench *bench; /* one a thread */
    size_t bench_count;
};

/* Room for `count` balls must be there. Errors: UNSUPPORTED. */
mns_status builder_prepare(fbvh_builder *builder, builder_slot *slot, const mns_field *field, work_set *set,
                           mns_error *error);
/* All balls as one node, its bounds left open; count 0: f < L everywhere. */
void builder_root(const work_set *set, uint32_t *list, work_node *root);

/* Builds all jobs, then the slot's arrays out of the crown and the benches. False: out of memory. */
bool builder_work(fbvh_builder *builder, const work_set *set, const uint32_t *list);
bool builder_assemble(fbvh_builder *builder, const work_set *set, builder_slot *slot);

/* Options with every default for so many balls put in. Errors: USAGE. */
mns_status fbvh_options_resolve(const fbvh_options *options, size_t balls, fbvh_options *o, mns_error *error);

#endif
