/* Build tool: writes files as a C table of {name, text, size}, byte for byte.
 * usage: embed_page OUTPUT.c FILE ... */
#include "embed.h"

enum { LINE = 96 };

/* Returns 0, or 1 where the file cannot be read. */
static int embed(FILE *out, const char *path)
{
    FILE *in = embed_begin(out, path);
    if (!in) return 1;
    size_t size = 0;
    for (int c = fgetc(in); c != EOF; c = fgetc(in), size++) {
        if (size && size % LINE == 0) fputs("\"\n     \"", out);
        embed_put(out, c);
    }
    fprintf(out, "\",\n     %zu},\n", size);
    fclose(in);
    return 0;
}

int main(int count, char **arguments)
{
    if (count < 2) return 2;
    FILE *out = fopen(arguments[1], "w");
    if (!out) return 1;
    fputs("#include \"compare/page_text.h\"\n\nconst page_text page_texts[] = {\n", out);
    int failed = 0;
    for (int i = 2; i < count; i++) failed |= embed(out, arguments[i]);
    fputs("    {NULL, NULL, 0},\n};\n", out);
    return fclose(out) || failed;
}
