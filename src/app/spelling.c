#include "app/spelling.h"

#include <string.h>

enum { LONGEST = 32 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The restricted edit distance (Damerau 1964), a row a letter of `word`. */
size_t spelling_slips(const char *word, size_t length, const char *name)
{
    size_t size = strlen(name), rows[3][LONGEST + 1];
    if (length > LONGEST || size > LONGEST) return SPELLING_FAR;
    for (size_t k = 0; k <= size; k++) rows[0][k] = k;
    for (size_t i = 1; i <= length; i++) {
        size_t *row = rows[i % 3];
        const size_t *above = rows[(i + 2) % 3], *second = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t k = 1; k <= size; k++) {
            row[k] = least(least(above[k], row[k - 1]) + 1, above[k - 1] + (word[i - 1] != name[k - 1]));
            if (i > 1 && k > 1 && word[i - 1] == name[k - 2] && word[i - 2] == name[k - 1])
                row[k] = least(row[k], second[k - 2] + 1);
        }
    }
    return least(rows[length % 3][size], SPELLING_FAR);
}
