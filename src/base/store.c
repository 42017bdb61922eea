#include "base/store.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { NAME_SIZE = 200, ORPHAN_SECONDS = 3600 };

bool store_folder(const char *kind, char folder[STORE_PATH])
{
    /* By the XDG base directory specification a relative path in the variable is to be passed over. */
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length = -1;
    if (cache && *cache == '/')
        length = snprintf(folder, STORE_PATH, "%s/meniscus/%s", cache, kind);
    else if (home && *home == '/')
        length = snprintf(folder, STORE_PATH, "%s/.cache/meniscus/%s", home, kind);
    return length > 0 && length < STORE_PATH;
}

/* Makes every folder of the path that is not there; false where one cannot be. */
static bool make_folders(const char *folder)
{
    char path[STORE_PATH];
    size_t length = strlen(folder);
    if (!length || length >= sizeof path) return false;
    memcpy(path, folder, length + 1);
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        bool there = !mkdir(path, 0777) || errno == EEXIST;
        *slash = '/';
        if (!there) return false;
    }
    return !mkdir(path, 0777) || errno == EEXIST;
}

static void path_of(char path[STORE_PATH + NAME_SIZE], const char *folder, const char *name,
                    const char *ending)
{
    snprintf(path, STORE_PATH + NAME_SIZE, "%.*s/%.150s.%.40s", STORE_PATH - 1, folder, name, ending);
}

/* ---- Reading ---- */

FILE *store_open(const char *folder, const char *name, const char *ending)
{
    char path[STORE_PATH + NAME_SIZE];
    path_of(path, folder, name, ending);
    int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* opening a pipe must not wait */
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "rb") : NULL;
    if (descriptor >= 0 && !file) close(descriptor);
    return file;
}

void store_close(FILE *file, const char *folder, const char *name, const char *ending, bool good)
{
    char path[STORE_PATH + NAME_SIZE];
    if (!file) return;
    fclose(file);
    path_of(path, folder, name, ending);
    if (good)
        utimensat(AT_FDCWD, path, NULL, 0); /* the oldest is what was not used for longest */
    else
        unlink(path);
}

/* ---- Writing ---- */

/* What a writer that was ended left behind: one that still writes takes seconds. */
static bool is_orphan(const char *name, const struct stat *about)
{
    const char *point = strrchr(name, '.');
    return name[0] == '.' && point && strcmp(point, ".part") == 0 && S_ISREG(about->st_mode) &&
           about->st_mtim.tv_sec < time(NULL) - ORPHAN_SECONDS;
}

static bool has_ending(const char *name, const char *ending)
{
    const char *point = strrchr(name, '.');
    return name[0] != '.' && point && strcmp(point + 1, ending) == 0;
}

/* Removes the file of that ending that was not used for longest, and all orphans; false where all files are
 * within `most` bytes, or cannot be seen through. */
static bool remove_oldest(const char *folder, const char *ending, uint64_t most)
{
    char path[STORE_PATH + 300], oldest[STORE_PATH + 300] = "";
    struct timespec least = {0};
    uint64_t total = 0;
    DIR *list = opendir(folder);
    if (!list) return false;
    for (struct dirent *entry; (entry = readdir(list));) {
        struct stat about;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (stat(path, &about)) continue;
        if (is_orphan(entry->d_name, &about)) unlink(path);
        if (!has_ending(entry->d_name, ending) || !S_ISREG(about.st_mode)) continue;
        total += (uint64_t)about.st_size;
        bool older = about.st_mtim.tv_sec < least.tv_sec ||
                     (about.st_mtim.tv_sec == least.tv_sec && about.st_mtim.tv_nsec < least.tv_nsec);
        if (*oldest && !older) continue;
        least = about.st_mtim;
        memcpy(oldest, path, sizeof oldest);
    }
    closedir(list);
    return total > most && unlink(oldest) == 0;
}

static bool write_parts(FILE *file, const store_part *part, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (fwrite(part[i].data, 1, part[i].size, file) != part[i].size) return false;
    return true;
}

int store_write(const char *folder, const char *name, const char *ending, const store_part *part,
                size_t count, uint64_t most)
{
    char path[STORE_PATH + NAME_SIZE], beside[STORE_PATH + NAME_SIZE];
    path_of(path, folder, name, ending);
    snprintf(beside, sizeof beside, "%.*s/.%.100s-%ld.part", STORE_PATH - 1, folder, name, (long)getpid());
    errno = 0;
    FILE *file = make_folders(folder) ? fopen(beside, "wbxe") : NULL;
    bool good = file && write_parts(file, part, count);
    if (file && fclose(file)) good = false;
    good = good && !rename(beside, path);
    int code = errno;
    if (file && !good) unlink(beside);
    if (!good) return code ? code : EIO;
    while (remove_oldest(folder, ending, most)) continue;
    return 0;
}

uint64_t store_sum(uint64_t sum, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i += 8) {
        uint64_t word = 0;
        memcpy(&word, bytes + i, size - i < 8 ? size - i : 8);
        sum = (sum ^ word) * 0xff51afd7ed558ccdu;
        sum ^= sum >> 32;
    }
    return sum;
}
