/* What the build tools share that write files as C tables. */
#ifndef MNS_EMBED_H
#define MNS_EMBED_H

#include <stdio.h>
#include <string.h>

/* A byte within a C string literal. */
static inline void embed_put(FILE *out, int c)
{
    if (c == '"' || c == '\\') {
        fprintf(out, "\\%c", c);
    } else if (c < 0x20 || c >= 0x7f || c == '?') { /* three digits end an escape; "??" would be a trigraph */
        fprintf(out, "\\%03o", (unsigned)c);
    } else {
        fputc(c, out);
    }
}

/* Opens a file and begins its row of the table, up to where its text does; NULL where it cannot be read. */
static inline FILE *embed_begin(FILE *out, const char *path)
{
    FILE *in = fopen(path, "rb");
    if (!in) {
        fprintf(stderr, "%s: cannot be read; expected a file to embed\n", path);
        return NULL;
    }
    const char *slash = strrchr(path, '/');
    fprintf(out, "    {\"%s\",\n     \"", slash ? slash + 1 : path);
    return in;
}

#endif
