/* meniscus compare --suite stiff: hard cases by every run, each with a verdict. */
#include "app/app.h"
#include "app/compare.h"
#include "compare/folder.h"
#include "compare/results.h"
#include "compare/suite.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>

static void print_line(void *context, const suite_line *line)
{
    const run_result *run = line->run;
    (void)context;
    printf("%-27s %-26s %-8s", line->which->name, run->spec.name, suite_verdict_name(line->verdict));
    if (!run->status && isfinite(run->ms.median)) printf(" %9.1f ms", run->ms.median);
    if (!run->status && run->errors.compared) printf("  t p99.9 %7.1g", run->errors.t.p999);
    printf("%s%s\n", *line->note ? "  " : "", line->note);
    fflush(stdout);
}

static mns_status write_results(const app_options *o, const char *command, const mns_context *context,
                                const mns_renderer *renderer, json_t *suite, mns_error *error)
{
    json_t *document = NULL;
    picture_list none = {0};
    results_about about = {
        .command = command, .renderer = mns_renderer_name(renderer), .backend = mns_context_name(context)};
    mns_status status = results_document(&about, NULL, 0, &document, error);
    if (!status && json_object_set(document, "suite", suite))
        status = app_fail(error, MNS_ERROR_MEMORY, "out of memory writing the suite's results");
    if (!status) status = compare_write(document, &none, o->output, error);
    json_decref(document);
    return status;
}

static mns_status run_suite(const app_options *o, const char *command, const mns_context *context,
                            const suite_options *options, mns_error *error)
{
    json_t *suite = NULL;
    size_t failures = 0;
    mns_status status = suite_run(options, &suite, &failures, error);
    if (!status && o->output) status = write_results(o, command, context, options->renderer, suite, error);
    json_decref(suite);
    if (!status && failures)
        status = app_fail(error, MNS_ERROR_INPUT,
                          "the stiff suite: %zu time%s an exact solver did not hold inside the stated domain "
                          "(docs/domain.md)",
                          failures, failures == 1 ? "" : "s");
    return status;
}

/* The cases have fields, cameras and sizes of their own. Errors: USAGE. */
static mns_status check_beside(const app_options *o, mns_error *error)
{
    static const char *const known[] = {"suite",   "case",    "quick",    "output", "runs",
                                        "backend", "threads", "no-cache", NULL};
    if (o->input_count)
        return app_fail(error, MNS_ERROR_USAGE, "--suite %s: expected no input beside it, but for -o FOLDER",
                        o->suite);
    const char *other = options_beside(o, known);
    if (!other) return MNS_OK;
    return app_fail(
        error, MNS_ERROR_USAGE,
        "--%s: not beside --suite %s, whose cases say it themselves; expected -o, --runs, --case, "
        "--quick, --backend, --threads or --no-cache",
        other, o->suite);
}

mns_status compare_suite(const app_options *o, const char *command, mns_error *error)
{
    run_spec *runs = NULL;
    mns_context *context = NULL;
    suite_options options = {
        .only = o->suite_case, .quick = o->quick, .use_cache = !o->no_cache, .seen = print_line};
    mns_status status = check_beside(o, error);
    if (status) return status;
    if (o->threads) omp_set_num_threads(o->threads);
    status = run_parse(o->runs, &runs, &options.run_count, error);
    if (!status && o->output) status = folder_check(o->output, error);
    if (!status) status = mns_context_create(o->backend, &context, error);
    if (!status) status = mns_renderer_create(mns_context_get_proc(context), &options.renderer, error);
    if (!status && o->no_cache) mns_renderer_keep_programs(options.renderer, NULL);
    options.runs = runs;
    if (!status) status = run_suite(o, command, context, &options, error);
    mns_renderer_destroy(options.renderer);
    mns_context_destroy(context);
    free(runs);
    return status;
}
