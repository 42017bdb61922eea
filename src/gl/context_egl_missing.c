/* Stands in for context_egl.c where EGL was absent at build time. */
#include "gl/context.h"

static mns_status not_built_in(mns_error *error)
{
    return status_fail(error, MNS_ERROR_UNSUPPORTED, "not built in; install libegl-dev and build again");
}

mns_status context_egl_surfaceless_open(mns_context *context, mns_error *error)
{
    (void)context;
    return not_built_in(error);
}

mns_status context_egl_device_open(mns_context *context, int device, mns_error *error)
{
    (void)context, (void)device;
    return not_built_in(error);
}

int context_egl_device_count(void)
{
    return 0;
}

bool context_egl_device_is_software(int device)
{
    (void)device;
    return false;
}

void context_egl_release(void) {}
