/* One ball on a piece of a ray: bounds by monotony, and a cubic with its remainder for the kernels that are
 * no polynomials in w. */
#ifndef MNS_REFERENCE_BOUND_H
#define MNS_REFERENCE_BOUND_H

#include "field/kernel.h"
#include "reference/chord.h"

/* k falls with the distance from m, so its range lies between the nearest and the farthest point. */
typedef struct bound_range {
    double from, to;   /* (s - m)/R at the ends */
    double length;     /* the piece's, over R */
    double w_lo, w_hi; /* of w, the chord's blur taken off and put on; w_hi <= 1 */
    double lo, hi;     /* of k */
} bound_range;

static inline bool bound_is_polynomial(mns_kernel kernel)
{
    return kernel != MNS_KERNEL_PERLIN && kernel != MNS_KERNEL_WENDLAND;
}

/* k at w in [0, 1]; its relative rounding is below KERNEL_ROUND, w's own being in the chord's blur. */
#define KERNEL_ROUND (24 * ROUND)
static inline double bound_value(mns_kernel kernel, double w)
{
    return w > 0 ? density_value((int)kernel, 1 - w) : 0;
}

/* At least |dk/dw| for every w up to this one. dk/dw = -k'(v)/(2v), which grows with w but for perlin's 15 v
 * (1-v)^2 <= 20/9; and 1 - v <= w. */
static inline double bound_rise(mns_kernel kernel, double w)
{
    if (kernel == MNS_KERNEL_PERLIN) return fmin(15 * w * w, 2.25);
    if (kernel == MNS_KERNEL_WENDLAND) return 10 * w * w * w;
    return 0.5 * density_slope_bound((int)kernel, w);
}

void bound_range_of(mns_kernel kernel, const reference_chord *chord, double from, double to,
                    bound_range *range);

/* A cubic through value and slope at both ends, for perlin and wendland. */
typedef struct bound_cubic {
    double c[4];                       /* Bernstein coefficients of k */
    double rounding;                   /* of each */
    double remainder, slope_remainder; /* as a piece's model and slope_model */
} bound_cubic;

/* What bound_cubic_of leaves out, without making it. */
double bound_remainder(mns_kernel kernel, const bound_range *range);
void bound_cubic_of(mns_kernel kernel, const reference_chord *chord, const bound_range *range,
                    bound_cubic *cubic);

#endif
