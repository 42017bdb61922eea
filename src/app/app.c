#include "app/app.h"

#include <stdarg.h>
#include <stdio.h>
#include <time.h>

/* Bytes quoted from a user's text or file must not break the line. */
static void one_line(char *text)
{
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
}

mns_status app_fail(mns_error *error, mns_status status, const char *format, ...)
{
    va_list arguments;
    error->status = status;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    one_line(error->text);
    return status;
}

int app_report(const mns_error *error)
{
    fprintf(stderr, "meniscus: %s\n", error->text);
    return error->status == MNS_ERROR_USAGE ? APP_USAGE : APP_FAILED;
}

void app_note(const char *format, ...)
{
    char text[480];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    one_line(text);
    fprintf(stderr, "meniscus: note: %s\n", text);
}

void app_note_warnings(const mns_plan *plan)
{
    size_t count;
    const char *const *lines = mns_plan_warnings(plan, &count);
    for (size_t i = 0; i < count; i++) app_note("outside the stated domain: %s", lines[i]);
}

double app_clock_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}
