/* Numbers of twice the length: an unevaluated sum of two doubles, good to about 2^-104 of their size.
 * Based on: Dekker 1971, "A floating-point technique for extending the available precision"; the bounds (3 to
 * 15 units of 2^-106) are those of Joldes, Muller & Popescu 2017. Values must stay below 2^990, as a product
 * splits its factors. */
#ifndef MNS_REFERENCE_REAL2_H
#define MNS_REFERENCE_REAL2_H

#include <math.h>

typedef struct real2 {
    double hi, lo; /* |lo| <= half a unit in the last place of hi */
} real2;

/* a + b without error. */
static inline real2 real2_sum(double a, double b)
{
    double sum = a + b, part = sum - a;
    return (real2){sum, (a - (sum - part)) + (b - part)};
}

/* The same for |a| >= |b|. */
static inline real2 real2_quick_sum(double a, double b)
{
    double sum = a + b;
    return (real2){sum, b - (sum - a)};
}

/* a b without error. */
static inline real2 real2_product(double a, double b)
{
    const double splitter = 134217729; /* 2^27 + 1 */
    double p = a * b, ca = splitter * a, cb = splitter * b;
    double a_hi = ca - (ca - a), a_lo = a - a_hi, b_hi = cb - (cb - b), b_lo = b - b_hi;
    return (real2){p, ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

static inline real2 real2_add(real2 a, real2 b)
{
    real2 s = real2_sum(a.hi, b.hi), t = real2_sum(a.lo, b.lo);
    s = real2_quick_sum(s.hi, s.lo + t.hi);
    return real2_quick_sum(s.hi, s.lo + t.lo);
}

static inline real2 real2_negate(real2 a)
{
    return (real2){-a.hi, -a.lo};
}

static inline real2 real2_multiply(real2 a, real2 b)
{
    real2 p = real2_product(a.hi, b.hi);
    return real2_quick_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* a > 0 */
static inline real2 real2_root(real2 a)
{
    double first = sqrt(a.hi);
    real2 rest = real2_add(a, real2_negate(real2_product(first, first)));
    return real2_quick_sum(first, rest.hi / (2 * first));
}

static inline real2 real2_divide(double a, real2 b)
{
    double first = a / b.hi;
    real2 back = real2_multiply((real2){first, 0}, b);
    real2 rest = real2_add((real2){a, 0}, real2_negate(back));
    return real2_quick_sum(first, rest.hi / b.hi);
}

#endif
