/* The truth of one view of one field: every pixel's first hit by the reference, in doubles, kept from run to
 * run in the user's cache. */
#ifndef MNS_COMPARE_TRUTH_H
#define MNS_COMPARE_TRUTH_H

#include "meniscus.h"

#include <stdatomic.h>

enum { TRUTH_HASH_SIZE = 33 }; /* 128 bits in hexadecimal, with its end */

/* What light does beyond a first hit, each a plane where the look has the effect. */
typedef enum truth_term {
    TRUTH_SHADOW = 0,
    TRUTH_OCCLUSION,
    TRUTH_MIRROR, /* distances, INFINITY where nothing is met */
    TRUTH_REFRACTION,
    TRUTH_TERMS
} truth_term;

/* Planes, row 0 at the top, width * height values each (x 3 for normal, x 4 for rgba). What a truth does not
 * know is NULL: radius, view, rgba, the terms of effects and their certainty may be. */
typedef struct truth_planes {
    int width, height;
    double *t;        /* distance of the first hit; INFINITY on a miss */
    double *t_error;  /* bound on its error */
    double *normal;   /* outward; 0,0,0 on a miss */
    double *radius;   /* R_j of the ball with the largest |q|k at the hit; 0 on a miss */
    uint8_t *certain; /* 1, or 0 where undecided */
    float *rgba;      /* shaded, linear, premultiplied */
    float *term[TRUTH_TERMS];
    float *effects_certain; /* 1, or 0 where some ray beyond the first hit was undecided */
    bool has_view;
    mns_view view; /* resolved, where has_view */
    size_t hits, undecided;
    double ms;                  /* what tracing it took, when it was traced; NAN where it was not here */
    bool cached;                /* it came from the cache */
    char hash[TRUTH_HASH_SIZE]; /* of all that it depends on; "" without */
    char note[200];             /* why the cache could not be used; "" where it was, or was not asked for */
} truth_planes;

/* The image's plane of that term, NULL where it has none. */
const float *truth_image_term(const mns_image *image, truth_term term);

/* What a truth is made of. */
typedef struct truth_desc {
    const mns_field *field;
    const mns_view *view;   /* resolved by mns_view_resolve */
    const mns_look *look;   /* NULL: defaults */
    mns_renderer *renderer; /* draws rgba, by MNS_METHOD_REFERENCE; NULL: no rgba */
    bool use_cache;         /* look in $XDG_CACHE_HOME/meniscus/truth (~/.cache), and leave it there */
    /* NULL, or called from one thread as rows end, and at the last. */
    void (*progress)(void *context, int done, int rows);
    void *context;
    const atomic_bool *stop; /* NULL, or becomes true when the truth is no longer wanted: then USAGE, soon */
} truth_desc;

/* Traces, or finds, the truth. A cached file that does not fit in every byte is thrown away. Errors: USAGE,
 * MEMORY, what the renderer gives. */
mns_status truth_create(const truth_desc *desc, truth_planes **result, mns_error *error);
/* The truth that a saved image holds (its t.err respected): no radius, no view. Errors: MEMORY. */
mns_status truth_from_image(const mns_image *image, truth_planes **result, mns_error *error);
void truth_destroy(truth_planes *planes);

/* What a truth hangs on, as 32 hexadecimal digits: balls, kernel, level, the resolved view, its size and the
 * reference's own text; and where it has colours (`look` is not NULL) the look, with an environment's file,
 * the driver that draws them (mns_renderer_name) and the text of what shades. */
void truth_hash(const mns_field *field, const mns_view *view, const mns_look *look, const char *driver,
                char hash[TRUTH_HASH_SIZE]);
/* The balls, kernel and level alone: an input's name in results. */
void truth_hash_field(const mns_field *field, char hash[TRUTH_HASH_SIZE]);

#endif
