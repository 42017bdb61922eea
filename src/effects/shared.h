/* The texts that GLSL and C share beyond the density, as C over double. */
#ifndef MNS_EFFECTS_SHARED_H
#define MNS_EFFECTS_SHARED_H

#include <math.h>
#include <stdint.h>

#define DENSITY_FN static inline __attribute__((unused))
#define REAL       double
#define UINT       uint32_t
#define NUM(x)     ((REAL)(x))
#define max        fmax
#include "optics.glsl"
#include "samples.glsl"
#include "sky.glsl"
#undef max
#undef NUM
#undef UINT
#undef REAL
#undef DENSITY_FN

#endif
