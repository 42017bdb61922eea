/* Where to cut a node: a greedy surface area heuristic over bins (Gourmel et al. 2010, section 5.1.1). */
#include "fbvh/work.h"

#include <float.h>
#include <string.h>

/* Larger nodes are sampled: the heuristic asks for shares, and a thousand balls tell those. */
enum { BINS_MOST = 16, BINS_FEW = 8, FEW = 96, SAMPLE = 1024 };

typedef struct bins {
    int count;
    uint32_t enter[3][BINS_MOST]; /* balls whose extent along the axis begins in the bin */
    uint32_t leave[3][BINS_MOST]; /* ... and ends */
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

static void fill(const work_set *set, const work_node *node, const uint32_t *list, size_t step, bins *b)
{
    float scale[3];
    for (int a = 0; a < 3; a++) {
        float extent = node->hi[a] - node->lo[a];
        scale[a] = extent > 0 ? (float)b->count / extent : 0;
        if (!(scale[a] < FLT_MAX)) scale[a] = 0;
    }
    memset(b->enter, 0, sizeof b->enter);
    memset(b->leave, 0, sizeof b->leave);
    for (size_t i = 0; i < node->count; i += step) {
        const fbvh_ball *ball = &set->ball[list[i]];
        float reach = work_reach(set, ball);
        for (int a = 0; a < 3; a++) {
            float at = ball->position[a] - node->lo[a];
            b->enter[a][bin_of((at - reach) * scale[a], b->count)]++;
            b->leave[a][bin_of((at + reach) * scale[a], b->count)]++;
        }
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
    float best;
    work_cut cut;
    bool found, bounded;
} search;

static void offer(search *s, const work_node *node, float cost, float balls, int axis, float plane)
{
    if (!(cost < s->best)) return;
    if ((double)balls > node->references) {
        s->bounded = true;
        return;
    }
    s->best = cost;
    s->cut = (work_cut){axis, plane};
    s->found = true;
}

/* Children are the halves of the node's box: a ball counts on both sides of a plane that it crosses. */
static void search_fitted(const work_set *set, const work_node *node, const bins *b, float scale, search *s)
{
    for (int a = 0; a < 3; a++) {
        float extent[3] = {node->hi[0] - node->lo[0], node->hi[1] - node->lo[1], node->hi[2] - node->lo[2]};
        float width = extent[a] / (float)b->count;
        float past = extent[(a + 1) % 3] + extent[(a + 2) % 3],
              face = extent[(a + 1) % 3] * extent[(a + 2) % 3];
        uint32_t below = 0, gone = 0, all = 0;
        for (int i = 0; i < b->count; i++) all += b->enter[a][i];
        for (int i = 1; i < b->count; i++) {
            below += b->enter[a][i - 1];
            gone += b->leave[a][i - 1];
            float left = (float)below * scale, right = (float)(all - gone) * scale;
            float area_left = face + past * width * (float)i;
            float area_right = face + past * width * (float)(b->count - i);
            float cost = area_left * cost_of(set, left) + area_right * cost_of(set, right);
            float plane = node->lo[a] + width * (float)i;
            if (plane > node->lo[a] && plane < node->hi[a]) offer(s, node, cost, left + right, a, plane);
        }
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

static void fill_crowds(const work_set *set, const work_node *node, const uint32_t *list, size_t step,
                        int axis, int count, crowd *bin)
{
    float extent = node->hi[axis] - node->lo[axis], scale = (float)count / extent;
    if (!(extent > 0 && scale < FLT_MAX)) scale = 0;
    for (int i = 0; i < count; i++) crowd_clear(&bin[i]);
    for (size_t i = 0; i < node->own; i += step) {
        const fbvh_ball *ball = &set->ball[list[i]];
        float tight = work_tight(set, ball, node->span), reach = work_reach(set, ball);
        crowd one = {.count = 1, .from = ball->position[axis] - reach, .to = ball->position[axis] + reach};
        for (int a = 0; a < 3; a++) {
            one.lo[a] = ball->position[a] - tight;
            one.hi[a] = ball->position[a] + tight;
        }
        crowd_add(&bin[bin_of((ball->position[axis] - node->lo[axis]) * scale, count)], &one);
    }
}

/* Children are the boxes of the balls whose centres lie on either side; a ball that reaches into the stretch
 * that a child's effective spheres cover counts with that child. */
static void search_overlapping(const work_set *set, const work_node *node, const uint32_t *list, size_t step,
                               const bins *b, float scale, search *s)
{
    for (int a = 0; a < 3; a++) {
        crowd bin[BINS_MOST], right[BINS_MOST], left;
        float width = (node->hi[a] - node->lo[a]) / (float)b->count;
        fill_crowds(set, node, list, step, a, b->count, bin);
        uint32_t enter[BINS_MOST + 1] = {0}, leave[BINS_MOST + 1] = {0};
        for (int i = 0; i < b->count; i++) {
            enter[i + 1] = enter[i] + b->enter[a][i];
            leave[i + 1] = leave[i] + b->leave[a][i];
        }
        right[b->count - 1] = bin[b->count - 1];
        for (int i = b->count - 2; i > 0; i--) {
            right[i] = bin[i];
            crowd_add(&right[i], &right[i + 1]);
        }
        crowd_clear(&left);
        for (int i = 1; i < b->count; i++) {
            crowd_add(&left, &bin[i - 1]);
            if (!left.count || !right[i].count || !(width > 0)) continue;
            int to = bin_of((left.to - node->lo[a]) / width, b->count);
            int from = bin_of((right[i].from - node->lo[a]) / width, b->count);
            float balls_left = (float)enter[to + 1] * scale;
            float balls_right = (float)(leave[b->count] - leave[from]) * scale;
            float cost = box_area(left.lo, left.hi) * cost_of(set, balls_left) +
                         box_area(right[i].lo, right[i].hi) * cost_of(set, balls_right);
            offer(s, node, cost, balls_left + balls_right, a, node->lo[a] + width * (float)i);
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

bool work_choose(const work_set *set, const work_node *node, const uint32_t *list, work_cut *cut,
                 bool *bounded)
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
    size_t step = node->count / SAMPLE + 1;
    bins b = {.count = node->count < FEW ? BINS_FEW : BINS_MOST};
    fill(set, node, list, step, &b);
    float area = box_area(node->lo, node->hi), balls = (float)node->count;
    search s = {.best = area * (cost_of(set, balls) - (float)set->options.traversal_cost)};
    if (set->options.kind == FBVH_FITTED)
        search_fitted(set, node, &b, (float)step, &s);
    else
        search_overlapping(set, node, list, step, &b, (float)step, &s);
    *cut = s.cut;
    *bounded = s.bounded && !s.found;
    return s.found;
}
