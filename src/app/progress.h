/* A line on the terminal that says how far a long work has come. */
#ifndef MNS_APP_PROGRESS_H
#define MNS_APP_PROGRESS_H

#include <stdbool.h>

typedef struct progress {
    const char *unit; /* "frame", "row" */
    bool is_on;       /* standard error is a terminal, and there is more than one unit */
    long total, done;
    double start_ms;
} progress;

void progress_begin(progress *p, const char *unit, long total);
/* Shows that `done` units are finished. */
void progress_show(progress *p, long done);
/* Wipes the line, so that other text may be printed. */
void progress_clear(const progress *p);

#endif
