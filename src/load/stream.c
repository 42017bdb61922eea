#include "load/stream.h"

#include "base/status.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The longest line; a power of ten, since messages name it. Large, so that all cores have work in it. */
enum { BUFFER_SIZE = 10000000 };

/* ---- Failures ---- */

mns_status stream_fail(load_stream *s, mns_status status, const char *format, ...)
{
    if (s->status) return s->status;
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return s->status = status_fail(s->error, status, "%s: %s", s->name, text);
}

mns_status stream_fail_line(load_stream *s, const char *format, ...)
{
    if (s->status) return s->status;
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    uint64_t line = s->line + (s->is_mid_line || !s->line);
    return s->status =
               status_fail(s->error, MNS_ERROR_INPUT, "%s:%llu: %s", s->name, (unsigned long long)line, text);
}

mns_status stream_fail_byte(load_stream *s, const char *format, ...)
{
    if (s->status) return s->status;
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return s->status = status_fail(s->error, MNS_ERROR_INPUT, "%s: byte %llu: %s", s->name,
                                   (unsigned long long)stream_place(s).offset, text);
}

mns_status stream_no_memory(load_stream *s)
{
    if (s->status) return s->status;
    return s->status = status_no_memory(s->error, "reading particles");
}

/* ---- Opening and raw bytes ---- */

static void set_name(load_stream *s, const char *name)
{
    size_t length = strlen(name), limit = sizeof s->name - 1;
    if (length <= limit)
        memcpy(s->name, name, length + 1);
    else /* the end of a long path tells more than its beginning */
        snprintf(s->name, sizeof s->name, "...%s", name + length - (limit - 3));
}

static ptrdiff_t read_file(load_stream *s, void *to, size_t size)
{
    for (;;) {
        ssize_t got = read(s->file, to, size);
        if (got >= 0) return got;
        if (errno == EINTR) continue;
        stream_fail(s, MNS_ERROR_IO, "cannot read: %m");
        return -1;
    }
}

ptrdiff_t stream_raw(load_stream *s, void *to, size_t size)
{
    if (s->file >= 0) return read_file(s, to, size);
    size_t left = s->memory_size - s->memory_at, got = size < left ? size : left;
    if (got) memcpy(to, s->memory + s->memory_at, got);
    s->memory_at += got;
    return (ptrdiff_t)got;
}

static bool fill(load_stream *s)
{
    if (s->status || s->at_end) return false;
    if (s->begin) {
        memmove(s->buffer, s->buffer + s->begin, s->end - s->begin);
        s->offset += s->begin;
        s->end -= s->begin;
        s->begin = 0;
    }
    size_t room = BUFFER_SIZE - s->end;
    if (!room) return false;
    ptrdiff_t got =
        s->gzip ? gzip_read(s, s->buffer + s->end, room) : stream_raw(s, s->buffer + s->end, room);
    if (got < 0) return false;
    s->end += (size_t)got;
    s->at_end = got == 0;
    return got > 0;
}

static mns_status start(load_stream *s)
{
    s->buffer = malloc(BUFFER_SIZE);
    if (!s->buffer) return stream_no_memory(s);
    while (s->end < 2 && fill(s)) {}
    if (s->status) return s->status;
    if (s->end >= 2 && !memcmp(s->buffer, "\x1f\x8b", 2)) {
        gzip_open(s);
        s->end = 0;
        s->at_end = false;
    }
    load_text mark = stream_peek(s, 3); /* some programs write a byte order mark */
    if (mark.end - mark.at == 3 && !memcmp(mark.at, "\xef\xbb\xbf", 3)) s->begin = 3;
    return s->status;
}

