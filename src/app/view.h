/* meniscus view: the options of `render`, and those of a window. */
#ifndef MNS_APP_VIEW_H
#define MNS_APP_VIEW_H

#include "app/options.h"
#include "window/window.h"

/* A command line that changes while the window is open: its words are read anew for every change, so that
 * what a window does is what an option does. */
typedef struct view_words {
    char **word; /* the command's name first */
    size_t count;
} view_words;

/* A copy; false: out of memory. */
bool view_words_copy(view_words *to, char *const *word, size_t count);
void view_words_free(view_words *words);
/* Takes every --NAME out, and puts --NAME=VALUE at the end (NULL: not). False: out of memory. */
bool view_words_set(view_words *words, const option_table *table, const char *name, const char *value);
/* Other inputs in place of those that are there. False: out of memory. */
bool view_words_inputs(view_words *words, const option_table *table, const char *const *names, size_t count);
/* The words that are options, for a shell, but for those named by `without`, which NULL ends; for free(). */
char *view_words_shell(const view_words *words, const option_table *table, const char *const *without);

/* The table, made of that of `render`; its rows are for free(). NULL rows: out of memory. */
option_table view_options(void);

#endif
