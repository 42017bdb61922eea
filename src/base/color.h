/* The transfer between sRGB, as people name colours, and linear light (IEC 61966-2-1). */
#ifndef MNS_BASE_COLOR_H
#define MNS_BASE_COLOR_H

#include <math.h>

static inline double color_linear(double srgb)
{
    return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4);
}

#endif
