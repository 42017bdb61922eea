/* Build tool: writes glsl files as a C table of {name, text}, comments stripped and line counts kept.
 * usage: embed_glsl OUTPUT.c NAME FILE.glsl ..., NAME being that of the table */
#include "embed.h"

/* Writes one C string literal a line of the source; returns 0, or 1 where the file cannot be read. */
static int embed(FILE *out, const char *path)
{
    FILE *in = embed_begin(out, path);
    if (!in) return 1;
    enum { CODE, LINE_COMMENT, BLOCK_COMMENT } state = CODE;
    for (int c = fgetc(in), next; c != EOF; c = next) {
        next = fgetc(in);
        if (c == '\n') {
            if (state == LINE_COMMENT) state = CODE;
            fputs("\\n\"\n     \"", out);
        } else if (state == CODE && c == '/' && (next == '/' || next == '*')) {
            state = next == '/' ? LINE_COMMENT : BLOCK_COMMENT;
            next = fgetc(in);
        } else if (state == BLOCK_COMMENT && c == '*' && next == '/') {
            state = CODE;
            next = fgetc(in);
        } else if (state == CODE) {
            embed_put(out, c);
        }
    }
    fputs("\"},\n", out);
    fclose(in);
    return 0;
}

int main(int count, char **arguments)
{
    if (count < 3) return 2;
    FILE *out = fopen(arguments[1], "w");
    if (!out) return 1;
    fputs("#include \"gl/glsl_text.h\"\n\n#include <stddef.h>\n\n", out);
    fprintf(out, "extern const glsl_text %s[];\nconst glsl_text %s[] = {\n", arguments[2], arguments[2]);
    int failed = 0;
    for (int i = 3; i < count; i++) failed |= embed(out, arguments[i]);
    fputs("    {NULL, NULL},\n};\n", out);
    return fclose(out) || failed;
}
