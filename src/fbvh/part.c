/* Sharing a node's balls out to two children (Gourmel et al. 2010, Algorithms 1 and 2). */
#include "fbvh/work.h"

/* Counts, S+ and box of a fitted child whose half of the parent's box is lo, hi. */
static void close_fitted(const work_set *set, const work_side *s, work_node *child)
{
    child->count = child->own = s->count;
    child->span = work_span(set, s->sum);
    if (!set->options.no_fit)
        for (int a = 0; a < 3; a++) {
            child->lo[a] = work_most(child->lo[a], s->lo[a]);
            child->hi[a] = work_least(child->hi[a], s->hi[a]);
            if (child->lo[a] > child->hi[a]) child->count = 0;
        }
    if (child->span < 0) child->count = 0;
}

static void part_fitted(const work_set *set, const work_node *node, const uint32_t *list, const work_cut *cut,
                        work_block *block, uint32_t *list_of[2], work_node child[2])
{
    work_side side_of[2] = {work_side_none(), work_side_none()};
    unsigned char taken[2][WORK_BLOCK];
    for (int k = 0; k < 2; k++) {
        child[k] = *node;
        (k ? child[k].lo : child[k].hi)[cut->axis] = cut->plane;
    }
    for (size_t first = 0; first < node->count; first += WORK_BLOCK) {
        size_t count = node->count - first < WORK_BLOCK ? node->count - first : WORK_BLOCK;
        if (node->count > WORK_BLOCK) work_gather(set, list + first, count, 1, block);
        for (int k = 0; k < 2; k++)
            work_take(set, block, child[k].lo, child[k].hi, node->span, taken[k], &side_of[k]);
        uint32_t *left = list_of[0] + side_of[0].count, *right = list_of[1] + side_of[1].count;
        for (size_t i = 0; i < count; i++) {
            *left = *right = list[first + i];
            left += taken[0][i];
            right += taken[1][i];
        }
        side_of[0].count = (size_t)(left - list_of[0]);
        side_of[1].count = (size_t)(right - list_of[1]);
    }
    for (int k = 0; k < 2; k++) close_fitted(set, &side_of[k], &child[k]);
}

/* The split balls of an overlapping child, out of a list: those whose spheres meet the box of its own
 * spheres. (work_leaf holds them against each sphere: what is left in the end is the same.) */
static void add_split(const work_set *set, const uint32_t *list, size_t list_count, const work_side *reach,
                      work_block *block, uint32_t *out, work_side *s)
{
    unsigned char taken[WORK_BLOCK];
    work_side found = work_side_none();
    for (size_t first = 0; first < list_count; first += WORK_BLOCK) {
        size_t count = list_count - first < WORK_BLOCK ? list_count - first : WORK_BLOCK;
        work_gather(set, list + first, count, 1, block);
        work_take(set, block, reach->lo, reach->hi, 0, taken, &found);
        for (size_t i = 0; i < count; i++) {
            out[s->count] = list[first + i];
            s->count += taken[i];
        }
    }
    s->sum += found.sum;
}

static void add_own(work_side *box, const fbvh_ball *ball, float radius)
{
    for (int a = 0; a < 3; a++) {
        box->lo[a] = work_least(box->lo[a], ball->position[a] - radius);
        box->hi[a] = work_most(box->hi[a], ball->position[a] + radius);
    }
}

static void part_overlapping(const work_set *set, const work_node *node, const uint32_t *list,
                             const work_cut *cut, work_block *block, uint32_t *list_of[2], work_node child[2])
{
    work_side side_of[2] = {work_side_none(), work_side_none()};
    work_side reach_of[2] = {work_side_none(), work_side_none()};
    for (size_t i = 0; i < node->own; i++) {
        uint32_t ref = list[i];
        const fbvh_ball *ball = &set->ball[ref];
        int k = ball->position[cut->axis] >= cut->plane;
        list_of[k][side_of[k].count++] = ref;
        side_of[k].sum += work_strength(set, ref);
        add_own(&side_of[k], ball, work_tight(set, ball, node->span));
        add_own(&reach_of[k], ball, work_reach(set, ball));
    }
    size_t own[2] = {side_of[0].count, side_of[1].count}, split = node->count - node->own;
    for (int k = 0; k < 2; k++) {
        child[k] = *node;
        child[k].own = own[k];
        for (int a = 0; a < 3; a++) child[k].lo[a] = side_of[k].lo[a], child[k].hi[a] = side_of[k].hi[a];
        if (own[k]) {
            add_split(set, list + node->own, split, &reach_of[k], block, list_of[k], &side_of[k]);
            add_split(set, list_of[!k], own[!k], &reach_of[k], block, list_of[k], &side_of[k]);
        }
        child[k].count = side_of[k].count;
        child[k].span = work_span(set, side_of[k].sum);
        if (child[k].span < 0) child[k].count = 0;
    }
}

void work_part(const work_set *set, const work_node *node, const uint32_t *list, const work_cut *cut,
               work_block *block, uint32_t *list_of[2], work_node child[2])
{
    if (set->options.kind == FBVH_FITTED)
        part_fitted(set, node, list, cut, block, list_of, child);
    else
        part_overlapping(set, node, list, cut, block, list_of, child);
}

bool work_share(const work_node *node, work_node child[2])
{
    size_t balls = child[0].count + child[1].count;
    if ((double)balls > node->references) return false;
    double spare = node->references - (double)balls;
    for (int k = 0; k < 2; k++) {
        double part = balls ? (double)child[k].count / (double)balls : 0;
        child[k].level = node->level + 1;
        child[k].references = (double)child[k].count + spare * part;
        child[k].leaves = child[!k].count ? 1 + (node->leaves - 2) * part : node->leaves;
    }
    return true;
}
