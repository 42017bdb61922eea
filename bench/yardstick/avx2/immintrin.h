// For processors without AVX-512: the 512-bit operations that the yardstick uses, each as two of AVX2. Put
// this folder first on the include path. What it costs the yardstick is about what AVX-512 would have saved
// it.
#ifndef YARDSTICK_AVX2_IMMINTRIN_H
#define YARDSTICK_AVX2_IMMINTRIN_H
#include_next <immintrin.h>

struct wide {
    __m256 lo, hi;
};

#define WIDE static inline __attribute__((always_inline))
#define WIDE_1(name)                                                                                         \
    WIDE wide wide_##name(wide a)                                                                            \
    {                                                                                                        \
        return {_mm256_##name(a.lo), _mm256_##name(a.hi)};                                                   \
    }
#define WIDE_2(name)                                                                                         \
    WIDE wide wide_##name(wide a, wide b)                                                                    \
    {                                                                                                        \
        return {_mm256_##name(a.lo, b.lo), _mm256_##name(a.hi, b.hi)};                                       \
    }
#define WIDE_3(name)                                                                                         \
    WIDE wide wide_##name(wide a, wide b, wide c)                                                            \
    {                                                                                                        \
        return {_mm256_##name(a.lo, b.lo, c.lo), _mm256_##name(a.hi, b.hi, c.hi)};                           \
    }

WIDE_1(sqrt_ps)
WIDE_2(add_ps)
WIDE_2(sub_ps)
WIDE_2(mul_ps)
WIDE_2(min_ps)
WIDE_2(max_ps)
WIDE_3(fmadd_ps)
WIDE_3(fmsub_ps)
WIDE_3(fnmadd_ps)
WIDE wide wide_set1_ps(float a)
{
    return {_mm256_set1_ps(a), _mm256_set1_ps(a)};
}
WIDE wide wide_setzero_ps()
{
    return {_mm256_setzero_ps(), _mm256_setzero_ps()};
}
WIDE wide wide_load_ps(const float *p)
{
    return {_mm256_load_ps(p), _mm256_load_ps(p + 8)};
}
WIDE void wide_store_ps(float *p, wide a)
{
    _mm256_store_ps(p, a.lo), _mm256_store_ps(p + 8, a.hi);
}
template <int relation> WIDE __mmask16 wide_compare(wide a, wide b)
{
    int lo = _mm256_movemask_ps(_mm256_cmp_ps(a.lo, b.lo, relation));
    int hi = _mm256_movemask_ps(_mm256_cmp_ps(a.hi, b.hi, relation));
    return (__mmask16)(lo | hi << 8);
}

#define __m512                             wide
#define _mm512_sqrt_ps                     wide_sqrt_ps
#define _mm512_add_ps                      wide_add_ps
#define _mm512_sub_ps                      wide_sub_ps
#define _mm512_mul_ps                      wide_mul_ps
#define _mm512_min_ps                      wide_min_ps
#define _mm512_max_ps                      wide_max_ps
#define _mm512_fmadd_ps                    wide_fmadd_ps
#define _mm512_fmsub_ps                    wide_fmsub_ps
#define _mm512_fnmadd_ps                   wide_fnmadd_ps
#define _mm512_set1_ps                     wide_set1_ps
#define _mm512_setzero_ps                  wide_setzero_ps
#define _mm512_load_ps                     wide_load_ps
#define _mm512_store_ps                    wide_store_ps
#define _mm512_cmp_ps_mask(a, b, relation) wide_compare<relation>(a, b)
#endif
