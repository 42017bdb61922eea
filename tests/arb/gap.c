#include "line.h"

#include <math.h>
#include <stdlib.h>

/* Extrema are looked for where f may be near L: intervals on which f is monotone, or on which it stays away
 * from L, are left; others are cut until the ratio is known to a quarter. */

static const double CLEAR = 0x1p-25; /* a ratio from which on nothing is near */

enum { DEPTH_MOST = 400 };

typedef struct hunt {
    const line *l;
    size_t *active; /* DEPTH_MOST + 2 rows of l->count */
    arf_t hit;      /* s of the hit; +inf on a miss */
    double gap;
    bool past; /* past the hit, f left L's surroundings: nothing further counts */
} hunt;

typedef struct ratio {
    double lo, hi; /* of |f - L| / scale */
    int slope;
} ratio;

static ratio enclose_ratio(const hunt *h, const size_t *active, size_t count, const arf_t lo, const arf_t hi)
{
    line_bounds b;
    arf_t most, least;
    ratio r;
    arf_init(most), arf_init(least);
    line_bounds_init(&b);
    line_enclose_between(h->l, active, count, lo, hi, true, &b);
    r.slope = line_sign(b.slope);
    arb_get_abs_ubound_arf(most, b.scale, 53);
    arb_get_abs_lbound_arf(least, b.value, 53);
    r.lo = arf_is_zero(most) ? INFINITY : arf_get_d(least, ARF_RND_DOWN) / arf_get_d(most, ARF_RND_UP);
    arb_get_abs_lbound_arf(least, b.scale, 53);
    arb_get_abs_ubound_arf(most, b.value, 53);
    r.hi = arf_is_zero(least) ? INFINITY : arf_get_d(most, ARF_RND_UP) / arf_get_d(least, ARF_RND_DOWN);
    arf_clear(most), arf_clear(least);
    line_bounds_clear(&b);
    return r;
}

static void hunt_between(hunt *h, const size_t *from, size_t from_count, const arf_t lo, const arf_t hi,
                         int depth)
{
    if (h->past) return;
    size_t *active = h->active + (size_t)depth * h->l->count;
    size_t count = line_active(h->l, from, from_count, lo, hi, active);
    ratio r = enclose_ratio(h, active, count, lo, hi);
    bool after = arf_cmp(lo, h->hit) >= 0, last = arf_cmp(hi, h->hit) >= 0;
    if (r.lo > CLEAR) {
        h->past = after;
        return;
    }
    if (r.slope != 0) {
        h->past = last && enclose_ratio(h, active, count, hi, hi).lo > CLEAR;
        return;
    }
    int before = enclose_ratio(h, active, count, lo, lo).slope,
        behind = enclose_ratio(h, active, count, hi, hi).slope;
    bool known = r.hi <= 1.25 * r.lo || r.hi < 0x1p-60;
    if ((known && before * behind < 0) || depth == DEPTH_MOST ||
        line_relative_width(h->l, active, count, lo, hi) < 0x1p-70) {
        h->gap = fmin(h->gap, r.hi < 0x1p-60 ? r.hi : r.lo);
        return;
    }
    arf_t split;
    arf_init(split);
    line_split(h->l, lo, hi, split);
    hunt_between(h, active, count, lo, split, depth + 1);
    hunt_between(h, active, count, split, hi, depth + 1);
    arf_clear(split);
}

static double hunt_line(hunt *h, const size_t *all, const arf_struct *cut, size_t cut_count)
{
    h->gap = enclose_ratio(h, all, h->l->count, &cut[0], &cut[0]).lo;
    for (size_t i = 0; i + 1 < cut_count && !h->past; i++)
        if (arf_cmp(&cut[i], &cut[i + 1]) < 0) hunt_between(h, all, h->l->count, &cut[i], &cut[i + 1], 0);
    return h->gap < CLEAR ? h->gap : 1;
}

double truth_gap(const truth_scene *scene, const truth_ray *ray, const truth_answer *answer)
{
    line l = {0};
    hunt h = {.l = &l};
    size_t cut_count = 0, *all = NULL;
    arf_struct *cut = NULL;
    double gap = NAN;
    arf_init(h.hit);
    if (!line_begin(&l, scene, ray, 256)) goto done;
    arf_pos_inf(h.hit);
    if (answer->kind == TRUTH_HIT) {
        arb_t s, rest;
        arb_init(s), arb_init(rest);
        arb_set_d(s, answer->t);
        arb_set_d(rest, answer->t_rest);
        arb_add(s, s, rest, l.bits);
        arb_div(s, s, l.length, l.bits);
        arf_set(h.hit, arb_midref(s));
        arb_clear(s), arb_clear(rest);
    }
    cut = line_cuts(&l, &cut_count);
    all = calloc(l.count + 1, sizeof *all);
    h.active = calloc((DEPTH_MOST + 2) * (l.count + 1), sizeof *h.active);
    if (!cut || !all || !h.active) goto done;
    for (size_t i = 0; i < l.count; i++) all[i] = i;
    gap = hunt_line(&h, all, cut, cut_count);
done:
    arf_clear(h.hit);
    free(h.active);
    free(all);
    line_cuts_free(cut, cut_count);
    line_end(&l);
    return gap;
}
