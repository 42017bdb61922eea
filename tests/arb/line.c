#include "line.h"

#include "kernel.h"

#include <math.h>
#include <stdlib.h>

/* ---- The balls that a ray meets ---- */

static void ball_init(line_ball *b)
{
    arb_init(b->middle), arb_init(b->least), arb_init(b->bend);
    arf_init(b->first), arf_init(b->last);
}

static void ball_clear(line_ball *b)
{
    arb_clear(b->middle), arb_clear(b->least), arb_clear(b->bend);
    arf_clear(b->first), arf_clear(b->last);
}

static void dot(arb_t sum, arb_srcptr a, arb_srcptr b, slong bits)
{
    arb_dot(sum, NULL, 0, a, 1, b, 1, 3, bits);
}

/* u(s) of ball i. The least distance is that of a difference of vectors, not the root of a difference. */
static void ball_shape(line_ball *b, const truth_scene *scene, size_t i, const truth_ray *ray, slong bits)
{
    arb_ptr c = _arb_vec_init(3), d = _arb_vec_init(3);
    arb_t square, x;
    arb_init(square), arb_init(x);
    for (int a = 0; a < 3; a++) {
        arb_set_d(c + a, scene->axis[a][i]);
        arb_set_d(x, ray->origin[a]);
        arb_sub(c + a, c + a, x, bits);
        arb_set_d(d + a, ray->direction[a]);
    }
    dot(square, d, d, bits);
    dot(b->middle, c, d, bits);
    arb_div(b->middle, b->middle, square, bits);
    for (int a = 0; a < 3; a++) arb_submul(c + a, d + a, b->middle, bits);
    dot(b->least, c, c, bits);
    arb_set_d(x, scene->radius[i]);
    arb_sqr(x, x, bits);
    arb_div(b->least, b->least, x, bits);
    arb_div(b->bend, square, x, bits);
    _arb_vec_clear(c, 3), _arb_vec_clear(d, 3);
    arb_clear(square), arb_clear(x);
}

/* The chord's ends, outwards. False: no part of the ray from s = 0 on is within the ball. */
static bool ball_chord(line_ball *b, slong bits)
{
    arb_t half;
    arb_init(half);
    arb_sub_ui(half, b->least, 1, bits);
    arb_neg(half, half);
    arb_div(half, half, b->bend, bits);
    arb_get_ubound_arf(b->last, half, bits);
    bool met = arf_sgn(b->last) > 0;
    if (met) {
        arb_set_arf(half, b->last);
        arb_sqrt(half, half, bits);
        arb_sub(half, b->middle, half, bits);
        arb_get_lbound_arf(b->first, half, 64);
        arb_sub(half, b->middle, half, bits); /* half a chord again, and the middle's error twice */
        arb_add(half, b->middle, half, bits);
        arb_get_ubound_arf(b->last, half, 64);
        met = arf_sgn(b->last) > 0;
    }
    arb_clear(half);
    return met;
}

