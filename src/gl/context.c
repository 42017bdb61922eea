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

void context_release_thread(void)
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
    mns_status status = status_fail(error, MNS_ERROR_GL, "no device");
    int count = context_egl_device_count();
    for (int device = 0; device < count; device++) {
        mns_error one = {0};
        if (want_hardware && context_egl_device_is_software(device)) continue;
        status = context_egl_device_open(context, device, &one);
        if (status == MNS_OK && want_hardware && context_renderer_is_software(current_renderer(context))) {
            close_context(context);
            status = status_fail(&one, MNS_ERROR_GL, "a software renderer");
        }
        if (status == MNS_OK) return MNS_OK;
        status_fail(error, status, "device %d: %s", device, one.text);
    }
    return status;
}

/* With a vendor's driver beside Mesa, surfaceless can end on the software renderer of a machine that has a
 * GPU: then `context` becomes one on the GPU's device, if that works. Either way it is current afterwards. */
static mns_status prefer_hardware(mns_context *context, mns_error *error)
{
    mns_context hardware = {0};
    if (!context_renderer_is_software(current_renderer(context))) return MNS_OK;
    if (open_device(&hardware, true, NULL) == MNS_OK) {
        close_context(context);
        *context = hardware;
    }
    context_release_thread();
    mns_status status = context->backend.make_current(context, error);
    if (status != MNS_OK) close_context(context);
    return status;
}

/* Surfaceless; a device where that fails. */
static mns_status open_egl(mns_context *context, mns_error *error)
{
    mns_error surfaceless = {0}, device = {0};
    mns_status status = context_egl_surfaceless_open(context, &surfaceless);
    if (status == MNS_OK) return prefer_hardware(context, error);
    if (status == MNS_ERROR_UNSUPPORTED) return status_fail(error, status, "%s", surfaceless.text);
    if (open_device(context, false, &device) == MNS_OK) return MNS_OK;
    return status_fail(error, MNS_ERROR_GL, "surfaceless: %s; %s", surfaceless.text, device.text);
}

static const struct {
    mns_backend kind;
    const char *name;
    int share; /* characters of AUTO's error, so that a long reason never hides a later one; in all below its
                  size */
    mns_status (*open)(mns_context *context, mns_error *error);
} backends[] = {
    /* in AUTO's order */
    {MNS_BACKEND_EGL, "EGL", 200, open_egl},
    {MNS_BACKEND_OSMESA, "OSMesa", 115, context_osmesa_open},
    {MNS_BACKEND_GLFW, "GLFW", 100, context_glfw_open},
};
enum { BACKEND_COUNT = sizeof backends / sizeof *backends };

static mns_status open_any(mns_context *context, mns_error *error)
{
    char text[sizeof error->text] = "";
    for (size_t i = 0, used = 0; i < BACKEND_COUNT; i++) {
        mns_error one = {0};
        if (backends[i].open(context, &one) == MNS_OK) return MNS_OK;
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s: %.*s", i ? "; " : "",
                                 backends[i].name, backends[i].share, one.text);
    }
    return status_fail(error, MNS_ERROR_GL, "no OpenGL 4.3 context: %s", text);
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
    if (!context) return status_fail(error, MNS_ERROR_USAGE, "GL context: nowhere to put it");
    mns_context *made = calloc(1, sizeof *made);
    if (!made) return status_no_memory(error, "making a GL context");
    context_release_thread();
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
    if (!context) return status_fail(error, MNS_ERROR_USAGE, "GL context: NULL cannot be made current");
    context_release_thread();
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
