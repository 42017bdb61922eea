/* Arithmetic that gives the same bits everywhere. */
#include "load/generate.h"

#include <math.h>

/* The finaliser of splitmix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators",
 * 2014). */
static uint64_t mix(uint64_t x)
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

static double unit(uint64_t bits)
{
    return (double)(bits >> 11) * 0x1p-53;
}

double generate_random(const generate_frame *frame, uint64_t index, unsigned which)
{
    return unit(mix(mix(frame->seed + 0x9e3779b97f4a7c15u * (which + 1)) + index * 0x9e3779b97f4a7c15u));
}

/* Steps of 1/g, 1/g^2 and 1/g^3 with g^4 = g + 1, the three-dimensional kin of the golden ratio (M. Roberts,
 * "The unreasonable effectiveness of quasirandom sequences", 2018), as 64-bit fractions. */
double generate_even(const generate_frame *frame, uint64_t index, int k)
{
    static const uint64_t step[3] = {0xd1b54a32d192ed03u, 0xabc98388fb8fac03u, 0x8cb92ba72f3d8dd7u};
    return unit(mix(frame->seed + (uint64_t)k) + index * step[k]);
}

double generate_sine(double turns)
{
    double t = turns - floor(turns + 0.5); /* to [-1/2, 1/2], then by symmetry to [-1/4, 1/4] */
    if (t > 0.25) t = 0.5 - t;
    if (t < -0.25) t = -0.5 - t;
    double x = 6.283185307179586477 * t, square = x * x, sum = 0;
    for (int k = 21; k >= 1; k -= 2)
        sum = 1 - square / ((k + 1.0) * (k + 2.0)) * sum; /* Taylor, innermost first */
    return x * sum;
}

double generate_cosine(double turns)
{
    return generate_sine(turns + 0.25);
}

double generate_exp2(double x)
{
    double whole = floor(x), y = (x - whole) * 0.693147180559945309, sum = 1;
    for (int k = 22; k >= 1; k--) sum = 1 + y / k * sum;
    return ldexp(sum, (int)whole);
}

double generate_cbrt(double x)
{
    int exponent, third;
    double m = frexp(x, &exponent),
           y = 0.8; /* x = m 2^exponent, brought to m in [1/8, 1) and a multiple of three */
    third = (int)floor(exponent / 3.0 + 0.9);
    m = ldexp(m, exponent - 3 * third);
    for (int i = 0; i < 8; i++) y -= (y - m / (y * y)) / 3;
    return ldexp(y, third);
}

double generate_radius(double overlap, double count, double volume, double area)
{
    double radius = generate_cbrt(overlap * volume / count * 0.238732414637843004); /* 3 / 4 pi */
    double loss = radius * area / volume;
    return radius * (1 + (loss < 4 ? loss : 4) / 16);
}
