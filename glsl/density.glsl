// The density kernels: every method's only copy, valid GLSL and valid C.
//
// The includer defines REAL (float or double), NUM(x) (a REAL constant; x must be exact in float, since GLSL reads 0.1 as a
// float even where a double is wanted, so a third is NUM(1.0) / NUM(3.0)) and DENSITY_FN (storage words; empty in GLSL).
// `kernel` is one of the numbers below (mns_kernel of meniscus.h); a literal there folds the choice away.
//
// A kernel is a function of v = r / R in [0, 1], with k(0) = 1 and zero from v = 1 on. All are evaluated from u = v^2 through
// w = 1 - u, which along a ray is the exact quadratic (s - a)(b - s) / R^2 between the ends a, b of the chord.

#define DENSITY_POLY2 1
#define DENSITY_POLY3 2
#define DENSITY_POLY4 3
#define DENSITY_WYVILL 4
#define DENSITY_PERLIN 5
#define DENSITY_WENDLAND 6

// k(v) for u = v^2 in [0, 1].
//   poly2..4   w^2, w^3, w^4                                    Gourmel et al. 2010, section 3
//   wyvill     w^2 (1 - 4u/9) = w^2 (5 + 4w) / 9                Wyvill et al. 1986
//   perlin     (1-v)^3 (1 + 3v + 6v^2) = 1 - v^3 (v (6v - 15) + 10), without its cancellation near 1   Perlin 2002
//   wendland   (1-v)^4 (1 + 4v)
// The last two take 1 - v as w / (1 + v): no cancellation there either.
DENSITY_FN REAL density_value(int kernel, REAL u)
{
    REAL w = NUM(1.0) - u;
    if (kernel == DENSITY_POLY2) return w * w;
    if (kernel == DENSITY_POLY3) return w * w * w;
    if (kernel == DENSITY_POLY4) return (w * w) * (w * w);
    if (kernel == DENSITY_WYVILL) return w * w * (NUM(5.0) + NUM(4.0) * w) / NUM(9.0);
    REAL v = sqrt(u);
    REAL e = w / (NUM(1.0) + v);
    if (kernel == DENSITY_PERLIN) return e * e * e * (NUM(1.0) + v * (NUM(3.0) + NUM(6.0) * v));
    return (e * e) * (e * e) * (NUM(1.0) + NUM(4.0) * v);
}

// k'(v) / v for u = v^2 in [0, 1]: what a gradient needs, grad k(|x - p| / R) = (k'(v) / v) (x - p) / R^2, finite at the centre.
DENSITY_FN REAL density_slope_over_v(int kernel, REAL u)
{
    REAL w = NUM(1.0) - u;
    if (kernel == DENSITY_POLY2) return NUM(-4.0) * w;
    if (kernel == DENSITY_POLY3) return NUM(-6.0) * w * w;
    if (kernel == DENSITY_POLY4) return NUM(-8.0) * w * w * w;
    if (kernel == DENSITY_WYVILL) return NUM(-4.0) * w * (NUM(5.0) + NUM(6.0) * w) / NUM(9.0);
    REAL v = sqrt(u);
    REAL e = w / (NUM(1.0) + v);
    if (kernel == DENSITY_PERLIN) return NUM(-30.0) * v * e * e;
    return NUM(-20.0) * e * e * e;
}

// k'(v) for u = v^2 in [0, 1].
DENSITY_FN REAL density_slope(int kernel, REAL u)
{
    return sqrt(u) * density_slope_over_v(kernel, u);
}

