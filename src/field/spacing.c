/* The median distance from a ball to its nearest distinct neighbour: all nearest neighbours over a tree of
 * boxes.
 *
 * The tree halves the tight box of its points along the longest side. Points that coincide can then never
 * part, so a crowd at one place ends in one leaf and is looked at as one point; density may vary without
 * limit; the depth is at most the number of times a box can be halved. The search runs a leaf at a time,
 * since the points of a leaf share most of what they visit. */
#include "base/memory.h"
#include "base/status.h"
#include "field/field.h"

#include <math.h>

enum { LEAF_POINTS = 8, TASK_POINTS = 8192 };

/* Boxes smaller than this count as one place: squares of shorter distances underflow. */
#define COINCIDENT 1e-150

/* An extent between these is taken as it is; beyond, over a power of two. */
#define EXTENT_LEAST 1e-60
#define EXTENT_MOST  1e60

typedef struct point {
    double at[3];
} point;

typedef struct node {
    double lo[3], hi[3];
    uint32_t first, count;
    uint32_t child; /* the first of two, or 0: a leaf */
    bool is_place;  /* all its points coincide */
} node;

typedef struct tree {
    point *points;
    node *nodes;
    size_t node_count;
} tree;

static void fit_box(const tree *t, node *n)
{
    for (int k = 0; k < 3; k++) n->lo[k] = n->hi[k] = t->points[n->first].at[k];
    for (uint32_t i = n->first + 1; i < n->first + n->count; i++)
        for (int k = 0; k < 3; k++) {
            double v = t->points[i].at[k];
            if (v < n->lo[k]) n->lo[k] = v;
            if (v > n->hi[k]) n->hi[k] = v;
        }
}

/* Puts the points at or below `cut` first; gives their number. */
static uint32_t part(point *points, uint32_t count, int axis, double cut)
{
    uint32_t low = 0;
    for (uint32_t i = 0; i < count; i++)
        if (points[i].at[axis] <= cut) {
            point swap = points[low];
            points[low++] = points[i];
            points[i] = swap;
        }
    return low;
}

static void split(tree *t, size_t index)
{
    node *n = &t->nodes[index];
    fit_box(t, n);
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (n->hi[k] - n->lo[k] > n->hi[axis] - n->lo[axis]) axis = k;
    n->is_place = n->hi[axis] - n->lo[axis] <= COINCIDENT;
    if (n->count <= LEAF_POINTS || n->is_place) return;

    /* The middle of two neighbouring doubles rounds to one of them: the lower, so that both sides get points.
     */
    double cut = n->lo[axis] + (n->hi[axis] - n->lo[axis]) / 2;
    if (cut >= n->hi[axis]) cut = n->lo[axis];
    uint32_t low = part(t->points + n->first, n->count, axis, cut);

    size_t child;
#pragma omp atomic capture
    {
        child = t->node_count;
        t->node_count += 2;
    }
    n->child = (uint32_t)child;
    t->nodes[child] = (node){.first = n->first, .count = low};
    t->nodes[child + 1] = (node){.first = n->first + low, .count = n->count - low};
    bool is_large = n->count > TASK_POINTS;
#pragma omp task if (is_large) firstprivate(t, child)
    split(t, child);
    split(t, child + 1);
}

static void build(tree *t, uint32_t count)
{
    t->nodes[0] = (node){.count = count};
    t->node_count = 1;
#pragma omp parallel
#pragma omp single
    split(t, 0);
}

typedef struct search {
    const tree *tree;
    const node *leaf;
    uint32_t count;           /* points searched for */
    double best[LEAF_POINTS]; /* squared */
    double bound;             /* the largest of best */
} search;

static double gap_squared(const node *a, const node *b)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double below = a->lo[k] - b->hi[k], above = b->lo[k] - a->hi[k];
        double gap = below > above ? below : above;
        if (gap > 0) sum += gap * gap;
    }
    return sum;
}

