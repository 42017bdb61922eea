/* The distinct words of a text column, numbered in the order they came. */
#ifndef MNS_LOAD_LABELS_H
#define MNS_LOAD_LABELS_H

#include "load/stream.h"

typedef struct load_labels {
    char **word; /* count of them */
    size_t count, capacity;
    uint32_t *slot; /* open addressing: 0 empty, else number + 1 */
    size_t slots;   /* a power of two */
    size_t last;    /* the number last given: neighbours are often alike */
} load_labels;

/* The word's number, new or known. False: out of memory. */
bool labels_number(load_labels *l, load_text word, size_t *number);
void labels_free(load_labels *l); /* frees the members, zeroes *l */

#endif
