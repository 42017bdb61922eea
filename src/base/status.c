#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>

mns_status status_fail(mns_error *error, mns_status status, const char *format, ...)
{
    if (!error) return status;
    error->status = status;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    for (char *c = error->text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
    return status;
}

mns_status status_no_memory(mns_error *error, const char *what)
{
    return status_fail(error, MNS_ERROR_MEMORY, "out of memory %s; try fewer particles or a smaller frame",
                       what);
}
