/* A line on the terminal that says how far a sequence has come. */
#ifndef MNS_APP_PROGRESS_H
#define MNS_APP_PROGRESS_H

#include <stdbool.h>

typedef struct progress {
    bool is_on; /* standard error is a terminal, and there is more than one frame */
    long total, done;
    double start_ms;
} progress;

void progress_begin(progress *p, long total);
/* Shows that `done` frames are finished. */
void progress_show(progress *p, long done);
/* Wipes the line, so that other text may be printed. */
void progress_clear(const progress *p);

#endif
