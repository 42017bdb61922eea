/* What the writer and the reader of EXR files share: the channels, and the library's errors kept from
 * standard error. */
#ifndef MNS_IMAGE_EXR_H
#define MNS_IMAGE_EXR_H

#include "image/image.h"

#include <OpenEXR/openexr.h>

enum { IMAGE_CHANNELS_MOST = 24 };

/* One channel of the file, and where its value lies in an image: in `plane`, `stride` floats a pixel, from
 * `offset`. */
typedef struct image_channel {
    const char *name;
    float *plane; /* optional ones only where there is one */
    int stride, offset;
} image_channel;

typedef struct image_channels {
    int count;
    image_channel channel[IMAGE_CHANNELS_MOST];
} image_channels;

/* Planes that not every image has; and the first of the counts of a ray's work, which come together. */
#define IMAGE_WORK "work.balls"
enum { IMAGE_OPTIONAL = 7 };
extern const char *const image_optional_names[IMAGE_OPTIONAL];
/* Where an image keeps optional plane `index`. */
float **image_optional(mns_image *image, int index);

/* The channels of an image: those that every one has, and those of its optional planes that are there. */
void image_list_channels(const mns_image *image, image_channels *channels);
/* The channel of that name, NULL where there is none. */
const image_channel *image_find_channel(const image_channels *channels, const char *name);

/* What OpenEXR's call-backs share with their caller. */
typedef struct image_stream {
    FILE *file;
    int64_t size;      /* bytes, of a file that is read */
    int code;          /* errno of the first failed read or write, 0 while there was none */
    char message[200]; /* the first thing that OpenEXR complained of in reading, "" while it did not */
} image_stream;

/* An EXR being read; zeroed but for path and error. */
typedef struct image_reader {
    const char *path;
    image_stream stream;
    exr_context_t context;
    exr_attr_box2i_t window;
    exr_compression_t compression;
    mns_error *error;
} image_reader;

/* Opens a file that begins as an EXR does, of one part of scan lines. End with image_exr_close, also after a
 * failure. Errors: IO, INPUT, MEMORY. */
mns_status image_exr_open(image_reader *reader, bool strict);
void image_exr_close(image_reader *reader);
/* The error for what OpenEXR says of the file. */
mns_status image_exr_damaged(const image_reader *reader, exr_result_t result);
/* The header's size, believed only where the file's own length can hold that many pixels, each of so many
 * bytes at least. */
mns_status image_exr_size(const image_reader *reader, int pixel_bytes, int *width, int *height);
/* NULL where the file has no channel of that name. */
const exr_attr_chlist_entry_t *image_exr_entry(const exr_attr_chlist_t *list, const char *name);
/* Reads the channels' rows, as floats; others are skipped. */
mns_status image_exr_rows(const image_reader *reader, int width, int height, const image_channels *channels);

#endif
