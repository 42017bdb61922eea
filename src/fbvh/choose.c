/* Where to cut a node: a greedy surface area heuristic over bins (Gourmel et al. 2010, section 5.1.1). */
#include "fbvh/work.h"

#include <float.h>
#include <string.h>

enum { BINS_MOST = 16, BINS_FEW = 8, FEW = 256 };

typedef struct bins {
    int count;
    float lo[3], width[3];
    int enter[3][BINS_MOST + 1]; /* balls whose extent along the axis begins before the bin */
    int leave[3][BINS_MOST + 1]; /* ... and ends before it */
} bins;

/* The own balls of an overlapping tree, whose centres lie in a bin. */
typedef struct crowd {
    uint32_t count;
    float lo[3], hi[3]; /* tight boxes */
    float from, to;     /* effective spheres, along the bin's axis */
} crowd;

static int bin_of(float x, int count)
{
    int bin = (int)work_least(work_most(x, 0), (float)(count - 1));
    return bin;
}

/* Where a plane before bin i stands. */
static float plane_of(const bins *b, int axis, int i)
{
    return b->lo[axis] + b->width[axis] * (float)i;
}

/* Few bins: all their planes are held against all balls, many balls at a time. */
WORK_WIDE static void compare(const work_set *set, const work_block *block, int axis, bins *b)
{
    _Static_assert(BINS_FEW == 8, "seven planes are compared with");
    const float *at = block->at[axis], *radius = block->radius, slack = set->slack;
    const float p1 = plane_of(b, axis, 1), p2 = plane_of(b, axis, 2), p3 = plane_of(b, axis, 3);
    const float p4 = plane_of(b, axis, 4), p5 = plane_of(b, axis, 5), p6 = plane_of(b, axis, 6);
    const float p7 = plane_of(b, axis, 7);
    int n1 = 0, n2 = 0, n3 = 0, n4 = 0, n5 = 0, n6 = 0, n7 = 0, n = work_lanes(block);
    int *enter = b->enter[axis], *leave = b->leave[axis];
    enter[0] = leave[0] = 0;
    WORK_SIMD(reduction(+ : n1, n2, n3, n4, n5, n6, n7))
    for (int k = 0; k < n; k++) {
        float low = at[k] - (radius[k] * WORK_GROW + slack);
        n1 += low <= p1, n2 += low <= p2, n3 += low <= p3, n4 += low <= p4;
        n5 += low <= p5, n6 += low <= p6, n7 += low <= p7;
    }
    enter[1] = n1, enter[2] = n2, enter[3] = n3, enter[4] = n4, enter[5] = n5, enter[6] = n6, enter[7] = n7;
    n1 = n2 = n3 = n4 = n5 = n6 = n7 = 0;
    WORK_SIMD(reduction(+ : n1, n2, n3, n4, n5, n6, n7))
    for (int k = 0; k < n; k++) {
        float high = at[k] + (radius[k] * WORK_GROW + slack);
        n1 += high < p1, n2 += high < p2, n3 += high < p3, n4 += high < p4;
        n5 += high < p5, n6 += high < p6, n7 += high < p7;
    }
    leave[1] = n1, leave[2] = n2, leave[3] = n3, leave[4] = n4, leave[5] = n5, leave[6] = n6, leave[7] = n7;
}

/* More: every ball is put where it begins and ends. */
WORK_WIDE static void count(const work_set *set, const work_block *block, int axis, bins *b)
{
    int from[WORK_BLOCK], to[WORK_BLOCK], n = work_lanes(block);
    float scale = 1 / b->width[axis], lo = b->lo[axis], last = (float)(b->count - 1), slack = set->slack;
    for (int k = 0; k < n; k++) {
        float reach = block->radius[k] * WORK_GROW + slack, at = block->at[axis][k] - lo;
        from[k] = (int)work_least(work_most((at - reach) * scale, 0), last);
        to[k] = (int)work_least(work_most((at + reach) * scale, 0), last);
    }
    for (size_t k = 0; k < block->count; k++) {
        b->enter[axis][from[k] + 1]++;
        b->leave[axis][to[k] + 1]++;
    }
    for (int i = 1; i <= b->count; i++) {
        b->enter[axis][i] += b->enter[axis][i - 1];
        b->leave[axis][i] += b->leave[axis][i - 1];
    }
}

