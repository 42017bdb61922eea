/* Sharing a node's balls out to two children (Gourmel et al. 2010, Algorithms 1 and 2). */
#include "fbvh/work.h"

#include <float.h>

/* A box that grows; the fourth lane idles, so that four floats move at a time. */
typedef struct hull {
    float lo[4], hi[4];
} hull;

static const hull nothing = {{FLT_MAX, FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX}};

static inline void hull_add(hull *h, const fbvh_ball *ball, float radius)
{
    const float *p = ball->position;
    float lane[4] = {p[0], p[1], p[2], 0};
    for (int a = 0; a < 4; a++) {
        h->lo[a] = work_least(lane[a] - radius, h->lo[a]);
        h->hi[a] = work_most(lane[a] + radius, h->hi[a]);
    }
}

typedef struct side {
    size_t count;
    double sum; /* of the positive strengths */
    hull tight;
} side;

/* Counts, S+ and box of a fitted child whose half of the parent's box is lo, hi. */
static void close_fitted(const work_set *set, const side *s, work_node *child)
{
    child->count = child->own = s->count;
    child->span = work_span(set, s->sum);
    if (!set->options.no_fit)
        for (int a = 0; a < 3; a++) {
            child->lo[a] = work_most(child->lo[a], s->tight.lo[a]);
            child->hi[a] = work_least(child->hi[a], s->tight.hi[a]);
            if (child->lo[a] > child->hi[a]) child->count = 0;
        }
    if (child->span < 0) child->count = 0;
}

/* One block's balls on one side: which reach into the box lo, hi, and what they add. */
WORK_WIDE static void take_side(const work_set *set, const work_block *block, const float lo[3],
                                const float hi[3], float span, bool fits, unsigned char *taken, side *s)
{
    int n = (int)block->count, positive = 0;
    float slack = set->slack, far = FLT_MAX;
    float x0 = far, y0 = far, z0 = far, x1 = -far, y1 = -far, z1 = -far;
    const float *px = block->at[0], *py = block->at[1], *pz = block->at[2];
    int in[WORK_BLOCK];
#pragma omp simd reduction(+ : positive) reduction(min : x0, y0, z0) reduction(max : x1, y1, z1)
    for (int k = 0; k < n; k++) {
        float x = px[k], y = py[k], z = pz[k], radius = block->radius[k];
        float dx = work_most(work_most(lo[0] - x, x - hi[0]), 0);
        float dy = work_most(work_most(lo[1] - y, y - hi[1]), 0);
        float dz = work_most(work_most(lo[2] - z, z - hi[2]), 0);
        float distance = dx * dx + dy * dy + dz * dz, reach = radius * WORK_GROW + slack;
        float tight = radius * span + slack;
        int pulls = block->strength[k] > 0, is = distance <= reach * reach;
        /* What is not near enough to hold the surface grows no box. */
        float away = (distance <= tight * tight) & pulls ? 0 : far;
        in[k] = is;
        positive += is & pulls;
        x0 = work_least(x0, x - tight + away), x1 = work_most(x1, x + tight - away);
        y0 = work_least(y0, y - tight + away), y1 = work_most(y1, y + tight - away);
        z0 = work_least(z0, z - tight + away), z1 = work_most(z1, z + tight - away);
    }
    for (int k = 0; k < n; k++) taken[k] = (unsigned char)in[k];
    if (set->strength)
        for (int k = 0; k < n; k++)
            s->sum += in[k] && block->strength[k] > 0 ? (double)block->strength[k] : 0;
    else
        s->sum += positive;
    if (!fits) return;
    float from[3] = {x0, y0, z0}, to[3] = {x1, y1, z1};
    for (int a = 0; a < 3; a++) {
        s->tight.lo[a] = work_least(s->tight.lo[a], from[a]);
        s->tight.hi[a] = work_most(s->tight.hi[a], to[a]);
    }
}

static void part_fitted(const work_set *set, const work_node *node, const uint32_t *list, const work_cut *cut,
                        work_block *block, uint32_t *list_of[2], work_node child[2])
{
    side side_of[2] = {{0, 0, nothing}, {0, 0, nothing}};
    unsigned char taken[2][WORK_BLOCK];
    for (int k = 0; k < 2; k++) {
        child[k] = *node;
        (k ? child[k].lo : child[k].hi)[cut->axis] = cut->plane;
    }
    for (size_t first = 0; first < node->count; first += WORK_BLOCK) {
        size_t count = node->count - first < WORK_BLOCK ? node->count - first : WORK_BLOCK;
        if (node->count > WORK_BLOCK) work_gather(set, list + first, count, 1, block);
        for (int k = 0; k < 2; k++)
            take_side(set, block, child[k].lo, child[k].hi, node->span, !set->options.no_fit, taken[k],
                      &side_of[k]);
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

/* The split balls of an overlapping child: those of the node and its sibling's own whose spheres meet the box
 * of its own spheres. (work_leaf holds them against each sphere: what is left in the end is the same.) */
static void add_split(const work_set *set, const work_node *node, const uint32_t *list, const uint32_t *other,
                      size_t other_count, const hull *reach_hull, uint32_t *out, side *s)
{
    size_t split = node->count - node->own;
    for (size_t i = 0; i < split + other_count; i++) {
        uint32_t ref = i < split ? list[node->own + i] : other[i - split];
        const fbvh_ball *ball = &set->ball[ref];
        float reach = work_reach(set, ball);
        if (work_distance(reach_hull->lo, reach_hull->hi, ball->position) > reach * reach) continue;
        out[s->count++] = ref;
        float q = work_strength(set, ref);
        if (q > 0) s->sum += q;
    }
}

static void part_overlapping(const work_set *set, const work_node *node, const uint32_t *list,
                             const work_cut *cut, uint32_t *list_of[2], work_node child[2])
{
    side side_of[2] = {{0, 0, nothing}, {0, 0, nothing}};
    hull reach_of[2] = {nothing, nothing};
    for (size_t i = 0; i < node->own; i++) {
        uint32_t ref = list[i];
        const fbvh_ball *ball = &set->ball[ref];
        int k = ball->position[cut->axis] >= cut->plane;
        list_of[k][side_of[k].count++] = ref;
        side_of[k].sum += work_strength(set, ref);
        hull_add(&side_of[k].tight, ball, work_tight(set, ball, node->span));
        hull_add(&reach_of[k], ball, work_reach(set, ball));
    }
    size_t own[2] = {side_of[0].count, side_of[1].count};
    for (int k = 0; k < 2; k++) {
        child[k] = *node;
        child[k].own = own[k];
        if (own[k]) add_split(set, node, list, list_of[!k], own[!k], &reach_of[k], list_of[k], &side_of[k]);
        for (int a = 0; a < 3; a++)
            child[k].lo[a] = side_of[k].tight.lo[a], child[k].hi[a] = side_of[k].tight.hi[a];
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
        part_overlapping(set, node, list, cut, list_of, child);
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
