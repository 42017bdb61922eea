// The number type of a variant: float for the fast path, double where a pixel is solved again (MNS_DOUBLE).
// TAU is the rounding allowance of the undecided bound (DESIGN: 2^-20 in floats, 2^-40 in doubles), relative to the sum of the
// densities and to their slopes times the distance from the origin of the coordinates.
#ifdef MNS_DOUBLE
#define REAL double
#define REAL2 dvec2
#define REAL3 dvec3
#define REAL4 dvec4
const double TAU = 9.094947017729282379150390625e-13LF;
const double SOLVE_TOLERANCE = 1.0e-13LF;
const double SETTLED = 1.0e-9LF;
#else
#define REAL float
#define REAL2 vec2
#define REAL3 vec3
#define REAL4 vec4
const float TAU = 9.5367431640625e-7;
const float SOLVE_TOLERANCE = 1.0e-6;
const float SETTLED = 4.0e-6; // of a hit's distance, what rounding may move it by
#endif
#define NUM(x) REAL(x)

// What an array keeps of a number: a driver was seen to hold arrays of doubles that are indexed by a variable as floats (NVIDIA
// 580.159), and a certain answer by them was none.
#ifdef MNS_DOUBLE
#define KEPT uvec2
KEPT keep(REAL x) { return unpackDouble2x32(x); }
REAL kept(KEPT x) { return packDouble2x32(x); }
#else
#define KEPT float
#define keep(x) (x)
#define kept(x) (x)
#endif
void kept_add(inout KEPT sum, REAL x) { sum = keep(kept(sum) + x); }
#define DENSITY_FN

// Larger than every ray parameter, small enough for products.
const REAL FAR_AWAY = NUM(3.0e+37);