static void fill(const work_set *set, const work_node *node, const work_block *block, bins *b)
{
    for (int a = 0; a < 3; a++) {
        b->lo[a] = node->lo[a];
        b->width[a] = (node->hi[a] - node->lo[a]) / (float)b->count;
        if (!(b->width[a] > FLT_MIN)) b->width[a] = 0;
        if (b->width[a] > 0 && b->count == BINS_FEW) {
            compare(set, block, a, b);
        } else {
            memset(b->enter[a], 0, sizeof b->enter[a]);
            memset(b->leave[a], 0, sizeof b->leave[a]);
            if (b->width[a] > 0) count(set, block, a, b);
        }
        b->enter[a][b->count] = b->leave[a][b->count] = (int)block->count;
    }
}

static float area_of(const float extent[3])
{
    return extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
}

static float box_area(const float lo[3], const float hi[3])
{
    float extent[3] = {hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]};
    return area_of(extent);
}

static float cost_of(const work_set *set, float balls)
{
    return set->options.cost == FBVH_COST_SQUARE ? balls * balls : balls;
}

typedef struct search {
    float best, most; /* balls of both children together */
    work_cut cut;
    bool found, bounded;
} search;

static inline void offer(search *s, float cost, float balls, int axis, float plane)
{
    if (!(cost < s->best)) return;
    if (balls > s->most) {
        s->bounded = true;
        return;
    }
    s->best = cost;
    s->cut = (work_cut){axis, plane};
    s->found = true;
}

typedef struct prices {
    float cost[3][BINS_MOST],
        balls[3][BINS_MOST]; /* of the plane before each bin: the cost, and both sides' balls */
} prices;

/* Children are the halves of the node's box: a ball counts on both sides of a plane that it crosses. */
WORK_WIDE static void weigh_fitted(const work_set *set, const work_node *node, const bins *b, float scale,
                                   prices *p)
{
    const bool square = set->options.cost == FBVH_COST_SQUARE;
    for (int a = 0; a < 3; a++) {
        float width = b->width[a], one = node->hi[(a + 1) % 3] - node->lo[(a + 1) % 3];
        float two = node->hi[(a + 2) % 3] - node->lo[(a + 2) % 3], face = one * two, round = one + two;
        const int *enter = b->enter[a], *leave = b->leave[a], count = b->count, all = enter[count];
        float *cost = p->cost[a], *balls = p->balls[a];
        for (int i = 0; i < count; i++) {
            float left = (float)enter[i] * scale, right = (float)(all - leave[i]) * scale;
            float area_left = face + round * width * (float)i;
            float area_right = face + round * width * (float)(count - i);
            float cost_left = square ? left * left : left, cost_right = square ? right * right : right;
            cost[i] = area_left * cost_left + area_right * cost_right;
            balls[i] = left + right;
        }
    }
}

static void search_fitted(const work_set *set, const work_node *node, const bins *b, float scale, search *s)
{
    prices p;
    weigh_fitted(set, node, b, scale, &p);
    for (int a = 0; a < 3; a++)
        for (int i = 1; i < b->count && b->width[a] > 0; i++) {
            if (!(p.cost[a][i] < s->best)) continue;
            float plane = plane_of(b, a, i);
            if (plane > node->lo[a] && plane < node->hi[a]) offer(s, p.cost[a][i], p.balls[a][i], a, plane);
        }
}

static void crowd_clear(crowd *c)
{
    *c = (crowd){0, {FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}, FLT_MAX, -FLT_MAX};
}

static void crowd_add(crowd *sum, const crowd *one)
{
    sum->count += one->count;
    for (int a = 0; a < 3; a++) {
        sum->lo[a] = work_least(sum->lo[a], one->lo[a]);
        sum->hi[a] = work_most(sum->hi[a], one->hi[a]);
    }
    sum->from = work_least(sum->from, one->from);
    sum->to = work_most(sum->to, one->to);
}

