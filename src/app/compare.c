#include "app/compare.h"

#include "app/app.h"
#include "app/drawing.h"
#include "app/progress.h"
#include "compare/compare.h"
#include "compare/folder.h"
#include "compare/results.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- Options ---- */

static mns_status option_runs(app_options *o, const char *name, const char *text, mns_error *error)
{
    run_spec *runs = NULL;
    size_t count;
    (void)name;
    o->runs = text;
    mns_status status = run_parse(text, &runs, &count, error);
    free(runs);
    return status;
}

static mns_status option_frames(app_options *o, const char *name, const char *text, mns_error *error)
{
    long frames = 0;
    mns_status status = parse_whole(name, text, RUN_FRAMES_LEAST, 100000, &frames, error);
    if (!status) o->timed_frames = (int)frames;
    return status;
}

static mns_status option_suite(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->suite = text;
    if (strcmp(text, "stiff") == 0) return MNS_OK;
    return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected stiff", name, text);
}

static mns_status option_case(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)error;
    o->suite_case = text;
    return MNS_OK;
}

static mns_status option_quick(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)text, (void)error;
    o->quick = true;
    return MNS_OK;
}

enum { TOLERANCE_T = 1, TOLERANCE_NORMAL = 2, TOLERANCE_MASK = 4 };

static mns_status option_tolerance_t(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->tolerance_set |= TOLERANCE_T;
    return parse_weight(name, text, &o->tolerance.t, error);
}

static mns_status option_tolerance_normal(app_options *o, const char *name, const char *text,
                                          mns_error *error)
{
    o->tolerance_set |= TOLERANCE_NORMAL;
    return parse_weight(name, text, &o->tolerance.normal, error);
}

static mns_status option_tolerance_mask(app_options *o, const char *name, const char *text, mns_error *error)
{
    long pixels = 0;
    mns_status status = parse_whole(name, text, 0, LONG_MAX, &pixels, error);
    o->tolerance_set |= TOLERANCE_MASK;
    if (!status) o->tolerance.mask = (size_t)pixels;
    return status;
}

static const option_row ROWS[] = {
    {NULL, 0, NULL, "What to compare:", NULL},
    {"output", 'o', "FOLDER", "gets results.csv, results.json, chart.svg (by gnuplot) and index.html",
     option_output},
    {"runs", 0, "METHOD:SOLVER[:KEY=VALUE]...,...",
     "what to draw by (default: every method and solver of this build but for the reference, which is the "
     "truth): list and tile with exact, cubic and "
     "cubic-monomial, fbvh and bvh with exact and secant, reference:exact. Keys: gather, slots, root-steps, "
     "shuffle, pool, aa and secant-steps, as the options of render",
     option_runs},
    {"frames", 0, "N",
     "frames a run, of which medians are taken, 5 or more (default 5), after two to warm up", option_frames},
    {"no-cache", 0, NULL,
     "trace the truth and compile the programs anew, and keep neither in $XDG_CACHE_HOME/meniscus "
     "(default ~/.cache)",
     option_no_cache},
    {"size", 0, "WxH", "pixels (default 1024x768)", option_size},
    {"frame", 0, "A", "the frame of the input, from 0 (default 0)", option_frame},
    {"backend", 0, "NAME", "auto (the default: the first that starts), egl, osmesa or glfw", option_backend},
    {"threads", 0, "N", "threads on the CPU (default: one a core)", option_threads},
    OPTIONS_OF_FIELD,
    OPTIONS_OF_CAMERA,
    {NULL, 0, NULL,
     "Of hard cases, instead of an input (exit status 1 where an exact solver fails in the stated domain):",
     NULL},
    {"suite", 0, "stiff", "every case by every run, with verdicts (docs/domain.md)", option_suite},
    {"case", 0, "PATTERN", "those cases alone whose name matches, as \"neck*\"", option_case},
    {"quick", 0, NULL, "without the heavy cases, and with times of first frames", option_quick},
    {NULL, 0, NULL, "Of two saved images (exit status 1 beyond one of these):", NULL},
    {"tolerance-t", 0, "X", "largest |t - t*| / t* (default 1e-5)", option_tolerance_t},
    {"tolerance-normal", 0, "DEG", "largest angle between normals (default 0.5)", option_tolerance_normal},
    {"tolerance-mask", 0, "N", "pixels missed, invented, or undecided in B.exr alone (default 0)",
     option_tolerance_mask},
};

