#include "app/info.h"

#include "app/app.h"
#include "app/options.h"

#include <stdio.h>
#include <stdlib.h>

static mns_status option_gl(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)text, (void)error;
    o->gl = true;
    return MNS_OK;
}

static mns_status option_json(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)text, (void)error;
    o->json = true;
    return MNS_OK;
}

static const option_row ROWS[] = {
    {NULL, 0, NULL, "What to print:", NULL},
    {"gl", 0, NULL, "what each OpenGL back end offers here, or why it cannot start", option_gl},
    {"json", 0, NULL, "as JSON", option_json},
    {"frame", 0, "A", "the frame of the input, from 0 (default 0)", option_frame},
    OPTIONS_OF_FIELD,
};

static const option_table INFO_OPTIONS = {
    .command = "info",
    .arguments = "INPUT...\n--gl",
    .doc = "Says what INPUT holds: count, box, radii, strengths, frames, columns, and the rows that were "
           "skipped and "
           "why.",
    .rows = ROWS,
    .count = sizeof ROWS / sizeof *ROWS,
};

static mns_status print_backends(const app_options *o, mns_error *error)
{
    if (o->input_count || o->json)
        return app_fail(error, MNS_ERROR_USAGE, "--gl: expected no input and no --json beside it");
    char *text = mns_backend_describe(MNS_BACKEND_AUTO);
    if (!text) return app_fail(error, MNS_ERROR_MEMORY, "out of memory describing the back ends");
    puts(text);
    free(text);
    return MNS_OK;
}

static mns_status print_json(const app_options *o, const mns_field *field, size_t frame, size_t frames,
                             mns_error *error)
{
    json_t *object = info_json(field, frame, frames);
    if (!object) return app_fail(error, MNS_ERROR_MEMORY, "out of memory describing the input");
    mns_status status = o->look.mesh_count ? info_add_meshes(object, &o->look, error) : MNS_OK;
    if (!status) {
        json_dumpf(object, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
        putchar('\n');
    }
    json_decref(object);
    return status;
}

static mns_status describe(const app_options *o, mns_input *input, mns_error *error)
{
    mns_field *field;
    size_t frame = o->frames.given ? (size_t)o->frames.first : 0, frames = mns_input_frames(input);
    if (frame >= frames || o->frames.last > o->frames.first)
        return app_fail(error, MNS_ERROR_USAGE,
                        "--frame: expected one frame below %zu, the number in the input", frames);
    mns_status status = mns_input_read(input, frame, &field, error);
    if (status) return status;
    if (o->json)
        status = print_json(o, field, frame, frames, error);
    else
        info_print(field, frame, frames);
    if (!status && !o->json) status = info_print_meshes(&o->look, error);
    mns_field_destroy(field);
    return status;
}

static mns_status info(const app_options *o, mns_error *error)
{
    if (o->gl) return print_backends(o, error);
    if (o->input_count == 0)
        return app_fail(
            error, MNS_ERROR_USAGE,
            "no input: expected a particle file, a scene, or a generator such as tornado:4000; or --gl");
    mns_input *input = NULL;
    mns_status status = mns_input_open(o->inputs, o->input_count, &o->field, &input, error);
    if (!status) status = describe(o, input, error);
    mns_input_close(input);
    return status;
}

int app_info(int argc, char **argv)
{
    app_options o;
    mns_error error;
    mns_status status = options_read(&INFO_OPTIONS, argc, argv, &o, &error);
    if (!status && !o.help) status = info(&o, &error);
    options_free(&o);
    return status ? app_report(&error) : APP_DONE;
}
