/* Which balls a ray meets: a box tree over the effective spheres, for the oracle. */
#ifndef MNS_TESTS_BRUTE_TREE_H
#define MNS_TESTS_BRUTE_TREE_H

#include "brute.h"
#include "field/field.h"

/* The piece of a ray inside one effective sphere. */
typedef struct brute_chord {
    long double entry, exit; /* distances along the ray; exit > 0, entry may be negative */
    long double middle;      /* where the ray is nearest to the centre */
    long double away2;       /* squared distance there */
    size_t ball;
} brute_chord;

typedef struct brute_chords {
    brute_chord *chord;
    size_t count, capacity;
} brute_chords;

typedef struct brute_tree brute_tree;

brute_tree *brute_tree_create(const mns_field *field);
void brute_tree_destroy(brute_tree *tree);
/* All chords with exit > 0, sorted by entry, ties by ball. False: out of memory. */
bool brute_tree_collect(const brute_tree *tree, const brute_ray *ray, brute_chords *chords);

#endif
