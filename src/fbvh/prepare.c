/* The field's balls as the tree holds them: floats around the origin, along a curve that keeps neighbours
 * near, and the node that is all of them. */
#include "fbvh/builder.h"
#include "list/order.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { CURVE_BITS = 10 };

/* Beyond these squares of lengths leave the floats. */
#define LENGTH_MOST  1e18
#define LENGTH_LEAST 1e-18

/* Mean number of effective spheres over a point from which a field is very dense (section 7), and the balls
 * that a node has when the halving of its first levels ends. */
enum { DENSE = 16, MIDDLE_LEAST = 65536 };

static uint32_t spread(uint32_t x) /* ten bits, two zeros before each */
{
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

static uint32_t curve_place(const mns_field *f, size_t i, double scale)
{
    uint32_t place = 0;
    for (int a = 0; a < 3; a++) {
        double step = (f->p.axis[a][i] - f->lo[a]) * scale;
        place |= spread((uint32_t)fmin(fmax(step, 0), (1 << CURVE_BITS) - 1)) << a;
    }
    return place;
}

/* Sorted along the curve (Morton's), ties by index. Balls of strength 0 are left out. */
static size_t sort_balls(const mns_field *f, builder_sort *sort)
{
    double extent = 0;
    for (int a = 0; a < 3; a++) extent = fmax(extent, f->hi[a] - f->lo[a]);
    double scale = extent > 0 ? (1 << CURVE_BITS) / extent : 0;
    if (!isfinite(scale)) scale = 0;
    size_t count = f->p.count;
    if (f->p.strength) {
        count = 0;
        for (size_t i = 0; i < f->p.count; i++)
            if (f->p.strength[i] != 0) sort->key[count++] = i;
    }
#pragma omp parallel for if (count > ORDER_ALONE)
    for (size_t i = 0; i < count; i++) {
        size_t at = f->p.strength ? (size_t)sort->key[i] : i;
        sort->key[i] = (uint64_t)curve_place(f, at, scale) << 32 | at;
    }
    list_radix_sort(sort->key, sort->scratch, sort->digits, count);
    return count;
}

static mns_status check_lengths(const mns_field *f, const double origin[3], double *most, mns_error *error)
{
    *most = 0;
    for (int a = 0; a < 3; a++) *most = fmax(*most, fmax(f->hi[a] - origin[a], origin[a] - f->lo[a]));
    if (*most + f->radius_max < LENGTH_MOST && f->radius_min > LENGTH_LEAST) return MNS_OK;
    const double unit = field_unit(f);
    return status_fail(
        error, MNS_ERROR_UNSUPPORTED,
        "fbvh: radii from %g to %g in a field that reaches %g from its middle do not fit floats; "
        "expected all between %g and %g",
        f->radius_min * unit, f->radius_max * unit, *most * unit, LENGTH_LEAST * unit, LENGTH_MOST * unit);
}

static float strength_as_float(double q)
{
    float near = (float)fmin(fmax(q, -FLT_MAX), FLT_MAX);
    return fabsf(near) < FLT_MIN ? copysignf(FLT_MIN, (float)copysign(1, q)) : near; /* none may vanish */
}

static void pack(const mns_field *f, const builder_sort *sort, builder_slot *slot)
{
    const double *o = slot->tree.origin;
    size_t count = slot->tree.ball_count;
#pragma omp parallel for if (count > ORDER_ALONE)
    for (size_t i = 0; i < count; i++) {
        size_t at = (uint32_t)sort->key[i];
        fbvh_ball *ball = &slot->ball[i];
        for (int a = 0; a < 3; a++) ball->position[a] = (float)(f->p.axis[a][at] - o[a]);
        ball->radius = (float)field_radius(f, at);
        slot->index[i] = (uint32_t)at;
        if (f->p.strength) slot->strength[i] = strength_as_float(f->p.strength[at]);
    }
}

/* Mean number of effective spheres over a point of the field's box. */
static double overlap_of(const mns_field *f)
{
    double volume = 1, sphere = 4.18879 * pow(f->radius_median, 3);
    for (int a = 0; a < 3; a++) volume *= f->effective_hi[a] - f->effective_lo[a];
    return (double)f->p.count * sphere / volume;
}

/* Chosen levels of plain halving: of a very dense field, until a node is of a size to try planes for. */
static int middle_levels(const mns_field *f, const fbvh_options *o)
{
    if (o->middle_levels) return o->middle_levels > 0 ? o->middle_levels : 0;
    if (!(overlap_of(f) >= DENSE)) return 0;
    int levels = 0;
    for (size_t balls = f->p.count; balls > MIDDLE_LEAST; balls /= 2) levels++;
    return levels;
}

mns_status builder_prepare(fbvh_builder *b, builder_slot *slot, const mns_field *f, work_set *set,
                           mns_error *error)
{
    double most;
    fbvh_tree *tree = &slot->tree;
    for (int a = 0; a < 3; a++) tree->origin[a] = f->lo[a] + 0.5 * (f->hi[a] - f->lo[a]);
    mns_status status = check_lengths(f, tree->origin, &most, error);
    if (status) return status;
    tree->ball_count = sort_balls(f, &b->sort);
    pack(f, &b->sort, slot);
    set->ball = slot->ball;
    set->strength = f->p.strength ? slot->strength : NULL;
    set->count = tree->ball_count;
    set->slack = (float)(most * 0x1p-21);
    set->iso = f->iso;
    set->middle_levels = middle_levels(f, &set->options);
    set->own = 0;
    set->sum = 0;
    for (size_t i = 0; i < set->count && set->strength; i++) {
        if (set->strength[i] > 0) set->own++, set->sum += set->strength[i];
    }
    if (!set->strength) set->own = set->count, set->sum = (double)set->count;
    return MNS_OK;
}

void builder_root(const work_set *set, uint32_t *list, work_node *root)
{
    bool fitted = set->options.kind == FBVH_FITTED;
    *root = (work_node){.lo = {FLT_MAX, FLT_MAX, FLT_MAX},
                        .hi = {-FLT_MAX, -FLT_MAX, -FLT_MAX},
                        .count = set->count,
                        .own = fitted ? set->count : set->own,
                        .span = work_span(set, set->sum)};
    size_t own = 0, split = root->own;
    for (uint32_t i = 0; i < set->count; i++) {
        bool positive = work_strength(set, i) > 0;
        list[fitted || positive ? own++ : split++] = i;
        if (!positive) continue;
        float tight = work_tight(set, &set->ball[i], root->span);
        for (int a = 0; a < 3; a++) {
            root->lo[a] = work_least(root->lo[a], set->ball[i].position[a] - tight);
            root->hi[a] = work_most(root->hi[a], set->ball[i].position[a] + tight);
        }
    }
    if (root->span < 0 || !set->own) root->count = 0;
}
