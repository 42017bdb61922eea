#include "app/progress.h"

#include "app/app.h"

#include <stdio.h>
#include <unistd.h>

void progress_begin(progress *p, const char *unit, long total)
{
    *p = (progress){.unit = unit,
                    .is_on = total > 1 && isatty(STDERR_FILENO),
                    .total = total,
                    .start_ms = app_clock_ms()};
    progress_show(p, 0);
}

void progress_show(progress *p, long done)
{
    p->done = done;
    if (!p->is_on) return;
    double seconds = (app_clock_ms() - p->start_ms) * 1e-3;
    if (done == 0 || !(seconds > 0)) {
        fprintf(stderr, "\r%s %ld/%ld", p->unit, done, p->total);
        return;
    }
    long left = (long)(seconds / (double)done * (double)(p->total - done) + 0.5);
    fprintf(stderr, "\r%s %ld/%ld, %.2f a second, %ld:%02ld:%02ld left\033[K", p->unit, done, p->total,
            (double)done / seconds, left / 3600, left / 60 % 60, left % 60);
}

void progress_clear(const progress *p)
{
    if (p->is_on) fputs("\r\033[K", stderr);
}
