#include "support/fbvh_check.h"

#include "field/kernel.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ---- The field, ball by ball ---- */

static double squared_distance(const mns_field *f, size_t i, const double x[3])
{
    double sum = 0;
    for (int a = 0; a < 3; a++) sum += (f->p.axis[a][i] - x[a]) * (f->p.axis[a][i] - x[a]);
    return sum;
}

static double ball_value(const mns_field *f, size_t i, const double x[3])
{
    double r = field_radius(f, i), u = squared_distance(f, i, x) / (r * r);
    return u < 1 ? field_strength(f, i) * density_value((int)f->kernel, u) : 0;
}

double fbvh_check_value(const mns_field *f, const double x[3])
{
    double sum = 0;
    for (size_t i = 0; i < f->p.count; i++) sum += ball_value(f, i, x);
    return sum;
}

/* Sums over all balls, and how far rounding may move such a sum. */
static double value_and_noise(const mns_field *f, const double x[3], double *noise)
{
    double sum = 0, size = 0;
    for (size_t i = 0; i < f->p.count; i++) {
        double value = ball_value(f, i, x);
        sum += value;
        size += fabs(value);
    }
    *noise = 1e-13 * (size + f->iso);
    return sum;
}

static size_t ball_of(const fbvh_tree *t, uint32_t reference)
{
    return t->index[reference & ~FBVH_SPLIT];
}

/* f over the leaf's references, and whether the leaf knows it at x. */
static double leaf_value(const fbvh_tree *t, const mns_field *f, const fbvh_node *leaf, const double x[3],
                         bool *known)
{
    double sum = 0;
    *known = t->kind == FBVH_FITTED;
    for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++) {
        size_t ball = ball_of(t, t->reference[i]);
        double value = ball_value(f, ball, x);
        sum += value;
        if (!(t->reference[i] & FBVH_SPLIT) && value != 0) *known = true;
    }
    return sum;
}

static bool in_box(const fbvh_tree *t, const fbvh_node *node, const double x[3])
{
    for (int a = 0; a < 3; a++)
        if (x[a] < t->origin[a] + (double)node->lo[a] || x[a] > t->origin[a] + (double)node->hi[a])
            return false;
    return true;
}

static bool inside_box(const fbvh_tree *t, const fbvh_node *node, const double x[3])
{
    for (int a = 0; a < 3; a++)
        if (x[a] <= t->origin[a] + (double)node->lo[a] || x[a] >= t->origin[a] + (double)node->hi[a])
            return false;
    return true;
}

/* ---- Shape ---- */

typedef struct shape {
    const fbvh_tree *tree;
    bool boxes_may_gape; /* without fitting */
    unsigned char *node_seen, *reference_seen;
    size_t leaves, depth, largest, own;
} shape;

static void walk(shape *s, uint32_t at, size_t depth)
{
    const fbvh_tree *t = s->tree;
    assert_true(at < t->node_count && at != 1);
    assert_false(s->node_seen[at]);
    s->node_seen[at] = 1;
    const fbvh_node *node = &t->node[at];
    if (depth > s->depth) s->depth = depth;
    for (int a = 0; a < 3; a++) assert_true(node->lo[a] <= node->hi[a]);
    if (node->count) {
        s->leaves++;
        if (node->count > s->largest) s->largest = node->count;
        for (uint32_t i = node->first; i < node->first + node->count; i++) {
            assert_true(i < t->reference_count && (t->reference[i] & ~FBVH_SPLIT) < t->ball_count);
            assert_false(s->reference_seen[i]);
            s->reference_seen[i] = 1;
            s->own += !(t->reference[i] & FBVH_SPLIT);
        }
        return;
    }
    assert_true(node->first >= 2 && node->first % 2 == 0 && node->first + 1 < t->node_count);
    const fbvh_node *one = &t->node[node->first], *two = one + 1;
    bool apart = false;
    for (int a = 0; a < 3; a++) {
        assert_true(one->lo[a] >= node->lo[a] && two->lo[a] >= node->lo[a]);
        assert_true(one->hi[a] <= node->hi[a] && two->hi[a] <= node->hi[a]);
        apart |= one->hi[a] <= two->lo[a] || two->hi[a] <= one->lo[a];
    }
    assert_true(apart || t->kind == FBVH_OVERLAPPING);
    walk(s, node->first, depth + 1);
    walk(s, node->first + 1, depth + 1);
}

void fbvh_check_shape(const fbvh_tree *t, const fbvh_options *options)
{
    const fbvh_figures *f = &t->figures;
    shape s = {.tree = t,
               .node_seen = calloc(t->node_count + 1, 1),
               .reference_seen = calloc(t->reference_count + 1, 1)};
    assert_true(s.node_seen && s.reference_seen);
    if (t->node_count) walk(&s, 0, 0);
    size_t nodes = 0;
    for (size_t i = 0; i < t->node_count; i++) nodes += s.node_seen[i];
    for (size_t i = 0; i < t->reference_count; i++) assert_true(s.reference_seen[i]);
    assert_int_equal(nodes + (t->node_count > 0), t->node_count);
    assert_int_equal(s.leaves, f->leaves);
    assert_int_equal(s.depth, f->depth);
    assert_int_equal(s.largest, f->leaf_largest);
    assert_int_equal(s.own, f->own);
    assert_true(s.depth <= FBVH_DEPTH_MOST);
    double bound = options->references_a_ball > 0 ? options->references_a_ball : FBVH_REFERENCES;
    assert_true((double)t->reference_count <= bound * (double)t->ball_count);
    assert_true(t->reference_count <= f->reference_bound);
    size_t block = options->max_block_bytes ? options->max_block_bytes : (size_t)128 << 20;
    assert_true(t->node_count * sizeof *t->node <= block &&
                t->reference_count * sizeof *t->reference <= block);
    free(s.node_seen);
    free(s.reference_seen);
}

