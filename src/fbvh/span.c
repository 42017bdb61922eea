/* The tight radius by table: k^-1 for every kernel, never too small. */
#include "fbvh/work.h"
#include "field/kernel.h"

#include <string.h>

/* Entry i is for ratios sum / L up to the (i + 1)th of WORK_SPANS_AN_OCTAVE even steps an octave: the bits of
 * a float above its low mantissa count those steps. */
enum { SPAN_SHIFT = 23 - 5, SPAN_ONE = 127 << 5 };
_Static_assert(WORK_SPANS_AN_OCTAVE == 1 << 5, "five bits of the mantissa tell the step");

void work_span_fill(work_set *set, mns_kernel kernel)
{
    for (int i = 0; i < WORK_SPANS; i++) {
        uint32_t bits = (uint32_t)(SPAN_ONE + i + 1) << SPAN_SHIFT;
        float ratio;
        memcpy(&ratio, &bits, sizeof ratio);
        double span = kernel_core_radius(kernel, 1 / (double)ratio) * (1 + 0x1p-20) * WORK_GROW;
        set->span[i] = (float)fmin(span, WORK_GROW);
    }
}

float work_span(const work_set *set, double sum)
{
    if (set->options.no_tight) return WORK_GROW;
    double exact = sum * (1 + 0x1p-20) / set->iso; /* a sum of rounded strengths may be a little too small */
    if (!(exact >= 1)) return -1;
    if (exact >= (double)(1 << WORK_OCTAVES)) return WORK_GROW;
    float ratio = (float)exact;
    uint32_t bits;
    memcpy(&bits, &ratio, sizeof bits);
    uint32_t step = (bits >> SPAN_SHIFT) - SPAN_ONE;
    return step < WORK_SPANS ? set->span[step] : WORK_GROW;
}
