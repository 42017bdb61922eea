#include "app/parse.h"

#include "app/app.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static mns_status wrong(const char *option, const char *text, const char *expected, mns_error *error)
{
    return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected %s", option, text, expected);
}

mns_status parse_numbers(const char *option, const char *text, char separator, size_t count, double *values,
                         const char *expected, mns_error *error)
{
    const char *c = text;
    for (size_t i = 0; i < count; i++) {
        char *end;
        double value = strtod(c, &end);
        char wanted = i + 1 < count ? separator : '\0';
        if (end == c || !isfinite(value) || *end != wanted) return wrong(option, text, expected, error);
        values[i] = value;
        c = end + 1;
    }
    return MNS_OK;
}

mns_status parse_point(const char *name, const char *text, double v[3], mns_error *error)
{
    return parse_numbers(name, text, ',', 3, v, "X,Y,Z, three numbers", error);
}

mns_status parse_direction(const char *name, const char *text, double v[3], mns_error *error)
{
    mns_status status = parse_point(name, text, v, error);
    if (!status && v[0] == 0 && v[1] == 0 && v[2] == 0)
        return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected a direction, not all zeros", name, text);
    return status;
}

mns_status parse_positive(const char *option, const char *text, double *value, mns_error *error)
{
    static const char expected[] = "a number above 0";
    mns_status status = parse_numbers(option, text, ',', 1, value, expected, error);
    return !status && !(*value > 0) ? wrong(option, text, expected, error) : status;
}

mns_status parse_weight(const char *option, const char *text, double *value, mns_error *error)
{
    static const char expected[] = "a number of 0 or more";
    mns_status status = parse_numbers(option, text, ',', 1, value, expected, error);
    return !status && !(*value >= 0) ? wrong(option, text, expected, error) : status;
}

/* A whole number in [low, high] that ends where *end then points; false where there is none. */
static bool scan_whole(const char *text, long low, long high, long *value, char **end)
{
    if (!isdigit((unsigned char)*text)) return false;
    errno = 0;
    *value = strtol(text, end, 10);
    return errno == 0 && *value >= low && *value <= high;
}

mns_status parse_whole(const char *option, const char *text, long low, long high, long *value,
                       mns_error *error)
{
    char *end, expected[80];
    if (scan_whole(text, low, high, value, &end) && *end == '\0') return MNS_OK;
    snprintf(expected, sizeof expected, "a whole number from %ld to %ld", low, high);
    return wrong(option, text, expected, error);
}

mns_status parse_count(const char *option, const char *text, int high, int *value, mns_error *error)
{
    long whole = 0;
    mns_status status = parse_whole(option, text, 1, high, &whole, error);
    if (!status) *value = (int)whole;
    return status;
}

mns_status parse_size(const char *option, const char *text, int *width, int *height, mns_error *error)
{
    long w, h;
    char *end;
    if (!scan_whole(text, 1, 65536, &w, &end) || *end != 'x' || !scan_whole(end + 1, 1, 65536, &h, &end) ||
        *end)
        return wrong(option, text, "WxH, two whole numbers from 1 to 65536", error);
    *width = (int)w;
    *height = (int)h;
    return MNS_OK;
}

mns_status parse_frames(const char *option, const char *text, parse_frames_range *range, mns_error *error)
{
    parse_frames_range r = {.given = true, .step = 1};
    char *end;
    bool good = scan_whole(text, 0, INT_MAX, &r.first, &end);
    r.last = r.first;
    if (good && *end == ':') good = scan_whole(end + 1, r.first, INT_MAX, &r.last, &end);
    if (good && *end == ':') good = scan_whole(end + 1, 1, INT_MAX, &r.step, &end);
    if (!good || *end)
        return wrong(option, text, "A[:B[:STEP]], whole numbers with 0 <= A <= B and STEP >= 1", error);
    *range = r;
    return MNS_OK;
}

mns_status parse_name(const char *option, const char *text, const char *(*name_of)(int), int count,
                      int *index, mns_error *error)
{
    char expected[160] = "one of";
    size_t used = strlen(expected);
    for (int i = 0; i < count; i++) {
        const char *name = name_of(i);
        if (!name) continue;
        if (strcmp(name, text) == 0) {
            *index = i;
            return MNS_OK;
        }
        if (used < sizeof expected)
            used += (size_t)snprintf(expected + used, sizeof expected - used, " %s", name);
    }
    return wrong(option, text, expected, error);
}
