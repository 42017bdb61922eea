#include "reference/bound.h"

void bound_range_of(mns_kernel kernel, const reference_chord *chord, double from, double to,
                    bound_range *range)
{
    double y0 = reference_chord_at(chord, from), y1 = reference_chord_at(chord, to);
    double far = fmax(-y0, y1), near = y0 > 0 ? y0 : y1 < 0 ? y1 : 0;
    range->from = y0, range->to = y1;
    range->length = (to - from) * chord->inverse;
    range->w_lo = fmax(chord->peak - far * far - chord->blur, 0);
    range->w_hi = fmin(chord->peak - near * near + chord->blur, 1);
    range->hi = bound_value(kernel, range->w_hi) * (1 + KERNEL_ROUND);
    range->lo = bound_value(kernel, range->w_lo) * (1 - KERNEL_ROUND);
}

/* Bound on the third derivative, in units of 1/R^3, of g(x) = k(sqrt(x^2 + a^2)) along any line. With k' = v
 * p(v), e = |x|/v <= 1: g''' = 3 p' e + (v p'' - p') e^3. perlin    p = -30 v (1-v)^2: -90 e + 30 e^3 at v =
 * 0, at most 60 in size for every v and e wendland  p = -20 (1-v)^3: 60 (1-v) e (3 (1-v) - (1+v) e^2), the
 * factor beside 60 (1-v) between -2 and 2; and 1 - v <= w At the edge both have k'' = 0, and at the centre
 * g'' is continuous: the bound holds across either. */
static double third_derivative(mns_kernel kernel, double w_hi)
{
    return kernel == MNS_KERNEL_PERLIN ? 60 : 120 * fmax(w_hi, 0);
}

/* Let T be Taylor's parabola at the middle and e = g - T, |e| <= K H^3/48 and |e'| <= K H^2/8. Hermite's
 * cubic through g is T plus the one through e, whose values are at most max|e| + max|e'| H/4 and slopes at
 * most 1.5 * 2 max|e|/H + max|e'|. So the cubic is off by at most K H^3 (1/48 + 1/48 + 1/32) = 7/96 K H^3,
 * its slope by 5/16 K H^2. */
double bound_remainder(mns_kernel kernel, const bound_range *range)
{
    double length = range->length;
    return third_derivative(kernel, range->w_hi) * (7.0 / 96) * (length * length * length) * (1 + 0x1p-40);
}

void bound_cubic_of(mns_kernel kernel, const reference_chord *chord, const bound_range *range,
                    bound_cubic *cubic)
{
    double y[2] = {range->from, range->to}, value[2], slope[2], length = range->length, error = 0;
    for (int i = 0; i < 2; i++) {
        double w = fmin(chord->peak - y[i] * y[i], 1), u = 1 - w;
        value[i] = bound_value(kernel, w);
        slope[i] = w > 0 ? density_slope_over_v((int)kernel, u) * y[i] : 0;
        error = fmax(error, KERNEL_ROUND * value[i] + 30 * ROUND * fabs(slope[i] * length));
    }
    cubic->c[0] = value[0];
    cubic->c[1] = value[0] + slope[0] * length / 3;
    cubic->c[2] = value[1] - slope[1] * length / 3;
    cubic->c[3] = value[1];
    /* dk/dw times the error of w. Of the slope p y, p = k'/v: an error d of w moves v by at most d/v, and |y|
     * <= v, so that p y moves by |p'(v)| d <= 30 d (perlin), 60 w^2 d (wendland), and by p times y's own. */
    double w = fmax(range->w_hi, 0);
    cubic->rounding = error + bound_rise(kernel, w) * chord->blur + 8 * ROUND * range->hi +
                      length * chord->blur * (kernel == MNS_KERNEL_PERLIN ? 35 : 60 * w * w + 20 * w * w * w);
    cubic->remainder = bound_remainder(kernel, range);
    /* In the piece's measure the slope comes times length / 3. */
    cubic->slope_remainder =
        third_derivative(kernel, w) * (5.0 / 16) * (length * length * length) / 3 * (1 + 0x1p-40);
}
