/* The file of --stats. Its keys are a face that others script against; README.md lists them. */
#ifndef MNS_APP_STATS_JSON_H
#define MNS_APP_STATS_JSON_H

#include "meniscus.h"

#include <jansson.h>

/* What the program itself knows of one drawn frame. */
typedef struct stats_frame {
    long index; /* in the input */
    const mns_stats *stats;
    const mns_plan *plan;
    const char *renderer; /* GL_RENDERER and GL_VERSION */
    const char *context;
    size_t messages; /* of medium or high severity by the driver */
    double load_ms, readback_ms, encode_ms;
    const mns_stats *runs; /* of --repeat; NULL without */
    size_t run_count;
} stats_frame;

/* The median of a double at offset `member` of n > 0 runs; NaN where memory ends. */
double stats_median(const mns_stats *runs, size_t n, size_t member);

/* The figures of one frame, a new reference; NULL where memory ends. */
json_t *stats_json_frame(const stats_frame *frame);

/* Writes the last frame's figures under "schema", with all of `frames` (a list, one object a frame) where
 * there are several: beside the name, then renamed. Errors: IO, MEMORY. */
mns_status stats_json_write(const char *path, const json_t *frames, mns_error *error);

#endif
