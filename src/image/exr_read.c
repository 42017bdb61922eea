/* Reads an EXR of scan lines: its header, its size, its rows; and whole one of ours, deflated or plain, with
 * all of our float32 channels. */
#include "base/memory.h"
#include "image/exr.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Deflate makes at most 1032 bytes of one (RFC 1951: a match of 258 bytes in 2 bits); doubled for safety. */
enum { INFLATION_MAX = 2064 };

static void on_error(exr_const_context_t context, exr_result_t result, const char *message)
{
    void *data = NULL;
    (void)result;
    if (!context || exr_get_user_data(context, &data) != EXR_ERR_SUCCESS || !data) return;
    image_stream *stream = data;
    if (!stream->message[0]) snprintf(stream->message, sizeof stream->message, "%s", message);
}

static int64_t on_read(exr_const_context_t context, void *data, void *bytes, uint64_t size, uint64_t offset,
                       exr_stream_error_func_ptr_t report)
{
    image_stream *stream = data;
    errno = 0;
    if (offset > INT64_MAX || fseeko(stream->file, (off_t)offset, SEEK_SET)) goto fail;
    size_t count = fread(bytes, 1, size, stream->file);
    if (count == size || feof(stream->file)) return (int64_t)count;
fail:
    if (!stream->code) stream->code = errno ? errno : EIO;
    report(context, EXR_ERR_READ_IO, "read failed");
    return -1;
}

static int64_t on_size(exr_const_context_t context, void *data)
{
    (void)context;
    return ((const image_stream *)data)->size;
}

static mns_status cannot_read(const char *path, int code, mns_error *error)
{
    char reason[128];
    return status_fail(error, MNS_ERROR_IO, "%s: cannot read: %s", path,
                       strerror_r(code, reason, sizeof reason));
}

mns_status image_exr_damaged(const image_reader *reader, exr_result_t result)
{
    const char *reason = reader->stream.message;
    if (reader->stream.code) return cannot_read(reader->path, reader->stream.code, reader->error);
    if (result == EXR_ERR_OUT_OF_MEMORY) return status_no_memory(reader->error, "reading an EXR");
    return status_fail(reader->error, MNS_ERROR_INPUT, "%s: not a whole EXR file: %s", reader->path,
                       *reason ? reason : exr_get_default_error_message(result));
}

/* Opens a regular file that begins as an EXR does. O_NONBLOCK, so that a pipe's name cannot hang the program.
 */
