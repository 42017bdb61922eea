/* The nearest balls of an order apart from the rest, before anything is sorted. */
#include "list/order.h"

#include <omp.h>
#include <string.h>

/* Distances in equal steps: bucket (distance - low) >> shift. */
typedef struct buckets {
    uint32_t low;
    int shift;
} buckets;

static uint32_t bucket_of(buckets b, uint64_t key)
{
    return ((uint32_t)(key >> 32) - b.low) >> b.shift;
}

static buckets buckets_over(const uint64_t *key, size_t count, int threads)
{
    uint32_t low = UINT32_MAX, high = 0;
#pragma omp parallel for num_threads(threads) reduction(min : low) reduction(max : high)
    for (size_t i = 0; i < count; i++) {
        uint32_t distance = (uint32_t)(key[i] >> 32);
        low = distance < low ? distance : low;
        high = distance > high ? distance : high;
    }
    buckets b = {low, 0};
    while ((high - low) >> b.shift >= RADIX_DIGITS) b.shift++;
    return b;
}

/* How many buckets hold the nearest `near`. */
static uint32_t buckets_of(const uint32_t *digits, int threads, size_t near)
{
    size_t sum = 0;
    uint32_t past = 0;
    while (past < RADIX_DIGITS && sum < near) {
        for (int thread = 0; thread < threads; thread++) sum += digits[thread * RADIX_DIGITS + past];
        past++;
    }
    return past;
}

size_t list_part_near(list_order *order, size_t near)
{
    size_t count = order->count, begin[RADIX_THREADS], total = 0;
    const uint64_t *from = order->key;
    uint64_t *to = order->scratch;
    uint32_t past = 0;
    int threads = omp_get_max_threads();
    if (threads > RADIX_THREADS) threads = RADIX_THREADS;
    if (count <= ORDER_ALONE) threads = 1;
    buckets b = buckets_over(from, count, threads);
#pragma omp parallel num_threads(threads)
    {
        int self = omp_get_thread_num(), all = omp_get_num_threads();
        size_t first = count * (size_t)self / (size_t)all, end = count * ((size_t)self + 1) / (size_t)all;
        uint32_t *own = order->digits + self * RADIX_DIGITS;
        memset(own, 0, RADIX_DIGITS * sizeof *own);
        for (size_t i = first; i < end; i++) own[bucket_of(b, from[i])]++;
#pragma omp barrier
#pragma omp single
        {
            past = buckets_of(order->digits, all, near);
            for (int thread = 0; thread < all; thread++) {
                begin[thread] = total;
                for (uint32_t i = 0; i < past; i++) total += order->digits[thread * RADIX_DIGITS + i];
            }
        }
        size_t near_at = begin[self], far_at = total + first - near_at;
        for (size_t i = first; i < end; i++)
            if (bucket_of(b, from[i]) < past)
                to[near_at++] = from[i];
            else
                to[far_at++] = from[i];
    }
    order->scratch = order->key;
    order->key = to;
    return total;
}
