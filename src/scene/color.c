/* Colours as people write them. */
#include "base/status.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    c = (char)tolower((unsigned char)c);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* "rrggbb" or "rrggbbaa". */
static bool parse_hex(const char *text, double rgba[4])
{
    size_t length = strlen(text);
    if (length != 6 && length != 8) return false;
    for (size_t i = 0; i < length / 2; i++) {
        int high = hex_digit(text[2 * i]), low = hex_digit(text[2 * i + 1]);
        if (high < 0 || low < 0) return false;
        rgba[i] = (16 * high + low) / 255.0;
    }
    return true;
}

/* "R,G,B" or "R,G,B,A". */
static bool parse_numbers(const char *text, double rgba[4])
{
    for (int i = 0; i < 4; i++) {
        char *end;
        rgba[i] = strtod(text, &end);
        if (end == text || !(rgba[i] >= 0 && rgba[i] <= 1)) return false;
        if (*end == '\0' && i >= 2) {
            if (i == 2) rgba[3] = 1;
            return true;
        }
        if (*end != ',') return false;
        text = end + 1;
    }
    return false;
}

mns_status mns_color_parse(const char *text, double rgba[4], mns_error *error)
{
    double parsed[4] = {0, 0, 0, 1};
    if (!text || !rgba) return status_fail(error, MNS_ERROR_USAGE, "colour: no text, or nowhere to put it");
    if (strcmp(text, "transparent") == 0)
        parsed[3] = 0;
    else if (text[0] == '#' ? !parse_hex(text + 1, parsed) : !parse_numbers(text, parsed))
        return status_fail(
            error, MNS_ERROR_USAGE,
            "colour \"%.60s\": expected R,G,B or R,G,B,A in [0, 1], #rrggbb, #rrggbbaa or transparent", text);
    memcpy(rgba, parsed, sizeof parsed);
    return MNS_OK;
}
