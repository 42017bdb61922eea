/* Contexts in memory by OSMesa, opened with dlopen on first use.
 *
 * Why it is not linked: measured on Debian 12, a program that links libOSMesa starts 15 ms later and 50 MB
 * larger, since it carries the whole rasteriser and LLVM, and it exports every gl* name, which would then
 * stand in the global scope of any host before its own libGL. Both it and EGL work in one process either way
 * (context.h says what they share). */
#include "gl/context.h"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BUFFER_SIDE = 16
}; /* OSMesa wants a colour buffer of the client's; everything is drawn into framebuffer objects */

typedef struct osmesa_library {
    OSMesaContext (*create)(const int *attributes, OSMesaContext share);
    void (*destroy)(OSMesaContext context);
    GLboolean (*make_current)(OSMesaContext context, void *buffer, GLenum type, GLsizei width,
                              GLsizei height);
    OSMesaContext (*get_current)(void);
    mns_get_proc get_proc;
} osmesa_library;

typedef struct osmesa_state {
    osmesa_library library;
    OSMesaContext context;
    unsigned char buffer[BUFFER_SIDE * BUFFER_SIDE * 4];
} osmesa_state;

/* POSIX lets a function's address pass through dlsym's void *, ISO C does not: hence the copy by bytes. */
static bool find(void *handle, const char *name, void *function)
{
    void *symbol = dlsym(handle, name);
    memcpy(function, &symbol, sizeof symbol);
    return symbol != NULL;
}

/* Opens the library (again: dlopen counts), or with RTLD_NOLOAD finds it only where it is open already. It
 * stays in the process: LLVM does not survive being unloaded. */
static void *open_library(int flags)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so"};
    void *handle = NULL;
    for (size_t i = 0; !handle && i < sizeof names / sizeof *names; i++)
        handle = dlopen(names[i], RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE | flags);
    return handle;
}

static mns_status load(osmesa_library *library, mns_error *error)
{
    void *handle = open_library(0);
    if (!handle) {
        const char *reason = dlerror();
        return status_fail(error, MNS_ERROR_GL, "library missing: %s; install libosmesa6",
                           reason ? reason : "libOSMesa.so.8");
    }
    bool found = find(handle, "OSMesaCreateContextAttribs", &library->create) &&
                 find(handle, "OSMesaDestroyContext", &library->destroy) &&
                 find(handle, "OSMesaMakeCurrent", &library->make_current) &&
                 find(handle, "OSMesaGetCurrentContext", &library->get_current) &&
                 find(handle, "OSMesaGetProcAddress", &library->get_proc);
    dlclose(handle); /* the count only: see RTLD_NODELETE */
    if (found) return MNS_OK;
    return status_fail(error, MNS_ERROR_GL,
                       "version too old: libOSMesa has no OSMesaCreateContextAttribs (Mesa 12)");
}

static mns_status make_current(mns_context *context, mns_error *error)
{
    osmesa_state *state = context->state;
    if (state->library.make_current(state->context, state->buffer, GL_UNSIGNED_BYTE, BUFFER_SIDE,
                                    BUFFER_SIDE))
        return MNS_OK;
    return status_fail(error, MNS_ERROR_GL, "driver failed: OSMesaMakeCurrent");
}

static void destroy(mns_context *context)
{
    osmesa_state *state = context->state;
    if (state->library.get_current() == state->context) state->library.make_current(NULL, NULL, 0, 0, 0);
    state->library.destroy(state->context);
    free(state);
}

void context_osmesa_release(void)
{
    void *handle = open_library(RTLD_NOLOAD);
    osmesa_library library;
    if (!handle) return;
    if (find(handle, "OSMesaGetCurrentContext", &library.get_current) &&
        find(handle, "OSMesaMakeCurrent", &library.make_current) && library.get_current())
        library.make_current(NULL, NULL, 0, 0, 0);
    dlclose(handle);
}

/* The newest core context from 4.5 down to 4.3. */
static mns_status create_context(osmesa_state *state, mns_error *error)
{
    for (int minor = 5; minor >= 3; minor--) {
        const int attributes[] = {
            OSMESA_FORMAT,
            OSMESA_RGBA,
            OSMESA_PROFILE,
            OSMESA_CORE_PROFILE,
            OSMESA_CONTEXT_MAJOR_VERSION,
            4,
            OSMESA_CONTEXT_MINOR_VERSION,
            minor,
            0,
        };
        state->context = state->library.create(attributes, NULL);
        if (state->context) return MNS_OK;
    }
    return status_fail(error, MNS_ERROR_GL, "version too old: no OpenGL core profile of 4.3 or later");
}

mns_status context_osmesa_open(mns_context *context, mns_error *error)
{
    osmesa_state *state = calloc(1, sizeof *state);
    if (!state) return status_no_memory(error, "making an OSMesa context");
    mns_status status = load(&state->library, error);
    if (status == MNS_OK) status = create_context(state, error);
    if (status != MNS_OK) goto fail;
    context->state = state;
    context->kind = MNS_BACKEND_OSMESA;
    status = make_current(context, error);
    if (status != MNS_OK) goto fail;
    snprintf(context->name, sizeof context->name, "osmesa");
    context->backend = (context_backend){make_current, destroy, state->library.get_proc};
    return MNS_OK;

fail:
    if (state->context) state->library.destroy(state->context);
    free(state);
    return status;
}