/* ---- References ---- */

static bool reaches_box(const fbvh_tree *t, const mns_field *f, size_t ball, const fbvh_node *leaf)
{
    double near[3];
    for (int a = 0; a < 3; a++)
        near[a] = fmin(fmax(f->p.axis[a][ball], t->origin[a] + (double)leaf->lo[a]),
                       t->origin[a] + (double)leaf->hi[a]);
    return squared_distance(f, ball, near) < field_radius(f, ball) * field_radius(f, ball);
}

static bool reaches_own(const fbvh_tree *t, const mns_field *f, size_t ball, const fbvh_node *leaf)
{
    for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++) {
        if (t->reference[i] & FBVH_SPLIT) continue;
        size_t own = ball_of(t, t->reference[i]);
        double at[3] = {f->p.axis[0][own], f->p.axis[1][own], f->p.axis[2][own]};
        double most = field_radius(f, ball) + field_radius(f, own);
        if (squared_distance(f, ball, at) < most * most) return true;
    }
    return false;
}

void fbvh_check_references(const fbvh_tree *t, const mns_field *f)
{
    size_t *held = calloc(f->p.count + 1, sizeof *held), *owned = calloc(f->p.count + 1, sizeof *owned);
    assert_true(held && owned);
    for (size_t n = 0; n < t->node_count; n++) {
        const fbvh_node *leaf = &t->node[n];
        if (n == 1 || !leaf->count) continue;
        for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++) {
            size_t ball = ball_of(t, t->reference[i]);
            assert_int_not_equal(held[ball], n + 1);
            held[ball] = n + 1;
            if (t->kind == FBVH_OVERLAPPING && !(t->reference[i] & FBVH_SPLIT))
                assert_int_equal(owned[ball]++, 0);
            bool own_first = i == leaf->first || !(t->reference[i - 1] & FBVH_SPLIT);
            assert_true(own_first || (t->reference[i] & FBVH_SPLIT));
        }
        for (size_t ball = 0; ball < f->p.count; ball++) {
            if (held[ball] == n + 1 || field_strength(f, ball) == 0) continue;
            assert_false(t->kind == FBVH_FITTED ? reaches_box(t, f, ball, leaf)
                                                : reaches_own(t, f, ball, leaf));
        }
    }
    free(held);
    free(owned);
}

/* ---- The field in the leaves ---- */

static double random_unit(uint64_t *state) /* splitmix64 */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static void check_at(const fbvh_tree *t, const mns_field *f, const double x[3])
{
    double noise, value = value_and_noise(f, x, &noise);
    size_t holding = 0, strictly = 0;
    for (size_t n = 0; n < t->node_count; n++) {
        const fbvh_node *leaf = &t->node[n];
        if (n == 1 || !leaf->count || !in_box(t, leaf, x)) continue;
        bool known;
        double here = leaf_value(t, f, leaf, x, &known);
        strictly += inside_box(t, leaf, x);
        if (!known) continue;
        holding++;
        if (value >= f->iso + noise || here >= f->iso + noise) assert_true(fabs(here - value) <= noise);
    }
    if (value >= f->iso + noise) assert_true(holding > 0);
    if (t->kind == FBVH_FITTED) assert_true(strictly <= 1);
}

static void random_in(const double lo[3], const double hi[3], uint64_t *seed, double x[3])
{
    for (int a = 0; a < 3; a++) x[a] = lo[a] + (hi[a] - lo[a]) * random_unit(seed);
}

/* Halves the way from x (outside) to y (inside) until it is as short as it gets; then y is on the surface. */
static void to_surface(const mns_field *f, double x[3], double y[3])
{
    for (int step = 0; step < 60; step++) {
        double middle[3] = {0.5 * (x[0] + y[0]), 0.5 * (x[1] + y[1]), 0.5 * (x[2] + y[2])};
        memcpy(fbvh_check_value(f, middle) >= f->iso ? y : x, middle, sizeof middle);
    }
}

void fbvh_check_field(const fbvh_tree *t, const mns_field *f, size_t points, uint64_t seed)
{
    for (size_t i = 0; i < points; i++) {
        double x[3], y[3];
        random_in(f->effective_lo, f->effective_hi, &seed, x);
        check_at(t, f, x);
        size_t ball = (size_t)((double)f->p.count * random_unit(&seed));
        for (int a = 0; a < 3; a++)
            y[a] = f->p.axis[a][ball] + 0.3 * field_radius(f, ball) * (2 * random_unit(&seed) - 1);
        check_at(t, f, y);
        if (fbvh_check_value(f, x) < f->iso && fbvh_check_value(f, y) >= f->iso) {
            to_surface(f, x, y);
            check_at(t, f, y);
            /* A hair within: by how much the surface may leave a box before anyone is wrong. */
            for (int a = 0; a < 3; a++) y[a] += 1e-6 * (f->p.axis[a][ball] - y[a]);
            check_at(t, f, y);
        }
    }
    for (size_t n = 0; n < t->node_count; n++) {
        const fbvh_node *leaf = &t->node[n];
        if (n == 1 || !leaf->count) continue;
        double lo[3], hi[3], x[3];
        for (int a = 0; a < 3; a++)
            lo[a] = t->origin[a] + (double)leaf->lo[a], hi[a] = t->origin[a] + (double)leaf->hi[a];
        random_in(lo, hi, &seed, x);
        check_at(t, f, x);
        check_at(t, f, lo);
        check_at(t, f, hi);
    }
}
