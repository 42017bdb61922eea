/* The stream: bytes that may be gzip are read to their end twice, alike; and packed here, they give the lines
 * that they give plain. */
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "load/stream.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Lines up to the end or a failure, each as length and bytes, in a sum. */
static uint64_t sum_lines(load_stream *s)
{
    uint64_t sum = 1;
    load_text line;
    while (stream_line(s, &line)) {
        for (const char *c = line.at; c < line.end; c++) sum = sum * 31 + (unsigned char)*c;
        sum = sum * 31 + 257;
    }
    return sum;
}

static void read_twice(const uint8_t *data, size_t size)
{
    load_stream s;
    mns_error error = {0};
    if (!stream_open_memory(&s, data, size, "memory", &error)) {
        load_place start = stream_place(&s);
        uint64_t first = sum_lines(&s);
        mns_status status = s.status;
        if (stream_seek(&s, start) || sum_lines(&s) != first || s.status != status) __builtin_trap();
    } else if (!error.text[0]) {
        __builtin_trap();
    }
    stream_close(&s);
}

static uint64_t sum_of(const uint8_t *data, size_t size)
{
    load_stream s;
    uint64_t sum = 0;
    if (!stream_open_memory(&s, data, size, "memory", NULL)) sum = sum_lines(&s);
    stream_close(&s);
    return sum;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_twice(data, size);
    if (size < 2 || data[0] == 0x1f) return 0;
    uLong room = compressBound(size) + 64;
    z_stream z = {0};
    uint8_t *packed = malloc(room);
    if (!packed || deflateInit2(&z, 1, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) abort();
    z.next_in = (Bytef *)data, z.avail_in = (uInt)size;
    z.next_out = packed, z.avail_out = (uInt)room;
    if (deflate(&z, Z_FINISH) != Z_STREAM_END) abort();
    if (sum_of(packed, z.total_out) != sum_of(data, size)) __builtin_trap();
    deflateEnd(&z);
    free(packed);
    return 0;
}
