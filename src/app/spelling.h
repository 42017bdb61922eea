/* Which known name a misspelt one was meant to be. */
#ifndef MNS_APP_SPELLING_H
#define MNS_APP_SPELLING_H

#include <stddef.h>

/* How many letters to add, drop, change or exchange with their neighbour make `name` of the first `length`
 * bytes of `word`; SPELLING_FAR where it is more than any slip is, or one of them is too long to ask. */
enum { SPELLING_FAR = 3 };
size_t spelling_slips(const char *word, size_t length, const char *name);

#endif
