#include "load/labels.h"

#include "base/memory.h"

#include <string.h>

static uint64_t hash(const char *at, size_t length)
{
    uint64_t h = 0xcbf29ce484222325u; /* FNV-1a, then mixed, since slots are taken from the low bits */
    for (size_t i = 0; i < length; i++) h = (h ^ (unsigned char)at[i]) * 0x100000001b3u;
    return h ^ h >> 29;
}

static bool is_word(const char *word, load_text text)
{
    size_t length = (size_t)(text.end - text.at);
    return !strncmp(word, text.at, length) && !word[length];
}

static size_t find_slot(const load_labels *l, load_text text)
{
    size_t i = hash(text.at, (size_t)(text.end - text.at)) & (l->slots - 1);
    while (l->slot[i] && !is_word(l->word[l->slot[i] - 1], text)) i = (i + 1) & (l->slots - 1);
    return i;
}

static bool grow(load_labels *l)
{
    size_t slots = l->slots ? l->slots * 2 : 64;
    uint32_t *slot = slots <= UINT32_MAX ? calloc(slots, sizeof *slot) : NULL;
    char **word = slot ? memory_resize(l->word, slots / 2, sizeof *word) : NULL;
    if (!word) {
        free(slot);
        return false;
    }
    free(l->slot);
    l->slot = slot, l->slots = slots;
    l->word = word, l->capacity = slots / 2;
    for (size_t i = 0; i < l->count; i++) {
        load_text text = {word[i], word[i] + strlen(word[i])};
        slot[find_slot(l, text)] = (uint32_t)(i + 1);
    }
    return true;
}

bool labels_number(load_labels *l, load_text text, size_t *number)
{
    /* A word ends at a zero byte, as it will in C. */
    const char *zero = memchr(text.at, 0, (size_t)(text.end - text.at));
    if (zero) text.end = zero;
    if (l->count && is_word(l->word[l->last], text)) {
        *number = l->last;
        return true;
    }
    if (l->count == l->capacity && !grow(l)) return false;
    size_t i = find_slot(l, text);
    if (!l->slot[i]) {
        char *copy = strndup(text.at, (size_t)(text.end - text.at));
        if (!copy) return false;
        l->word[l->count++] = copy;
        l->slot[i] = (uint32_t)l->count;
    }
    *number = l->last = l->slot[i] - 1;
    return true;
}

void labels_free(load_labels *l)
{
    for (size_t i = 0; i < l->count; i++) free(l->word[i]);
    free(l->word);
    free(l->slot);
    memset(l, 0, sizeof *l);
}
