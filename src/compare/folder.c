#include "compare/folder.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static mns_status failed(const char *path, const char *what, int code, mns_error *error)
{
    char reason[96];
    return status_fail(error, MNS_ERROR_IO, "%.300s: cannot %s: %s", path, what,
                       strerror_r(code ? code : EIO, reason, sizeof reason));
}

char *folder_file(const folder_output *output, const char *name)
{
    char *path = NULL;
    return asprintf(&path, "%s/%s", output->temporary, name) < 0 ? NULL : path;
}

/* Removes the files of a folder, which has no folders in it, and the folder. */
static void remove_folder(const char *path)
{
    DIR *list = opendir(path);
    if (!list) return;
    for (struct dirent *entry; (entry = readdir(list));)
        if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, ".."))
            unlinkat(dirfd(list), entry->d_name, 0);
    closedir(list);
    rmdir(path);
}

/* The name of something in the folder that is no file of a comparison; false where there is none. */
static bool find_strange(const char *path, char name[256])
{
    static const char *const ours[] = {".",          "..",        "results.csv", "results.json",
                                       "index.html", "chart.dat", "chart.gp",    "chart.svg"};
    DIR *list = opendir(path);
    bool strange = false;
    for (struct dirent *entry; list && !strange && (entry = readdir(list));) {
        strange = true;
        for (size_t i = 0; i < sizeof ours / sizeof *ours; i++)
            if (!strcmp(entry->d_name, ours[i])) strange = false;
        snprintf(name, 256, "%s", entry->d_name);
    }
    if (list) closedir(list);
    return strange;
}

/* Is there a folder to make the new one in? */
static mns_status check_parent(const char *path, mns_error *error)
{
    char *parent = strdup(path);
    if (!parent) return status_no_memory(error, "naming a folder");
    size_t length = strlen(parent);
    while (length > 1 && parent[length - 1] == '/') length--;
    while (length > 0 && parent[length - 1] != '/') length--;
    parent[length] = '\0';
    int code = access(length ? parent : ".", W_OK | X_OK) ? errno : 0;
    free(parent);
    return code ? failed(path, "write", code, error) : MNS_OK;
}

mns_status folder_check(const char *path, mns_error *error)
{
    struct stat about;
    if (!*path)
        return status_fail(error, MNS_ERROR_USAGE, "the folder for the results has no name; give one");
    mns_status status = check_parent(path, error);
    if (status) return status;
    if (stat(path, &about)) return errno == ENOENT ? MNS_OK : failed(path, "look there", errno, error);
    if (!S_ISDIR(about.st_mode))
        return status_fail(error, MNS_ERROR_IO, "%.300s: is no folder; give another name", path);
    char name[256];
    if (!find_strange(path, name)) return MNS_OK;
    return status_fail(error, MNS_ERROR_IO,
                       "%.200s: has %.100s in it, which is no file of a comparison; give another name", path,
                       name);
}

mns_status folder_begin(folder_output *output, const char *path, mns_error *error)
{
    *output = (folder_output){.path = strdup(path)};
    if (!output->path) return status_no_memory(error, "naming a folder");
    for (size_t n = strlen(output->path); n > 1 && output->path[n - 1] == '/'; n--)
        output->path[n - 1] = '\0';
    mns_status status = folder_check(output->path, error);
    if (!status && asprintf(&output->temporary, "%s.meniscus-%ld.part", output->path, (long)getpid()) < 0) {
        output->temporary = NULL;
        status = status_no_memory(error, "naming a folder");
    }
    if (!status && mkdir(output->temporary, 0777)) status = failed(output->path, "write", errno, error);
    if (!status) return MNS_OK;
    free(output->path);
    free(output->temporary);
    *output = (folder_output){0};
    return status;
}

mns_status folder_commit(folder_output *output, mns_error *error)
{
    char *aside = NULL;
    mns_status status = folder_check(output->path, error); /* much may have happened since */
    if (!status && asprintf(&aside, "%s.old", output->temporary) < 0) {
        aside = NULL;
        status = status_no_memory(error, "naming a folder");
    }
    bool moved = !status && !rename(output->path, aside);
    if (!status && !moved && errno != ENOENT) status = failed(output->path, "replace", errno, error);
    if (!status && rename(output->temporary, output->path)) {
        status = failed(output->path, "write", errno, error);
        if (moved) rename(aside, output->path);
        moved = false;
    }
    if (moved) remove_folder(aside);
    free(aside);
    if (status) {
        folder_discard(output);
        return status;
    }
    free(output->path);
    free(output->temporary);
    *output = (folder_output){0};
    return MNS_OK;
}

void folder_discard(folder_output *output)
{
    if (!output->temporary) return;
    remove_folder(output->temporary);
    free(output->path);
    free(output->temporary);
    *output = (folder_output){0};
}
