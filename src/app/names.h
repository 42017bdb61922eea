/* Names of output files: numbered ones, and what can be told to be wrong before anything is drawn. */
#ifndef MNS_APP_NAMES_H
#define MNS_APP_NAMES_H

#include "meniscus.h"

/* "frame.%04d.png" taken apart: what stands before and behind the number, and how wide it is. */
typedef struct names_pattern {
    const char *text;
    size_t before;      /* bytes before the number; the whole name where it is not numbered */
    const char *behind; /* "" where it is not numbered */
    bool is_numbered, pads_zero;
    int digits;
} names_pattern;

/* Takes `text` apart; one %d, %Nd or %0Nd may be in the file's name, and no other '%'. Errors: USAGE. */
mns_status names_parse(const char *option, const char *text, names_pattern *pattern, mns_error *error);

/* The name of frame `index`, for the caller to free; NULL where memory ends. */
char *names_expand(const names_pattern *pattern, long index);

/* Does the name end like an image (with `exr_only`, like an OpenEXR file)? Errors: USAGE. */
mns_status names_check_ending(const char *option, const char *text, bool exr_only, mns_error *error);

/* Is there a folder to write `path` in, and no folder in its place? Errors: IO. */
mns_status names_check_place(const char *path, mns_error *error);

#endif
