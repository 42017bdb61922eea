#include "base/clock.h"
#include "base/memory.h"
#include "fbvh/builder.h"
#include "list/order.h"

#include <math.h>
#include <omp.h>
#include <string.h>

mns_status fbvh_builder_create(fbvh_builder **builder, mns_error *error)
{
    fbvh_builder *b = calloc(1, sizeof *b);
    if (!b) return status_no_memory(error, "making a builder of trees");
    b->bench_count = (size_t)omp_get_max_threads();
    b->bench = calloc(b->bench_count, sizeof *b->bench);
    b->sort.digits = memory_array((size_t)RADIX_THREADS * RADIX_DIGITS, sizeof *b->sort.digits);
    if (!b->bench || !b->sort.digits) {
        fbvh_builder_destroy(b);
        return status_no_memory(error, "making a builder of trees");
    }
    *builder = b;
    return MNS_OK;
}

void fbvh_builder_destroy(fbvh_builder *b)
{
    if (!b) return;
    for (int i = 0; i < 2; i++) {
        free(b->slot[i].node);
        free(b->slot[i].reference);
        free(b->slot[i].ball);
        free(b->slot[i].strength);
        free(b->slot[i].index);
        free(b->crown.list[i]);
    }
    for (size_t i = 0; b->bench && i < b->bench_count; i++) {
        free(b->bench[i].list);
        free(b->bench[i].node);
        free(b->bench[i].reference);
    }
    free(b->bench);
    free(b->crown.top);
    free(b->crown.job);
    free(b->sort.key);
    free(b->sort.scratch);
    free(b->sort.digits);
    free(b);
}

static bool reserve(fbvh_builder *b, builder_slot *slot, size_t count, bool strengths)
{
    builder_sort *s = &b->sort;
    return work_reserve(&s->key, &s->key_capacity, count + 1, sizeof *s->key) &&
           work_reserve(&s->scratch, &s->scratch_capacity, count + 1, sizeof *s->scratch) &&
           work_reserve(&slot->ball, &slot->ball_capacity, count + 1, sizeof *slot->ball) &&
           work_reserve(&slot->index, &slot->index_capacity, count + 1, sizeof *slot->index) &&
           (!strengths ||
            work_reserve(&slot->strength, &slot->strength_capacity, count + 1, sizeof(float))) &&
           work_reserve(&b->crown.list[0], &b->crown.list_capacity[0], count + 1, sizeof(uint32_t));
}

/* Bounds on references and leaves, so that each packed array fits its block. */
static mns_status set_bounds(const fbvh_options *o, size_t balls, work_node *root, fbvh_figures *figures,
                             mns_error *error)
{
    size_t block = o->max_block_bytes;
    if (balls * sizeof(fbvh_ball) > block || balls >= FBVH_SPLIT || block < 4 * sizeof(fbvh_node))
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "fbvh: %zu balls do not fit a buffer of %zu bytes; use the list, or fewer balls",
                           balls, block);
    const size_t references = block / sizeof(uint32_t), nodes = block / sizeof(fbvh_node);
    double wish = floor(o->references_a_ball * (double)balls);
    double fits = fmin((double)references, (double)UINT32_MAX);
    root->references = fmin(wish, fits);
    /* n leaves are n - 1 pairs under the root's, which is one more. */
    double leaves = fmin((double)nodes, (double)UINT32_MAX) / 2;
    root->leaves = fmin(root->references, leaves);
    figures->made_smaller = fits < wish || leaves < root->references;
    figures->reference_bound = (size_t)root->references;
    return MNS_OK;
}

static void gather_figures(const fbvh_builder *b, builder_slot *slot)
{
    fbvh_tree *t = &slot->tree;
    fbvh_figures *f = &t->figures;
    work_tally sum = {0};
    for (size_t i = 0; i < b->crown.job_count; i++) work_tally_add(&sum, &b->crown.job[i].tally);
    f->leaves = sum.leaves;
    f->leaf_largest = sum.leaf_largest;
    f->leaf_mean = sum.leaves ? (double)t->reference_count / (double)sum.leaves : 0;
    f->own = sum.own;
    f->discarded = sum.discarded;
    f->leaves_bounded = sum.bounded;
    f->leaves_deep = sum.deep;
}

static void count_bytes(const fbvh_builder *b, builder_slot *slot)
{
    const fbvh_tree *t = &slot->tree;
    size_t ball = sizeof *t->ball + (t->strength ? sizeof(float) : 0);
    slot->tree.figures.memory_bytes =
        t->node_count * sizeof *t->node + t->reference_count * sizeof *t->reference + t->ball_count * ball;
    size_t scratch = (b->sort.key_capacity + b->sort.scratch_capacity) * sizeof(uint64_t) +
                     (b->crown.list_capacity[0] + b->crown.list_capacity[1]) * sizeof(uint32_t);
    for (size_t i = 0; i < b->bench_count; i++)
        scratch += (b->bench[i].list_capacity + b->bench[i].reference_capacity) * sizeof(uint32_t) +
                   b->bench[i].node_capacity * sizeof(fbvh_node);
    slot->tree.figures.scratch_bytes = scratch;
}

/* Nodes and references, or none where f < L everywhere. */
static mns_status grow_tree(fbvh_builder *b, builder_slot *slot, const work_set *set, mns_error *error)
{
    work_node root;
    const uint32_t *list;
    b->crown.job_count = 0;
    builder_root(set, b->crown.list[0], &root);
    mns_status status = set_bounds(&set->options, set->count, &root, &slot->tree.figures, error);
    if (status || !root.count) return status;
    if (!work_crown_grow(set, &root, &b->crown, &list) || !builder_work(b, set, list) ||
        !builder_assemble(b, set, slot))
        return status_no_memory(error, "building the tree");
    return MNS_OK;
}

void fbvh_builder_keep(fbvh_builder *b, const fbvh_tree *tree)
{
    b->kept = tree;
}

/* The slot of the build before last, or the one that does not hold what is kept. */
static int next_slot(const fbvh_builder *b)
{
    return b->kept ? b->kept == &b->slot[0].tree : !b->last;
}

mns_status fbvh_build(fbvh_builder *b, const mns_field *field, const fbvh_options *options,
                      const fbvh_tree **tree, mns_error *error)
{
    double start = clock_ms();
    const int next = next_slot(b);
    builder_slot *slot = &b->slot[next];
    work_set set;
    mns_status status = fbvh_options_resolve(options, field->p.count, &set.options, error);
    if (status) return status;
    memset(&slot->tree, 0, sizeof slot->tree);
    slot->tree.kind = set.options.kind;
    if (field->p.count >= FBVH_SPLIT)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "fbvh: %zu balls are more than references can tell apart", field->p.count);
    if (!reserve(b, slot, field->p.count, field->p.strength != NULL))
        return status_no_memory(error, "building the tree");
    if (field->p.count) {
        status = builder_prepare(b, slot, field, &set, error);
        slot->tree.figures.sort_ms = clock_ms() - start;
        work_span_fill(&set, field->kernel);
        if (!status) status = grow_tree(b, slot, &set, error);
        if (status) return status;
        gather_figures(b, slot);
    }
    slot->tree.node = slot->node;
    slot->tree.reference = slot->reference;
    slot->tree.ball = slot->ball;
    slot->tree.strength = field->p.strength ? slot->strength : NULL;
    slot->tree.index = slot->index;
    count_bytes(b, slot);
    slot->tree.figures.build_ms = clock_ms() - start;
    b->last = next;
    *tree = &slot->tree;
    return MNS_OK;
}
