/* A median-split tree over the boxes of the effective spheres: which balls a ray or a point may meet. */
#ifndef MNS_REFERENCE_TREE_H
#define MNS_REFERENCE_TREE_H

#include "field/field.h"

typedef struct reference_node {
    double lo[3], hi[3];
    size_t first, count; /* of the tree's balls; count 0: an inner node */
    size_t right;        /* an inner node's second child; the first is the next node */
} reference_node;

typedef struct reference_tree {
    reference_node *node;
    size_t node_count;
    size_t *ball;
} reference_tree;

/* Ball indices, growable. */
typedef struct reference_list {
    size_t *item;
    size_t count, capacity;
} reference_list;

/* Room for `count` items; false: out of memory. */
bool reference_list_reserve(reference_list *list, size_t count);

/* False: out of memory. */
bool reference_tree_build(reference_tree *tree, const mns_field *field);
void reference_tree_free(reference_tree *tree);

/* All balls whose boxes, each widened by `pad`, the ray from `origin` along `direction` meets between 0 and
 * `reach`: every ball whose sphere it meets there, and some others. False: out of memory. */
bool reference_tree_collect(const reference_tree *tree, const double origin[3], const double direction[3],
                            const double pad[3], double reach, reference_list *list);

/* Calls `visit` for the balls whose boxes hold `point`. */
void reference_tree_around(const reference_tree *tree, const double point[3],
                           void (*visit)(void *user, size_t ball), void *user);

#endif
