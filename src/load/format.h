/* The one table of formats. A reader is a file of its own and sees nothing but a stream. */
#ifndef MNS_LOAD_FORMAT_H
#define MNS_LOAD_FORMAT_H

#include "field/field.h"
#include "load/stream.h"

/* Where the frames of a file begin. */
typedef struct load_frames {
    load_place *place;
    size_t count, capacity;
} load_frames;

typedef struct load_format {
    const char *name;          /* as mns_field_info says it */
    const char *endings;       /* of file names, each with a blank behind it */
    const char *radius_source; /* what the file's radii are */
    /* Whether a file that begins so is of this format. */
    bool (*is_like)(load_text head);
    /* Finds frames with little effort, up to the end or to the first thing that it does not understand; where
     * that is inside or after a frame, it counts as one, and reading it will tell. NULL: always one frame.
     * False: out of memory. */
    bool (*scan)(load_stream *s, load_frames *frames);
    /* Reads the frame that begins at the stream's place. A failure is recorded in the stream; *p may hold
     * parts. */
    mns_status (*read)(load_stream *s, particles *p);
} load_format;

extern const load_format format_csv, format_xyz, format_lammps, format_pdb, format_vtk;

/* NULL-terminated. */
extern const load_format *const load_formats[];

/* The format by content, else by the name's ending; NULL: a failure, recorded in the stream. */
const load_format *format_find(load_stream *s, const char *name);
const load_format *format_by_name(const char *name);

/* Notes that a frame begins there. False: out of memory. */
bool frames_add(load_frames *frames, load_place place);

/* Passes over blank lines and gives the next one; *place is where it begins. */
bool format_next_line(load_stream *s, load_place *place, load_text *line);

/* A whole file of the format out of memory, every frame read and given up again, as the fuzzers do. The first
 * failure. */
mns_status format_try(const load_format *format, const void *data, size_t size, mns_error *error);

#endif
