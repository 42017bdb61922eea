/* The bytes of one input, unpacked: lines and tokens in place in one large buffer, blocks of binary, places
 * to come back to. A reader works until a call gives false, then looks at `status`: the first failure stays,
 * with its message. */
#ifndef MNS_LOAD_STREAM_H
#define MNS_LOAD_STREAM_H

#include "meniscus.h"

/* Bytes from `at` up to `end`, borrowed from the stream until its next call. */
typedef struct load_text {
    const char *at, *end;
} load_text;

/* Where a frame begins: unpacked bytes before it, and lines. */
typedef struct load_place {
    uint64_t offset, line;
} load_place;

typedef struct load_gzip load_gzip;

typedef struct load_stream {
    mns_status status; /* of the first failure since the last seek */
    mns_error *error;  /* where its message goes, or NULL */
    char name[200];    /* as messages show it */
    uint64_t line;     /* lines ended so far: the number of the line last given */
    bool is_mid_line;  /* tokens were given of the line after that */

    int file;                    /* descriptor, or -1: memory */
    const unsigned char *memory; /* borrowed */
    size_t memory_size, memory_at;
    load_gzip *gzip; /* NULL: plain */
    char *buffer;
    size_t begin, end; /* what is unread in the buffer */
    uint64_t offset;   /* unpacked bytes before buffer[0] */
    bool at_end;
} load_stream;

/* Opens a file, or `size` bytes that stay the caller's; gzip is told by its first bytes. Errors: IO, INPUT,
 * MEMORY. */
mns_status stream_open(load_stream *s, const char *path, mns_error *error);
mns_status stream_open_memory(load_stream *s, const void *data, size_t size, const char *name,
                              mns_error *error);
void stream_close(load_stream *s); /* zeroed is closed */

/* The next line without its end ("\n" or "\r\n"). False at the end of the input and on failure. */
bool stream_line(load_stream *s, load_text *line);
/* Passes over `count` lines; gives how many there were. */
uint64_t stream_skip_lines(load_stream *s, uint64_t count);
/* What the buffer holds of whole lines that come next, at least one, and at the end of the input what follows
 * the last newline; not passed over. False at the end and on failure. */
bool stream_peek_lines(load_stream *s, load_text *lines);
/* Passes over such lines up to `end`; `line` is for the caller to raise. */
void stream_pass(load_stream *s, const char *end);
/* The next run of bytes that are no white space, over lines. False at the end and on failure. */
bool stream_token(load_stream *s, load_text *token);
/* The next `size` bytes. False where there are fewer: that is a failure. */
bool stream_bytes(load_stream *s, void *to, size_t size);
/* Ends the current line after tokens: true if only white space was left of it. */
bool stream_end_line(load_stream *s);
/* Up to `size` bytes that come next, not passed over; fewer only at the end. */
load_text stream_peek(load_stream *s, size_t size);

load_place stream_place(const load_stream *s);
/* Goes to a place given before, and forgets a failure. Forwards costs reading; backwards in gzip starts anew.
 */
mns_status stream_seek(load_stream *s, load_place place);

/* Record a failure, unless there was one: "name:line: ..." of the line last given, "name: byte N: ..." of the
 * next byte, or "name: ...". They give the status that stands. */
mns_status stream_fail_line(load_stream *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
mns_status stream_fail_byte(load_stream *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
mns_status stream_fail(load_stream *s, mns_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
mns_status stream_no_memory(load_stream *s);

/* Newlines in a text; where the `count`-th line of it ends, with its newline; the next line of it, as
 * stream_line gives it. */
uint64_t text_count_lines(load_text text);
const char *text_skip_lines(load_text text, uint64_t count);
bool text_next_line(load_text *rest, load_text *line);

/* For messages: at most 40 bytes of a text, as arguments of "%.*s". */
#define SHOWN(text) ((text).end - (text).at > 40 ? 40 : (int)((text).end - (text).at)), (text).at

/* Inside the stream: raw bytes of the file or memory, and the gzip layer above them. */
ptrdiff_t stream_raw(load_stream *s, void *to, size_t size); /* 0: end; -1: failed */
mns_status gzip_open(load_stream *s);
ptrdiff_t gzip_read(load_stream *s, void *to, size_t size); /* as stream_raw */
mns_status gzip_rewind(load_stream *s);
void gzip_close(load_gzip *g);

#endif