static double distance(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* The point of the box of the effective spheres nearest to the ray's origin. */
static void nearest_of_box(const truth_scene *scene, const double origin[3], double point[3])
{
    for (int a = 0; a < 3; a++) {
        double lo = INFINITY, hi = -INFINITY;
        for (size_t i = 0; i < scene->count; i++) {
            lo = fmin(lo, scene->axis[a][i] - scene->radius[i]);
            hi = fmax(hi, scene->axis[a][i] + scene->radius[i]);
        }
        point[a] = fmin(fmax(origin[a], lo), hi);
    }
}

bool line_begin(line *l, const truth_scene *scene, const truth_ray *ray, slong bits)
{
    *l = (line){.scene = scene, .bits = bits};
    l->ball = calloc(scene->count + 1, sizeof *l->ball);
    if (!l->ball) return false;
    arb_init(l->length);
    for (int a = 0; a < 3; a++) {
        arb_t x;
        arb_init(x);
        arb_set_d(x, ray->direction[a]);
        arb_addmul(l->length, x, x, bits);
        arb_clear(x);
    }
    arb_sqrt(l->length, l->length, bits);
    double near[3], unit = arf_get_d(arb_midref(l->length), ARF_RND_NEAR);
    nearest_of_box(scene, ray->origin, near);
    for (size_t i = 0; i < scene->count; i++) {
        line_ball *b = &l->ball[l->count];
        ball_init(b);
        ball_shape(b, scene, i, ray, bits);
        if (!ball_chord(b, bits)) {
            ball_clear(b);
            continue;
        }
        double p[3] = {scene->axis[0][i], scene->axis[1][i], scene->axis[2][i]}, radius = scene->radius[i];
        b->strength = scene->strength[i];
        b->radius = radius / unit;
        b->far = distance(p, ray->origin) / radius;
        b->far_box = distance(p, near) / radius;
        l->count++;
    }
    return true;
}

void line_end(line *l)
{
    if (!l->ball) return;
    for (size_t i = 0; i < l->count; i++) ball_clear(&l->ball[i]);
    free(l->ball);
    arb_clear(l->length);
}

/* ---- Enclosures ---- */

void line_bounds_init(line_bounds *b)
{
    arb_init(b->value), arb_init(b->slope), arb_init(b->scale);
}

void line_bounds_clear(line_bounds *b)
{
    arb_clear(b->value), arb_clear(b->slope), arb_clear(b->scale);
}

/* u over the offsets `away` from the middle, within [0, 1]. False: all beyond 1. */
static bool ball_reach(const line_ball *b, const arb_t away, slong bits, arf_t lo, arf_t hi)
{
    arb_t x;
    arb_init(x);
    arb_get_abs_lbound_arf(lo, away, bits);
    arb_get_abs_ubound_arf(hi, away, bits);
    arb_set_arf(x, lo);
    arb_sqr(x, x, bits);
    arb_mul(x, x, b->bend, bits);
    arb_add(x, x, b->least, bits);
    arb_get_lbound_arf(lo, x, bits);
    arb_set_arf(x, hi);
    arb_sqr(x, x, bits);
    arb_mul(x, x, b->bend, bits);
    arb_add(x, x, b->least, bits);
    arb_get_ubound_arf(hi, x, bits);
    arb_clear(x);
    if (arf_sgn(lo) < 0) arf_zero(lo);
    if (arf_cmp_si(hi, 1) > 0) arf_one(hi);
    return arf_cmp_si(lo, 1) < 0;
}

/* scale += |q| (k + |k'| far), |k'| being v times -k'/v. */
static void add_scale(const line *l, const line_ball *b, const arf_t lo, const arf_t hi, const arb_t value,
                      const arb_t fall, arb_t scale, arb_t scale_box)
{
    arb_t v, x, far;
    arb_init(v), arb_init(x), arb_init(far);
    arb_set_interval_arf(v, lo, hi, l->bits);
    arb_sqrtpos(v, v, l->bits);
    arb_mul(v, v, fall, l->bits);
    const double from[2] = {b->far, b->far_box};
    arb_struct *sum[2] = {scale, scale_box};
    for (int o = 0; o < 2; o++) {
        arb_set_d(far, from[o]);
        arb_mul(x, v, far, l->bits);
        arb_add(x, x, value, l->bits);
        arb_set_d(far, fabs(b->strength));
        arb_addmul(sum[o], x, far, l->bits);
    }
    arb_clear(v), arb_clear(x), arb_clear(far);
}

void line_enclose(const line *l, const size_t *active, size_t count, const arb_t s, bool with_scale,
                  line_bounds *b)
{
    arb_t away, value, fall, q, box;
    arf_t lo, hi;
    arb_init(away), arb_init(value), arb_init(fall), arb_init(q), arb_init(box);
    arf_init(lo), arf_init(hi);
    arb_set_d(b->value, -l->scene->iso);
    arb_zero(b->slope), arb_zero(b->scale);
    for (size_t i = 0; i < count; i++) {
        const line_ball *ball = &l->ball[active[i]];
        arb_sub(away, s, ball->middle, l->bits);
        if (!ball_reach(ball, away, l->bits, lo, hi)) continue;
        kernel_enclose(l->scene->kernel, lo, hi, l->bits, value, fall);
        arb_set_d(q, ball->strength);
        arb_addmul(b->value, q, value, l->bits);
        if (with_scale) add_scale(l, ball, lo, hi, value, fall, b->scale, box);
        arb_mul(away, away, ball->bend, l->bits);
        arb_mul(away, away, fall, l->bits);
        arb_submul(b->slope, q, away, l->bits); /* q (k'/v) du/ds / 2 */
    }
    if (with_scale) arb_max(b->scale, b->scale, box, l->bits);
    arb_clear(away), arb_clear(value), arb_clear(fall), arb_clear(q), arb_clear(box);
    arf_clear(lo), arf_clear(hi);
}

void line_enclose_between(const line *l, const size_t *active, size_t count, const arf_t lo, const arf_t hi,
                          bool with_scale, line_bounds *b)
{
    arb_t s, middle;
    line_bounds at;
    arb_init(s), arb_init(middle);
    line_bounds_init(&at);
    arb_set_interval_arf(s, lo, hi, l->bits);
    line_enclose(l, active, count, s, with_scale, b);
    if (line_sign(b->value) == 0) {
        arb_set_arf(middle, arb_midref(s));
        line_enclose(l, active, count, middle, false, &at);
        arb_sub(s, s, middle, l->bits);
        arb_addmul(at.value, s, b->slope, l->bits);
        if (line_sign(at.value) != 0 || mag_cmp(arb_radref(at.value), arb_radref(b->value)) < 0)
            arb_set(b->value, at.value);
    }
    arb_clear(s), arb_clear(middle);
    line_bounds_clear(&at);
}

/* ---- Intervals ---- */

size_t line_active(const line *l, const size_t *from, size_t count, const arf_t lo, const arf_t hi,
                   size_t *to)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        const line_ball *b = &l->ball[from[i]];
        if (arf_cmp(b->first, hi) <= 0 && arf_cmp(b->last, lo) >= 0) to[kept++] = from[i];
    }
    return kept;
}

