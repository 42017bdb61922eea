#include "reference/piece.h"

#include "reference/bound.h"

#include <string.h>

void piece_range_of(const piece_balls *balls, double from, double to, piece_range *range)
{
    bool polynomial = bound_is_polynomial(balls->kernel);
    double lo = 0, hi = 0, loose = 0, at_most = 0;
    for (size_t i = 0; i < balls->count; i++) {
        const reference_chord *chord = &balls->chord[balls->item[i]];
        double q = chord->strength, size = fabs(q);
        bound_range one;
        bound_range_of(balls->kernel, chord, from, to, &one);
        lo += q > 0 ? q * one.lo : q * one.hi;
        hi += q > 0 ? q * one.hi : q * one.lo;
        at_most += size * one.hi;
        if (!polynomial)
            loose += size * fmin(one.hi - one.lo, 2 * bound_remainder(balls->kernel, &one));
        else if (!(one.w_lo > 0))
            loose += size * one.hi;
    }
    double slack = ((double)balls->count + 8) * 2 * ROUND * at_most;
    *range = (piece_range){lo - slack, hi + slack, loose, at_most};
}

/* ---- Sums of polynomials ---- */

typedef struct sum {
    int degree;
    double hi[PIECE_DEGREE + 1], lo[PIECE_DEGREE + 1]; /* each addition's error is kept */
    double size;                                       /* of what was added */
    double rounding, model, slope_model;
} sum;

static void add(sum *s, double q, const double *c)
{
    for (int j = 0; j <= s->degree; j++) {
        real2 term = real2_sum(s->hi[j], q * c[j]);
        s->hi[j] = term.hi;
        s->lo[j] += term.lo;
    }
}

/* A ball of which only its range is used. */
static void add_range(sum *s, mns_kernel kernel, double q, const bound_range *range)
{
    double middle = 0.5 * (range->lo + range->hi), half = 0.5 * (range->hi - range->lo), size = fabs(q);
    double constant[PIECE_DEGREE + 1];
    for (int j = 0; j <= s->degree; j++) constant[j] = middle;
    add(s, q, constant);
    s->size += size * range->hi;
    s->rounding += 4 * ROUND * size * range->hi;
    s->model += size * half;
    s->slope_model += size * density_slope_bound((int)kernel, range->w_hi) * range->length / s->degree;
}

/* Coefficients of w^2, of degree 4, from those of w. */
static void square(const double b[3], double a[5])
{
    a[0] = b[0] * b[0];
    a[1] = b[0] * b[1];
    a[2] = (b[0] * b[2] + 2 * b[1] * b[1]) / 3;
    a[3] = b[1] * b[2];
    a[4] = b[2] * b[2];
}

/* Degree 4 times degree 2. */
static void times_quadratic(const double a[5], const double b[3], double c[7])
{
    c[0] = a[0] * b[0];
    c[1] = (2 * a[1] * b[0] + a[0] * b[1]) / 3;
    c[2] = (6 * a[2] * b[0] + 8 * a[1] * b[1] + a[0] * b[2]) / 15;
    c[3] = (a[3] * b[0] + 3 * a[2] * b[1] + a[1] * b[2]) / 5;
    c[4] = (a[4] * b[0] + 8 * a[3] * b[1] + 6 * a[2] * b[2]) / 15;
    c[5] = (a[4] * b[1] + 2 * a[3] * b[2]) / 3;
    c[6] = a[4] * b[2];
}

/* The square of a degree 4. */
static void square_quartic(const double a[5], double c[9])
{
    for (int side = 0; side < 2; side++) {
        double a0 = a[side ? 4 : 0], a1 = a[side ? 3 : 1], a2 = a[2], a3 = a[side ? 1 : 3];
        double *to = side ? c + 8 : c;
        int step = side ? -1 : 1;
        to[0] = a0 * a0;
        to[step] = a0 * a1;
        to[2 * step] = (3 * a0 * a2 + 4 * a1 * a1) / 7;
        to[3 * step] = (a0 * a3 + 6 * a1 * a2) / 7;
    }
    c[4] = (a[0] * a[4] + 16 * a[1] * a[3] + 18 * a[2] * a[2]) / 35;
}

/* A ball whose sphere holds the whole piece, so that its kernel is a polynomial in w there. All coefficients
 * are positive; each is a form of the kernel's degree in those of w, good to dk/dw times their error and to
 * 24 roundings of its own. */
