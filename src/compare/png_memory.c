#include "compare/png_memory.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

mns_status png_encode(const unsigned char *rgb, int width, int height, unsigned char **png, size_t *size,
                      mns_error *error)
{
    png_image about = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)width,
                       .height = (png_uint_32)height,
                       .format = PNG_FORMAT_RGB};
    png_alloc_size_t bytes = 0;
    unsigned char *made = NULL;
    if (!png_image_write_get_memory_size(about, bytes, 0, rgb, 0, NULL)) goto fail;
    made = malloc(bytes);
    if (!made || !png_image_write_to_memory(&about, made, &bytes, 0, rgb, 0, NULL)) goto fail;
    png_image_free(&about);
    *png = made;
    *size = bytes;
    return MNS_OK;
fail:
    png_image_free(&about);
    free(made);
    return status_no_memory(error, "making a PNG");
}
