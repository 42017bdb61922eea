#include "support/cli.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static void path_of(const cli *c, const char *name, char path[256])
{
    snprintf(path, 256, "%s/%s", c->folder, name);
}

void cli_setup(cli *c, const char *program)
{
    memset(c, 0, sizeof *c);
    c->program = program;
    strcpy(c->folder, "/tmp/meniscus-cli-XXXXXX");
    assert_non_null(mkdtemp(c->folder));
}

void cli_teardown(cli *c)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", c->folder);
    assert_int_equal(system(command), 0);
}

/* What a run printed, kept beside the folder; removed once read. */
static void take_text(const cli *c, const char *ending, char *text, size_t size)
{
    char path[256];
    snprintf(path, sizeof path, "%s%s", c->folder, ending);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    size_t length = fread(text, 1, size - 1, file);
    text[length] = '\0';
    fclose(file);
    unlink(path);
}

void cli_run(cli *c, const char *arguments, ...)
{
    char words[1 << 12], command[1 << 13];
    va_list list;
    va_start(list, arguments);
    vsnprintf(words, sizeof words, arguments, list);
    va_end(list);
    snprintf(command, sizeof command, "cd '%s' && { '%s' %s ; } >'%s.out' 2>'%s.err' </dev/null", c->folder,
             c->program, words, c->folder, c->folder);
    int result = system(command);
    assert_true(WIFEXITED(result));
    c->status = WEXITSTATUS(result);
    take_text(c, ".out", c->out, sizeof c->out);
    take_text(c, ".err", c->err, sizeof c->err);
    if (c->status > 2) fail_msg("exit status %d of %s: %s", c->status, words, c->err);
}

void cli_expect(const cli *c, int status)
{
    if (c->status != status) fail_msg("exit status %d, expected %d: %s", c->status, status, c->err);
}

void cli_expect_error(const cli *c, int status, const char *word)
{
    cli_expect(c, status);
    assert_string_equal(c->out, "");
    const char *end = strchr(c->err, '\n');
    if (!end || end[1] || strncmp(c->err, "meniscus: ", 10))
        fail_msg("not one line of error: \"%s\"", c->err);
    if (!strstr(c->err, word)) fail_msg("\"%s\" does not say \"%s\"", c->err, word);
}

void cli_write(const cli *c, const char *name, const char *text)
{
    char path[256];
    path_of(c, name, path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

bool cli_exists(const cli *c, const char *name)
{
    char path[256];
    path_of(c, name, path);
    return access(path, F_OK) == 0;
}

size_t cli_count_files(const cli *c)
{
    DIR *folder = opendir(c->folder);
    assert_non_null(folder);
    size_t count = 0;
    for (struct dirent *entry; (entry = readdir(folder));)
        if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..")) count++;
    closedir(folder);
    return count;
}

char *cli_read(const cli *c, const char *name, size_t *size)
{
    char path[256];
    path_of(c, name, path);
    FILE *file = fopen(path, "rb");
    if (!file) fail_msg("%s: is not there", path);
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    bytes[*size] = '\0';
    fclose(file);
    return bytes;
}