static int cut_order(const void *a, const void *b)
{
    return arf_cmp(a, b);
}

arf_struct *line_cuts(const line *l, size_t *count)
{
    arf_struct *cut = calloc(2 * l->count + 1, sizeof *cut);
    if (!cut) return NULL;
    size_t n = 0;
    arf_t out, end,
        part; /* a little outside the chord, so that what touches at its end is inside an interval */
    arf_init(out), arf_init(end), arf_init(part), arf_init(&cut[n++]);
    arf_set_d(part, 0x1.2f6a95p-11);
    for (size_t i = 0; i < l->count; i++) {
        const line_ball *b = &l->ball[i];
        arf_sub(out, b->last, b->first, 53, ARF_RND_UP);
        arf_mul(out, out, part, 53, ARF_RND_UP);
        arf_init(&cut[n]);
        arf_add(&cut[n++], b->last, out, 128, ARF_RND_CEIL);
        arf_sub(end, b->first, out, 128, ARF_RND_FLOOR);
        if (arf_sgn(end) <= 0) continue;
        arf_init(&cut[n]);
        arf_set(&cut[n++], end);
    }
    arf_clear(out), arf_clear(end), arf_clear(part);
    qsort(cut, n, sizeof *cut, cut_order);
    *count = n;
    return cut;
}

void line_cuts_free(arf_struct *cut, size_t count)
{
    for (size_t i = 0; cut && i < count; i++) arf_clear(&cut[i]);
    free(cut);
}

void line_split(const line *l, const arf_t lo, const arf_t hi, arf_t split)
{
    arf_t part;
    arf_init(part);
    arf_set_d(part, 0x1.f38b1d6c4e2a9p-2);
    arf_sub(split, hi, lo, l->bits, ARF_RND_DOWN);
    arf_mul(split, split, part, l->bits, ARF_RND_DOWN);
    arf_add(split, lo, split, l->bits, ARF_RND_DOWN);
    arf_clear(part);
}

double line_relative_width(const line *l, const size_t *active, size_t count, const arf_t lo, const arf_t hi)
{
    double radius = INFINITY;
    for (size_t i = 0; i < count; i++) radius = fmin(radius, l->ball[active[i]].radius);
    arf_t width;
    arf_init(width);
    arf_sub(width, hi, lo, 53, ARF_RND_UP);
    double relative = arf_get_d(width, ARF_RND_UP) / radius;
    arf_clear(width);
    return relative;
}

int line_sign(const arb_t x)
{
    return arb_is_positive(x) ? 1 : arb_is_negative(x) ? -1 : 0;
}
