/* A truth and an image of it, made by hand: for tests of comparisons. */
#ifndef MNS_TESTS_PLANES_H
#define MNS_TESTS_PLANES_H

#include "compare/truth.h"

typedef struct planes {
    truth_planes *truth;
    mns_image *image;
} planes;

/* Both miss everywhere and are certain; radii are 1, the colours white; no view. Ends the test on failure. */
planes planes_make(int width, int height);
void planes_free(planes *p);

/* Pixel `index` hits, the truth at t, the image at t + off; normals 0,0,1. */
void planes_hit(planes *p, size_t index, double t, double off);

#endif
