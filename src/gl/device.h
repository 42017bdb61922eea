/* The functions and limits of one GL context. */
#ifndef MNS_GL_DEVICE_H
#define MNS_GL_DEVICE_H

#include "meniscus.h"

#include <glad/gl.h>

typedef struct gl_device {
    GladGLContext gl;
    mns_limits limits;
    char name[256]; /* renderer, version */
    char vendor[128];
    size_t messages; /* of medium or high severity, from the driver's debug output */
    char last_message[256];
    GLuint reading; /* the buffer through which gl_buffer_fetch reads; 0: not made */
} gl_device;

/* Loads the functions of the current context. `device` must keep its address: the debug output reports to it.
 * Errors: GL (functions missing, below 4.3). */
mns_status gl_device_open(gl_device *device, mns_get_proc get_proc, mns_error *error);
/* Stops the debug output from reporting to `device`, whose context is current, and frees what it holds. */
void gl_device_close(gl_device *device);

/* GL with a first error pending in `error` when the driver reports one since the last call; `where` names the
 * step. */
mns_status gl_check(gl_device *device, const char *where, mns_error *error);

#endif
