#include "base/status.h"
#include "gl/reload.h"
#include "render/render.h"

#include <stdlib.h>

mns_status mns_renderer_create(mns_get_proc get_proc, mns_renderer **renderer, mns_error *error)
{
    if (!renderer) return status_fail(error, MNS_ERROR_USAGE, "renderer: nowhere to put it");
    mns_renderer *r = calloc(1, sizeof *r);
    if (!r) return status_no_memory(error, "while making a renderer");
    mns_status status = gl_device_open(&r->device, get_proc, error);
    if (status) {
        free(r);
        return status;
    }
    char folder[STORE_PATH];
    gl_binaries_open(&r->device, &r->programs.binaries, store_folder("programs", folder) ? folder : NULL);
    *renderer = r;
    return MNS_OK;
}

void mns_renderer_keep_programs(mns_renderer *renderer, const char *folder)
{
    gl_binaries_open(&renderer->device, &renderer->programs.binaries, folder);
}

mns_status mns_renderer_read_shaders(mns_renderer *r, const char *folder, mns_error *error)
{
    glsl_text *texts;
    if (!r || !folder) return status_fail(error, MNS_ERROR_USAGE, "shaders: renderer or folder is NULL");
    mns_status status = glsl_texts_read(folder, &texts, error);
    if (status) return status;
    status = gl_programs_reload(&r->device, &r->programs, texts, error);
    if (status) glsl_texts_free(texts);
    return status;
}

void mns_renderer_destroy(mns_renderer *r)
{
    if (!r) return;
    list_passes_free(&r->passes, &r->device);
    list_order_free(&r->order);
    trace_worker_free(&r->worker);
    trace_passes_free(&r->trace, &r->device);
    tile_bins_free(&r->bins);
    gl_buffer_free(&r->device, &r->shade);
    shade_effects_free(&r->effects, &r->device);
    solid_files_free(&r->solids);
    gl_programs_free(&r->device, &r->programs);
    gl_device_close(&r->device);
    free(r);
}

const mns_limits *mns_renderer_limits(const mns_renderer *renderer)
{
    return &renderer->device.limits;
}

const char *mns_renderer_name(const mns_renderer *renderer)
{
    return renderer->device.name;
}

size_t mns_renderer_messages(const mns_renderer *renderer, const char **last)
{
    if (last) *last = renderer->device.last_message;
    return renderer->device.messages;
}

const char *mns_phase_name(mns_phase phase)
{
    static const char *const names[MNS_PHASE_COUNT] = {"sort",   "bin",     "upload", "core_depth",
                                                       "gather", "build",   "cast",   "normal",
                                                       "trace",  "effects", "shade",  "readback"};
    return (unsigned)phase < MNS_PHASE_COUNT ? names[phase] : NULL;
}
