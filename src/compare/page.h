/* index.html: a comparison as one file that opens without a network. */
#ifndef MNS_COMPARE_PAGE_H
#define MNS_COMPARE_PAGE_H

#include "compare/pictures.h"

#include <jansson.h>

/* Writes the page of `results` (a document as results.h has it) with its pictures inlined. `path` is new; the
 * caller moves it to its place. Errors: IO, MEMORY. */
mns_status page_write(const json_t *results, const page_picture *pictures, size_t count, const char *path,
                      mns_error *error);

#endif
