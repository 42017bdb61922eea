/* Errors of an image against the truth, each defined in docs/errors.md and computed here and nowhere else. */
#ifndef MNS_COMPARE_METRICS_H
#define MNS_COMPARE_METRICS_H

#include "compare/truth.h"

enum { METRICS_WORST = 20 };

/* "Wrong root" is a distance off by more than METRICS_ROOT_RADII R_j + METRICS_ROOT_RELATIVE t*. */
#define METRICS_ROOT_RADII    0.1
#define METRICS_ROOT_RELATIVE 0x1p-20
/* A term is wrong that is off by more than METRICS_TERM: less than one ray of many; a term that is a
 * distance, one that is another surface's: by METRICS_ROOT_RADII R_j + METRICS_TERM_RELATIVE t*, or finite
 * where it should not be. */
#define METRICS_TERM          1e-4
#define METRICS_TERM_RELATIVE 0x1p-10
/* What the PSNR of equal images is given as, decibels. */
#define METRICS_PSNR_MOST 200.0

/* Of values >= 0; all NAN where there were none. */
typedef struct metrics_spread {
    double median, p99, p999, max;
    double rms; /* root of the mean square */
} metrics_spread;

/* Terms of effects, where the truth has any. */
typedef struct metrics_effects {
    bool any, has[TRUTH_TERMS];
    size_t compared;           /* pixels that both hit, decided, with effects that both are certain of */
    size_t undecided;          /* that the image calls uncertain */
    size_t wrong[TRUTH_TERMS]; /* of the compared; all where the image lacks the term */
} metrics_effects;

typedef enum metrics_kind {
    METRICS_DEPTH = 0, /* both hit, the distances differ */
    METRICS_WRONG_ROOT,
    METRICS_MISSED,  /* the truth hits, the image does not */
    METRICS_INVENTED /* the image hits, the truth does not */
} metrics_kind;

/* "depth", "wrong root", "missed", "invented". */
const char *metrics_kind_name(metrics_kind kind);

typedef struct metrics_pixel {
    int x, y; /* 0,0 is the top left */
    metrics_kind kind;
    double t, truth; /* distances, INFINITY on a miss */
    double error;    /* |t - t*| / max(t*, R_j); NAN where one of them misses */
} metrics_pixel;

/* |t - t*| stands for what of it the truth's own bound (t_error) leaves. A pixel is decided where the truth
 * is certain and the image says so of itself. */
typedef struct metrics {
    size_t pixels;
    size_t hits;                             /* of the image */
    size_t missed, invented;                 /* all */
    size_t missed_decided, invented_decided; /* decided pixels alone */
    size_t wrong_root;                       /* decided pixels that both hit */
    size_t undecided;                        /* that the image calls uncertain */
    size_t compared;          /* decided pixels that both hit: t, footprint and normal are of these */
    metrics_spread t;         /* |t - t*| / max(t*, R_j) */
    metrics_spread footprint; /* |t - t*| in pixel footprints; NAN where the view is unknown */
    metrics_spread residual;  /* |f - L| / L at every hit of the image; NAN without a reference */
    metrics_spread normal;    /* angle between the normals, degrees */
    metrics_effects effects;
    double psnr; /* decibels, METRICS_PSNR_MOST where equal; NAN where the truth has no colours */
    size_t worst_count;
    metrics_pixel worst[METRICS_WORST]; /* decided pixels, the worst first */
} metrics;

/* Measures `image` against `truth`. `reference` and its level `iso` are for the residual; NULL: none.
 * Parallel. Errors: USAGE (the sizes differ), MEMORY. */
mns_status metrics_measure(const truth_planes *truth, const mns_image *image, const mns_reference *reference,
                           double iso, metrics *result, mns_error *error);

/* Sorts `count` values in place and takes their figures. */
metrics_spread metrics_spread_of(double *value, size_t count);

/* The terms' figures alone. */
metrics_effects metrics_effects_of(const truth_planes *truth, const mns_image *image);
/* "shadow", "occlusion", "mirror", "refraction". */
const char *metrics_term_name(truth_term term);

/* What every pixel is to the hit mask: the colours of the mask picture. */
typedef enum metrics_mask {
    METRICS_MASK_NONE = 0, /* neither hits */
    METRICS_MASK_BOTH,
    METRICS_MASK_MISSED,
    METRICS_MASK_INVENTED,
    METRICS_MASK_UNDECIDED, /* by the truth or by the image, whatever they hit */
    METRICS_MASK_COUNT
} metrics_mask;

metrics_mask metrics_mask_of(const truth_planes *truth, const mns_image *image, size_t pixel);
/* Length of a pixel's side at distance t, seen along the middle of the view: t 2 tan(fov / 2) / height. */
double metrics_footprint(const mns_view *view, double t);

#endif