static mns_status open_file(image_reader *reader)
{
    static const unsigned char magic[4] = {0x76, 0x2f, 0x31, 0x01};
    unsigned char start[4] = {0};
    struct stat status;
    int descriptor = open(reader->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return cannot_read(reader->path, errno, reader->error);
    if (!fstat(descriptor, &status) && S_ISREG(status.st_mode))
        reader->stream.file = fdopen(descriptor, "rb");
    if (!reader->stream.file) {
        close(descriptor);
        if (S_ISDIR(status.st_mode)) return cannot_read(reader->path, EISDIR, reader->error);
        return status_fail(reader->error, MNS_ERROR_IO, "%s: cannot read: not a regular file", reader->path);
    }
    reader->stream.size = status.st_size;
    if (fread(start, 1, 4, reader->stream.file) == 4 && !memcmp(start, magic, 4)) return MNS_OK;
    return status_fail(reader->error, MNS_ERROR_INPUT,
                       "%s: not an EXR file: expected the bytes 76 2f 31 01 at its beginning", reader->path);
}

static mns_status read_header(image_reader *reader, bool strict)
{
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    int parts = 0;
    exr_storage_t storage = EXR_STORAGE_DEEP_SCANLINE;
    initializer.error_handler_fn = on_error;
    initializer.user_data = &reader->stream;
    initializer.read_fn = on_read;
    initializer.size_fn = on_size;
    initializer.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    if (strict) initializer.flags |= EXR_CONTEXT_FLAG_STRICT_HEADER;
    exr_result_t result = exr_start_read(&reader->context, reader->path, &initializer);
    if (result == EXR_ERR_SUCCESS) result = exr_get_count(reader->context, &parts);
    if (result == EXR_ERR_SUCCESS) result = exr_get_storage(reader->context, 0, &storage);
    if (result == EXR_ERR_SUCCESS) result = exr_get_compression(reader->context, 0, &reader->compression);
    if (result == EXR_ERR_SUCCESS) result = exr_get_data_window(reader->context, 0, &reader->window);
    if (result != EXR_ERR_SUCCESS) return image_exr_damaged(reader, result);
    if (parts != 1 || storage != EXR_STORAGE_SCANLINE)
        return status_fail(reader->error, MNS_ERROR_INPUT,
                           "%s: expected one part of scan lines, as meniscus writes it", reader->path);
    return MNS_OK;
}

mns_status image_exr_open(image_reader *reader, bool strict)
{
    mns_status status = open_file(reader);
    return status ? status : read_header(reader, strict);
}

void image_exr_close(image_reader *reader)
{
    if (reader->context) exr_finish(&reader->context);
    if (reader->stream.file) fclose(reader->stream.file);
}

mns_status image_exr_size(const image_reader *reader, int pixel_bytes, int *width, int *height)
{
    int64_t w = (int64_t)reader->window.max.x - reader->window.min.x + 1;
    int64_t h = (int64_t)reader->window.max.y - reader->window.min.y + 1;
    bool in_range = w >= 1 && h >= 1 && w <= IMAGE_SIDE_MAX && h <= IMAGE_SIDE_MAX;
    if (!in_range || w * h > reader->stream.size * INFLATION_MAX / pixel_bytes)
        return status_fail(reader->error, MNS_ERROR_INPUT,
                           "%s: announces %lld x %lld pixels, which its %lld bytes cannot hold", reader->path,
                           (long long)w, (long long)h, (long long)reader->stream.size);
    *width = (int)w, *height = (int)h;
    return MNS_OK;
}

const exr_attr_chlist_entry_t *image_exr_entry(const exr_attr_chlist_t *list, const char *name)
{
    for (int i = 0; i < list->num_channels; i++)
        if (!strcmp(list->entries[i].name.str, name)) return &list->entries[i];
    return NULL;
}

/* Planes for those that not every image has, where the file has them. */
static mns_status make_optional(const image_reader *reader, const exr_attr_chlist_t *list, mns_image *image)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (int i = 0; i < IMAGE_OPTIONAL; i++) {
        if (!image_exr_entry(list, image_optional_names[i])) continue;
        float **plane = image_optional(image, i);
        *plane = memory_array(pixels, sizeof **plane);
        if (!*plane) return status_no_memory(reader->error, "reading an EXR");
    }
    if (image_exr_entry(list, IMAGE_WORK)) {
        image->work = memory_array(pixels, MNS_WORK_COUNT * sizeof *image->work);
        if (!image->work) return status_no_memory(reader->error, "reading an EXR");
    }
    return MNS_OK;
}

/* Are all our channels there, as we write them? Planes are made for the optional ones that are. */
static mns_status check_channels(const image_reader *reader, mns_image *image, image_channels *channels)
{
    const exr_attr_chlist_t *list = NULL;
    exr_result_t result = exr_get_channels(reader->context, 0, &list);
    if (result != EXR_ERR_SUCCESS) return image_exr_damaged(reader, result);
    mns_status status = make_optional(reader, list, image);
    if (status) return status;
    image_list_channels(image, channels);
    for (int i = 0; i < channels->count; i++) {
        const char *name = channels->channel[i].name;
        const exr_attr_chlist_entry_t *found = image_exr_entry(list, name);
        if (!found)
            return status_fail(reader->error, MNS_ERROR_INPUT,
                               "%s: lacks the channel %s; meniscus writes it with --aov", reader->path, name);
        if (found->pixel_type != EXR_PIXEL_FLOAT || found->x_sampling != 1 || found->y_sampling != 1)
            return status_fail(reader->error, MNS_ERROR_INPUT,
                               "%s: channel %s: expected a float32 of every pixel", reader->path, name);
    }
    return MNS_OK;
}

