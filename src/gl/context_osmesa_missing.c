/* Stands in for context_osmesa.c where OSMesa was absent at build time. */
#include "gl/context.h"

mns_status context_osmesa_open(mns_context *context, mns_error *error)
{
    (void)context;
    return status_fail(error, MNS_ERROR_UNSUPPORTED, "not built in; install libosmesa6-dev and build again");
}

void context_osmesa_release(void) {}
