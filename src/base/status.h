/* The one funnel for errors: a status and one line that says what, where, and what to do. */
#ifndef MNS_BASE_STATUS_H
#define MNS_BASE_STATUS_H

#include "meniscus.h"

/* Fills *error (which may be NULL) with a formatted line and returns `status`, so that a caller can
 * `return status_fail(error, MNS_ERROR_INPUT, "%s:%zu: expected ...", ...);`. Newlines and control bytes in
 * the formatted text become '?', so that bytes quoted from a bad file cannot break the line. */
mns_status status_fail(mns_error *error, mns_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Out of memory while `what`. */
mns_status status_no_memory(mns_error *error, const char *what);

#endif
