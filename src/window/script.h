/* A script: a line an action, replayed one after the other. Empty lines and those that begin with '#' are
 * passed over; "rest" waits until the picture is whole, "sleep MS" for a time. */
#ifndef MNS_WINDOW_SCRIPT_H
#define MNS_WINDOW_SCRIPT_H

#include "meniscus.h"

typedef struct script {
    const char *path;
    char *text, *next; /* NULL: there is none, or it has come to its end */
    size_t line;       /* the number of the last line, from 1 */
    double until_ms;   /* waits for a time */
    bool rests;        /* waits for the picture */
} script;

/* Reads the file. Errors: IO, INPUT, MEMORY. */
mns_status script_read(script *s, const char *path, mns_error *error);
void script_free(script *s);
/* The next line that is an action, its end cut off; NULL: no more. It lives until the script is freed. */
char *script_next(script *s);

#endif
