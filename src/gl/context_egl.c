/* Contexts with no surface by EGL: on Mesa's surfaceless platform, or on a device that EGL lists. */
#include "gl/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct egl_state {
    EGLDisplay display; /* shared by all contexts on it, and with the host: never terminated */
    EGLContext context;
} egl_state;

static bool has_extension(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || !at[length])) return true;
    return false;
}

static bool client_has(const char *name)
{
    return has_extension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), name);
}

static const char *error_name(EGLint code)
{
    switch (code) {
    case EGL_SUCCESS:
        return "no reason given";
    case EGL_NOT_INITIALIZED:
        return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
        return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
        return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
        return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
        return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
        return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY:
        return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
        return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
        return "EGL_BAD_PARAMETER";
    case EGL_CONTEXT_LOST:
        return "EGL_CONTEXT_LOST";
    default:
        return "an unknown EGL error";
    }
}

static mns_status driver_failed(mns_error *error, const char *call)
{
    return status_fail(error, MNS_ERROR_GL, "driver failed: %s: %s", call, error_name(eglGetError()));
}

static mns_status make_current(mns_context *context, mns_error *error)
{
    const egl_state *state = context->state;
    if (!eglBindAPI(EGL_OPENGL_API)) return driver_failed(error, "eglBindAPI");
    if (!eglMakeCurrent(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->context))
        return driver_failed(error, "eglMakeCurrent");
    return MNS_OK;
}

static void destroy(mns_context *context)
{
    egl_state *state = context->state;
    if (eglGetCurrentContext() == state->context) context_egl_release();
    eglDestroyContext(state->display, state->context);
    free(state);
}

void context_egl_release(void)
{
    EGLDisplay display = eglGetCurrentDisplay();
    if (display != EGL_NO_DISPLAY) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

/* A config is asked for only where the display cannot do without one. */
static EGLConfig find_config(EGLDisplay display)
{
    static const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                    EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    if (has_extension(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_no_config_context")) return config;
    return eglChooseConfig(display, wanted, &config, 1, &count) && count ? config : EGL_NO_CONFIG_KHR;
}

/* The newest core context from 4.6 down to 4.3. */
static mns_status create_context(egl_state *state, mns_error *error)
{
    EGLConfig config = find_config(state->display);
    for (EGLint minor = 6; minor >= 3; minor--) {
        const EGLint attributes[] = {
            EGL_CONTEXT_MAJOR_VERSION,
            4,
            EGL_CONTEXT_MINOR_VERSION,
            minor,
            EGL_CONTEXT_OPENGL_DEBUG,
            EGL_TRUE,
            EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
            EGL_NONE,
        };
        state->context = eglCreateContext(state->display, config, EGL_NO_CONTEXT, attributes);
        if (state->context != EGL_NO_CONTEXT) return MNS_OK;
    }
    EGLint code = eglGetError();
    if (code == EGL_BAD_MATCH || code == EGL_BAD_ATTRIBUTE || code == EGL_BAD_CONFIG)
        return status_fail(error, MNS_ERROR_GL,
                           "version too old: no OpenGL core profile of 4.3 or later (%s)", error_name(code));
    return status_fail(error, MNS_ERROR_GL, "driver failed: eglCreateContext: %s", error_name(code));
}

static mns_status open_display(mns_context *context, EGLDisplay display, mns_error *error)
{
    const context_backend backend = {make_current, destroy, eglGetProcAddress};
    if (display == EGL_NO_DISPLAY) return driver_failed(error, "eglGetPlatformDisplay");
    if (!eglInitialize(display, NULL, NULL)) return driver_failed(error, "eglInitialize");
    if (!has_extension(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
        return status_fail(error, MNS_ERROR_GL,
                           "version too old: the EGL driver lacks EGL_KHR_surfaceless_context");
    if (!eglBindAPI(EGL_OPENGL_API)) return driver_failed(error, "eglBindAPI(EGL_OPENGL_API)");

    egl_state *state = malloc(sizeof *state);
    if (!state) return status_no_memory(error, "making an EGL context");
    state->display = display;
    mns_status status = create_context(state, error);
    if (status != MNS_OK) {
        free(state);
        return status;
    }
    context->state = state;
    context->kind = MNS_BACKEND_EGL;
    status = make_current(context, error);
    if (status != MNS_OK) {
        destroy(context);
        return status;
    }
    context->backend = backend;
    return MNS_OK;
}

/* eglGetPlatformDisplay is EGL 1.5; the older name of the same function is an extension. */
static EGLDisplay platform_display(EGLenum platform, void *native)
{
    PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    return get ? get(platform, native, NULL) : EGL_NO_DISPLAY;
}

mns_status context_egl_surfaceless_open(mns_context *context, mns_error *error)
{
    if (!client_has("EGL_MESA_platform_surfaceless")) /* GLVND's libEGL alone offers none */
        return status_fail(
            error, MNS_ERROR_GL,
            "library missing: no EGL driver with EGL_MESA_platform_surfaceless; install libegl-mesa0");
    mns_status status =
        open_display(context, platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY), error);
    if (status == MNS_OK) snprintf(context->name, sizeof context->name, "egl surfaceless");
    return status;
}

enum { DEVICES_MAX = 64 };

/* Lists up to DEVICES_MAX devices and returns how many. */
static int list_devices(EGLDeviceEXT devices[DEVICES_MAX])
{
    EGLint count = 0;
    PFNEGLQUERYDEVICESEXTPROC query = (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    bool can_list = client_has("EGL_EXT_device_base") || client_has("EGL_EXT_device_enumeration");
    if (!can_list || !client_has("EGL_EXT_platform_device") || !query) return 0;
    return query(DEVICES_MAX, devices, &count) ? count : 0;
}

int context_egl_device_count(void)
{
    EGLDeviceEXT devices[DEVICES_MAX];
    return list_devices(devices);
}

bool context_egl_device_is_software(int device)
{
    EGLDeviceEXT devices[DEVICES_MAX];
    PFNEGLQUERYDEVICESTRINGEXTPROC query =
        (PFNEGLQUERYDEVICESTRINGEXTPROC)eglGetProcAddress("eglQueryDeviceStringEXT");
    if (device < 0 || device >= list_devices(devices) || !query) return false;
    return has_extension(query(devices[device], EGL_EXTENSIONS), "EGL_MESA_device_software");
}

mns_status context_egl_device_open(mns_context *context, int device, mns_error *error)
{
    EGLDeviceEXT devices[DEVICES_MAX];
    int count = list_devices(devices);
    if (device < 0 || device >= count)
        return status_fail(error, MNS_ERROR_GL, "no EGL device %d: the driver lists %d", device, count);
    mns_status status =
        open_display(context, platform_display(EGL_PLATFORM_DEVICE_EXT, devices[device]), error);
    if (status == MNS_OK) snprintf(context->name, sizeof context->name, "egl device %d", device);
    return status;
}
