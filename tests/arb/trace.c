#include "line.h"

#include <math.h>
#include <stdlib.h>

/* From left to right, every interval is cut until f - L cannot be 0 on it, or f is monotone there and the
 * signs at its ends tell. Where f has an extremum at a distance x from L the intervals around it shrink
 * geometrically to the root of x, so a touch costs some hundred intervals, not millions. */

enum { INTERVALS_MOST = 400000, DEPTH_MOST = 600 };

typedef enum step { STEP_CLEAR, STEP_FOUND, STEP_STUCK, STEP_GAVE_UP } step;

typedef struct search {
    const line *l;
    size_t *active; /* DEPTH_MOST + 2 rows of l->count */
    double narrow;  /* the width, in radii, at which a touch is called one */
    int sign;       /* of f - L up to here */
    size_t intervals;
    arb_t root; /* where FOUND */
} search;

static int sign_at(search *w, const size_t *active, size_t count, const arf_t s)
{
    arb_t at;
    line_bounds b;
    arb_init(at);
    line_bounds_init(&b);
    arb_set_arf(at, s);
    line_enclose(w->l, active, count, at, false, &b);
    int sign = line_sign(b.value);
    arb_clear(at);
    line_bounds_clear(&b);
    return sign;
}

/* ---- A root on a monotone interval ---- */

/* One step of Newton's method over [lo, hi], all of it enclosed: false where it does not halve the interval.
 */
static bool newton(search *w, const size_t *active, size_t count, arf_t lo, arf_t hi)
{
    arb_t s, middle;
    line_bounds over, at;
    arf_t a, b;
    arb_init(s), arb_init(middle), arf_init(a), arf_init(b);
    line_bounds_init(&over), line_bounds_init(&at);
    arb_set_interval_arf(s, lo, hi, w->l->bits);
    arb_set_arf(middle, arb_midref(s));
    line_enclose(w->l, active, count, s, false, &over);
    bool better = line_sign(over.slope) != 0;
    if (better) {
        line_enclose(w->l, active, count, middle, false, &at);
        arb_div(s, at.value, over.slope, w->l->bits);
        arb_sub(s, middle, s, w->l->bits);
        arb_get_lbound_arf(a, s, w->l->bits);
        arb_get_ubound_arf(b, s, w->l->bits);
        if (arf_cmp(a, lo) < 0) arf_set(a, lo);
        if (arf_cmp(b, hi) > 0) arf_set(b, hi);
        double before = line_relative_width(w->l, active, count, lo, hi),
               after = line_relative_width(w->l, active, count, a, b);
        better = after >= 0 && after < 0.5 * before;
        if (better) arf_set(lo, a), arf_set(hi, b);
    }
    arb_clear(s), arb_clear(middle), arf_clear(a), arf_clear(b);
    line_bounds_clear(&over), line_bounds_clear(&at);
    return better;
}

/* The root between lo and hi, at which the signs differ; f is monotone in between. */
static step refine(search *w, const size_t *active, size_t count, const arf_t from, const arf_t to)
{
    arf_t lo, hi, middle;
    arf_init(lo), arf_init(hi), arf_init(middle);
    arf_set(lo, from), arf_set(hi, to);
    step result = STEP_FOUND;
    while (line_relative_width(w->l, active, count, lo, hi) > 0x1p-110) {
        if (w->intervals++ > INTERVALS_MOST) {
            result = STEP_GAVE_UP;
            break;
        }
        if (newton(w, active, count, lo, hi)) continue;
        line_split(w->l, lo, hi, middle);
        int sign = sign_at(w, active, count, middle);
        if (sign == 0) {
            if (line_relative_width(w->l, active, count, lo, hi) > 0x1p-90) result = STEP_STUCK;
            break;
        }
        arf_set(sign == w->sign ? lo : hi, middle);
    }
    if (result == STEP_FOUND) arb_set_interval_arf(w->root, lo, hi, w->l->bits);
    arf_clear(lo), arf_clear(hi), arf_clear(middle);
    return result;
}

/* ---- The search ---- */

static step search_between(search *w, const size_t *from, size_t from_count, const arf_t lo, const arf_t hi,
                           int depth)
{
    if (w->intervals++ > INTERVALS_MOST || depth > DEPTH_MOST) return STEP_GAVE_UP;
    size_t *active = w->active + (size_t)depth * w->l->count;
    size_t count = line_active(w->l, from, from_count, lo, hi, active);
    line_bounds b;
    line_bounds_init(&b);
    line_enclose_between(w->l, active, count, lo, hi, false, &b);
    int value = line_sign(b.value), slope = line_sign(b.slope);
    line_bounds_clear(&b);
    if (value == w->sign) return STEP_CLEAR;
    if (slope == w->sign) return STEP_CLEAR; /* away from L */
    if (slope != 0) {
        int end = sign_at(w, active, count, hi);
        if (end == 0) return STEP_STUCK;
        return end == w->sign ? STEP_CLEAR : refine(w, active, count, lo, hi);
    }
    if (line_relative_width(w->l, active, count, lo, hi) < w->narrow) return STEP_STUCK;
    arf_t split;
    arf_init(split);
    line_split(w->l, lo, hi, split);
    step result = search_between(w, active, count, lo, split, depth + 1);
    if (result == STEP_CLEAR) result = search_between(w, active, count, split, hi, depth + 1);
    arf_clear(split);
    return result;
}

