/* Makes a context by name or by trial, and hides which back end it came from. */
#include "gl/context.h"

#include <glad/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool context_renderer_is_software(const char *renderer)
{
    static const char *const software[] = {"llvmpipe", "softpipe", "swr", "SWR", "Software Rasterizer"};
    for (size_t i = 0; i < sizeof software / sizeof *software; i++)
        if (strstr(renderer, software[i])) return true;
    return false;
}

static void release_thread(void)
{
    context_glfw_release();
    context_osmesa_release();
    context_egl_release();
}

/* The GL_RENDERER of a context that is current, "" where it gives none. */
static const char *current_renderer(const mns_context *context)
{
    PFNGLGETSTRINGPROC get_string = (PFNGLGETSTRINGPROC)context->backend.get_proc("glGetString");
    const char *renderer = get_string ? (const char *)get_string(GL_RENDERER) : NULL;
    return renderer ? renderer : "";
}

static void close_context(mns_context *context)
{
    if (context->backend.destroy) context->backend.destroy(context);
    *context = (mns_context){0};
}

/* The first device on which a context can be made; of them, where `want_hardware`, only those that are no
 * software. */
static mns_status open_device(mns_context *context, bool want_hardware, mns_error *error)
{
    int count = context_egl_device_count(), tried = 0;
    mns_error last = {0};
    for (int device = 0; device < count; device++) {
        if (want_hardware && context_egl_device_is_software(device)) continue;
        tried++;
        if (context_egl_device_open(context, device, &last) != MNS_OK) continue;
        if (!want_hardware || !context_renderer_is_software(current_renderer(context))) return MNS_OK;
        close_context(context);
        last.text[0] = 0;
    }
    if (!tried || !last.text[0]) return status_fail(error, MNS_ERROR_GL, "no EGL device");
    return status_fail(error, MNS_ERROR_GL, "%d EGL devices, of the last: %s", tried, last.text);
}

/* Surfaceless; a device where that fails. With a vendor's driver beside Mesa, surfaceless can end on the
 * software rasteriser of a machine that has a GPU: then the GPU's device is taken instead, if it works. */
static mns_status open_egl(mns_context *context, mns_error *error)
{
    mns_error surfaceless = {0}, device = {0};
    mns_status status = context_egl_surfaceless_open(context, &surfaceless);
    if (status == MNS_OK) {
        mns_context hardware = {0};
        if (!context_renderer_is_software(current_renderer(context))) return MNS_OK;
        if (open_device(&hardware, true, NULL) == MNS_OK) {
            close_context(context);
            *context = hardware;
        }
        release_thread();
        return context->backend.make_current(context, error);
    }
    if (status == MNS_ERROR_UNSUPPORTED) return status_fail(error, status, "%s", surfaceless.text);
    if (open_device(context, false, &device) == MNS_OK) return MNS_OK;
    return status_fail(error, MNS_ERROR_GL, "surfaceless: %s; device: %s", surfaceless.text, device.text);
}

static const struct {
    mns_backend kind;
    const char *name;
    mns_status (*open)(mns_context *context, mns_error *error);
} backends[] = {
    /* in AUTO's order */
    {MNS_BACKEND_EGL, "EGL", open_egl},
    {MNS_BACKEND_OSMESA, "OSMesa", context_osmesa_open},
    {MNS_BACKEND_GLFW, "GLFW", context_glfw_open},
};
enum { BACKEND_COUNT = sizeof backends / sizeof *backends };

static mns_status open_any(mns_context *context, mns_error *error)
{
    char tried[sizeof error->text] = "";
    size_t used = 0;
    for (size_t i = 0; i < BACKEND_COUNT; i++) {
        mns_error one = {0};
        if (backends[i].open(context, &one) == MNS_OK) return MNS_OK;
        /* an equal share of the line for each, so that a long reason never hides a later back end's */
        int written = snprintf(tried + used, sizeof tried - used, "%s%s: %.135s", i ? "; " : "",
                               backends[i].name, one.text);
        if (written > 0 && (size_t)written < sizeof tried - used) used += (size_t)written;
    }
    return status_fail(error, MNS_ERROR_GL, "no OpenGL 4.3 context: %s", tried);
}

static mns_status open_one(mns_backend kind, mns_context *context, mns_error *error)
{
    if (kind == MNS_BACKEND_AUTO) return open_any(context, error);
    for (size_t i = 0; i < BACKEND_COUNT; i++) {
        if (backends[i].kind != kind) continue;
        mns_error one = {0};
        mns_status status = backends[i].open(context, &one);
        return status == MNS_OK ? MNS_OK : status_fail(error, status, "%s: %s", backends[i].name, one.text);
    }
    return status_fail(error, MNS_ERROR_USAGE, "no back end has the number %d", (int)kind);
}

mns_status mns_context_create(mns_backend backend, mns_context **context, mns_error *error)
{
    mns_context *made = calloc(1, sizeof *made);
    if (!made) return status_no_memory(error, "making a GL context");
    release_thread();
    mns_status status = open_one(backend, made, error);
    if (status != MNS_OK) {
        free(made);
        return status;
    }
    *context = made;
    return MNS_OK;
}

void mns_context_destroy(mns_context *context)
{
    if (!context) return;
    close_context(context);
    free(context);
}

mns_status mns_context_make_current(mns_context *context, mns_error *error)
{
    release_thread();
    return context->backend.make_current(context, error);
}

mns_get_proc mns_context_get_proc(const mns_context *context)
{
    return context->backend.get_proc;
}

const char *mns_context_name(const mns_context *context)
{
    return context->name;
}
