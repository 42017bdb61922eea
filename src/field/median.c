/* Exact medians of non-negative doubles without moving them: such doubles order as their bits do, so the k-th
 * smallest is found digit by digit from histograms. Six passes whatever the values, no worst case. */
#include "field/field.h"

#include <string.h>

enum { DIGIT_BITS = 11, DIGITS = 6, BINS = 1 << DIGIT_BITS };

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* The k-th smallest, k from 0. */
static double select_rank(const double *value, size_t count, size_t k)
{
    uint64_t prefix = 0, mask = 0;
    for (int digit = DIGITS - 1; digit >= 0; digit--) {
        int shift = digit * DIGIT_BITS;
        size_t histogram[BINS] = {0};
        for (size_t i = 0; i < count; i++) {
            uint64_t bits = bits_of(value[i]);
            if ((bits & mask) == prefix) histogram[(bits >> shift) & (BINS - 1)]++;
        }
        uint64_t bin = 0;
        while (bin + 1 < BINS && k >= histogram[bin]) k -= histogram[bin++];
        prefix |= bin << shift;
        mask |= (uint64_t)(BINS - 1) << shift;
    }
    double found;
    memcpy(&found, &prefix, sizeof found);
    return found;
}

double field_median(const double *value, size_t count)
{
    if (!count) return 0;
    double upper = select_rank(value, count, count / 2);
    if (count % 2) return upper;
    double lower = select_rank(value, count, count / 2 - 1);
    return lower + (upper - lower) / 2;
}
