#include "list/order.h"

#include <omp.h>
#include <string.h>

/* One stable counting pass: each thread counts its own stretch, the counts are summed digit by digit over the
 * threads in order, and each thread moves its stretch. */
static void radix_pass(const uint64_t *from, uint64_t *to, size_t count, int shift, uint32_t *digits,
                       int threads)
{
#pragma omp parallel num_threads(threads)
    {
        int self = omp_get_thread_num(), all = omp_get_num_threads();
        size_t first = count * (size_t)self / (size_t)all, past = count * ((size_t)self + 1) / (size_t)all;
        uint32_t *own = digits + self * RADIX_DIGITS;
        memset(own, 0, RADIX_DIGITS * sizeof *own);
        for (size_t i = first; i < past; i++) own[from[i] >> shift & (RADIX_DIGITS - 1)]++;
#pragma omp barrier
#pragma omp single
        {
            uint32_t sum = 0;
            for (int digit = 0; digit < RADIX_DIGITS; digit++)
                for (int thread = 0; thread < all; thread++) {
                    uint32_t *at = digits + thread * RADIX_DIGITS + digit, n = *at;
                    *at = sum;
                    sum += n;
                }
        }
        for (size_t i = first; i < past; i++) to[own[from[i] >> shift & (RADIX_DIGITS - 1)]++] = from[i];
    }
}

void list_radix_sort(uint64_t *key, uint64_t *scratch, uint32_t *digits, size_t count)
{
    int threads = omp_get_max_threads();
    if (threads > RADIX_THREADS) threads = RADIX_THREADS;
    if (count <= ORDER_ALONE) threads = 1;
    radix_pass(key, scratch, count, 32, digits, threads);
    radix_pass(scratch, key, count, 32 + RADIX_BITS, digits, threads);
    radix_pass(key, scratch, count, 32 + 2 * RADIX_BITS, digits, threads);
    memcpy(key, scratch, count * sizeof *key);
}
