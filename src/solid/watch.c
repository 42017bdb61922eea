#include "solid/watch.h"

#include "base/memory.h"

#include <string.h>

static bool is_noted(const watch *w, const char *name)
{
    for (size_t i = 0; i < w->count; i++)
        if (!strcmp(w->file[i].name, name)) return true;
    return false;
}

bool watch_note(watch *w, const char *name, const struct stat *about)
{
    if (is_noted(w, name)) return true; /* as it was when it was opened first */
    watch_file *file = memory_resize(w->file, w->count + 1, sizeof *file);
    if (file) w->file = file;
    char *copy = file ? strdup(name) : NULL;
    if (copy)
        w->file[w->count++] = (watch_file){copy, about->st_mtim, about->st_size};
    else
        w->failed = true;
    return copy != NULL;
}

static bool is_same(const watch_file *f)
{
    struct stat about;
    return !stat(f->name, &about) && about.st_size == f->size && about.st_mtim.tv_sec == f->time.tv_sec &&
           about.st_mtim.tv_nsec == f->time.tv_nsec;
}

bool watch_is_same(const watch *w)
{
    for (size_t i = 0; i < w->count; i++)
        if (!is_same(&w->file[i])) return false;
    return !w->failed;
}

void watch_free(watch *w)
{
    for (size_t i = 0; i < w->count; i++) free(w->file[i].name);
    free(w->file);
    *w = (watch){0};
}
