#include "app/names.h"

#include "app/app.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* Digits of a frame's number, at most. */
#define DIGITS_MAX 9

mns_status names_parse(const char *option, const char *text, names_pattern *pattern, mns_error *error)
{
    const char *percent = strchr(text, '%');
    *pattern = (names_pattern){.text = text, .before = strlen(text), .behind = ""};
    if (!percent) return MNS_OK;
    const char *c = percent + 1;
    pattern->is_numbered = true;
    pattern->before = (size_t)(percent - text);
    pattern->pads_zero = *c == '0';
    for (; isdigit((unsigned char)*c) && pattern->digits <= DIGITS_MAX; c++)
        pattern->digits = 10 * pattern->digits + *c - '0';
    if (*c != 'd' || pattern->digits > DIGITS_MAX || strpbrk(c, "%/"))
        return app_fail(
            error, MNS_ERROR_USAGE,
            "%s %.200s: expected at most one '%%' in it, %%d or %%04d in the file's name for the frame's "
            "number",
            option, text);
    pattern->behind = c + 1;
    return MNS_OK;
}

char *names_expand(const names_pattern *pattern, long index)
{
    char number[32] = "", *name;
    if (pattern->is_numbered)
        snprintf(number, sizeof number, pattern->pads_zero ? "%0*ld" : "%*ld", pattern->digits, index);
    size_t size = pattern->before + strlen(number) + strlen(pattern->behind) + 1;
    name = malloc(size);
    if (name) snprintf(name, size, "%.*s%s%s", (int)pattern->before, pattern->text, number, pattern->behind);
    return name;
}

mns_status names_check_ending(const char *option, const char *text, bool exr_only, mns_error *error)
{
    const char *slash = strrchr(text, '/'), *file = slash ? slash + 1 : text, *ending = strrchr(file, '.');
    bool is_named = ending && ending > file;
    if (is_named && strcasecmp(ending, ".exr") == 0) return MNS_OK;
    if (is_named && !exr_only && strcasecmp(ending, ".png") == 0) return MNS_OK;
    return app_fail(error, MNS_ERROR_USAGE, "%s %.200s: unknown ending; expected %s", option, text,
                    exr_only ? "FILE.exr" : "FILE.png or FILE.exr");
}

mns_status names_check_place(const char *path, mns_error *error)
{
    const char *slash = strrchr(path, '/');
    size_t length = slash ? (size_t)(slash - path) + 1 : 1;
    char *folder = strndup(slash ? path : ".", length);
    if (!folder) return app_fail(error, MNS_ERROR_MEMORY, "out of memory reading the command line");
    struct stat about;
    mns_status status = MNS_OK;
    if (access(folder, W_OK | X_OK))
        status = app_fail(error, MNS_ERROR_IO, "%.200s: cannot write in the folder %.160s: %s", path, folder,
                          strerror(errno));
    else if (stat(path, &about) == 0 && !S_ISREG(about.st_mode))
        status = app_fail(error, MNS_ERROR_IO, "%.300s: is not a regular file; give another name", path);
    free(folder);
    return status;
}
