#include "trace/pack.h"

#include "base/rounded.h"
#include "field/kernel.h"
#include "shade/ball_colors.h"

#include <math.h>
#include <string.h>

enum { CHUNK = 4096 }; /* pairs that a thread takes at once */

/* ---- Nodes ---- */

trace_grid trace_grid_of(const fbvh_tree *tree)
{
    trace_grid grid = {.root = TRACE_NONE, .cell = {1, 1, 1}};
    if (!tree->node_count) return grid;
    const fbvh_node *root = &tree->node[0];
    for (int axis = 0; axis < 3; axis++) {
        float size = root->hi[axis] - root->lo[axis];
        grid.base[axis] = root->lo[axis];
        grid.cell[axis] = size > 0 ? size / 65535 : 1;
    }
    grid.root = root->count ? TRACE_LEAF : root->first / 2 - 1;
    grid.pair_count = tree->node_count > 2 ? (tree->node_count - 2) / 2 : 0;
    grid.leaf_count = root->count ? 1 : 0;
    for (size_t i = 2; i < tree->node_count; i++) grid.leaf_count += tree->node[i].count != 0;
    return grid;
}

/* What a float division may move a step by is far less than what glsl/tree.glsl allows for. */
static uint32_t box_of(const trace_grid *grid, const fbvh_node *node, int axis)
{
    float lo = floorf((node->lo[axis] - grid->base[axis]) / grid->cell[axis]);
    float hi = ceilf((node->hi[axis] - grid->base[axis]) / grid->cell[axis]);
    lo = fminf(fmaxf(lo, 0), 65535);
    hi = fminf(fmaxf(hi, 0), 65535);
    return (uint32_t)lo | (uint32_t)hi << 16;
}

/* The axis along which two boxes are furthest apart, and whether the first is the low one there. */
static int axis_between(const fbvh_node *a, const fbvh_node *b, bool *in_order)
{
    int best = 0;
    float most = -INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        float after = b->lo[axis] - a->hi[axis], before = a->lo[axis] - b->hi[axis];
        float apart = fmaxf(after, before);
        if (apart > most) {
            most = apart;
            best = axis;
            *in_order = after >= before;
        }
    }
    return best;
}

static void pack_pair(const fbvh_tree *tree, const trace_grid *grid, size_t at, size_t *leaf_at,
                      trace_pair *pair, trace_leaf *leaf)
{
    const fbvh_node *node = tree->node + 2 * at + 2;
    bool in_order = true;
    int axis = axis_between(&node[0], &node[1], &in_order);
    for (int i = 0; i < 2; i++) {
        const fbvh_node *child = &node[i];
        int place = in_order ? i : 1 - i;
        for (int k = 0; k < 3; k++) pair->child[place].box[k] = box_of(grid, child, k);
        if (child->count) {
            memcpy(&leaf[*leaf_at], child, sizeof *leaf);
            pair->child[place].link = TRACE_LEAF | (uint32_t)(*leaf_at)++;
        } else {
            pair->child[place].link = child->first / 2 - 1;
        }
    }
    pair->child[0].link |= (uint32_t)axis << 29;
}

void trace_pack_nodes(const fbvh_tree *tree, const trace_grid *grid, trace_pair *pair, trace_leaf *leaf)
{
    _Static_assert(sizeof(trace_leaf) == sizeof(fbvh_node), "a leaf is packed as the node that it is");
    if (grid->root == TRACE_LEAF) memcpy(leaf, tree->node, sizeof *leaf);
    size_t leaf_at = 0;
    for (size_t i = 0; i < grid->pair_count; i++) pack_pair(tree, grid, i, &leaf_at, &pair[i], leaf);
}

/* ---- Balls ---- */

void trace_pack_balls(const fbvh_tree *tree, const mns_plan *plan, float *out)
{
    size_t stride = plan_tree_floats(plan);
    bool radii = plan->features & FEATURE_RADII, strengths = plan->features & FEATURE_STRENGTHS;
#pragma omp parallel for if (tree->ball_count > CHUNK * 8)
    for (size_t i = 0; i < tree->ball_count; i++) {
        float *to = out + i * stride;
        to[stride - 1] = 0; /* there may be room to spare */
        memcpy(to, tree->ball[i].position, sizeof tree->ball[i].position);
        if (radii) to[3] = tree->ball[i].radius;
        if (strengths) to[stride - 1] = tree->strength ? tree->strength[i] : 1;
    }
}

void trace_pack_low(const uint32_t *index, size_t count, const mns_field *field, const mns_plan *plan,
                    float *out)
{
    size_t stride = plan_tree_floats(plan);
    bool radii = plan->features & FEATURE_RADII, strengths = plan->features & FEATURE_STRENGTHS;
#pragma omp parallel for if (count > CHUNK * 8)
    for (size_t i = 0; i < count; i++) {
        float *to = out + i * stride;
        to[stride - 1] = 0;
        for (int axis = 0; axis < 3; axis++) {
            double exact = field->p.axis[axis][index[i]] - plan->tree_origin[axis];
            to[axis] = (float)(exact - (double)rounded(exact));
        }
        double radius = field_radius(field, index[i]), strength = field_strength(field, index[i]);
        if (radii) to[3] = (float)(radius - (double)rounded(radius));
        if (strengths) to[stride - 1] = (float)(strength - (double)rounded(strength));
    }
}

void trace_pack_colors(const uint32_t *index, size_t count, const mns_field *field, const mns_plan *plan,
                       void *out)
{
    ball_colors colors = ball_colors_of(field, plan);
#pragma omp parallel for if (count > CHUNK * 8)
    for (size_t i = 0; i < count; i++) ball_colors_put(&colors, index[i], (uint32_t *)out + i * colors.words);
}
