#include "app/view.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool view_words_copy(view_words *to, char *const *word, size_t count)
{
    *to = (view_words){calloc(count + 1, sizeof *to->word), 0};
    if (!to->word) return false;
    for (size_t i = 0; i < count; i++) {
        to->word[i] = strdup(word[i]);
        if (!to->word[i]) return false;
        to->count++;
    }
    return true;
}

void view_words_free(view_words *words)
{
    for (size_t i = 0; words->word && i < words->count; i++) free(words->word[i]);
    free(words->word);
    *words = (view_words){0};
}

/* The row of an option's word; NULL: it is none. *ahead: its value is the word after. Names may be shortened,
 * as they may be for argp. */
static const option_row *row_of(const option_table *table, const char *word, bool *ahead)
{
    size_t length = strcspn(word, "=");
    const option_row *found = NULL;
    *ahead = false;
    if (word[0] != '-' || word[1] == '\0') return NULL;
    for (size_t i = 0; i < table->count; i++) {
        const option_row *row = &table->rows[i];
        if (!row->name) continue;
        bool letter = word[1] != '-' && row->letter && word[1] == row->letter;
        bool exact = word[1] == '-' && strlen(row->name) == length - 2;
        if (!letter && (word[1] != '-' || strncmp(word + 2, row->name, length - 2) != 0)) continue;
        if (found && !exact) continue;
        found = row;
        bool takes = row->value && row->value[0] != '?';
        *ahead = takes && (letter ? word[2] == '\0' : word[length] == '\0');
        if (letter || exact) break;
    }
    return found;
}

/* How many words from `i` on belong together: an option with its value, or one name. */
static size_t span(const view_words *words, const option_table *table, size_t i, const option_row **row)
{
    bool ahead;
    *row = row_of(table, words->word[i], &ahead);
    return ahead && i + 1 < words->count ? 2 : 1;
}

static void cut(view_words *words, size_t i, size_t count)
{
    for (size_t k = 0; k < count; k++) free(words->word[i + k]);
    memmove(words->word + i, words->word + i + count, (words->count - i - count) * sizeof *words->word);
    words->count -= count;
}

static bool append(view_words *words, char *word)
{
    char **larger = word ? realloc(words->word, (words->count + 2) * sizeof *larger) : NULL;
    if (!larger) {
        free(word);
        return false;
    }
    words->word = larger;
    words->word[words->count++] = word;
    words->word[words->count] = NULL;
    return true;
}

bool view_words_set(view_words *words, const option_table *table, const char *name, const char *value)
{
    const option_row *row;
    size_t size = strlen(name) + (value ? strlen(value) : 0) + 4;
    for (size_t i = 1, n; i < words->count; i += n) {
        n = span(words, table, i, &row);
        if (!row || strcmp(row->name, name) != 0) continue;
        cut(words, i, n);
        n = 0;
    }
    if (!value) return true;
    char *word = malloc(size);
    if (word) snprintf(word, size, *value ? "--%s=%s" : "--%s", name, value);
    return append(words, word);
}

bool view_words_inputs(view_words *words, const option_table *table, const char *const *names, size_t count)
{
    const option_row *row;
    for (size_t i = 1, n; i < words->count; i += n) {
        n = span(words, table, i, &row);
        if (row) continue;
        cut(words, i, n);
        n = 0;
    }
    for (size_t i = 0; i < count; i++)
        if (!append(words, strdup(names[i]))) return false;
    return true;
}

/* A word as a shell takes it. */
static void quote(FILE *out, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,./:@%";
    if (*word && strspn(word, plain) == strlen(word)) {
        fprintf(out, " %s", word);
        return;
    }
    fputs(" '", out);
    for (; *word; word++) *word == '\'' ? fputs("'\\''", out) : fputc(*word, out);
    fputc('\'', out);
}

char *view_words_shell(const view_words *words, const option_table *table, const char *const *without)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    const option_row *row;
    for (size_t i = 1, n; i < words->count; i += n) {
        bool leave = false;
        n = span(words, table, i, &row);
        for (size_t k = 0; row && without[k]; k++) leave = leave || strcmp(row->name, without[k]) == 0;
        for (size_t k = 0; k < n && !leave; k++) quote(out, words->word[i + k]);
    }
    if (fclose(out)) {
        free(text);
        return NULL;
    }
    return text;
}
