/* What the writer and the reader of EXR files share: the channels, and the library's errors kept from
 * standard error. */
#ifndef MNS_IMAGE_EXR_H
#define MNS_IMAGE_EXR_H

#include "image/image.h"

#include <OpenEXR/openexr.h>

enum { IMAGE_CHANNELS = 10 };

/* One channel of the file, and where its value lies in an image: in `plane`, `stride` floats a pixel, from
 * `offset`. */
typedef struct image_channel {
    const char *name;
    float *plane;
    int stride, offset;
} image_channel;

/* The channels of an image, in the order of their names as an EXR file has them. */
void image_list_channels(const mns_image *image, image_channel channels[IMAGE_CHANNELS]);
/* The channel of that name, NULL where there is none. */
const image_channel *image_find_channel(const image_channel channels[IMAGE_CHANNELS], const char *name);

/* What OpenEXR's call-backs share with their caller. */
typedef struct image_stream {
    FILE *file;
    int64_t size;      /* bytes, of a file that is read */
    int code;          /* errno of the first failed read or write, 0 while there was none */
    char message[200]; /* the first thing that OpenEXR complained of in reading, "" while it did not */
} image_stream;

#endif
