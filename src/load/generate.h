/* The generators: fields by formula, for trials, tests and comparisons. The same specification gives the same
 * balls on every machine: random numbers are integers hashed from seed and index, and of floating point only
 * operations that IEEE 754 rounds exactly are used (+ - * / and square root), so no mathematics library has a
 * say. */
#ifndef MNS_LOAD_GENERATE_H
#define MNS_LOAD_GENERATE_H

#include "field/field.h"

typedef struct generate_shape generate_shape;

typedef struct generate_spec {
    const generate_shape *shape;
    size_t count, frames;
    uint64_t seed;
} generate_spec;

/* Whether the text reads as "name:count..." with a word for a name, known or not. */
bool generate_is_spec(const char *text);
bool generate_is_name(const char *text);
/* "name:count[:seed[:frames]]"; seed 1 and one frame by default. Errors: USAGE. */
mns_status generate_parse(const char *text, generate_spec *spec, mns_error *error);
/* Frame `frame`: exactly spec->count balls. Errors: MEMORY. */
mns_status generate_make(const generate_spec *spec, size_t frame, particles *p, mns_error *error);

/* ---- Inside ---- */

typedef struct generate_ball {
    double at[3], radius;
    double extra; /* of the shape's column */
} generate_ball;

/* What all balls of a frame share. */
typedef struct generate_frame {
    double count;
    uint64_t seed;
    double time; /* seconds: a frame is 1/60 */
    double radius;
    double spacing;    /* edge of the cube that a ball has to itself */
    uint64_t sites[3]; /* of a lattice */
} generate_frame;

struct generate_shape {
    const char *name;
    const char *column;        /* an extra column, or NULL */
    const char *const *labels; /* of that column, NULL-terminated, or NULL: numbers */
    bool radius_is_surface;
    void (*prepare)(generate_frame *frame);
    void (*place)(const generate_frame *frame, uint64_t index, generate_ball *ball);
};

extern const generate_shape generate_scattered, generate_dense, generate_mixed, generate_sheet,
    generate_molecule, generate_tornado, generate_pool, generate_drop;

/* In [0, 1): random number `which` of ball `index`. */
double generate_random(const generate_frame *frame, uint64_t index, unsigned which);
/* In [0, 1): coordinate k of point `index` of a sequence that fills the unit cube evenly whatever its length.
 */
double generate_even(const generate_frame *frame, uint64_t index, int k);

double generate_sine(double turns); /* of 2 pi turns, to about 1e-15 */
double generate_cosine(double turns);
double generate_exp2(double x); /* |x| < 1000 */
double generate_cbrt(double x); /* x > 0 */

/* The radius at which a volume evenly filled with `count` balls has that many effective spheres over a ball's
 * centre; what the spheres at the surface, of `area`, lose is made up for (3/16 R area / volume of them, to
 * first order). */
double generate_radius(double overlap, double count, double volume, double area);

#endif
