/* The balls of an order as the GPU's buffers hold them. */
#ifndef MNS_LIST_PACK_H
#define MNS_LIST_PACK_H

#include "list/order.h"

/* What is packed: the order's balls at these places, or all in order where `place` is NULL. */
typedef struct list_chosen {
    const uint32_t *place;
    size_t count;
} list_chosen;

/* x y z [R] [q] as floats, plan->ball_floats a ball. */
void list_pack_high(const list_order *order, list_chosen chosen, const mns_field *field, const mns_plan *plan,
                    float *out);
/* After them the order's `quads` once more, in reverse. */
void list_pack_quads(const list_order *order, const mns_plan *plan, float *out);
/* What those floats left over of the doubles, in the same form. */
void list_pack_low(const list_order *order, list_chosen chosen, const mns_field *field, const mns_plan *plan,
                   float *out);
/* Core radii (CORE_RADII): R k^-1(L / q), 0 where q <= L. */
void list_pack_cores(const list_order *order, const mns_field *field, float *out);
/* Colours and materials (BLENDS): the words of shade/ball_colors.h. */
void list_pack_colors(const list_order *order, list_chosen chosen, const mns_field *field,
                      const mns_plan *plan, void *out);

#endif
