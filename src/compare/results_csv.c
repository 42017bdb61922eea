/* results.csv: a row a run, of a suite a row a case and run. */
#include "compare/results.h"

#include "base/status.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static const char *const SPREADS[] = {"t", "footprint", "residual", "normal"};
static const char *const FIGURES[] = {"median", "p99", "p999", "max", "rms"};
static const char *const COUNTS[] = {"pixels",
                                     "hits",
                                     "missed",
                                     "invented",
                                     "missed_decided",
                                     "invented_decided",
                                     "wrong_root",
                                     "undecided",
                                     "compared",
                                     "effects_compared",
                                     "effects_undecided",
                                     "shadow_wrong",
                                     "occlusion_wrong",
                                     "mirror_wrong",
                                     "refraction_wrong"};
#define LENGTH(array) (sizeof(array) / sizeof *(array))

static void write_header(FILE *file)
{
    fputs("case,name,method,solver,settings,frames,ms_median,ms_min,ms_max", file);
    for (int p = 0; p < MNS_PHASE_SHADE; p++) fprintf(file, ",ms_%s", mns_phase_name((mns_phase)p));
    for (size_t i = 0; i < LENGTH(COUNTS); i++) fprintf(file, ",%s", COUNTS[i]);
    for (size_t i = 0; i < LENGTH(SPREADS); i++)
        for (size_t k = 0; k < LENGTH(FIGURES); k++) fprintf(file, ",%s_%s", SPREADS[i], FIGURES[k]);
    fputs(",psnr,pareto,failed\n", file);
}

/* RFC 4180: in quotes where it holds a comma, a quote or a line's end. */
static void write_text(FILE *file, const char *text)
{
    if (!text) return;
    bool quoted = strpbrk(text, ",\"\r\n") != NULL;
    if (quoted) fputc('"', file);
    for (const char *c = text; *c; c++) {
        if (*c == '"') fputc('"', file);
        fputc(*c, file);
    }
    if (quoted) fputc('"', file);
}

/* A comma and the number; nothing behind the comma where there is none. */
static void write_number(FILE *file, const json_t *value)
{
    fputc(',', file);
    if (json_is_integer(value))
        fprintf(file, "%lld", (long long)json_integer_value(value));
    else if (json_is_real(value))
        fprintf(file, "%.9g", json_real_value(value));
}

static void write_settings(FILE *file, const json_t *settings)
{
    char text[320] = "";
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)settings, key, value)
    {
        size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "%s%s=%s", used ? ";" : "", key, json_string_value(value));
    }
    write_text(file, text);
}

static void write_row(FILE *file, const char *name_of_case, const json_t *run)
{
    static const char *const names[] = {"name", "method", "solver"};
    static const char *const ms_names[] = {"median", "min", "max"};
    const json_t *ms = json_object_get(run, "ms"), *errors = json_object_get(run, "errors");
    const json_t *phases = json_object_get(ms, "phases");
    write_text(file, name_of_case);
    for (size_t i = 0; i < LENGTH(names); i++) {
        fputc(',', file);
        write_text(file, json_string_value(json_object_get(run, names[i])));
    }
    fputc(',', file);
    write_settings(file, json_object_get(run, "settings"));
    write_number(file, json_object_get(run, "frames"));
    for (size_t i = 0; i < LENGTH(ms_names); i++) /* of a suite's run there is one number */
        write_number(file, i || json_is_object(ms) ? json_object_get(ms, ms_names[i]) : ms);
    for (int p = 0; p < MNS_PHASE_SHADE; p++)
        write_number(file, json_object_get(phases, mns_phase_name((mns_phase)p)));
    for (size_t i = 0; i < LENGTH(COUNTS); i++) write_number(file, json_object_get(errors, COUNTS[i]));
    for (size_t i = 0; i < LENGTH(SPREADS); i++)
        for (size_t k = 0; k < LENGTH(FIGURES); k++)
            write_number(file, json_object_get(json_object_get(errors, SPREADS[i]), FIGURES[k]));
    write_number(file, json_object_get(errors, "psnr"));
    fprintf(file, ",%d,", json_is_true(json_object_get(run, "pareto")) ? 1 : 0);
    write_text(file, json_string_value(json_object_get(run, "failed")));
    fputc('\n', file);
}

static void write_rows(FILE *file, const char *name_of_case, const json_t *runs)
{
    for (size_t i = 0; i < json_array_size(runs); i++) write_row(file, name_of_case, json_array_get(runs, i));
}

mns_status results_write_csv(const json_t *document, const char *path, mns_error *error)
{
    char reason[96];
    errno = 0;
    FILE *file = fopen(path, "wx");
    bool good = file != NULL;
    if (file) {
        const json_t *cases = json_object_get(json_object_get(document, "suite"), "cases");
        write_header(file);
        write_rows(file, "", json_object_get(document, "runs"));
        for (size_t i = 0; i < json_array_size(cases); i++) {
            const json_t *one = json_array_get(cases, i);
            write_rows(file, json_string_value(json_object_get(one, "name")), json_object_get(one, "runs"));
        }
        good = !ferror(file);
        good = !fclose(file) && good;
    }
    if (good) return MNS_OK;
    return status_fail(error, MNS_ERROR_IO, "%.300s: cannot write: %s", path,
                       strerror_r(errno ? errno : EIO, reason, sizeof reason));
}
