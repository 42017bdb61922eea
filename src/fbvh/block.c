/* Balls side by side, and what is asked of all of a block at once. */
#include "fbvh/work.h"

void work_gather(const work_set *set, const uint32_t *list, size_t count, size_t step, work_block *block)
{
    size_t n = 0;
    for (size_t i = 0; i < count && n < WORK_BLOCK; i += step, n++) {
        const fbvh_ball *ball = &set->ball[list[i]];
        for (int a = 0; a < 3; a++) block->at[a][n] = ball->position[a];
        block->radius[n] = ball->radius;
        block->strength[n] = work_strength(set, list[i]);
    }
    block->count = n;
}

size_t work_look(const work_set *set, const work_node *node, const uint32_t *list, work_block *block)
{
    size_t step = (node->count + WORK_BLOCK - 1) / WORK_BLOCK;
    work_gather(set, list, node->count, step, block);
    return step;
}

/* f at a point, nearly: with (1 - v^2)^3 whatever the kernel. Only the shape of the tree hangs on it. */
WORK_WIDE static float nearly_value(const work_block *block, float x, float y, float z)
{
    float sum = 0;
    int n = (int)block->count;
#pragma omp simd reduction(+ : sum)
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