// k(v) / w^(3/2): with w = Q^2 / R^2 at the middle of a chord of half-length Q this is the peak over (Q / R)^3, which stays finite
// as the chord shrinks, so that a spline's coefficients need no division by Q.
DENSITY_FN REAL density_over_cube(int kernel, REAL u)
{
    REAL w = NUM(1.0) - u;
    REAL z = sqrt(w);
    if (kernel == DENSITY_POLY2) return z;
    if (kernel == DENSITY_POLY3) return w * z;
    if (kernel == DENSITY_POLY4) return w * w * z;
    if (kernel == DENSITY_WYVILL) return z * (NUM(5.0) + NUM(4.0) * w) / NUM(9.0);
    REAL v = sqrt(u);
    REAL e = NUM(1.0) / (NUM(1.0) + v);
    if (kernel == DENSITY_PERLIN) return w * z * e * e * e * (NUM(1.0) + v * (NUM(3.0) + NUM(6.0) * v));
    return w * w * z * (e * e) * (e * e) * (NUM(1.0) + NUM(4.0) * v);
}

// At least |k'(v)| for every v at which 1 - v^2 <= w. A kernel's |k'| is bounded by |k'/v|, since v <= 1; that grows with w but
// for perlin (30 v (1-v)^2 <= 40/9) and, with w, for wendland through 1 - v <= w.
DENSITY_FN REAL density_slope_bound(int kernel, REAL w)
{
    if (kernel == DENSITY_POLY2) return NUM(4.0) * w;
    if (kernel == DENSITY_POLY3) return NUM(6.0) * w * w;
    if (kernel == DENSITY_POLY4) return NUM(8.0) * w * w * w;
    if (kernel == DENSITY_WYVILL) return NUM(5.0) * w;
    if (kernel == DENSITY_PERLIN) return min(NUM(30.0) * w * w, NUM(1.875));
    return min(NUM(20.0) * w * w * w, NUM(2.125));
}

// At least |second derivative of k(|x|) along any line|, that is |k''(v)| and |k'(v)/v|, for every v at which 1 - v^2 <= w <= 1. (k''(v)
// <= about 8, 4.8, 5.3, 4.8, 5.8, 5 from above; the least values at the centre are -4, -6, -8, -44/9, -5.8, -20.) Towards the edge those of the
// last two go by 1 - v <= w: k'' is -60 v (1-v) (1-2v) for perlin, 20 (1-v)^2 (4v-1) for wendland.
DENSITY_FN REAL density_curvature_bound(int kernel, REAL w)
{
    if (kernel == DENSITY_POLY2) return NUM(8.0);
    if (kernel == DENSITY_POLY3) return NUM(6.0);
    if (kernel == DENSITY_POLY4) return NUM(8.0);
    if (kernel == DENSITY_WYVILL) return NUM(5.0);
    if (kernel == DENSITY_PERLIN) return min(NUM(60.0) * w, NUM(5.875));
    return min(NUM(60.0) * w * w, NUM(20.0));
}

// At least the second derivative of k(|x|) along any line where it is positive, for the same v: what lets a density rise.
DENSITY_FN REAL density_rise_bound(int kernel, REAL w)
{
    if (kernel == DENSITY_POLY2) return NUM(8.0);
    if (kernel == DENSITY_POLY3) return NUM(4.875);
    if (kernel == DENSITY_POLY4) return NUM(5.25);
    if (kernel == DENSITY_WYVILL) return NUM(4.75);
    if (kernel == DENSITY_PERLIN) return min(NUM(60.0) * w, NUM(5.875));
    return min(NUM(60.0) * w * w, NUM(5.0));
}

// Core radius over R: the v at which k(v) = ratio (L / q of a ball); 0 where ratio >= 1, a ball that alone never reaches L.
// Bisection over u: k falls strictly, so the bracket halves until it is one step of REAL wide.
DENSITY_FN REAL density_core(int kernel, REAL ratio)
{
    if (ratio >= NUM(1.0)) return NUM(0.0);
    REAL low = NUM(0.0);
    REAL high = NUM(1.0);
    for (int step = 0; step < 64; step++) {
        REAL middle = NUM(0.5) * (low + high);
        if (density_value(kernel, middle) >= ratio)
            low = middle;
        else
            high = middle;
    }
    return sqrt(low);
}
