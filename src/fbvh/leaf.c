/* Closing a leaf: its box fitted to what can hold the surface, what cannot matter in it left out. */
#include "fbvh/work.h"

#include <float.h>

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

/* Keeps what reaches the leaf, and finds its S+. */
static void sift(const work_set *set, work_node *node, uint32_t *list)
{
    bool fitted = set->options.kind == FBVH_FITTED;
    size_t kept = fitted ? 0 : node->own;
    double sum = 0;
    for (size_t i = kept; i < node->count; i++) {
        const fbvh_ball *ball = &set->ball[list[i]];
        if (fitted ? meets(node, ball, work_reach(set, ball)) : meets_own(set, node, list, list[i]))
            list[kept++] = list[i];
    }
    for (size_t i = 0; i < kept; i++) {
        float q = work_strength(set, list[i]);
        if (q > 0) sum += q;
    }
    node->count = kept;
    if (fitted) node->own = kept;
    node->span = work_span(set, sum);
}

/* The box of the tight spheres that meet it (of an overlapping leaf: of its own), within what it was; false:
 * none does. */
static bool fit(const work_set *set, work_node *node, const uint32_t *list)
{
    float lo[3] = {FLT_MAX, FLT_MAX, FLT_MAX}, hi[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (size_t i = 0; i < node->own; i++) {
        const fbvh_ball *ball = &set->ball[list[i]];
        float tight = work_tight(set, ball, node->span);
        if (!(work_strength(set, list[i]) > 0) || !meets(node, ball, tight)) continue;
        for (int a = 0; a < 3; a++) {
            lo[a] = work_least(lo[a], ball->position[a] - tight);
            hi[a] = work_most(hi[a], ball->position[a] + tight);
        }
    }
    for (int a = 0; a < 3; a++) {
        node->lo[a] = work_most(node->lo[a], lo[a]);
        node->hi[a] = work_least(node->hi[a], hi[a]);
        if (node->lo[a] > node->hi[a]) return false;
    }
    return true;
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
    (void)block;
    const fbvh_options *o = &set->options;
    bool fits = o->kind == FBVH_OVERLAPPING || !o->no_fit;
    *discarded = 0;
    /* A smaller box leaves fewer balls, and those a smaller box: twice gets nearly all of it. */
    for (int round = 0; round < 2; round++) {
        if (round == 0 || o->kind == FBVH_FITTED) sift(set, node, list);
        if (!node->count || node->span < 0) return 0;
        if (fits && !fit(set, node, list)) return 0;
        if (round == 0 && !o->no_discard && node->count <= o->discard_most) {
            *discarded = discard(set, node, list);
            if (!node->count) return 0;
        }
    }
    if (o->kind == FBVH_OVERLAPPING)
        for (size_t i = node->own; i < node->count; i++) list[i] |= FBVH_SPLIT;
    return node->count;
}
