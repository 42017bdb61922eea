/* The tree of boxes over a set's triangles: by the surface area heuristic over bins of their middles. */
#include "base/memory.h"
#include "solid/solid.h"

#include <string.h>

/* From this depth on ranges are halved, so that no tree is deeper than SOLID_DEPTH. */
enum { BINS = 16, LEAF_MOST = 4, HALVE_FROM = 32 };

typedef struct bounds {
    double lo[3], hi[3];
} bounds;

/* A triangle on its way into the tree. */
typedef struct item {
    bounds box;
    double middle[3];
    uint32_t index;
} item;

static const bounds nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void grow(bounds *b, const double lo[3], const double hi[3])
{
    for (int a = 0; a < 3; a++) b->lo[a] = fmin(b->lo[a], lo[a]), b->hi[a] = fmax(b->hi[a], hi[a]);
}

/* Half of a box's surface. */
static double area(const bounds *b)
{
    double x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

static int bin_of(const item *i, int axis, const bounds *middles)
{
    double span = middles->hi[axis] - middles->lo[axis];
    int bin = (int)(BINS * ((i->middle[axis] - middles->lo[axis]) / span));
    return bin < BINS ? bin : BINS - 1;
}

/* The cheapest split along an axis: below bin *split. INFINITY where the middles are one. */
static double cheapest(const item *items, size_t count, int axis, const bounds *middles, int *split)
{
    bounds box[BINS], left = nothing, right = nothing;
    size_t in[BINS] = {0}, below = 0;
    double cost[BINS], best = INFINITY;
    if (!(middles->hi[axis] > middles->lo[axis])) return INFINITY;
    for (int b = 0; b < BINS; b++) box[b] = nothing;
    for (size_t i = 0; i < count; i++) {
        int b = bin_of(&items[i], axis, middles);
        grow(&box[b], items[i].box.lo, items[i].box.hi);
        in[b]++;
    }
    for (int b = 1; b < BINS; b++) {
        grow(&left, box[b - 1].lo, box[b - 1].hi);
        below += in[b - 1];
        cost[b] = area(&left) * (double)below;
    }
    for (int b = BINS - 1; b > 0; b--) {
        grow(&right, box[b].lo, box[b].hi);
        double both = cost[b] + area(&right) * (double)(count - below);
        if (below > 0 && below < count && both < best) best = both, *split = b;
        below -= in[b - 1];
    }
    return best;
}

static void swap(item *a, item *b)
{
    item other = *a;
    *a = *b, *b = other;
}

/* How many items go to the first child, which are put first. */
static size_t divide(item *items, size_t count, int depth, const bounds *middles)
{
    double best = INFINITY;
    int axis = -1, below = 0;
    for (int a = 0; a < 3 && depth < HALVE_FROM; a++) {
        int split = 0;
        double cost = cheapest(items, count, a, middles, &split);
        if (cost < best) best = cost, axis = a, below = split;
    }
    if (axis < 0) return count / 2;
    size_t first = 0;
    for (size_t i = 0; i < count; i++)
        if (bin_of(&items[i], axis, middles) < below) swap(&items[first++], &items[i]);
    return first;
}

static void build(solid_set *set, uint32_t at, item *all, size_t begin, size_t count, int depth)
{
    bounds box = nothing, middles = nothing;
    item *items = all + begin;
    for (size_t i = 0; i < count; i++) {
        grow(&box, items[i].box.lo, items[i].box.hi);
        grow(&middles, items[i].middle, items[i].middle);
    }
    solid_node *node = &set->node[at];
    memcpy(node->lo, box.lo, sizeof node->lo);
    memcpy(node->hi, box.hi, sizeof node->hi);
    node->first = (uint32_t)begin;
    node->count = (uint32_t)count;
    if (count <= LEAF_MOST) return;
    size_t first = divide(items, count, depth, &middles);
    uint32_t child = (uint32_t)set->node_count;
    set->node_count += 2;
    node->first = child;
    node->count = 0;
    build(set, child, all, begin, first, depth + 1);
    build(set, child + 1, all, begin + first, count - first, depth + 1);
}

static item item_of(const solid_set *set, size_t i)
{
    item one = {.box = nothing, .index = (uint32_t)i};
    for (int k = 0; k < 3; k++) {
        const double *corner = set->corner[set->triangle[i].corner[k]];
        grow(&one.box, corner, corner);
    }
    for (int a = 0; a < 3; a++) one.middle[a] = 0.5 * one.box.lo[a] + 0.5 * one.box.hi[a];
    return one;
}

bool solid_tree_build(solid_set *set)
{
    size_t count = set->triangle_count;
    item *items = memory_array(count, sizeof *items);
    solid_triangle *ordered = memory_array(count, sizeof *ordered);
    set->node = memory_array(2 * count, sizeof *set->node);
    bool made = items && ordered && set->node;
    if (made && count) {
        for (size_t i = 0; i < count; i++) items[i] = item_of(set, i);
        set->node_count = 1;
        build(set, 0, items, 0, count, 0);
        for (size_t i = 0; i < count; i++) ordered[i] = set->triangle[items[i].index];
        memcpy(set->triangle, ordered, count * sizeof *ordered);
    }
    free(items);
    free(ordered);
    return made;
}