static const option_table COMPARE_OPTIONS = {
    .command = "compare",
    .arguments = "INPUT... -o FOLDER\n--suite stiff [-o FOLDER]\nA.exr B.exr [-o FOLDER]",
    .doc = "Draws INPUT by several methods, over the same rays, and measures each: its time, and its errors "
           "against the certified tracer's truth (docs/errors.md). Of two saved images, A.exr is the truth.",
    .rows = ROWS,
    .count = sizeof ROWS / sizeof *ROWS,
};

/* ---- A scene ---- */

typedef struct compare_job {
    const app_options *o;
    drawing d;
    progress progress;
    truth_planes *truth;
    run_spec *runs;
    run_result *results;
    size_t count, done;
    picture_list pictures;
} compare_job;

static void show_row(void *context, int done, int rows)
{
    (void)rows;
    progress_show(&((compare_job *)context)->progress, done);
}

static mns_status find_truth(compare_job *job, mns_error *error)
{
    truth_desc desc = {.field = job->d.field,
                       .view = &job->d.view,
                       .look = &job->o->look,
                       .renderer = job->d.renderer,
                       .use_cache = !job->o->no_cache,
                       .progress = show_row,
                       .context = job};
    progress_begin(&job->progress, "truth: row", job->d.view.height);
    mns_status status = truth_create(&desc, &job->truth, error);
    progress_clear(&job->progress);
    if (status) return status;
    if (*job->truth->note) app_note("%s", job->truth->note);
    printf("truth: %zu hits, %zu undecided, %.1f s%s\n", job->truth->hits, job->truth->undecided,
           1e-3 * job->truth->ms, job->truth->cached ? " (kept from an earlier time)" : "");
    fflush(stdout);
    return pictures_add(&job->pictures, "truth", job->truth, NULL, error);
}

/* A run that was asked for and cannot be drawn ends the comparison. */
static mns_status take_run(void *context, const run_result *result, const mns_image *image, mns_error *error)
{
    compare_job *job = context;
    if (result->status)
        return app_fail(error, result->status, "%s: %.360s", result->spec.name, result->error.text);
    compare_print(result);
    return pictures_add(&job->pictures, job->runs[job->done++].name, job->truth, image, error);
}

static mns_status write_results(compare_job *job, const char *command, mns_error *error)
{
    json_t *document = NULL;
    results_about about = {.command = command,
                           .renderer = mns_renderer_name(job->d.renderer),
                           .backend = mns_context_name(job->d.context),
                           .input = job->o->inputs[0],
                           .field = job->d.field,
                           .view = &job->d.view,
                           .truth = job->truth};
    mns_status status = results_document(&about, job->results, job->count, &document, error);
    if (!status) status = compare_write(document, &job->pictures, job->o->output, error);
    json_decref(document);
    return status;
}

static mns_status compare_runs(compare_job *job, const char *command, mns_error *error)
{
    const app_options *o = job->o;
    mns_status status = run_parse(o->runs, &job->runs, &job->count, error);
    if (status) return status;
    job->results = calloc(job->count, sizeof *job->results);
    if (!job->results) return app_fail(error, MNS_ERROR_MEMORY, "out of memory before drawing");
    status = folder_check(o->output, error); /* before hours of work */
    if (!status) status = drawing_open(o, &job->d, error);
    if (!status) status = find_truth(job, error);
    if (!status)
        status = compare_scene(job->d.renderer, job->d.field, &job->d.view, &o->look, job->runs, job->count,
                               o->timed_frames, job->truth, job->results, take_run, job, error);
    if (!status) status = write_results(job, command, error);
    return status;
}

