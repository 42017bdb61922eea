/* A file that appears under its name whole or not at all: written beside it, then renamed. */
#ifndef MNS_IMAGE_OUTPUT_H
#define MNS_IMAGE_OUTPUT_H

#include "base/status.h"

#include <stdio.h>

typedef struct output_file {
    FILE *file;       /* to be written, never closed, by the caller */
    char *temporary;  /* its name for now, in the folder of `path` */
    const char *path; /* borrowed */
} output_file;

/* Opens a temporary file in the folder of `path`. End with commit or discard. Errors: IO (no such folder, no
 * right to write in it, `path` is there and is not a regular file), MEMORY. */
mns_status output_open(output_file *output, const char *path, mns_error *error);
/* Closes the file and gives it its name, replacing what bore it. On failure nothing of it is left. Errors:
 * IO. */
mns_status output_commit(output_file *output, mns_error *error);
/* Closes the file and removes it. */
void output_discard(output_file *output);

/* "PATH: cannot write: reason of the errno `code`", as an IO error. */
mns_status output_failed(const char *path, int code, mns_error *error);

#endif
