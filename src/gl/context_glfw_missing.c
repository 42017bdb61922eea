/* Stands in for context_glfw.c where GLFW was absent at build time. */
#include "gl/context.h"

mns_status context_glfw_open(mns_context *context, mns_error *error)
{
    (void)context;
    return status_fail(error, MNS_ERROR_UNSUPPORTED, "not built in; install libglfw3-dev and build again");
}

void context_glfw_release(void) {}
