/* Balls side by side, and what is asked of all of a block at once. */
#include "fbvh/work.h"

#include <float.h>

void work_gather(const work_set *set, const uint32_t *list, size_t count, size_t step, work_block *block)
{
    size_t n = 0;
    for (size_t i = 0; i < count && n < WORK_BLOCK; i += step, n++) {
        const fbvh_ball *ball = &set->ball[list[i]];
        for (int a = 0; a < 3; a++) block->at[a][n] = ball->position[a];
        block->radius[n] = ball->radius;
    }
    if (set->strength)
        for (size_t i = 0; i < n; i++) block->strength[i] = set->strength[list[i * step]];
    else
        for (size_t i = 0; i < n; i++) block->strength[i] = 1;
    block->count = n;
    for (; n % WORK_LANES; n++) {
        for (int a = 0; a < 3; a++) block->at[a][n] = 2e18f; /* lengths are below 1e18 */
        block->radius[n] = 1;
        block->strength[n] = 0;
    }
}

size_t work_look(const work_set *set, const work_node *node, const uint32_t *list, work_block *block)
{
    size_t step = (node->count + WORK_BLOCK - 1) / WORK_BLOCK;
    work_gather(set, list, node->count, step, block);
    return step;
}

work_side work_side_none(void)
{
    return (work_side){0, 0, {FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
}

/* Sums in doubles, in order: the same for any width of vectors. */
static double sum_taken(const work_block *block, const unsigned char *taken)
{
    double sum = 0;
    for (size_t k = 0; k < block->count; k++)
        sum += taken[k] && block->strength[k] > 0 ? (double)block->strength[k] : 0;
    return sum;
}

WORK_WIDE void work_take(const work_set *set, const work_block *block, const float lo[3], const float hi[3],
                         float span, unsigned char *taken, work_side *s)
{
    int n = work_lanes(block), positive = 0, in[WORK_BLOCK];
    float slack = set->slack, l0 = lo[0], l1 = lo[1], l2 = lo[2], h0 = hi[0], h1 = hi[1], h2 = hi[2];
    float x0 = s->lo[0], y0 = s->lo[1], z0 = s->lo[2], x1 = s->hi[0], y1 = s->hi[1], z1 = s->hi[2];
    const float *px = block->at[0], *py = block->at[1], *pz = block->at[2];
    WORK_SIMD(reduction(+ : positive) reduction(min : x0, y0, z0) reduction(max : x1, y1, z1))
    for (int k = 0; k < n; k++) {
        float x = px[k], y = py[k], z = pz[k], radius = block->radius[k];
        float dx = work_most(work_most(l0 - x, x - h0), 0), dy = work_most(work_most(l1 - y, y - h1), 0);
        float dz = work_most(work_most(l2 - z, z - h2), 0), distance = dx * dx + dy * dy + dz * dz;
        float reach = radius * WORK_GROW + slack, tight = radius * span + slack;
        int is = distance <= reach * reach ? 1 : 0, pulls = block->strength[k] > 0 ? is : 0;
        /* What is not near enough to hold the surface grows no box. */
        float away = distance <= tight * tight ? 0 : FLT_MAX;
        away = pulls ? away : FLT_MAX;
        in[k] = is;
        positive += pulls;
        x0 = work_least(x0, x - tight + away), x1 = work_most(x1, x + tight - away);
        y0 = work_least(y0, y - tight + away), y1 = work_most(y1, y + tight - away);
        z0 = work_least(z0, z - tight + away), z1 = work_most(z1, z + tight - away);
    }
    for (int k = 0; k < n; k++) taken[k] = (unsigned char)in[k];
    s->sum += set->strength ? sum_taken(block, taken) : positive;
    s->lo[0] = x0, s->lo[1] = y0, s->lo[2] = z0;
    s->hi[0] = x1, s->hi[1] = y1, s->hi[2] = z1;
}

/* f at a point, nearly: with (1 - v^2)^3 whatever the kernel. Only the shape of the tree hangs on it. */
WORK_WIDE static float nearly_value(const work_block *block, float x, float y, float z)
{
    float sum = 0;
    int n = work_lanes(block);
    WORK_SIMD(reduction(+ : sum))
    for (int k = 0; k < n; k++) {
        float dx = block->at[0][k] - x, dy = block->at[1][k] - y, dz = block->at[2][k] - z,
              r = block->radius[k];
        float w = work_most(1 - (dx * dx + dy * dy + dz * dz) / (r * r), 0);
        sum += block->strength[k] * w * w * w;
    }
    return sum;
}

bool work_deep(const work_set *set, const work_node *node, const work_block *block)
{
    enum { ENOUGH = 3 };
    float enough = ENOUGH * (float)set->iso, middle[3];
    for (int a = 0; a < 3; a++) middle[a] = 0.5f * (node->lo[a] + node->hi[a]);
    if (nearly_value(block, middle[0], middle[1], middle[2]) < enough) return false;
    for (int k = 0; k < 8; k++) {
        float x = k & 1 ? node->hi[0] : node->lo[0], y = k & 2 ? node->hi[1] : node->lo[1];
        if (nearly_value(block, x, y, k & 4 ? node->hi[2] : node->lo[2]) < enough) return false;
    }
    return true;
}
