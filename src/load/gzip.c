/* The gzip layer of a stream: members one after another, checked by their sums, so that a cut or damaged file
 * is told, with the packed byte where it was. */
#include "load/stream.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

enum { PACKED_SIZE = 1 << 16, WINDOW_GZIP = 15 + 16 };

struct load_gzip {
    z_stream z;
    uint64_t packed; /* bytes of the file given to zlib so far, and those that wait */
    bool in_member;
    unsigned char bytes[PACKED_SIZE];
};

static uint64_t packed_at(const load_gzip *g)
{
    return g->packed - g->z.avail_in;
}

mns_status gzip_rewind(load_stream *s)
{
    load_gzip *g = s->gzip;
    s->memory_at = 0;
    if (s->file >= 0 && lseek(s->file, 0, SEEK_SET) < 0)
        return stream_fail(s, MNS_ERROR_IO, "cannot read anew: %m");
    g->z.avail_in = 0;
    g->packed = 0;
    g->in_member = false;
    return MNS_OK;
}

mns_status gzip_open(load_stream *s)
{
    load_gzip *g = calloc(1, sizeof *g);
    if (!g) return stream_no_memory(s);
    if (inflateInit2(&g->z, WINDOW_GZIP) != Z_OK) {
        free(g);
        return stream_no_memory(s);
    }
    s->gzip = g;
    return gzip_rewind(s);
}

void gzip_close(load_gzip *g)
{
    if (!g) return;
    inflateEnd(&g->z);
    free(g);
}

/* Has packed bytes ready; false at the end of the file and on failure. */
static bool refill(load_stream *s)
{
    load_gzip *g = s->gzip;
    if (g->z.avail_in) return true;
    ptrdiff_t got = stream_raw(s, g->bytes, sizeof g->bytes);
    if (got <= 0) return false;
    g->z.next_in = g->bytes;
    g->z.avail_in = (uInt)got;
    g->packed += (uint64_t)got;
    return true;
}

/* After a member: another one, zeros that pad, or the end. False at the end and on failure. */
static bool next_member(load_stream *s)
{
    load_gzip *g = s->gzip;
    while (refill(s)) {
        if (*g->z.next_in == 0 && packed_at(g) > 0) {
            g->z.next_in++, g->z.avail_in--;
            continue;
        }
        if (*g->z.next_in != 0x1f) {
            stream_fail(s, MNS_ERROR_INPUT,
                        "byte %llu: bytes after the end of the gzip stream; expected nothing",
                        (unsigned long long)packed_at(g));
            return false;
        }
        inflateReset(&g->z);
        g->in_member = true;
        return true;
    }
    return false;
}

ptrdiff_t gzip_read(load_stream *s, void *to, size_t size)
{
    load_gzip *g = s->gzip;
    g->z.next_out = to;
    g->z.avail_out = (uInt)size;
    while (g->z.avail_out == size) {
        if (!g->in_member && !next_member(s)) return s->status ? -1 : 0;
        if (!refill(s)) {
            stream_fail(s, MNS_ERROR_INPUT, "byte %llu: the gzip stream is cut off; expected more bytes",
                        (unsigned long long)packed_at(g));
            return -1;
        }
        int result = inflate(&g->z, Z_NO_FLUSH);
        if (result == Z_STREAM_END) {
            g->in_member = false;
        } else if (result == Z_MEM_ERROR) {
            stream_no_memory(s);
            return -1;
        } else if (result != Z_OK && result != Z_BUF_ERROR) {
            if (g->z.avail_out < size) break; /* what is good first; the next call fails again */
            stream_fail(s, MNS_ERROR_INPUT, "byte %llu: the gzip stream is damaged (%s)",
                        (unsigned long long)packed_at(g), g->z.msg ? g->z.msg : "no gzip data");
            return -1;
        }
    }
    return (ptrdiff_t)(size - g->z.avail_out);
}