static void visit_leaf(search *s, const node *n)
{
    const point *own = s->tree->points + s->leaf->first, *other = s->tree->points + n->first;
    uint32_t count = n->is_place ? 1 : n->count;
    s->bound = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        for (uint32_t j = 0; j < count; j++) {
            double dx = own[i].at[0] - other[j].at[0], dy = own[i].at[1] - other[j].at[1],
                   dz = own[i].at[2] - other[j].at[2];
            double d = dx * dx + dy * dy + dz * dz;
            if (d > 0 && d < s->best[i]) s->best[i] = d;
        }
        if (s->best[i] > s->bound) s->bound = s->best[i];
    }
}

static void visit(search *s, const node *n)
{
    if (n == s->leaf) return;
    if (!n->child) {
        visit_leaf(s, n);
        return;
    }
    const node *near = &s->tree->nodes[n->child], *far = near + 1;
    double near_gap = gap_squared(near, s->leaf), far_gap = gap_squared(far, s->leaf);
    if (far_gap < near_gap) {
        const node *swap_node = near;
        near = far, far = swap_node;
        double swap_gap = near_gap;
        near_gap = far_gap, far_gap = swap_gap;
    }
    if (near_gap < s->bound) visit(s, near);
    if (far_gap < s->bound) visit(s, far);
}

static void search_leaf(const tree *t, const node *leaf, double *distance)
{
    search s = {.tree = t, .leaf = leaf, .count = leaf->is_place ? 1 : leaf->count};
    for (uint32_t i = 0; i < s.count; i++) s.best[i] = INFINITY;
    visit_leaf(&s, leaf);
    visit(&s, &t->nodes[0]);
    for (uint32_t i = 0; i < leaf->count; i++)
        distance[leaf->first + i] = sqrt(s.best[leaf->is_place ? 0 : i]);
}

/* A power of two about the extent of the centres, where its squares could leave the doubles; else 1. */
static double spacing_unit(const particles *p)
{
    double extent = 0;
    for (int k = 0; k < 3; k++) {
        double low = p->axis[k][0], high = low;
        for (size_t i = 1; i < p->count; i++) {
            low = p->axis[k][i] < low ? p->axis[k][i] : low;
            high = p->axis[k][i] > high ? p->axis[k][i] : high;
        }
        extent = fmax(extent, high - low);
    }
    bool plain = extent >= EXTENT_LEAST && extent <= EXTENT_MOST;
    return plain || !(extent > 0) ? 1 : ldexp(1, ilogb(extent));
}

mns_status field_spacing(const particles *p, double *median, mns_error *error)
{
    mns_status status = MNS_OK;
    if (p->count < 2) {
        *median = 0;
        return MNS_OK;
    }
    if (p->count > UINT32_MAX / 2)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "%zu particles without radii; expected at most %u, or give a radius", p->count,
                           UINT32_MAX / 2);
    const double unit = spacing_unit(p);
    /* A tree of n points has fewer than 2 n nodes; pages never touched cost nothing. */
    tree t = {.points = memory_array(p->count, sizeof *t.points),
              .nodes = memory_array(p->count, 2 * sizeof *t.nodes)};
    double *distance = memory_array(p->count, sizeof *distance);
    if (!t.points || !t.nodes || !distance) {
        status = status_no_memory(error, "measuring the spacing of the particles");
        goto done;
    }
    for (size_t i = 0; i < p->count; i++)
        for (int k = 0; k < 3; k++) t.points[i].at[k] = p->axis[k][i] / unit;
    build(&t, (uint32_t)p->count);
#pragma omp parallel for schedule(dynamic, 256)
    for (size_t i = 0; i < t.node_count; i++)
        if (!t.nodes[i].child) search_leaf(&t, &t.nodes[i], distance);
    /* Infinite means that all centres coincide. */
    *median = isfinite(distance[0]) ? field_median(distance, p->count) * unit : 0;
done:
    free(distance);
    free(t.nodes);
    free(t.points);
    return status;
}