mns_status stream_open(load_stream *s, const char *path, mns_error *error)
{
    *s = (load_stream){.error = error, .file = -1};
    set_name(s, path);
    struct stat about;
    s->file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* opening a pipe must not wait for a writer */
    if (s->file < 0) return stream_fail(s, MNS_ERROR_IO, "cannot open: %m");
    if (fstat(s->file, &about)) return stream_fail(s, MNS_ERROR_IO, "cannot open: %m");
    if (S_ISDIR(about.st_mode)) return stream_fail(s, MNS_ERROR_IO, "is a folder; expected a particle file");
    if (!S_ISREG(about.st_mode))
        return stream_fail(s, MNS_ERROR_IO, "is not an ordinary file; expected a particle file");
    if (about.st_size == 0) return stream_fail(s, MNS_ERROR_INPUT, "the file is empty; expected particles");
    return start(s);
}

mns_status stream_open_memory(load_stream *s, const void *data, size_t size, const char *name,
                              mns_error *error)
{
    *s = (load_stream){.error = error, .file = -1, .memory = data, .memory_size = size};
    set_name(s, name);
    if (!size) return stream_fail(s, MNS_ERROR_INPUT, "the file is empty; expected particles");
    return start(s);
}

void stream_close(load_stream *s)
{
    if (!s->buffer && !s->name[0]) return;
    if (s->file >= 0) close(s->file);
    gzip_close(s->gzip);
    free(s->buffer);
    memset(s, 0, sizeof *s);
}

/* ---- Reading ---- */

load_text stream_peek(load_stream *s, size_t size)
{
    if (size > BUFFER_SIZE) size = BUFFER_SIZE;
    while (s->end - s->begin < size && fill(s)) {}
    size_t left = s->end - s->begin;
    const char *at = s->buffer + s->begin;
    return (load_text){at, at + (left < size ? left : size)};
}

/* Has a whole line in the buffer, or what follows the last newline of the input. False at the end and on
 * failure. */
static bool fill_line(load_stream *s)
{
    if (s->status) return false;
    size_t seen = 0;
    while (!memchr(s->buffer + s->begin + seen, '\n', s->end - s->begin - seen)) {
        seen = s->end - s->begin;
        if (fill(s)) continue;
        if (s->status || !seen) return false;
        if (s->at_end) return true;
        s->is_mid_line = true;
        stream_fail_line(s, "the line is longer than %d bytes; expected a line for each particle",
                         BUFFER_SIZE);
        return false;
    }
    return true;
}

bool stream_line(load_stream *s, load_text *line)
{
    if (!fill_line(s)) return false;
    load_text rest = {s->buffer + s->begin, s->buffer + s->end};
    if (!text_next_line(&rest, line)) return false;
    s->begin = (size_t)(rest.at - s->buffer);
    s->line++;
    s->is_mid_line = false;
    return true;
}

bool stream_peek_lines(load_stream *s, load_text *lines)
{
    if (!fill_line(s)) return false;
    const char *at = s->buffer + s->begin, *last = memrchr(at, '\n', s->end - s->begin);
    *lines = (load_text){at, last ? last + 1 : s->buffer + s->end};
    return true;
}

void stream_pass(load_stream *s, const char *end)
{
    s->begin = (size_t)(end - s->buffer);
    s->is_mid_line = false;
}

uint64_t stream_skip_lines(load_stream *s, uint64_t count)
{
    uint64_t skipped = 0;
    load_text lines;
    while (skipped < count && stream_peek_lines(s, &lines)) {
        uint64_t there = text_count_lines(lines) + (lines.end[-1] != '\n');
        if (there > count - skipped) {
            there = count - skipped;
            lines.end = text_skip_lines(lines, there);
        }
        stream_pass(s, lines.end);
        s->line += there;
        skipped += there;
    }
    return skipped;
}

