/* What every command shares: how errors and notes reach the user, and the clock. The program is the library's
 * first client, and knows no more of it than meniscus.h says. */
#ifndef MNS_APP_APP_H
#define MNS_APP_APP_H

#include "meniscus.h"

enum { APP_DONE = 0, APP_FAILED = 1, APP_USAGE = 2 }; /* exit statuses */

/* Fills *error and returns `status`. */
mns_status app_fail(mns_error *error, mns_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Prints the error as one line and returns the exit status that it means. */
int app_report(const mns_error *error);

/* One line on standard error that is no error: "meniscus: note: ...". */
void app_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A note for each limit of the stated domain that the plan's input breaks. */
void app_note_warnings(const mns_plan *plan);

/* Monotonic milliseconds. */
double app_clock_ms(void);

/* The commands: each takes its own arguments, argv[0] being its name, and returns the exit status. */
int app_render(int argc, char **argv);
int app_info(int argc, char **argv);
int app_compare(int argc, char **argv);
int app_verify(int argc, char **argv);
int app_view(int argc, char **argv);

#endif