/* Points the decoder at the rows of the image from `row` on; channels that are not ours are skipped. */
static void aim(exr_decode_pipeline_t *decoder, int width, const image_channels *channels, int row)
{
    for (int i = 0; i < decoder->channel_count; i++) {
        exr_coding_channel_info_t *coded = &decoder->channels[i];
        const image_channel *channel = image_find_channel(channels, coded->channel_name);
        if (!channel) continue;
        float *start = channel->plane + (size_t)row * (size_t)width * (size_t)channel->stride;
        coded->user_bytes_per_element = sizeof(float);
        coded->user_data_type = EXR_PIXEL_FLOAT;
        coded->user_pixel_stride = channel->stride * (int)sizeof(float);
        coded->user_line_stride = width * coded->user_pixel_stride;
        coded->decode_to_ptr = (uint8_t *)(start + channel->offset);
    }
}

mns_status image_exr_rows(const image_reader *reader, int width, int height, const image_channels *channels)
{
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_chunk_info_t chunk;
    int32_t lines = 0;
    exr_result_t result = exr_get_scanlines_per_chunk(reader->context, 0, &lines);
    for (int row = 0; row < height && result == EXR_ERR_SUCCESS; row += lines) {
        result = exr_read_scanline_chunk_info(reader->context, 0, reader->window.min.y + row, &chunk);
        if (result != EXR_ERR_SUCCESS) break;
        result = row ? exr_decoding_update(reader->context, 0, &chunk, &decoder)
                     : exr_decoding_initialize(reader->context, 0, &chunk, &decoder);
        if (result != EXR_ERR_SUCCESS) break;
        aim(&decoder, width, channels, row);
        if (!row) result = exr_decoding_choose_default_routines(reader->context, 0, &decoder);
        if (result == EXR_ERR_SUCCESS) result = exr_decoding_run(reader->context, 0, &decoder);
    }
    exr_decoding_destroy(reader->context, &decoder);
    return result == EXR_ERR_SUCCESS ? MNS_OK : image_exr_damaged(reader, result);
}

static mns_status read_image(image_reader *reader, mns_image **image)
{
    enum { PIXEL_BYTES = 10 * (int)sizeof(float) };
    image_channels channels;
    int width = 0, height = 0;
    mns_image *made = NULL;
    mns_status status = image_exr_open(reader, true);
    if (status == MNS_OK && reader->compression > EXR_COMPRESSION_ZIP) /* none, RLE, ZIPS, ZIP */
        status = status_fail(reader->error, MNS_ERROR_INPUT,
                             "%s: compressed by OpenEXR's method %d; expected ZIP, as meniscus writes it",
                             reader->path, (int)reader->compression);
    if (status == MNS_OK) status = image_exr_size(reader, PIXEL_BYTES, &width, &height);
    if (status == MNS_OK) status = image_create(width, height, &made, reader->error);
    if (status == MNS_OK) status = check_channels(reader, made, &channels);
    if (status == MNS_OK) status = image_exr_rows(reader, width, height, &channels);
    if (status == MNS_OK)
        *image = made;
    else
        mns_image_destroy(made);
    return status;
}

mns_status mns_image_read(const char *path, mns_image **image, mns_error *error)
{
    if (!path || !image)
        return status_fail(error, MNS_ERROR_USAGE, "image: no name to read, or nowhere to put it");
    image_reader reader = {.path = path, .error = error};
    mns_status status = read_image(&reader, image);
    image_exr_close(&reader);
    return status;
}
