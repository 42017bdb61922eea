/* A folder of results that appears under its name whole or not at all. */
#ifndef MNS_COMPARE_FOLDER_H
#define MNS_COMPARE_FOLDER_H

#include "base/status.h"

typedef struct folder_output {
    char *path;      /* its name in the end */
    char *temporary; /* its name for now, beside it */
} folder_output;

/* May a result be written under that name? What is there already must be a folder with nothing in it but the
 * files of a comparison. Errors: IO. */
mns_status folder_check(const char *path, mns_error *error);
/* Makes a new folder beside `path`. End with commit or discard. Errors: IO, MEMORY. */
mns_status folder_begin(folder_output *output, const char *path, mns_error *error);
/* "folder/name", for the caller to free; NULL where memory ends. */
char *folder_file(const folder_output *output, const char *name);
/* Gives the folder its name; the earlier result is removed. On failure nothing of the new one is left.
 * Errors: IO. */
mns_status folder_commit(folder_output *output, mns_error *error);
void folder_discard(folder_output *output);

#endif
