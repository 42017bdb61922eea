#include "reference/tree.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { LEAF_MOST = 4, DEPTH_MOST = 128 }; /* halving leaves at most 64 levels */

bool reference_list_reserve(reference_list *list, size_t count)
{
    if (count <= list->capacity) return true;
    size_t capacity = list->capacity ? list->capacity : 64;
    while (capacity < count) {
        if (capacity > SIZE_MAX / 2) return false;
        capacity *= 2;
    }
    size_t *item = memory_resize(list->item, capacity, sizeof *item);
    if (!item) return false;
    list->item = item;
    list->capacity = capacity;
    return true;
}

/* ---- Building ---- */

/* Puts the balls [first, last) in such an order along `axis` that none before `middle` lies beyond one after.
 * Both scans stop at equal keys, so that coincident centres split evenly too. */
static void select_middle(size_t *ball, const double *axis, size_t first, size_t last, size_t middle)
{
    while (last - first > 1) {
        double pivot = axis[ball[first + (last - first) / 2]];
        size_t i = first, j = last - 1;
        for (;;) {
            while (axis[ball[i]] < pivot) i++;
            while (axis[ball[j]] > pivot) j--;
            if (i >= j) break;
            size_t swap = ball[i];
            ball[i++] = ball[j], ball[j--] = swap;
        }
        /* [first, i) <= pivot <= [j + 1, last) */
        if (middle < i && i < last)
            last = i;
        else if (middle > j && j + 1 > first)
            first = j + 1;
        else
            return;
    }
}

/* The box of the spheres of balls [first, last), and the axis along which their centres spread furthest. */
static int measure(reference_node *node, const reference_tree *tree, const mns_field *f, size_t first,
                   size_t last)
{
    int widest = 0;
    double spread = -1;
    for (int a = 0; a < 3; a++) {
        double lo = INFINITY, hi = -INFINITY, centre_lo = INFINITY, centre_hi = -INFINITY;
        for (size_t i = first; i < last; i++) {
            double p = f->p.axis[a][tree->ball[i]], r = field_radius(f, tree->ball[i]);
            lo = fmin(lo, p - r), hi = fmax(hi, p + r);
            centre_lo = fmin(centre_lo, p), centre_hi = fmax(centre_hi, p);
        }
        node->lo[a] = lo, node->hi[a] = hi;
        if (centre_hi - centre_lo > spread) spread = centre_hi - centre_lo, widest = a;
    }
    return widest;
}

static void build(reference_tree *tree, const mns_field *f, size_t first, size_t last)
{
    reference_node *node = &tree->node[tree->node_count++];
    int axis = measure(node, tree, f, first, last);
    node->first = first;
    node->count = last - first;
    if (node->count <= LEAF_MOST) return;
    size_t middle = first + node->count / 2;
    node->count = 0;
    select_middle(tree->ball, f->p.axis[axis], first, last, middle);
    build(tree, f, first, middle);
    node->right = tree->node_count;
    build(tree, f, middle, last);
}

bool reference_tree_build(reference_tree *tree, const mns_field *field)
{
    size_t count = field->p.count;
    memset(tree, 0, sizeof *tree);
    if (!count) return true;
    tree->ball = memory_array(count, sizeof *tree->ball);
    tree->node = memory_array(count, 2 * sizeof *tree->node); /* a leaf holds at least one ball */
    if (!tree->ball || !tree->node) return false;
    for (size_t i = 0; i < count; i++) tree->ball[i] = i;
    build(tree, field, 0, count);
    return true;
}

void reference_tree_free(reference_tree *tree)
{
    free(tree->node);
    free(tree->ball);
    memset(tree, 0, sizeof *tree);
}

/* ---- Asking ---- */

typedef struct slabs {
    double origin[3], inverse[3], pad[3], reach;
} slabs;

static bool meets(const slabs *s, const reference_node *node)
{
    double from = 0, to = s->reach;
    for (int a = 0; a < 3; a++) {
        double t0 = (node->lo[a] - s->pad[a] - s->origin[a]) * s->inverse[a];
        double t1 = (node->hi[a] + s->pad[a] - s->origin[a]) * s->inverse[a];
        double near = t0 < t1 ? t0 : t1, far = t0 < t1 ? t1 : t0;
        if (near > from) from = near;
        if (far < to) to = far;
    }
    return from <= to;
}

bool reference_tree_collect(const reference_tree *tree, const double origin[3], const double direction[3],
                            const double pad[3], double reach, reference_list *list)
{
    size_t stack[DEPTH_MOST], top = 0;
    slabs s = {.reach = reach};
    list->count = 0;
    for (int a = 0; a < 3; a++) {
        /* A ray along a slab: so small a step aside moves nothing, and 0 / 0 cannot come about. */
        double d = fabs(direction[a]) < 1e-200 ? 1e-200 : direction[a];
        s.origin[a] = origin[a], s.inverse[a] = 1 / d, s.pad[a] = pad[a];
    }
    if (tree->node_count) stack[top++] = 0;
    while (top) {
        size_t index = stack[--top];
        const reference_node *node = &tree->node[index];
        if (!meets(&s, node)) continue;
        if (!node->count) {
            stack[top++] = node->right;
            stack[top++] = index + 1;
            continue;
        }
        if (!reference_list_reserve(list, list->count + node->count)) return false;
        memcpy(list->item + list->count, tree->ball + node->first, node->count * sizeof *list->item);
        list->count += node->count;
    }
    return true;
}

void reference_tree_around(const reference_tree *tree, const double point[3],
                           void (*visit)(void *user, size_t ball), void *user)
{
    size_t stack[DEPTH_MOST], top = 0;
    if (tree->node_count) stack[top++] = 0;
    while (top) {
        size_t index = stack[--top];
        const reference_node *node = &tree->node[index];
        bool holds = true;
        for (int a = 0; a < 3; a++) holds = holds && node->lo[a] <= point[a] && point[a] <= node->hi[a];
        if (!holds) continue;
        for (size_t i = 0; i < node->count; i++) visit(user, tree->ball[node->first + i]);
        if (node->count) continue;
        stack[top++] = node->right;
        stack[top++] = index + 1;
    }
}
