#include "kernel.h"

/* k at one u. */
static void value_at(mns_kernel kernel, const arb_t u, slong bits, arb_t value)
{
    arb_t v, w, x;
    arb_init(v), arb_init(w), arb_init(x);
    arb_sqrt(v, u, bits);
    arb_sub_ui(w, u, 1, bits);
    arb_neg(w, w);
    switch (kernel) {
    case MNS_KERNEL_POLY2: /* (1 - u)^2 */
        arb_pow_ui(value, w, 2, bits);
        break;
    case MNS_KERNEL_POLY3: /* (1 - u)^3 */
        arb_pow_ui(value, w, 3, bits);
        break;
    case MNS_KERNEL_POLY4: /* (1 - u)^4 */
        arb_pow_ui(value, w, 4, bits);
        break;
    case MNS_KERNEL_WYVILL: /* (1 - u)^2 (1 - 4u/9) */
        arb_mul_si(x, u, -4, bits);
        arb_div_ui(x, x, 9, bits);
        arb_add_ui(x, x, 1, bits);
        arb_pow_ui(w, w, 2, bits);
        arb_mul(value, w, x, bits);
        break;
    case MNS_KERNEL_PERLIN: /* 1 - v^3 (v (6v - 15) + 10) */
        arb_mul_ui(x, v, 6, bits);
        arb_sub_ui(x, x, 15, bits);
        arb_mul(x, x, v, bits);
        arb_add_ui(x, x, 10, bits);
        arb_mul(x, x, v, bits);
        arb_mul(x, x, u, bits);
        arb_sub_ui(x, x, 1, bits);
        arb_neg(value, x);
        break;
    default: /* wendland: (1 - v)^4 (1 + 4v) */
        arb_mul_ui(x, v, 4, bits);
        arb_add_ui(x, x, 1, bits);
        arb_sub_ui(v, v, 1, bits);
        arb_pow_ui(v, v, 4, bits);
        arb_mul(value, v, x, bits);
    }
    arb_clear(v), arb_clear(w), arb_clear(x);
}

/* -k'(v)/v at one u. */
static void fall_at(mns_kernel kernel, const arb_t u, slong bits, arb_t fall)
{
    arb_t v, w, x;
    arb_init(v), arb_init(w), arb_init(x);
    arb_sqrt(v, u, bits);
    arb_sub_ui(w, u, 1, bits);
    arb_neg(w, w);
    arb_sub_ui(v, v, 1, bits);
    arb_neg(v, v); /* 1 - v */
    switch (kernel) {
    case MNS_KERNEL_POLY2: /* 4 (1 - u) */
        arb_mul_ui(fall, w, 4, bits);
        break;
    case MNS_KERNEL_POLY3: /* 6 (1 - u)^2 */
        arb_pow_ui(w, w, 2, bits);
        arb_mul_ui(fall, w, 6, bits);
        break;
    case MNS_KERNEL_POLY4: /* 8 (1 - u)^3 */
        arb_pow_ui(w, w, 3, bits);
        arb_mul_ui(fall, w, 8, bits);
        break;
    case MNS_KERNEL_WYVILL: /* (1 - u) (44 - 24u) / 9 */
        arb_mul_si(x, u, -24, bits);
        arb_add_ui(x, x, 44, bits);
        arb_mul(x, x, w, bits);
        arb_div_ui(fall, x, 9, bits);
        break;
    case MNS_KERNEL_PERLIN: /* 30 v (1 - v)^2 */
        arb_pow_ui(x, v, 2, bits);
        arb_sub_ui(v, v, 1, bits);
        arb_mul(x, x, v, bits);
        arb_mul_si(fall, x, -30, bits);
        break;
    default: /* wendland: 20 (1 - v)^3 */
        arb_pow_ui(v, v, 3, bits);
        arb_mul_ui(fall, v, 20, bits);
    }
    arb_clear(v), arb_clear(w), arb_clear(x);
}

void kernel_enclose(mns_kernel kernel, const arf_t lo, const arf_t hi, slong bits, arb_t value, arb_t fall)
{
    arb_t u, near, far;
    arb_init(u), arb_init(near), arb_init(far);
    arb_set_arf(u, lo);
    value_at(kernel, u, bits, value);
    fall_at(kernel, u, bits, near);
    arb_set_arf(u, hi);
    value_at(kernel, u, bits, far);
    arb_union(value, value, far, bits); /* k falls */
    fall_at(kernel, u, bits, far);
    arb_union(fall, near, far, bits); /* so does -k'/v, but for perlin's, whose one peak is 40/9 at v = 1/3 */
    if (kernel == MNS_KERNEL_PERLIN) {
        arf_t ninth;
        arf_init(ninth);
        arf_mul_ui(ninth, lo, 9, ARF_PREC_EXACT, ARF_RND_DOWN);
        bool rising = arf_cmp_si(ninth, 1) <= 0;
        arf_mul_ui(ninth, hi, 9, ARF_PREC_EXACT, ARF_RND_DOWN);
        if (rising && arf_cmp_si(ninth, 1) >= 0) {
            arb_set_ui(near, 40);
            arb_div_ui(near, near, 9, bits);
            arb_union(fall, fall, near, bits);
        }
        arf_clear(ninth);
    }
    arb_clear(u), arb_clear(near), arb_clear(far);
}
