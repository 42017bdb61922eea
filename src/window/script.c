#include "window/script.h"

#include "base/status.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SCRIPT_MOST = 1 << 20 };

mns_status script_read(script *s, const char *path, mns_error *error)
{
    memset(s, 0, sizeof *s);
    FILE *file = fopen(path, "r");
    if (!file)
        return status_fail(error, MNS_ERROR_IO, "%s: cannot read the script: %s", path, strerror(errno));
    char *text = malloc(SCRIPT_MOST + 1);
    size_t size = text ? fread(text, 1, SCRIPT_MOST + 1, file) : 0;
    bool failed = ferror(file);
    fclose(file);
    if (!text) return status_no_memory(error, "reading a script");
    if (failed || size > SCRIPT_MOST) {
        free(text);
        return status_fail(error, MNS_ERROR_IO,
                           "%s: cannot read the script: expected a file of at most %d bytes", path,
                           SCRIPT_MOST);
    }
    text[size] = '\0';
    *s = (script){.path = path, .text = text, .next = text};
    return MNS_OK;
}

void script_free(script *s)
{
    free(s->text);
    memset(s, 0, sizeof *s);
}

char *script_next(script *s)
{
    while (s->next && *s->next) {
        char *line = s->next, *end = line + strcspn(line, "\n");
        s->next = *end ? end + 1 : end;
        s->line++;
        while (end > line && strchr(" \t\r\n", end[-1])) end--;
        *end = '\0';
        line += strspn(line, " \t");
        if (*line && *line != '#') return line;
    }
    s->next = NULL;
    return NULL;
}
