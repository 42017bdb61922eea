/* The balls in view, in order of effective distance (Szecsi & Illes 2012, section 5, "Sorting"). */
#ifndef MNS_LIST_ORDER_H
#define MNS_LIST_ORDER_H

#include "plan/plan.h"

#include <string.h>

/* A ball as it goes to the GPU: position relative to the plan's origin, in floats, and where it stands in
 * the field. */
typedef struct list_ball {
    float position[3];
    uint32_t index;
} list_ball;

typedef struct list_order {
    list_ball *ball; /* in view, in the order of the field */
    uint64_t *key;   /* effective distance in the upper half, place in `ball` in the lower */
    uint64_t *scratch;
    uint32_t *digits; /* counts of the sort */
    size_t capacity;
    size_t in_view; /* balls */
    size_t count;   /* of them in the order: all but what was found to be hidden */
    size_t sorted;  /* of these, the nearest; the rest stands behind them in the order of the field */
    size_t quads; /* up to the last too large for a point: all drawn as rectangles; 0 unless all are sorted */
    float size;   /* largest sum of a ball's coordinates, signs aside */
} list_order;

/* Culls what is outside the view, sorts the rest ascending by |p - e| - R, ties by index: all, or the nearest
 * `near` and few more. Parallel, the same result for any number of threads. Errors: MEMORY. */
mns_status list_order_make(list_order *order, const mns_field *field, const mns_plan *plan, size_t near,
                           mns_error *error);
/* Puts the nearest `near`, and those of about the same distance as the last of them, before all others; both
 * stay in the order of the field. Returns how many they are. */
size_t list_part_near(list_order *order, size_t near);
/* Sorts what is not sorted yet. */
void list_order_finish(list_order *order);
void list_order_free(list_order *order);

static inline const list_ball *list_ball_at(const list_order *order, size_t place)
{
    return &order->ball[(uint32_t)order->key[place]];
}

/* The effective distance that a key was made from. */
static inline float list_key_distance(uint64_t key)
{
    uint32_t bits = (uint32_t)(key >> 32);
    float distance;
    bits = bits & 0x80000000u ? bits & 0x7fffffffu : ~bits;
    memcpy(&distance, &bits, sizeof distance);
    return distance;
}

/* Fewer balls are sorted and packed by one thread: OpenMP's threads go on spinning for milliseconds after
 * their work, on the processors that a software renderer then wants (docs/decisions.md). */
enum { ORDER_ALONE = 32768 };

enum { RADIX_BITS = 11, RADIX_DIGITS = 1 << RADIX_BITS, RADIX_THREADS = 32 };

/* Sorts `key` by the upper 32 bits, stably, in three passes; the result is in `key`. scratch: count keys;
 * digits: RADIX_THREADS x RADIX_DIGITS counts. */
void list_radix_sort(uint64_t *key, uint64_t *scratch, uint32_t *digits, size_t count);

#endif
