/* Writes an image as OpenEXR: one part of scan lines, float32, ZIP. */
#include "image/exr.h"
#include "image/output.h"

#include <errno.h>

/* Without a handler OpenEXR prints. This one can learn nothing: while it writes, OpenEXR 3.1 calls it with
 * its own lock held, and exr_get_user_data would wait for that lock for ever. */
static void on_error(exr_const_context_t context, exr_result_t result, const char *message)
{
    (void)context, (void)result, (void)message;
}

static int64_t on_write(exr_const_context_t context, void *data, const void *bytes, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t report)
{
    image_stream *stream = data;
    errno = 0;
    if (!fseeko(stream->file, (off_t)offset, SEEK_SET) && fwrite(bytes, 1, size, stream->file) == size)
        return (int64_t)size;
    if (!stream->code) stream->code = errno ? errno : EIO;
    report(context, EXR_ERR_WRITE_IO, "write failed");
    return -1;
}

static exr_result_t write_header(exr_context_t context, const mns_image *image,
                                 const image_channels *channels)
{
    int part = 0;
    exr_result_t result = exr_add_part(context, "meniscus", EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr_simple(context, part, image->width, image->height,
                                                     EXR_COMPRESSION_ZIP);
    for (int i = 0; i < channels->count && result == EXR_ERR_SUCCESS; i++)
        result = exr_add_channel(context, part, channels->channel[i].name, EXR_PIXEL_FLOAT,
                                 EXR_PERCEPTUALLY_LINEAR, 1, 1);
    if (result == EXR_ERR_SUCCESS) result = exr_write_header(context);
    return result;
}

/* Points the encoder at the rows from y on. */
static void aim(exr_encode_pipeline_t *encoder, const mns_image *image, const image_channels *channels, int y)
{
    for (int i = 0; i < encoder->channel_count; i++) {
        exr_coding_channel_info_t *coded = &encoder->channels[i];
        const image_channel *channel = image_find_channel(channels, coded->channel_name);
        const float *row = channel->plane + (size_t)y * (size_t)image->width * (size_t)channel->stride;
        coded->user_bytes_per_element = sizeof(float);
        coded->user_data_type = EXR_PIXEL_FLOAT;
        coded->user_pixel_stride = channel->stride * (int)sizeof(float);
        coded->user_line_stride = image->width * coded->user_pixel_stride;
        coded->encode_from_ptr = (const uint8_t *)(row + channel->offset);
    }
}

static exr_result_t write_rows(exr_context_t context, const mns_image *image, const image_channels *channels)
{
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_chunk_info_t chunk;
    int32_t lines = 0;
    exr_result_t result = exr_get_scanlines_per_chunk(context, 0, &lines);
    for (int y = 0; y < image->height && result == EXR_ERR_SUCCESS; y += lines) {
        result = exr_write_scanline_chunk_info(context, 0, y, &chunk);
        if (result != EXR_ERR_SUCCESS) break;
        result = y ? exr_encoding_update(context, 0, &chunk, &encoder)
                   : exr_encoding_initialize(context, 0, &chunk, &encoder);
        if (result != EXR_ERR_SUCCESS) break;
        aim(&encoder, image, channels, y);
        if (!y) result = exr_encoding_choose_default_routines(context, 0, &encoder);
        if (result == EXR_ERR_SUCCESS) result = exr_encoding_run(context, 0, &encoder);
    }
    exr_encoding_destroy(context, &encoder);
    return result;
}

mns_status image_write_exr(const mns_image *image, FILE *file, const char *path, mns_error *error)
{
    image_stream stream = {.file = file};
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    image_channels channels;
    exr_context_t context = NULL;
    initializer.error_handler_fn = on_error;
    initializer.user_data = &stream;
    initializer.write_fn = on_write;
    image_list_channels(image, &channels);
    exr_result_t result = exr_start_write(&context, path, EXR_WRITE_FILE_DIRECTLY, &initializer);
    if (result == EXR_ERR_SUCCESS) result = write_header(context, image, &channels);
    if (result == EXR_ERR_SUCCESS) result = write_rows(context, image, &channels);
    exr_result_t finished = context ? exr_finish(&context) : EXR_ERR_SUCCESS; /* writes the table of chunks */
    if (result == EXR_ERR_SUCCESS) result = finished;

    if (stream.code) return output_failed(path, stream.code, error);
    if (result == EXR_ERR_SUCCESS) return MNS_OK;
    if (result == EXR_ERR_OUT_OF_MEMORY) return status_no_memory(error, "writing an EXR");
    return status_fail(error, MNS_ERROR_IO, "%s: cannot write: OpenEXR: %s", path,
                       exr_get_default_error_message(result));
}
