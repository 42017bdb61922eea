/* The oracle of the tests: the first hit of a ray with the true field, in long double, by guaranteed steps.
 *
 * It shares nothing with the library's solvers: the kernels are written again from the design's table, and a
 * ray is walked by a bound on the curvature of f along it, so that no sign change can be stepped over. Slow,
 * and right.
 */
#ifndef MNS_TESTS_BRUTE_H
#define MNS_TESTS_BRUTE_H

#include "meniscus.h"

typedef struct brute_ray {
    long double origin[3], direction[3]; /* direction of length one */
} brute_ray;

/* What counts as too near to call: an extremum e of f along the ray with |f(e) - L| <= tau * bound, the bound
 * being the sum of |q|k + |q||k'||p - reference|/R, taken at its largest over the balls around e. */
typedef struct brute_limits {
    double tau;          /* 2^-40 for doubles, 2^-20 for floats */
    double reference[3]; /* origin of the coordinates whose rounding is meant: mostly the eye */
} brute_limits;

typedef struct brute_hit {
    bool hit;  /* f - L changes sign at t > 0, and nowhere before */
    bool near; /* undecided in the design's sense: `hit` may be right or wrong, and nobody can be blamed */
    long double t;         /* where hit */
    long double normal[3]; /* -grad f / |grad f| there */
    double radius;         /* the smallest R of the balls that cover the hit */
    double gap;            /* least |f(e) - L| / bound of the extrema passed, where that was small; else 1 */
    size_t steps;
} brute_hit;

typedef struct brute brute;

/* Holds on to `field`, which must outlive it. NULL: out of memory. */
brute *brute_create(const mns_field *field);
void brute_destroy(brute *oracle);

long double brute_value(const brute *oracle, const long double x[3]);
void brute_gradient(const brute *oracle, const long double x[3], long double gradient[3]);
/* Thread safe: one oracle may serve many threads. */
brute_hit brute_first_hit(const brute *oracle, const brute_ray *ray, const brute_limits *limits);

/* k(v), and k'(v)/v, which is finite at 0; both 0 from v = 1 on. `u` is v squared. */
long double brute_kernel(mns_kernel kernel, long double u, long double *slope_over_v);
/* Bounds over v in [0,1]: of |k'|, and of max(|k''|, |k'/v|), the curvature along any line. */
long double brute_kernel_slope_bound(mns_kernel kernel);
long double brute_kernel_curvature_bound(mns_kernel kernel);

#endif
