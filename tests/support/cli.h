/* Runs the program as a user would, in a new folder of its own. */
#ifndef MNS_TESTS_CLI_H
#define MNS_TESTS_CLI_H

#include <stdbool.h>
#include <stddef.h>

typedef struct cli {
    const char *program;
    char folder[64];
    int status;                      /* of the last run: its exit status */
    char out[1 << 16], err[1 << 13]; /* what it printed */
} cli;

/* Makes the folder. */
void cli_setup(cli *c, const char *program);
/* Removes it, with all that is in it. */
void cli_teardown(cli *c);

/* Runs `program ARGUMENTS` in the folder, the arguments being a shell's words; fails the test if a signal
 * ended it. */
void cli_run(cli *c, const char *arguments, ...) __attribute__((format(printf, 2, 3)));
/* Fails the test unless the last run ended with `status`. */
void cli_expect(const cli *c, int status);
/* Fails the test unless it ended with `status`, nothing but one line "meniscus: ..." printed, `word` in it.
 */
void cli_expect_error(const cli *c, int status, const char *word);

/* A file of the folder, written or looked for. */
void cli_write(const cli *c, const char *name, const char *text);
bool cli_exists(const cli *c, const char *name);
/* Names in the folder, hidden ones too. */
size_t cli_count_files(const cli *c);
/* The whole file, for the caller to free. */
char *cli_read(const cli *c, const char *name, size_t *size);

#endif