/* The sign of f - L just after s = 0: where f = L there as far as can be told, that of the slope on [0,
 * start]. 0: it cannot be told. `start` becomes where the search begins. */
static int first_sign(search *w, const size_t *all, const arf_t first_end, bool exact, arf_t start)
{
    arf_zero(start);
    int sign = sign_at(w, all, w->l->count, start);
    if (sign != 0 || !exact) return sign;
    arf_set(start, first_end);
    for (int halving = 0; halving < 120 && sign == 0; halving++) {
        arb_t s;
        line_bounds b;
        arb_init(s);
        line_bounds_init(&b);
        arf_mul_2exp_si(start, start, -1);
        arb_set_arf(s, start);
        arf_t zero;
        arf_init(zero);
        arb_set_interval_arf(s, zero, start, w->l->bits);
        line_enclose(w->l, all, w->l->count, s, false, &b);
        sign = line_sign(b.slope);
        arf_clear(zero);
        arb_clear(s);
        line_bounds_clear(&b);
    }
    return sign;
}

static step search_line(search *w, const size_t *all, const arf_struct *cut, size_t cut_count, bool exact)
{
    arf_t start;
    arf_init(start);
    step result = STEP_CLEAR;
    w->sign = first_sign(w, all, &cut[1], exact, start);
    if (w->sign == 0) result = STEP_STUCK;
    for (size_t i = 0; i + 1 < cut_count && result == STEP_CLEAR; i++) {
        if (arf_cmp(start, &cut[i + 1]) >= 0) continue;
        result = search_between(w, all, w->l->count, start, &cut[i + 1], 0);
        arf_set(start, &cut[i + 1]);
    }
    arf_clear(start);
    return result;
}

static void set_hit(truth_answer *answer, const line *l, const arb_t root)
{
    arb_t t;
    arf_t rest;
    arb_init(t), arf_init(rest);
    arb_mul(t, root, l->length, l->bits);
    answer->t = arf_get_d(arb_midref(t), ARF_RND_NEAR);
    arf_set_d(rest, answer->t);
    arf_sub(rest, arb_midref(t), rest, l->bits, ARF_RND_NEAR);
    answer->t_rest = arf_get_d(rest, ARF_RND_NEAR);
    arb_clear(t), arf_clear(rest);
}

/* One try with `bits`; the last of them takes for L what is L as far as it can tell. */
static step attempt(const truth_scene *scene, const truth_ray *ray, slong bits, double narrow, bool exact,
                    truth_answer *answer)
{
    line l = {0};
    size_t cut_count = 0, *all = NULL;
    arf_struct *cut = NULL;
    search w = {.l = &l, .narrow = narrow};
    step result = STEP_GAVE_UP;
    arb_init(w.root);
    if (!line_begin(&l, scene, ray, bits)) goto done;
    cut = line_cuts(&l, &cut_count);
    all = calloc(l.count + 1, sizeof *all);
    w.active = calloc((DEPTH_MOST + 2) * (l.count + 1), sizeof *w.active);
    if (!cut || !all || !w.active) goto done;
    for (size_t i = 0; i < l.count; i++) all[i] = i;
    result = cut_count > 1 ? search_line(&w, all, cut, cut_count, exact) : STEP_CLEAR;
    answer->intervals += w.intervals;
    if (result == STEP_FOUND) set_hit(answer, &l, w.root);
done:
    arb_clear(w.root);
    free(w.active);
    free(all);
    line_cuts_free(cut, cut_count);
    line_end(&l);
    return result;
}

truth_answer truth_trace(const truth_scene *scene, const truth_ray *ray)
{
    truth_answer answer = {0};
    step result = attempt(scene, ray, 256, 0x1p-80, false, &answer);
    if (result == STEP_STUCK) result = attempt(scene, ray, 1024, 0x1p-130, true, &answer);
    static const truth_kind kind[] = {
        [STEP_CLEAR] = TRUTH_MISS,
        [STEP_FOUND] = TRUTH_HIT,
        [STEP_STUCK] = TRUTH_TOUCH,
        [STEP_GAVE_UP] = TRUTH_UNTOLD,
    };
    answer.kind = kind[result];
    return answer;
}

double truth_distance(const truth_answer *hit, double t)
{
    double distance = fabs((t - hit->t) - hit->t_rest); /* t - hit->t is exact where the two are near */
    return distance * (1 + 0x1p-50);
}

double truth_value(const truth_scene *scene, const double point[3], double gradient[3])
{
    double value = NAN;
    for (int a = 0; a < (gradient ? 3 : 1); a++) {
        truth_ray ray = {.origin = {point[0], point[1], point[2]}};
        ray.direction[a] = 1;
        line l = {0};
        size_t *all = NULL;
        if (line_begin(&l, scene, &ray, 256) && (all = calloc(l.count + 1, sizeof *all))) {
            arb_t zero;
            line_bounds b;
            arb_init(zero);
            line_bounds_init(&b);
            for (size_t i = 0; i < l.count; i++) all[i] = i;
            line_enclose(&l, all, l.count, zero, false, &b);
            if (gradient) gradient[a] = arf_get_d(arb_midref(b.slope), ARF_RND_NEAR);
            arb_set_d(zero, scene->iso);
            arb_add(b.value, b.value, zero, 256);
            value = arf_get_d(arb_midref(b.value), ARF_RND_NEAR);
            line_bounds_clear(&b);
            arb_clear(zero);
        }
        free(all);
        line_end(&l);
    }
    return value;
}

void truth_thread_end(void)
{
    flint_cleanup();
}
