#include "compare/truth_cache.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The cache is let grow to this many bytes; a truth of 1024x768 pixels takes 51 MB. */
#define CACHE_BYTES ((off_t)1 << 30)

enum { PATH_SIZE = 3000, PLANES = 6, FORMAT = 1 };

static const uint64_t MAGIC = 0x4854555254534e4du; /* "MNSTRUTH", read in this machine's order of bytes */

/* In front of the planes. No gaps: it is written as it lies. */
typedef struct cache_header {
    uint64_t magic;
    uint32_t format, has_rgba;
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
    return count;
}

static uint64_t checksum_of(double ms, const cache_plane *list, size_t count)
{
    uint64_t sum;
    memcpy(&sum, &ms, sizeof sum);
    for (size_t k = 0; k < count; k++) {
        const unsigned char *bytes = list[k].data;
        for (size_t i = 0; i < list[k].size; i += 8) {
            uint64_t word = 0;
            memcpy(&word, bytes + i, list[k].size - i < 8 ? list[k].size - i : 8);
            sum = (sum ^ word) * 0xff51afd7ed558ccdu;
            sum ^= sum >> 32;
        }
    }
    return sum;
}

/* ---- Places
 * -------------------------------------------------------------------------------------------------------- */

/* Makes every folder of the path that is not there; false where one cannot be. */
static bool make_folders(char *path)
{
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        bool there = !mkdir(path, 0777) || errno == EEXIST;
        *slash = '/';
        if (!there) return false;
    }
    return !mkdir(path, 0777) || errno == EEXIST;
}

/* The cache's folder, by the XDG base directory specification: a relative path in the variable is to be
 * passed over. */
static bool cache_folder(char path[PATH_SIZE])
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length = -1;
    if (cache && *cache == '/')
        length = snprintf(path, PATH_SIZE, "%s/meniscus/truth", cache);
    else if (home && *home == '/')
        length = snprintf(path, PATH_SIZE, "%s/.cache/meniscus/truth", home);
    return length > 0 && length < PATH_SIZE - 100;
}

/* ---- Reading
 * ------------------------------------------------------------------------------------------------------- */

static bool read_file(FILE *file, truth_planes *p)
{
    cache_header header;
    cache_plane plane[PLANES];
    size_t count = list_planes(p, plane), whole = sizeof header;
    for (size_t k = 0; k < count; k++) whole += plane[k].size;
    struct stat about;
    if (fstat(fileno(file), &about) || about.st_size != (off_t)whole) return false;
    if (fread(&header, sizeof header, 1, file) != 1) return false;
    if (header.magic != MAGIC || header.format != FORMAT || header.has_rgba != (p->rgba != NULL) ||
        header.width != p->width || header.height != p->height ||
        memcmp(header.hash, p->hash, sizeof header.hash))
        return false;
    for (size_t k = 0; k < count; k++)
        if (fread(plane[k].data, 1, plane[k].size, file) != plane[k].size) return false;
    p->ms = header.ms;
    return header.checksum == checksum_of(header.ms, plane, count);
}

bool truth_cache_read(truth_planes *planes)
{
    char path[PATH_SIZE];
    if (!cache_folder(path)) return false;
    size_t used = strlen(path);
    snprintf(path + used, sizeof path - used, "/%s.truth", planes->hash);
    int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return false;
    FILE *file = fdopen(descriptor, "rb");
    bool good = file && read_file(file, planes);
    if (file)
        fclose(file);
    else
        close(descriptor);
    if (good)
        utimensat(AT_FDCWD, path, NULL, 0); /* the oldest is what was not used for longest */
    else
        unlink(path);
    return good;
}

/* ---- Writing
 * ------------------------------------------------------------------------------------------------------- */

static bool write_file(FILE *file, const truth_planes *p)
{
    cache_plane plane[PLANES];
    size_t count = list_planes(p, plane);
    cache_header header = {.magic = MAGIC,
                           .format = FORMAT,
                           .has_rgba = p->rgba != NULL,
                           .width = p->width,
                           .height = p->height,
                           .ms = p->ms,
                           .checksum = checksum_of(p->ms, plane, count)};
    memcpy(header.hash, p->hash, sizeof header.hash);
    bool good = fwrite(&header, sizeof header, 1, file) == 1;
    for (size_t k = 0; k < count && good; k++)
        good = fwrite(plane[k].data, 1, plane[k].size, file) == plane[k].size;
    return good;
}

/* Removes the truth that was not used for longest; false where the cache is within its size, or cannot be
 * seen through. */
static bool remove_oldest(const char *folder)
{
    char path[PATH_SIZE + 256], oldest[PATH_SIZE + 256] = "";
    struct timespec least = {0};
    off_t total = 0;
    DIR *list = opendir(folder);
    if (!list) return false;
    for (struct dirent *entry; (entry = readdir(list));) {
        struct stat about;
        size_t length = strlen(entry->d_name);
        if (length != TRUTH_HASH_SIZE + 5 || strcmp(entry->d_name + length - 6, ".truth")) continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (stat(path, &about)) continue;
        total += about.st_size;
        bool older = about.st_mtim.tv_sec < least.tv_sec ||
                     (about.st_mtim.tv_sec == least.tv_sec && about.st_mtim.tv_nsec < least.tv_nsec);
        if (*oldest && !older) continue;
        least = about.st_mtim;
        memcpy(oldest, path, sizeof oldest);
    }
    closedir(list);
    return total > CACHE_BYTES && unlink(oldest) == 0;
}

void truth_cache_write(truth_planes *planes)
{
    char folder[PATH_SIZE], path[PATH_SIZE + 64], beside[PATH_SIZE + 64];
    if (!cache_folder(folder)) {
        snprintf(planes->note, sizeof planes->note,
                 "the truth is not kept for the next time: neither XDG_CACHE_HOME nor HOME is set");
        return;
    }
    snprintf(path, sizeof path, "%s/%s.truth", folder, planes->hash);
    snprintf(beside, sizeof beside, "%s/.%s-%ld.part", folder, planes->hash, (long)getpid());
    errno = 0;
    FILE *file = make_folders(folder) ? fopen(beside, "wbx") : NULL;
    bool good = file && write_file(file, planes);
    if (file && fclose(file)) good = false;
    good = good && !rename(beside, path);
    int code = errno;
    if (file && !good) unlink(beside);
    if (good) {
        while (remove_oldest(folder)) continue;
        return;
    }
    char reason[64];
    snprintf(planes->note, sizeof planes->note, "the truth is not kept for the next time: %.90s: %s", folder,
             strerror_r(code ? code : EIO, reason, sizeof reason));
}
