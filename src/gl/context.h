/* GL contexts without a visible window: one table of functions a back end, chosen by name or tried in order.
 *
 * A thread has at most one current context, whatever made it: Mesa's EGL and OSMesa share the slot of the
 * current context (libglapi), but each keeps its own idea of what is in it, so that eglMakeCurrent of a
 * context that EGL still believes current does nothing after OSMesa took the slot. Making a context current
 * here therefore first makes every back end let go of the thread. */
#ifndef MNS_GL_CONTEXT_H
#define MNS_GL_CONTEXT_H

#include "base/status.h"

/* What an open context can do. Filled last by the opening function: a half-made context is never visible. */
typedef struct context_backend {
    mns_status (*make_current)(mns_context *context, mns_error *error);
    void (*destroy)(mns_context *context); /* frees the state; the context is not current on another thread */
    mns_get_proc get_proc;
} context_backend;

struct mns_context {
    context_backend backend;
    void *state; /* the back end's own */
    char name[32];
    mns_backend kind;
};

/* Each fills a zeroed *context and makes it current, or leaves nothing behind. Where the library was absent
 * when this was built, context_*_missing.c takes its place. Errors: GL, UNSUPPORTED, MEMORY. */
mns_status context_egl_surfaceless_open(mns_context *context, mns_error *error);
mns_status context_egl_device_open(mns_context *context, int device, mns_error *error);
mns_status context_osmesa_open(mns_context *context, mns_error *error);
mns_status context_glfw_open(mns_context *context, mns_error *error);

/* Devices that EGL lists, 0 where it cannot list any; `is_software` of one of them. */
int context_egl_device_count(void);
bool context_egl_device_is_software(int device);

/* Each makes no context current on this thread, as far as this back end knows. */
void context_egl_release(void);
void context_osmesa_release(void);
void context_glfw_release(void);

/* All three: no context is current on this thread. */
void context_release_thread(void);

/* Whether a GL_RENDERER string is that of a software rasteriser. */
bool context_renderer_is_software(const char *renderer);

#endif
