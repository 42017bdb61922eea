/* Files in the user's cache: what was dear to make, and can be made again. Nothing depends on it: where it
 * cannot be read or written, one does without. */
#ifndef MNS_BASE_STORE_H
#define MNS_BASE_STORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { STORE_PATH = 3000 };

/* $XDG_CACHE_HOME/meniscus/KIND, or ~/.cache/meniscus/KIND. False: neither variable is an absolute path of a
 * length that fits. */
bool store_folder(const char *kind, char folder[STORE_PATH]);

typedef struct store_part {
    const void *data;
    size_t size;
} store_part;

/* Leaves the parts, one after the other, as folder/NAME.ENDING: written beside it and renamed. The folder is
 * made where it is not there. Files of that ending that were not used for longest are then removed, until all
 * take at most `most` bytes; and what was begun more than an hour ago and never renamed. 0, or an errno. */
int store_write(const char *folder, const char *name, const char *ending, const store_part *part,
                size_t count, uint64_t most);

/* The file, open for reading, or NULL. store_close notes that it was of use, or removes one that was not
 * good. */
FILE *store_open(const char *folder, const char *name, const char *ending);
void store_close(FILE *file, const char *folder, const char *name, const char *ending, bool good);

/* Goes on with a check sum, from 0, over more bytes; the last of 8 are taken with zeros behind. */
uint64_t store_sum(uint64_t sum, const void *data, size_t size);

#endif
