/* A subtree, depth first, by one thread. */
#include "base/memory.h"
#include "fbvh/work.h"

#include <string.h>

bool work_reserve(void *block, size_t *capacity, size_t count, size_t size)
{
    if (count <= *capacity) return true;
    size_t wish = *capacity + *capacity / 2;
    if (wish < count) wish = count;
    void *old;
    memcpy(&old, block, sizeof old);
    void *grown = memory_resize(old, wish, size);
    if (!grown) return false;
    memcpy(block, &grown, sizeof grown);
    *capacity = wish;
    return true;
}

static bool close_leaf(const work_set *set, work_node *node, work_bench *bench, fbvh_node *result,
                       bool *found, work_tally *tally)
{
    uint32_t *list = bench->list + node->first;
    size_t discarded, count = work_leaf(set, node, list, &bench->block, &discarded);
    *found = count > 0;
    if (!count) return true;
    if (!work_reserve(&bench->reference, &bench->reference_capacity, bench->reference_count + count,
                      sizeof *bench->reference))
        return false;
    memcpy(bench->reference + bench->reference_count, list, count * sizeof *list);
    *result = (fbvh_node){.first = (uint32_t)bench->reference_count, .count = (uint32_t)count};
    memcpy(result->lo, node->lo, sizeof result->lo);
    memcpy(result->hi, node->hi, sizeof result->hi);
    bench->reference_count += count;
    tally->leaves++;
    tally->discarded += discarded;
    tally->own += node->own;
    if (count > tally->leaf_largest) tally->leaf_largest = count;
    return true;
}

/* In a crowd it is asked first whether the box is deep inside, for that costs less than the planes; else only
 * of what would be cut. */
enum { CROWDED = 64 };

/* Cuts the node; its children's references take the place of its own in the stack, the second's below the
 * first's, so that the first can be built and forgotten. 1: two children; 0: one, which *node has become;
 * -1: a leaf; -2: no surface; -3: out of memory. */
enum { CUT_PAIR = 1, CUT_ONE = 0, CUT_LEAF = -1, CUT_EMPTY = -2, CUT_MEMORY = -3 };
static int cut_node(const work_set *set, work_node *node, work_bench *bench, work_node child[2],
                    work_tally *tally)
{
    work_cut cut;
    bool bounded = false;
    size_t step = work_look(set, node, bench->list + node->first, &bench->block);
    const bool ask = step == 1 && !set->options.no_deep, crowded = node->count > CROWDED;
    bool deep = ask && crowded && work_deep(set, node, &bench->block);
    bool wanted = !deep && work_choose(set, node, &bench->block, step, &cut, &bounded);
    if (ask && !crowded && (wanted || bounded)) deep = work_deep(set, node, &bench->block);
    if (deep) {
        tally->deep++;
        return CUT_LEAF;
    }
    tally->bounded += bounded;
    if (!wanted) return CUT_LEAF;
    size_t top = node->first + node->count;
    if (!work_reserve(&bench->list, &bench->list_capacity, top + 2 * node->count, sizeof *bench->list))
        return CUT_MEMORY;
    uint32_t *list = bench->list + node->first;
    uint32_t *list_of[2] = {list + node->count, list + 2 * node->count};
    work_part(set, node, list, &cut, &bench->block, list_of, child);
    if (!work_share(node, child)) {
        tally->bounded++;
        return CUT_LEAF;
    }
    if (!child[0].count && !child[1].count) return CUT_EMPTY;
    child[1].first = node->first;
    child[0].first = node->first + child[1].count;
    memcpy(list, list_of[1], child[1].count * sizeof *list);
    memmove(list + child[1].count, list_of[0], child[0].count * sizeof *list);
    if (child[0].count && child[1].count) return CUT_PAIR;
    *node = child[child[0].count ? 0 : 1];
    return CUT_ONE;
}

static bool grow(const work_set *set, work_node *node, work_bench *bench, fbvh_node *result, bool *found,
                 work_tally *tally, size_t *depth)
{
    work_node child[2];
    int cut;
    *depth = 0;
    do cut = cut_node(set, node, bench, child, tally);
    while (cut == CUT_ONE);
    *found = false;
    if (cut == CUT_LEAF) return close_leaf(set, node, bench, result, found, tally);
    if (cut != CUT_PAIR) return cut == CUT_EMPTY;

    fbvh_node pair[2];
    bool is[2];
    size_t depth_of[2];
    double references = child[0].references, leaves = child[0].leaves;
    size_t references_before = bench->reference_count, leaves_before = tally->leaves;
    if (!grow(set, &child[0], bench, &pair[0], &is[0], tally, &depth_of[0])) return false;
    /* What the first did not need of its bounds is the second's: it may have been deep inside. */
    child[1].references += references - (double)(bench->reference_count - references_before);
    child[1].leaves += leaves - (double)(tally->leaves - leaves_before);
    if (!grow(set, &child[1], bench, &pair[1], &is[1], tally, &depth_of[1])) return false;
    *found = is[0] || is[1];
    if (is[0] != is[1]) {
        *result = pair[is[1]];
        *depth = depth_of[is[1]];
    }
    if (!is[0] || !is[1]) return true;
    if (!work_reserve(&bench->node, &bench->node_capacity, bench->node_count + 2, sizeof *bench->node))
        return false;
    *result = work_join(set, node, pair, bench->node_count);
    memcpy(bench->node + bench->node_count, pair, sizeof pair);
    bench->node_count += 2;
    *depth = 1 + (depth_of[0] > depth_of[1] ? depth_of[0] : depth_of[1]);
    return true;
}

bool work_subtree(const work_set *set, const work_node *node, const uint32_t *list, work_bench *bench,
                  fbvh_node *result, bool *found, work_tally *tally)
{
    if (!work_reserve(&bench->list, &bench->list_capacity, 3 * node->count, sizeof *bench->list))
        return false;
    memcpy(bench->list, list, node->count * sizeof *list);
    work_node root = *node;
    root.first = 0;
    return grow(set, &root, bench, result, found, tally, &tally->depth);
}
