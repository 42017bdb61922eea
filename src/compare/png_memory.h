/* PNG files in memory. */
#ifndef MNS_COMPARE_PNG_MEMORY_H
#define MNS_COMPARE_PNG_MEMORY_H

#include "base/status.h"

/* Encodes 8-bit sRGB rows, the top first, three bytes a pixel. *png is for free. Errors: MEMORY. */
mns_status png_encode(const unsigned char *rgb, int width, int height, unsigned char **png, size_t *size,
                      mns_error *error);

#endif