static mns_status compare_input(const app_options *o, const char *command, mns_error *error)
{
    if (!o->output) return app_fail(error, MNS_ERROR_USAGE, "nothing to write: expected -o FOLDER");
    compare_job job = {.o = o};
    mns_status status = compare_runs(&job, command, error);
    pictures_free(&job.pictures);
    free(job.results);
    free(job.runs);
    truth_destroy(job.truth);
    drawing_close(&job.d);
    return status;
}

/* ---- The command ---- */

static bool ends_in(const char *name, const char *ending)
{
    const char *dot = strrchr(name, '.');
    return dot && strcasecmp(dot, ending) == 0;
}

/* Whether two saved images are to be compared. Errors: USAGE (an image that has no fellow, or too many; what
 * would be of no use beside the inputs). */
static mns_status find_images(const app_options *o, bool *are_images, mns_error *error)
{
    static const char *const of_images[] = {"output", "tolerance-t", "tolerance-normal", "tolerance-mask",
                                            NULL};
    const char *image = NULL; /* one that cannot be compared, where there is one */
    size_t saved = 0;
    for (size_t i = 0; i < o->input_count; i++) {
        bool is_saved = ends_in(o->inputs[i], ".exr");
        saved += is_saved;
        if (ends_in(o->inputs[i], ".png") || (is_saved && !image)) image = o->inputs[i];
    }
    *are_images = saved == 2 && o->input_count == 2;
    if (image && !*are_images)
        return app_fail(error, MNS_ERROR_USAGE,
                        "%.200s: an image: expected two of them, both .exr, and no other input", image);
    if (o->suite_case || o->quick)
        return app_fail(error, MNS_ERROR_USAGE, "--case and --quick: expected --suite stiff beside them");
    const char *other = *are_images ? options_beside(o, of_images) : NULL;
    if (other)
        return app_fail(error, MNS_ERROR_USAGE, "--%s: expected something to draw, not two saved images",
                        other);
    if (*are_images || !o->tolerance_set) return MNS_OK;
    return app_fail(error, MNS_ERROR_USAGE,
                    "--tolerance-t, -normal and -mask: expected two saved images beside them");
}

static mns_status compare_inputs(const app_options *o, const char *command, mns_error *error)
{
    bool images = false;
    mns_status status = find_images(o, &images, error);
    if (status) return status;
    return images ? compare_images(o, command, error) : compare_input(o, command, error);
}

/* The command as it was typed, for the results; NULL where memory ends. */
static char *join(int argc, char **argv)
{
    size_t size = sizeof "meniscus";
    for (int i = 0; i < argc; i++) size += strlen(argv[i]) + 3;
    char *text = malloc(size), *end = text;
    if (!text) return NULL;
    end += sprintf(end, "meniscus");
    for (int i = 0; i < argc; i++)
        end += sprintf(end, strpbrk(argv[i], " \t'\"$&;|<>()*?") ? " '%s'" : " %s", argv[i]);
    return text;
}

int app_compare(int argc, char **argv)
{
    app_options o;
    mns_error error;
    char *command = join(argc, argv);
    mns_status status = options_read(&COMPARE_OPTIONS, argc, argv, &o, &error);
    if (!o.timed_frames) o.timed_frames = RUN_FRAMES_LEAST;
    if (!(o.tolerance_set & TOLERANCE_T)) o.tolerance.t = IMAGES_TOLERANCE_T;
    if (!(o.tolerance_set & TOLERANCE_NORMAL)) o.tolerance.normal = IMAGES_TOLERANCE_NORMAL;
    if (!status && !o.help && o.suite)
        status = compare_suite(&o, command, &error);
    else if (!status && !o.help)
        status = compare_inputs(&o, command, &error);
    options_free(&o);
    free(command);
    return status ? app_report(&error) : APP_DONE;
}
