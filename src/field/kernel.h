/* glsl/density.glsl as C: once over float (suffix _f, to hold against GLSL), once over double. */
#ifndef MNS_FIELD_KERNEL_H
#define MNS_FIELD_KERNEL_H

#include "meniscus.h"

#include <math.h>

#define DENSITY_FN static inline __attribute__((unused))
#define NUM(x)     ((REAL)(x))

#define REAL double
#define min  fmin
#include "density.glsl"
#undef min
#undef REAL

#define REAL                    float
#define sqrt                    sqrtf
#define min                     fminf
#define density_value           density_value_f
#define density_slope_over_v    density_slope_over_v_f
#define density_slope           density_slope_f
#define density_over_cube       density_over_cube_f
#define density_slope_bound     density_slope_bound_f
#define density_curvature_bound density_curvature_bound_f
#define density_rise_bound      density_rise_bound_f
#define density_core            density_core_f
#include "density.glsl"
#undef sqrt
#undef min
#undef density_value
#undef density_slope_over_v
#undef density_slope
#undef density_over_cube
#undef density_slope_bound
#undef density_curvature_bound
#undef density_rise_bound
#undef density_core
#undef REAL
#undef NUM
#undef DENSITY_FN

_Static_assert((int)MNS_KERNEL_POLY2 == DENSITY_POLY2 && (int)MNS_KERNEL_WENDLAND == DENSITY_WENDLAND,
               "mns_kernel numbers the kernels as density.glsl does");

/* Core radius over R: v with k(v) = ratio, ratio > 0; 0 where ratio >= 1. */
static inline double kernel_core_radius(mns_kernel kernel, double ratio)
{
    return density_core((int)kernel, ratio);
}

#endif
