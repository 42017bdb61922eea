/* The files that something was read from, as they were then: whether they still are. */
#ifndef MNS_SOLID_WATCH_H
#define MNS_SOLID_WATCH_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/stat.h>

typedef struct watch_file {
    char *name;
    struct timespec time;
    off_t size;
} watch_file;

/* Zeroed: none. */
typedef struct watch {
    watch_file *file;
    size_t count;
    bool failed; /* out of memory: some file is not in it */
} watch;

/* Notes a file, of which `about` tells, once. False: out of memory. */
bool watch_note(watch *w, const char *name, const struct stat *about);
/* Whether all of them are there, and of the same time and size. */
bool watch_is_same(const watch *w);
void watch_free(watch *w);

#endif
