/* Two saved images, one of them the truth: the engine of image regression tests. */
#ifndef MNS_COMPARE_IMAGES_H
#define MNS_COMPARE_IMAGES_H

#include "compare/metrics.h"

typedef struct images_tolerance {
    double t;      /* largest |t - t*| / t* */
    double normal; /* largest angle, degrees */
    size_t mask;   /* pixels of images_mask_errors; wrong terms of effects */
} images_tolerance;

#define IMAGES_TOLERANCE_T      1e-5
#define IMAGES_TOLERANCE_NORMAL 0.5

/* Pixels that miss or invent a hit, or that the image leaves undecided where the truth is certain. */
size_t images_mask_errors(const truth_planes *truth, const mns_image *image, const metrics *m);
/* Is the image within the tolerances? Where not, `why` gets the first reason, with the worst pixel. */
bool images_judge(const images_tolerance *tolerance, size_t mask_errors, const metrics *m, char *why,
                  size_t size);

#endif
