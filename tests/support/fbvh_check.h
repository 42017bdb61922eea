/* What every tree must be, whatever its options, held against all balls one by one. */
#ifndef MNS_TESTS_FBVH_CHECK_H
#define MNS_TESTS_FBVH_CHECK_H

#include "fbvh/fbvh.h"

/* f at x, over all balls of the field. */
double fbvh_check_value(const mns_field *field, const double x[3]);

/* Boxes nest, siblings of a fitted tree share no more than a face, every node and reference is used once,
 * depth and bounds are kept, and the figures are those of the tree. */
void fbvh_check_shape(const fbvh_tree *tree, const fbvh_options *options);

/* Each leaf refers to every ball it must (of a tree made without discarding), and none twice. */
void fbvh_check_references(const fbvh_tree *tree, const mns_field *field);

/* At `points` random places in space, as many on the surface and some in every leaf: {f >= L} lies in the
 * leaves, and a leaf that knows the place agrees with all balls. */
void fbvh_check_field(const fbvh_tree *tree, const mns_field *field, size_t points, uint64_t seed);

#endif
