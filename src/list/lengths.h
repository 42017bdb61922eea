/* How long the gathered lists are. */
#ifndef MNS_LIST_LENGTHS_H
#define MNS_LIST_LENGTHS_H

#include "list/passes.h"

typedef struct list_lengths {
    uint32_t *length; /* of every non-empty list seen */
    size_t count;
} list_lengths;

/* Reads a region's lists back and notes their lengths. False: out of memory. */
bool list_lengths_add(list_lengths *lengths, list_passes *p, gl_device *device, list_region region,
                      size_t nodes);
/* Notes a list that `pixels` pixels share. False: out of memory. */
bool list_lengths_share(list_lengths *lengths, uint32_t length, size_t pixels);
/* Mean, 99th percentile and maximum, into the stats. */
void list_lengths_finish(list_lengths *lengths, mns_stats *stats);

#endif
