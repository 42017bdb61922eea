// The pieces of the true field: exact polynomials where the kernel is one along a ray, proven bounds elsewhere.
#if KERNEL <= DENSITY_WYVILL
#if KERNEL == DENSITY_POLY2
#define DEGREE 4
#elif KERNEL == DENSITY_POLY4
#define DEGREE 8
#else
#define DEGREE 6
#endif
#include "bernstein.glsl"
#include "piece.glsl"
#else
#define DEGREE 1
#include "bernstein.glsl"
#include "taylor.glsl"
#endif
