/* The public input: files and their frames as one sequence, or a generator. One file is open at a time. */
#include "base/memory.h"
#include "base/status.h"
#include "load/format.h"
#include "load/generate.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct source {
    char *path;
    const load_format *format;
} source;

typedef struct input_frame {
    size_t source;
    load_place place;
} input_frame;

struct mns_input {
    mns_input_options options;
    generate_spec generator; /* shape NULL: files */
    source *source;
    size_t source_count;
    input_frame *frame;
    size_t frame_count;
    load_stream stream; /* of source `open`, if open < source_count */
    size_t open;
};

static mns_status open_source(mns_input *input, size_t index, mns_error *error)
{
    if (input->open == index) {
        input->stream.error = error;
        return MNS_OK;
    }
    stream_close(&input->stream);
    input->open = SIZE_MAX;
    mns_status status = stream_open(&input->stream, input->source[index].path, error);
    if (status)
        stream_close(&input->stream);
    else
        input->open = index;
    return status;
}

static mns_status add_frames(mns_input *input, size_t index, const load_frames *found, mns_error *error)
{
    input_frame *grown = found->count <= SIZE_MAX - input->frame_count
                             ? memory_resize(input->frame, input->frame_count + found->count, sizeof *grown)
                             : NULL;
    if (!grown) return status_no_memory(error, "finding frames");
    input->frame = grown;
    for (size_t i = 0; i < found->count; i++)
        input->frame[input->frame_count++] = (input_frame){index, found->place[i]};
    return MNS_OK;
}

/* Opens the next file, tells its format and finds its frames. */
static mns_status add_file(mns_input *input, const char *path, mns_error *error)
{
    size_t index = input->source_count;
    load_frames found = {0};
    input->source[index].path = strdup(path);
    if (!input->source[index].path) return status_no_memory(error, "opening files");
    input->source_count++;
    mns_status status = open_source(input, index, error);
    if (status) return status;
    load_stream *s = &input->stream;
    const load_format *format = input->source[index].format = format_find(s, path);
    if (!format) return s->status;
    const load_place start = stream_place(s);
    s->error = NULL; /* what a scan does not understand, reading will tell */
    bool is_fine = !format->scan || format->scan(s, &found);
    if (is_fine && !found.count) is_fine = frames_add(&found, start);
    status = is_fine ? add_frames(input, index, &found, error) : status_no_memory(error, "finding frames");
    free(found.place);
    return status;
}

static mns_status add_generator(mns_input *input, const char *text, size_t count, mns_error *error)
{
    if (count > 1)
        return status_fail(error, MNS_ERROR_USAGE,
                           "'%.80s' is a generator among several inputs; expected it alone", text);
    mns_status status = generate_parse(text, &input->generator, error);
    if (!status) input->frame_count = input->generator.frames;
    return status;
}

static mns_status add_name(mns_input *input, const char *name, size_t count, mns_error *error)
{
    if (!name || !*name)
        return status_fail(error, MNS_ERROR_USAGE, "an input has no name; expected a file or generator");
    if (access(name, F_OK) != 0) {
        if (generate_is_spec(name)) return add_generator(input, name, count, error);
        if (generate_is_name(name))
            return status_fail(error, MNS_ERROR_USAGE,
                               "'%s' is a generator without a count; expected %s:count", name, name);
    }
    return add_file(input, name, error);
}

mns_status mns_input_open(const char *const *names, size_t count, const mns_input_options *options,
                          mns_input **input, mns_error *error)
{
    if (!input) return status_fail(error, MNS_ERROR_USAGE, "input: nowhere to put it");
    if (!count || !names)
        return status_fail(error, MNS_ERROR_USAGE, "no input is named; expected a file or a generator");
    mns_input *made = calloc(1, sizeof *made);
    if (!made) return status_no_memory(error, "opening files");
    mns_status status = MNS_OK;
    made->open = SIZE_MAX;
    if (options) made->options = *options;
    made->source = count <= SIZE_MAX / sizeof *made->source ? calloc(count, sizeof *made->source) : NULL;
    if (!made->source) status = status_no_memory(error, "opening files");
    for (size_t i = 0; !status && i < count; i++) status = add_name(made, names[i], count, error);
    if (status) goto fail;
    *input = made;
    return MNS_OK;
fail:
    mns_input_close(made);
    return status;
}

void mns_input_close(mns_input *input)
{
    if (!input) return;
    stream_close(&input->stream);
    for (size_t i = 0; i < input->source_count; i++) free(input->source[i].path);
    free(input->source);
    free(input->frame);
    free(input);
}

size_t mns_input_frames(const mns_input *input)
{
    return input->frame_count;
}

/* A failure that names no file yet gets the file's name in front. */
static mns_status name_failure(const mns_input *input, mns_status status, mns_error *error)
{
    if (!error || status != MNS_ERROR_UNSUPPORTED) return status;
    mns_error inner = *error;
    return status_fail(error, status, "%s: %s", input->stream.name, inner.text);
}

static mns_status read_file(mns_input *input, size_t index, mns_field **field, mns_error *error)
{
    particles p = {0};
    const input_frame *frame = &input->frame[index];
    const load_format *format = input->source[frame->source].format;
    mns_status status = open_source(input, frame->source, error);
    if (status) return status;
    status = stream_seek(&input->stream, frame->place);
    if (!status) status = format->read(&input->stream, &p);
    input->stream.error = NULL; /* the caller's, not to be kept */
    if (!status) {
        p.format = format->name;
        status = field_from_particles(&p, &input->options, format->radius_source, field, error);
        if (status) status = name_failure(input, status, error);
    }
    if (status) particles_free(&p);
    return status;
}

static mns_status read_generator(mns_input *input, size_t index, mns_field **field, mns_error *error)
{
    particles p = {0};
    mns_status status = generate_make(&input->generator, index, &p, error);
    const char *radii = p.radius_is_surface ? "van der Waals" : "generator";
    if (!status) status = field_from_particles(&p, &input->options, radii, field, error);
    if (status) particles_free(&p);
    return status;
}

mns_status mns_input_read(mns_input *input, size_t frame, mns_field **field, mns_error *error)
{
    if (!input || !field)
        return status_fail(error, MNS_ERROR_USAGE, "input: none to read, or nowhere to put it");
    if (frame >= input->frame_count)
        return status_fail(error, MNS_ERROR_USAGE, "there is no frame %zu; the input has %zu, counted from 0",
                           frame, input->frame_count);
    if (input->generator.shape) return read_generator(input, frame, field, error);
    return read_file(input, frame, field, error);
}
