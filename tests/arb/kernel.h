/* The kernels of the design's table, in ball arithmetic, over intervals of u = v^2. */
#ifndef MNS_TESTS_ARB_KERNEL_H
#define MNS_TESTS_ARB_KERNEL_H

#include "meniscus.h"

#include <arb.h>

/* k and -k'(v)/v (which is not negative) over u in [lo, hi], 0 <= lo <= hi <= 1. */
void kernel_enclose(mns_kernel kernel, const arf_t lo, const arf_t hi, slong bits, arb_t value, arb_t fall);

#endif
