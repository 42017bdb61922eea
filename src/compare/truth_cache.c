#include "compare/truth_cache.h"

#include "base/store.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* The cache is let grow to this many bytes; a truth of 1024x768 pixels takes 51 MB. */
#define CACHE_BYTES ((uint64_t)1 << 30)

enum { PLANES = 7 + TRUTH_TERMS, FORMAT = 2 };

static const uint64_t MAGIC = 0x4854555254534e4du; /* "MNSTRUTH", read in this machine's order of bytes */

/* In front of the planes. No gaps: it is written as it lies. */
typedef struct cache_header {
    uint64_t magic;
    uint32_t format;
    uint16_t has_rgba, terms; /* bits: 1 << truth_term */
    int32_t width, height;
    char hash[TRUTH_HASH_SIZE - 1];
    double ms;
    uint64_t checksum; /* of the planes and ms */
} cache_header;

typedef struct cache_plane {
    void *data;
    size_t size;
} cache_plane;

static size_t list_planes(const truth_planes *p, cache_plane list[PLANES])
{
    size_t pixels = (size_t)p->width * (size_t)p->height, count = 5;
    list[0] = (cache_plane){p->t, pixels * sizeof *p->t};
    list[1] = (cache_plane){p->t_error, pixels * sizeof *p->t_error};
    list[2] = (cache_plane){p->normal, 3 * pixels * sizeof *p->normal};
    list[3] = (cache_plane){p->radius, pixels * sizeof *p->radius};
    list[4] = (cache_plane){p->certain, pixels * sizeof *p->certain};
    if (p->rgba) list[count++] = (cache_plane){p->rgba, 4 * pixels * sizeof *p->rgba};
    for (int i = 0; i < TRUTH_TERMS; i++)
        if (p->term[i]) list[count++] = (cache_plane){p->term[i], pixels * sizeof(float)};
    if (p->effects_certain) list[count++] = (cache_plane){p->effects_certain, pixels * sizeof(float)};
    return count;
}

static unsigned terms_of(const truth_planes *p)
{
    unsigned which = 0;
    for (int i = 0; i < TRUTH_TERMS; i++) which |= p->term[i] ? 1u << i : 0;
    return which;
}

static uint64_t checksum_of(double ms, const cache_plane *list, size_t count)
{
    uint64_t sum;
    memcpy(&sum, &ms, sizeof sum);
    for (size_t k = 0; k < count; k++) sum = store_sum(sum, list[k].data, list[k].size);
    return sum;
}

/* ---- Reading ---- */

static bool read_file(FILE *file, truth_planes *p)
{
    cache_header header;
    cache_plane plane[PLANES];
    struct stat about;
    if (fstat(fileno(file), &about) || fread(&header, sizeof header, 1, file) != 1) return false;
    if (header.magic != MAGIC || header.format != FORMAT || header.has_rgba != (p->rgba != NULL) ||
        header.width != p->width || header.height != p->height ||
        memcmp(header.hash, p->hash, sizeof header.hash) || header.terms >> TRUTH_TERMS)
        return false;
    if (!truth_allocate_effects(p, header.terms)) return false;
    size_t count = list_planes(p, plane), whole = sizeof header;
    for (size_t k = 0; k < count; k++) whole += plane[k].size;
    if (about.st_size != (off_t)whole) return false;
    for (size_t k = 0; k < count; k++)
        if (fread(plane[k].data, 1, plane[k].size, file) != plane[k].size) return false;
    p->ms = header.ms;
    return header.checksum == checksum_of(header.ms, plane, count);
}

bool truth_cache_read(truth_planes *planes)
{
    char folder[STORE_PATH];
    FILE *file = store_folder("truth", folder) ? store_open(folder, planes->hash, "truth") : NULL;
    bool good = file && read_file(file, planes);
    if (!good) truth_free_effects(planes);
    store_close(file, folder, planes->hash, "truth", good);
    return good;
}

/* ---- Writing ---- */

void truth_cache_write(truth_planes *planes)
{
    char folder[STORE_PATH];
    if (!store_folder("truth", folder)) {
        snprintf(planes->note, sizeof planes->note,
                 "the truth is not kept for the next time: neither XDG_CACHE_HOME nor HOME is set");
        return;
    }
    cache_plane plane[PLANES];
    store_part part[PLANES + 1];
    size_t count = list_planes(planes, plane);
    for (size_t k = 0; k < count; k++) part[k + 1] = (store_part){plane[k].data, plane[k].size};
    cache_header header = {.magic = MAGIC,
                           .format = FORMAT,
                           .has_rgba = planes->rgba != NULL,
                           .terms = (uint16_t)terms_of(planes),
                           .width = planes->width,
                           .height = planes->height,
                           .ms = planes->ms,
                           .checksum = checksum_of(planes->ms, plane, count)};
    memcpy(header.hash, planes->hash, sizeof header.hash);
    part[0] = (store_part){&header, sizeof header};
    char reason[64];
    int code = store_write(folder, planes->hash, "truth", part, count + 1, CACHE_BYTES);
    if (code)
        snprintf(planes->note, sizeof planes->note, "the truth is not kept for the next time: %.90s: %s",
                 folder, strerror_r(code, reason, sizeof reason));
}
