/* Closing a leaf: its box fitted to what can hold the surface, what cannot matter in it left out. */
#include "fbvh/work.h"

static bool meets(const work_node *node, const fbvh_ball *ball, float radius)
{
    return work_distance(node->lo, node->hi, ball->position) <= radius * radius;
}

static bool spheres_meet(const fbvh_ball *one, float radius, const fbvh_ball *other, float other_radius)
{
    float x = one->position[0] - other->position[0], y = one->position[1] - other->position[1];
    float z = one->position[2] - other->position[2], most = radius + other_radius;
    return x * x + y * y + z * z <= most * most;
}

/* Whether split ball `ref` overlaps the effective sphere of an own one (Algorithm 1, line 16). */
static bool meets_own(const work_set *set, const work_node *node, const uint32_t *list, uint32_t ref)
{
    const fbvh_ball *ball = &set->ball[ref];
    float reach = work_reach(set, ball);
    for (size_t i = 0; i < node->own; i++) {
        const fbvh_ball *own = &set->ball[list[i]];
        if (spheres_meet(ball, reach, own, work_reach(set, own))) return true;
    }
    return false;
}

/* The part of the leaf's box that `side` covers; false: none. */
static bool shrink(work_node *node, const work_side *side)
{
    for (int a = 0; a < 3; a++) {
        node->lo[a] = work_most(node->lo[a], side->lo[a]);
        node->hi[a] = work_least(node->hi[a], side->hi[a]);
        if (node->lo[a] > node->hi[a]) return false;
    }
    return true;
}

/* Keeps what reaches the leaf's box, finds S+ of it, and fits the box. False: no surface in it. *gathered:
 * the block holds the list, before and after. */
static bool sift_fitted(const work_set *set, work_node *node, uint32_t *list, work_block *block,
                        bool *gathered)
{
    unsigned char taken[WORK_BLOCK];
    work_side side = work_side_none();
    for (size_t first = 0; first < node->count; first += WORK_BLOCK) {
        size_t count = node->count - first < WORK_BLOCK ? node->count - first : WORK_BLOCK;
        if (!*gathered) work_gather(set, list + first, count, 1, block);
        work_take(set, block, node->lo, node->hi, node->span, taken, &side);
        for (size_t i = 0; i < count; i++) {
            list[side.count] = list[first + i];
            side.count += taken[i];
        }
    }
    *gathered = side.count == node->count && node->count <= WORK_BLOCK;
    node->count = node->own = side.count;
    node->span = work_span(set, side.sum);
    return side.count && node->span >= 0 && (set->options.no_fit || shrink(node, &side));
}

static bool sift_overlapping(const work_set *set, work_node *node, uint32_t *list)
{
    size_t kept = node->own;
    double sum = 0;
    for (size_t i = node->own; i < node->count; i++)
        if (meets_own(set, node, list, list[i])) list[kept++] = list[i];
    for (size_t i = 0; i < kept; i++) {
        float q = work_strength(set, list[i]);
        if (q > 0) sum += q;
    }
    node->count = kept;
    node->span = work_span(set, sum);
    if (node->span < 0) return false;
    work_side side = work_side_none();
    for (size_t i = 0; i < node->own; i++) {
        const fbvh_ball *ball = &set->ball[list[i]];
        float tight = work_tight(set, ball, node->span);
        for (int a = 0; a < 3; a++) {
            side.lo[a] = work_least(side.lo[a], ball->position[a] - tight);
            side.hi[a] = work_most(side.hi[a], ball->position[a] + tight);
        }
    }
    return shrink(node, &side);
}

/* Section 5.3.2, mended. Where f >= L at x in the box, some positive ball j has x in its tight sphere. Ball i
 * matters at x only if x is in its effective sphere: so it is j itself (first test), or its effective sphere
 * meets the tight sphere of another j (second test). Without it, f >= L just where it was: the argument holds
 * for the field that is left, too, so that one may go after the other. */
static bool contributes(const work_set *set, const work_node *node, const uint32_t *list, size_t i)
{
    const fbvh_ball *ball = &set->ball[list[i]];
    if (work_strength(set, list[i]) > 0 && meets(node, ball, work_tight(set, ball, node->span))) return true;
    float reach = work_reach(set, ball);
    for (size_t j = 0; j < node->count; j++) {
        const fbvh_ball *other = &set->ball[list[j]];
        if (j == i || !(work_strength(set, list[j]) > 0)) continue;
        float tight = work_tight(set, other, node->span);
        if (spheres_meet(ball, reach, other, tight) && meets(node, other, tight)) return true;
    }
    return false;
}

/* Own balls of an overlapping leaf stay: they say where it knows f. */
static size_t discard(const work_set *set, work_node *node, uint32_t *list)
{
    size_t first = set->options.kind == FBVH_FITTED ? 0 : node->own, before = node->count;
    for (size_t i = first; i < node->count;) {
        if (contributes(set, node, list, i)) {
            i++;
            continue;
        }
        for (size_t k = i; k + 1 < node->count; k++) list[k] = list[k + 1];
        node->count--;
    }
    if (set->options.kind == FBVH_FITTED) node->own = node->count;
    return before - node->count;
}

size_t work_leaf(const work_set *set, work_node *node, uint32_t *list, work_block *block, size_t *discarded)
{
    bool fitted = set->options.kind == FBVH_FITTED, gathered = node->count <= WORK_BLOCK;
    *discarded = 0;
    if (!(fitted ? sift_fitted(set, node, list, block, &gathered) : sift_overlapping(set, node, list)))
        return 0;
    if (!set->options.no_discard && node->count <= set->options.discard_most)
        *discarded = discard(set, node, list);
    if (*discarded) gathered = false;
    /* A smaller box leaves fewer balls, and those a smaller box: twice gets nearly all of it. */
    if (fitted && !sift_fitted(set, node, list, block, &gathered)) return 0;
    for (size_t i = node->own; i < node->count; i++) list[i] |= FBVH_SPLIT;
    return node->count;
}
