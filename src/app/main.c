/* meniscus: the first word names the command, and the command reads the rest. */
#include "app/app.h"

#include <stdio.h>
#include <string.h>

typedef struct command {
    const char *name, *doc;
    int (*run)(int argc, char **argv);
} command;

static const command COMMANDS[] = {
    {"render", "draw particles to an image, or a sequence of them", app_render},
    {"view", "look at particles in a window", app_view},
    {"compare", "draw by several methods: their errors against their times", app_compare},
    {"verify", "solve random pixels of a drawing again: is the picture right?", app_verify},
    {"info", "say what an input holds, or what OpenGL offers here", app_info},
};

enum { COMMAND_COUNT = sizeof COMMANDS / sizeof *COMMANDS };

static void print_help(void)
{
    puts("Usage: meniscus COMMAND [ARGUMENT...]\n"
         "Draws the exact surface of a particle field, straight from the particles.\n");
    for (int i = 0; i < COMMAND_COUNT; i++) printf("  %-10s %s\n", COMMANDS[i].name, COMMANDS[i].doc);
    puts("\n  --version  print the version and what was built in\n"
         "  --help     print this; \"meniscus COMMAND --help\" lists a command's options");
}

static int usage(const char *what, const char *word)
{
    mns_error error;
    char known[80] = "";
    for (int i = 0; i < COMMAND_COUNT; i++) {
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", COMMANDS[i].name);
    }
    app_fail(&error, MNS_ERROR_USAGE, "%s%.80s: expected a command (%s), --version or --help", what, word,
             known);
    return app_report(&error);
}

static int dispatch(int argc, char **argv)
{
    if (argc < 2) return usage("no command", "");
    const char *word = argv[1];
    if (strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0)
        return puts(mns_version()) < 0 ? APP_FAILED : APP_DONE;
    if (strcmp(word, "--help") == 0 || strcmp(word, "-?") == 0 || strcmp(word, "-h") == 0) {
        print_help();
        return APP_DONE;
    }
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(word, COMMANDS[i].name) == 0) return COMMANDS[i].run(argc - 1, argv + 1);
    return usage(word[0] == '-' ? "unknown option " : "unknown command ", word);
}

int main(int argc, char **argv)
{
    int result = dispatch(argc, argv);
    /* A full disk or a closed pipe shows only when the text is flushed. */
    if ((fflush(stdout) || ferror(stdout)) && result == APP_DONE) {
        mns_error error;
        app_fail(&error, MNS_ERROR_IO, "cannot write to standard output");
        result = app_report(&error);
    }
    return result;
}
