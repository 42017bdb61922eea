/* Option values from text: each checks the whole text and says which option, what it was given, and what it
 * expected. */
#ifndef MNS_APP_PARSE_H
#define MNS_APP_PARSE_H

#include "meniscus.h"

#include <limits.h>

/* An inclusive range of frames; `last` is PARSE_FRAMES_ALL where every frame of the input is meant. */
typedef struct parse_frames_range {
    bool given;
    long first, last, step;
} parse_frames_range;

#define PARSE_FRAMES_ALL LONG_MAX

/* `count` finite numbers with `separator` between them. */
mns_status parse_numbers(const char *option, const char *text, char separator, size_t count, double *values,
                         const char *expected, mns_error *error);
/* "X,Y,Z"; and not all of them 0. */
mns_status parse_point(const char *name, const char *text, double v[3], mns_error *error);
mns_status parse_direction(const char *name, const char *text, double v[3], mns_error *error);
/* One finite number above 0. */
mns_status parse_positive(const char *option, const char *text, double *value, mns_error *error);
/* One finite number of 0 or more. */
mns_status parse_weight(const char *option, const char *text, double *value, mns_error *error);
/* A whole number in [low, high]. */
mns_status parse_whole(const char *option, const char *text, long low, long high, long *value,
                       mns_error *error);
/* As parse_whole, from 1, into an int. */
mns_status parse_count(const char *option, const char *text, int high, int *value, mns_error *error);
/* "WxH". */
mns_status parse_size(const char *option, const char *text, int *width, int *height, mns_error *error);
/* "A[:B[:STEP]]", B included. */
mns_status parse_frames(const char *option, const char *text, parse_frames_range *range, mns_error *error);
/* The index whose name is `text`; name_of gives NULL for an index without a name. */
mns_status parse_name(const char *option, const char *text, const char *(*name_of)(int), int count,
                      int *index, mns_error *error);

#endif
