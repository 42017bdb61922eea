/* Values as JSON has them. */
#ifndef MNS_BASE_JSON_H
#define MNS_BASE_JSON_H

#include <jansson.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* JSON has no infinities and no NaN: null. */
static inline json_t *json_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static inline json_t *json_count(uint64_t value)
{
    return json_integer((json_int_t)value);
}

/* Text from outside may be in any encoding: bytes that are not UTF-8 become "?"; no text is null. NULL: out
 * of memory. */
static inline json_t *json_text(const char *text)
{
    if (!text) return json_null();
    json_t *value = json_string(text);
    if (value) return value;
    char *plain = strdup(text);
    for (char *c = plain; c && *c; c++)
        if ((unsigned char)*c >= 0x80) *c = '?';
    value = plain ? json_string(plain) : NULL;
    free(plain);
    return value;
}

#endif
