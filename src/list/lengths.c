#include "list/lengths.h"

#include "base/memory.h"

#include <stdlib.h>

static uint32_t walk(uint32_t head, const uint32_t *nodes, size_t count)
{
    uint32_t length = 0;
    while (head && head < count && length < count) {
        head = nodes[4 * (size_t)head + 1];
        length++;
    }
    return length;
}

bool list_lengths_add(list_lengths *lengths, list_passes *p, gl_device *device, list_region region,
                      size_t nodes)
{
    const GladGLContext *gl = &device->gl;
    size_t pixels = (size_t)region.width * (size_t)region.height;
    uint32_t *larger = memory_resize(lengths->length, lengths->count + pixels, sizeof *larger);
    if (larger) lengths->length = larger;
    uint32_t *head = memory_array(pixels, sizeof *head), *pool = memory_array(nodes, LIST_NODE);
    bool good = larger && head && pool;
    if (good) {
        gl->BindFramebuffer(GL_READ_FRAMEBUFFER, p->heads_target);
        gl->ReadPixels(region.x, region.y, region.width, region.height, GL_RED_INTEGER, GL_UNSIGNED_INT,
                       head);
        gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, p->nodes.id);
        gl->GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, (GLsizeiptr)(nodes * LIST_NODE), pool);
        for (size_t i = 0; i < pixels; i++) {
            uint32_t length = walk(head[i], pool, nodes);
            if (length) lengths->length[lengths->count++] = length;
        }
    }
    free(head);
    free(pool);
    return good;
}

bool list_lengths_share(list_lengths *lengths, uint32_t length, size_t pixels)
{
    if (!length) return true;
    uint32_t *larger = memory_resize(lengths->length, lengths->count + pixels, sizeof *larger);
    if (!larger) return false;
    lengths->length = larger;
    for (size_t i = 0; i < pixels; i++) larger[lengths->count++] = length;
    return true;
}

static int ascending(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

void list_lengths_finish(list_lengths *lengths, mns_stats *stats)
{
    size_t count = lengths->count;
    if (count) {
        uint64_t sum = 0;
        qsort(lengths->length, count, sizeof *lengths->length, ascending);
        for (size_t i = 0; i < count; i++) sum += lengths->length[i];
        stats->list_mean = (double)sum / (double)count;
        size_t last_but_1_percent = (count - 1) * 99 / 100;
        stats->list_p99 = lengths->length[last_but_1_percent];
        stats->list_max = lengths->length[count - 1];
    }
    free(lengths->length);
    *lengths = (list_lengths){0};
}
