/* Keys and the actions that they stand for. */
#ifndef MNS_WINDOW_KEYS_H
#define MNS_WINDOW_KEYS_H

#include <stdbool.h>

typedef struct key_row {
    int key, mods; /* as GLFW has them; key 0: it is the character that counts, whichever key gives it */
    const char *name, *action, *doc;
    bool repeats; /* while it is held */
} key_row;

/* The row of a key that was pressed; of a character that was typed; of that name ("F5", "ctrl+S"); NULL: it
 * stands for nothing. */
const key_row *key_of(int key, int mods);
const key_row *key_typed(unsigned character);
const key_row *key_named(const char *name);
/* Row `index`; NULL from the last on. */
const key_row *key_at(int index);

#endif