/* `own` of the block's balls are the node's own. */
static void fill_crowds(const work_set *set, const work_node *node, const work_block *block, size_t own,
                        const bins *b, int axis, crowd *bin)
{
    for (int i = 0; i < b->count; i++) crowd_clear(&bin[i]);
    for (size_t k = 0; k < own; k++) {
        float tight = block->radius[k] * node->span + set->slack,
              reach = block->radius[k] * WORK_GROW + set->slack;
        float at = block->at[axis][k];
        crowd one = {.count = 1, .from = at - reach, .to = at + reach};
        for (int a = 0; a < 3; a++) {
            one.lo[a] = block->at[a][k] - tight;
            one.hi[a] = block->at[a][k] + tight;
        }
        crowd_add(&bin[bin_of((at - b->lo[axis]) / b->width[axis], b->count)], &one);
    }
}

/* Children are the boxes of the balls whose centres lie on either side; a ball that reaches into the stretch
 * that a child's effective spheres cover counts with that child. */
static void search_overlapping(const work_set *set, const work_node *node, const work_block *block,
                               size_t own, const bins *b, float scale, search *s)
{
    for (int a = 0; a < 3; a++) {
        crowd bin[BINS_MOST], right[BINS_MOST], left;
        if (!(b->width[a] > 0)) continue;
        fill_crowds(set, node, block, own, b, a, bin);
        right[b->count - 1] = bin[b->count - 1];
        for (int i = b->count - 2; i > 0; i--) {
            right[i] = bin[i];
            crowd_add(&right[i], &right[i + 1]);
        }
        crowd_clear(&left);
        for (int i = 1; i < b->count; i++) {
            crowd_add(&left, &bin[i - 1]);
            if (!left.count || !right[i].count) continue;
            int to = bin_of((left.to - node->lo[a]) / b->width[a], b->count);
            int from = bin_of((right[i].from - node->lo[a]) / b->width[a], b->count);
            float balls_left = (float)b->enter[a][to + 1] * scale;
            float balls_right = (float)(b->leave[a][b->count] - b->leave[a][from]) * scale;
            float cost = box_area(left.lo, left.hi) * cost_of(set, balls_left) +
                         box_area(right[i].lo, right[i].hi) * cost_of(set, balls_right);
            offer(s, cost, balls_left + balls_right, a, plane_of(b, a, i));
        }
    }
}

/* Very dense sets have too many split balls to try planes for: their first levels are halved (section 7). */
static void middle(const work_node *node, work_cut *cut)
{
    cut->axis = 0;
    for (int a = 1; a < 3; a++)
        if (node->hi[a] - node->lo[a] > node->hi[cut->axis] - node->lo[cut->axis]) cut->axis = a;
    cut->plane = 0.5f * node->lo[cut->axis] + 0.5f * node->hi[cut->axis];
}

bool work_choose(const work_set *set, const work_node *node, const work_block *block, size_t step,
                 work_cut *cut, bool *bounded)
{
    *bounded = false;
    if (node->count <= set->options.leaf_least) return false;
    if (set->options.kind == FBVH_OVERLAPPING && node->own < 2) return false;
    if (node->level >= FBVH_DEPTH_MOST || node->leaves < 2) {
        *bounded = true;
        return false;
    }
    if (node->level < set->middle_levels) {
        middle(node, cut);
        return true;
    }
    float area = box_area(node->lo, node->hi), balls = (float)node->count;
    search s = {.best = area * (cost_of(set, balls) - (float)set->options.traversal_cost),
                .most = (float)node->references};
    if (s.best <= 0) return false; /* no two leaves cost less than nothing */
    bins b;
    b.count = block->count < FEW ? BINS_FEW : BINS_MOST;
    fill(set, node, block, &b);
    if (set->options.kind == FBVH_FITTED)
        search_fitted(set, node, &b, (float)step, &s);
    else
        search_overlapping(set, node, block, (node->own + step - 1) / step, &b, (float)step, &s);
    *cut = s.cut;
    *bounded = s.bounded && !s.found;
    return s.found;
}
