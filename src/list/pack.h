/* The balls of an order as the GPU's buffers hold them. */
#ifndef MNS_LIST_PACK_H
#define MNS_LIST_PACK_H

#include "list/order.h"

/* x y z [R] [q] as floats, plan->ball_floats a ball, in order; after them the order's `quads` once more, in
 * reverse. */
void list_pack_high(const list_order *order, const mns_field *field, const mns_plan *plan, float *out);
/* What those floats left over of the doubles, in the same form. */
void list_pack_low(const list_order *order, const mns_field *field, const mns_plan *plan, float *out);
/* The same of one ball, to its place in `out`. */
void list_pack_low_ball(const list_order *order, const mns_field *field, const mns_plan *plan, size_t place,
                        float *out);
/* Core radii (CORE_RADII): R k^-1(L / q), 0 where q <= L. */
void list_pack_cores(const list_order *order, const mns_field *field, float *out);
/* Colours of the balls (COLORS): a value each as float, or an rgba8 each with LABELS. */
void list_pack_colors(const list_order *order, const mns_field *field, const mns_plan *plan, void *out);

#endif
