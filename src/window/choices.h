/* Settings that are chosen by name: for keys that take the next one, and for the panel. */
#ifndef MNS_WINDOW_CHOICES_H
#define MNS_WINDOW_CHOICES_H

#include "window/viewer.h"

enum { CHOICE_NAMES = 64 };

/* A choice as it is now; the names live as long as the field and the settings. */
typedef struct choice {
    const char *label, *action; /* see panel_choice */
    const char *names[CHOICE_NAMES];
    int count, now; /* now: -1 where none of them is chosen */
} choice;

/* Choice `index`, or that of a name; false: there is none. */
bool choice_at(const viewer *v, int index, choice *c);
bool choice_named(const viewer *v, const char *name, choice *c);

#endif
