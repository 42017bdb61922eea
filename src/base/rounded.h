/* Doubles as floats, in parts. */
#ifndef MNS_BASE_ROUNDED_H
#define MNS_BASE_ROUNDED_H

/* A double as the float nearest to it, forced through memory: one compiler kept the wider value in a
 * register. */
static inline float rounded(double value)
{
    volatile float f = (float)value;
    return f;
}

#endif
