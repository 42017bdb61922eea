/* What the writer and the reader of EXR files share: the channels, and the library's errors kept from
 * standard error. */
#ifndef MNS_IMAGE_EXR_H
#define MNS_IMAGE_EXR_H

#include "image/image.h"

#include <OpenEXR/openexr.h>

enum { IMAGE_CHANNELS = 11, IMAGE_WORK_CHANNELS = MNS_WORK_COUNT }; /* at most */

/* One channel of the file, and where its value lies in an image: in `plane`, `stride` floats a pixel, from
 * `offset`. */
typedef struct image_channel {
    const char *name;
    float *plane;
    int stride, offset;
} image_channel;

typedef struct image_channels {
    int count;
    image_channel channel[IMAGE_CHANNELS + IMAGE_WORK_CHANNELS];
} image_channels;

/* The one channel that not every image has: the bound on the error of t. */
#define IMAGE_ERROR_CHANNEL "t.err"

/* The channels of an image, in the order of their names as an EXR file has them; with `has_error` its t_error
 * too, and with counts of work these. */
void image_list_channels(const mns_image *image, bool has_error, image_channels *channels);
/* The channel of that name, NULL where there is none. */
const image_channel *image_find_channel(const image_channels *channels, const char *name);

/* What OpenEXR's call-backs share with their caller. */
typedef struct image_stream {
    FILE *file;
    int64_t size;      /* bytes, of a file that is read */
    int code;          /* errno of the first failed read or write, 0 while there was none */
    char message[200]; /* the first thing that OpenEXR complained of in reading, "" while it did not */
} image_stream;

#endif
