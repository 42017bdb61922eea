/* How far an image's planes are from the oracle's first hits, over random pixels. */
#ifndef MNS_TESTS_BRUTE_IMAGE_H
#define MNS_TESTS_BRUTE_IMAGE_H

#include "brute.h"

#include <stdint.h>

/* The ray through the centre of pixel (x, y), (0, 0) at the top left; `view` resolved. */
brute_ray brute_pixel_ray(const mns_view *view, int x, int y);

/* What was seen, over all the images taken into one tally. Rays that the image or the oracle calls undecided
 * are counted apart, and in nothing else. */
typedef struct brute_report {
    size_t rays, hits; /* drawn, and those of them that truly hit */
    size_t missed;     /* the image has no hit, the ray has one */
    size_t invented;   /* the image has a hit, the ray has none */
    size_t later;      /* another root: |t - t*| > 0.1 R, R the smallest of the balls that cover the hit */
    size_t undecided;  /* the image says `certain` 0 */
    size_t near;       /* the oracle finds an extremum too near to L to call */
    size_t compared;   /* rays that the figures below are taken over */
    double t_median, t_p99, t_p999, t_max; /* |t - t*| / t* */
    double normal_p999, normal_max;        /* degrees */
    double gap_most; /* of the wrong rays, the largest gap: 0 where none is wrong, 1 far from any extremum */
} brute_report;

typedef struct brute_tally brute_tally;

brute_tally *brute_tally_create(void);
void brute_tally_destroy(brute_tally *tally);
/* Draws `rays` pixels of the image, without replacement and six in ten of them hits while there are that
 * many, and compares. Parallel. False: out of memory. */
bool brute_tally_add(brute_tally *tally, const brute *oracle, const mns_view *view, const mns_image *image,
                     size_t rays, double tau, uint64_t seed);
/* Sorts the errors; may be called after any number of images. */
brute_report brute_tally_report(brute_tally *tally);

#endif