static bool is_space(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

bool stream_token(load_stream *s, load_text *token)
{
    if (s->status) return false;
    for (;;) { /* to the token */
        for (; s->begin < s->end && is_space(s->buffer[s->begin]); s->begin++)
            if (s->buffer[s->begin] == '\n') s->line++, s->is_mid_line = false;
        if (s->begin < s->end) break;
        if (!fill(s)) return false;
    }
    size_t length = 0;
    for (;;) {
        while (s->begin + length < s->end && !is_space(s->buffer[s->begin + length])) length++;
        if (s->begin + length < s->end || !fill(s)) break;
    }
    if (s->status) return false;
    if (length == BUFFER_SIZE) {
        stream_fail_line(s, "a word is longer than %d bytes", BUFFER_SIZE - 1);
        return false;
    }
    token->at = s->buffer + s->begin;
    token->end = token->at + length;
    s->is_mid_line = true;
    s->begin += length;
    return true;
}

bool stream_end_line(load_stream *s)
{
    load_text rest;
    if (!stream_line(s, &rest)) return !s->status;
    while (rest.at < rest.end && is_space(*rest.at)) rest.at++;
    return rest.at == rest.end;
}

bool stream_bytes(load_stream *s, void *to, size_t size)
{
    char *out = to;
    while (!s->status && size) {
        size_t left = s->end - s->begin, part = left < size ? left : size;
        if (part) memcpy(out, s->buffer + s->begin, part);
        s->begin += part;
        out += part;
        size -= part;
        if (size && !fill(s)) {
            stream_fail_byte(s, "the file ends early; expected %zu more bytes", size);
            return false;
        }
    }
    return !s->status;
}

/* ---- Lines in a text ---- */

uint64_t text_count_lines(load_text text)
{
    uint64_t count = 0;
    while (text.at < text.end) { /* in parts, whose counts the compiler can hold in bytes' lanes */
        const char *end = text.end - text.at > 4096 ? text.at + 4096 : text.end;
        uint32_t part = 0;
        for (const char *c = text.at; c < end; c++) part += *c == '\n';
        count += part;
        text.at = end;
    }
    return count;
}

const char *text_skip_lines(load_text text, uint64_t count)
{
    for (; count && text.at < text.end; count--) {
        const char *newline = memchr(text.at, '\n', (size_t)(text.end - text.at));
        text.at = newline ? newline + 1 : text.end;
    }
    return text.at;
}

bool text_next_line(load_text *rest, load_text *line)
{
    if (rest->at == rest->end) return false;
    const char *end = memchr(rest->at, '\n', (size_t)(rest->end - rest->at));
    line->at = rest->at;
    rest->at = end ? end + 1 : rest->end;
    if (!end) end = rest->end;
    line->end = end > line->at && end[-1] == '\r' ? end - 1 : end;
    return true;
}

/* ---- Places ---- */

load_place stream_place(const load_stream *s)
{
    return (load_place){s->offset + s->begin, s->line};
}

static mns_status rewind_to(load_stream *s, uint64_t offset)
{
    s->begin = s->end = 0;
    s->at_end = false;
    s->offset = s->gzip ? 0 : offset;
    if (s->gzip) return gzip_rewind(s);
    if (s->file < 0)
        s->memory_at = offset < s->memory_size ? (size_t)offset : s->memory_size;
    else if (lseek(s->file, (off_t)offset, SEEK_SET) < 0)
        return stream_fail(s, MNS_ERROR_IO, "cannot go to byte %llu: %m", (unsigned long long)offset);
    return MNS_OK;
}

mns_status stream_seek(load_stream *s, load_place place)
{
    bool failed = s->status != MNS_OK;
    s->status = MNS_OK;
    bool is_here = place.offset >= s->offset && place.offset <= s->offset + s->end;
    bool is_ahead = s->gzip && !failed && place.offset >= s->offset;
    if (!is_here && !is_ahead && rewind_to(s, place.offset)) return s->status;
    if (failed && is_here && rewind_to(s, place.offset)) return s->status;
    while (place.offset > s->offset + s->end) {
        s->begin = s->end;
        if (!fill(s)) return s->status ? s->status : stream_fail_byte(s, "the file has become shorter");
    }
    s->begin = (size_t)(place.offset - s->offset);
    s->line = place.line;
    s->is_mid_line = false;
    return MNS_OK;
}
