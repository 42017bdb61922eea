/* Particles as they were read (structure of arrays, doubles), and the field made of them. */
#ifndef MNS_FIELD_FIELD_H
#define MNS_FIELD_FIELD_H

#include "meniscus.h"

/* An extra scalar of every particle, kept for colour. A text column (element) holds indices into its labels.
 */
typedef struct particles_column {
    char *name;
    double *value; /* count of them */
    char **label;  /* NULL for numbers */
    size_t label_count;
    double min, max;
} particles_column;

/* What a reader gives: numbers checked (finite, radii > 0), nothing resolved. Zeroed is empty. */
typedef struct particles {
    size_t count;
    double *axis[3];        /* x, y, z */
    double *radius;         /* NULL: the input has none */
    double *strength;       /* NULL: the input has none, all are 1 */
    bool radius_is_surface; /* radius is where a lone ball's surface shall lie (van der Waals), not R */
    particles_column *column;
    size_t column_count;
    const char *format; /* a literal */
    size_t rows_skipped;
    char rows_skipped_why[160];
    bool has_cell;
    double cell_origin[3], cell[3][3];
} particles;

void particles_free(particles *p); /* frees the members, zeroes *p */

/* Fills the column's min and max from its `count` values (0, 0 where there are none). */
void particles_column_range(particles_column *column, size_t count);

/* All lengths in it, but for the cell's, are in the field's own unit. */
struct mns_field {
    uint64_t stamp; /* nanoseconds of the clock when it was made: tells it from another at the same address */
    double unit;    /* scene units in one of the field's, a power of two (unit.c); 0: 1 */
    particles p;    /* p.radius holds R, or NULL where all are uniform_radius; never radius_is_surface */
    double uniform_radius; /* where p.radius is NULL */
    mns_kernel kernel;     /* never DEFAULT */
    double iso;
    const char *radius_source; /* a literal */
    double lo[3], hi[3];       /* box of the centres */
    double effective_lo[3], effective_hi[3];
    double radius_min, radius_median, radius_max;
    double strength_min, strength_max; /* 1, 1 without strengths */
    double positive_sum_bound;         /* sum of the positive strengths */
};

/* Takes over `p` (zeroing it) and resolves kernel, level and radii. On failure `p` is left to the caller. */
mns_status field_from_particles(particles *p, const mns_input_options *options, const char *radius_source,
                                mns_field **field, mns_error *error);

/* A unit in which lengths between the smallest radius and the field's extent lie about 1, so that floats and
 * doubles can square them: 1 where they can as it is. `farthest` is the largest |coordinate|. Errors:
 * UNSUPPORTED. */
mns_status field_choose_unit(double radius_min, double extent, double farthest, double *unit,
                             mns_error *error);
/* Puts the lengths of a field in scene units into its own. */
void field_enter_unit(mns_field *f);

/* Median distance from a ball to its nearest distinct neighbour (a coincident centre is none); 0 where there
 * is none (fewer than two distinct centres). Parallel, over a tree of boxes; exact, not sampled. Errors:
 * MEMORY, UNSUPPORTED. */
mns_status field_spacing(const particles *p, double *median, mns_error *error);

/* Exact median of non-negative finite values, the mean of the middle two where count is even; 0 of none. */
double field_median(const double *value, size_t count);

static inline double field_unit(const mns_field *f)
{
    return f->unit > 0 ? f->unit : 1;
}

/* In the field's own unit. */
static inline double field_radius(const mns_field *f, size_t i)
{
    return f->p.radius ? f->p.radius[i] : f->uniform_radius;
}

static inline double field_strength(const mns_field *f, size_t i)
{
    return f->p.strength ? f->p.strength[i] : 1.0;
}

#endif
