/* A picture of somebody else's as linear colours: what an environment is made of. */
#ifndef MNS_IMAGE_PICTURE_H
#define MNS_IMAGE_PICTURE_H

#include "base/status.h"

typedef struct image_picture {
    int width, height;
    float *rgb; /* linear, row 0 at the top */
} image_picture;

/* Reads channels R, G and B of an .exr of scan lines, or a .png (sRGB), told by content. Errors: IO, INPUT,
 * MEMORY. */
mns_status image_picture_read(const char *path, image_picture *picture, mns_error *error);
void image_picture_free(image_picture *picture);

#endif