static void add_polynomial(sum *s, mns_kernel kernel, const reference_chord *chord, const bound_range *range)
{
    double y0 = range->from, y1 = range->to;
    double b[3] = {chord->peak - y0 * y0, chord->peak - y0 * y1, chord->peak - y1 * y1};
    double a[5], c[PIECE_DEGREE + 1], q = chord->strength;
    double most = fmax(b[0], fmax(b[1], b[2])) + chord->blur, power;
    square(b, a);
    if (kernel == MNS_KERNEL_POLY2) {
        memcpy(c, a, sizeof a);
        power = most * most;
    } else if (kernel == MNS_KERNEL_POLY3) {
        times_quadratic(a, b, c);
        power = most * most * most;
    } else if (kernel == MNS_KERNEL_POLY4) {
        square_quartic(a, c);
        power = most * most * most * most;
    } else {
        double factor[3];
        for (int j = 0; j < 3; j++) factor[j] = (5 + 4 * b[j]) / 9;
        times_quadratic(a, factor, c);
        power = most * most * fmax(1, most);
    }
    double rise = bound_rise(kernel, most);
    if (kernel == MNS_KERNEL_WYVILL) rise *= fmax(1, most); /* coefficients of w may pass 1 */
    add(s, q, c);
    s->size += fabs(q) * power;
    s->rounding += fabs(q) * (rise * chord->blur + 24 * ROUND * power);
}

static void add_cubic(sum *s, mns_kernel kernel, const reference_chord *chord, const bound_range *range)
{
    if (bound_remainder(kernel, range) >= 0.5 * (range->hi - range->lo)) {
        add_range(s, kernel, chord->strength, range);
        return;
    }
    bound_cubic cubic;
    double size = fabs(chord->strength);
    bound_cubic_of(kernel, chord, range, &cubic);
    add(s, chord->strength, cubic.c);
    s->size += size * (range->hi + cubic.rounding);
    s->rounding += size * cubic.rounding;
    s->model += size * cubic.remainder;
    s->slope_model += size * cubic.slope_remainder;
}

void piece_make(const piece_balls *balls, double from, double to, piece *p)
{
    static const int degrees[MNS_KERNEL_COUNT] = {
        [MNS_KERNEL_POLY2] = 4,  [MNS_KERNEL_POLY3] = 6,  [MNS_KERNEL_POLY4] = 8,
        [MNS_KERNEL_WYVILL] = 6, [MNS_KERNEL_PERLIN] = 3, [MNS_KERNEL_WENDLAND] = 3,
    };
    bool polynomial = bound_is_polynomial(balls->kernel);
    sum s = {.degree = degrees[balls->kernel], .size = balls->iso};
    for (int j = 0; j <= s.degree; j++) s.hi[j] = -balls->iso;
    for (size_t i = 0; i < balls->count; i++) {
        const reference_chord *chord = &balls->chord[balls->item[i]];
        bound_range range;
        bound_range_of(balls->kernel, chord, from, to, &range);
        if (!(range.hi > 0)) continue;
        if (!polynomial)
            add_cubic(&s, balls->kernel, chord, &range);
        else if (range.w_lo > 0)
            add_polynomial(&s, balls->kernel, chord, &range);
        else
            add_range(&s, balls->kernel, chord->strength, &range);
    }
    p->from = from, p->to = to;
    p->degree = s.degree;
    for (int j = 0; j <= s.degree; j++) p->c[j] = s.hi[j] + s.lo[j];
    /* The kept errors leave a product's and the last sum's; the bounds themselves are sums of positive terms.
     */
    double swell = 1 + ((double)balls->count + 8) * 2 * ROUND;
    p->rounding = (s.rounding + 4 * ROUND * s.size) * swell;
    p->model = s.model * swell;
    p->slope_model = s.slope_model * swell;
}

void piece_point_at(const piece_balls *balls, double s, piece_point *at)
{
    real2 value = {-balls->iso, 0};
    double slope = 0, error = 0, size = balls->iso;
    for (size_t i = 0; i < balls->count; i++) {
        const reference_chord *c = &balls->chord[balls->item[i]];
        double y = reference_chord_at(c, s), w = fmin(c->peak - y * y, 1);
        if (w + c->blur <= 0) continue;
        double k = bound_value(balls->kernel, w), q = c->strength;
        real2 term = real2_sum(value.hi, q * k);
        value = (real2){term.hi, value.lo + term.lo};
        if (w > 0) slope += q * density_slope_over_v((int)balls->kernel, 1 - w) * y * c->inverse;
        error += fabs(q) * (bound_rise(balls->kernel, w + c->blur) * c->blur + KERNEL_ROUND * k);
        size += fabs(q) * k;
    }
    at->value = value.hi + value.lo;
    at->slope = slope;
    at->error = (error + 4 * ROUND * size) * (1 + ((double)balls->count + 8) * 2 * ROUND);
}
