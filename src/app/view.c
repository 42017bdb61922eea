#include "app/view.h"

#include "app/app.h"
#include "app/render.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a window is told: now, before the last change, and when it could last be drawn. */
typedef struct view_state {
    view_words words;
    app_options *o; /* stays where it is: its look points into it */
    window_settings settings;
} view_state;

typedef struct view_job {
    option_table table;
    view_state now, last, kept;
} view_job;

/* ---- The words and what they mean ---- */

static void state_free(view_state *state)
{
    if (state->o) options_free(state->o);
    free(state->o);
    view_words_free(&state->words);
    memset(state, 0, sizeof *state);
}

/* Reads the words, which the state takes over. */
static mns_status state_read(const option_table *table, view_words words, view_state *state, mns_error *error)
{
    memset(state, 0, sizeof *state);
    state->words = words;
    app_options *o = state->o = calloc(1, sizeof *o);
    mns_status status = o ? options_read(table, (int)words.count, words.word, o, error)
                          : app_fail(error, MNS_ERROR_MEMORY, "out of memory reading the options");
    if (!status && !o->help && o->input_count == 0)
        status = app_fail(
            error, MNS_ERROR_USAGE,
            "no input: expected a particle file, a scene with an input, or a generator such as tornado:4000");
    if (!status && o->frames.given && o->frames.first != o->frames.last)
        status = app_fail(error, MNS_ERROR_USAGE, "--frame: expected one frame; the window plays them all");
    if (status) {
        state_free(state);
        return status;
    }
    state->settings = (window_settings){.inputs = o->inputs,
                                        .input_count = o->input_count,
                                        .field = o->field,
                                        .view = o->view,
                                        .look = o->look,
                                        .draw = o->draw,
                                        .frame = o->frames.given ? o->frames.first : 0,
                                        .no_cache = o->no_cache,
                                        .threads = o->threads,
                                        .patience_ms = 1000 * (o->patience > 0 ? o->patience : 15)};
    return MNS_OK;
}

/* The words as they are now, to be changed. */
static mns_status copy(const view_job *job, view_words *words, mns_error *error)
{
    if (view_words_copy(words, job->now.words.word, job->now.words.count)) return MNS_OK;
    view_words_free(words);
    return app_fail(error, MNS_ERROR_MEMORY, "out of memory changing the options");
}

static mns_status become(view_job *job, view_words words, bool whole, mns_error *error)
{
    view_state next;
    if (!whole) {
        view_words_free(&words);
        return app_fail(error, MNS_ERROR_MEMORY, "out of memory changing the options");
    }
    mns_status status = state_read(&job->table, words, &next, error);
    if (status) return status;
    state_free(&job->last);
    job->last = job->now;
    job->now = next;
    return MNS_OK;
}

/* ---- The window's host ---- */

static const window_settings *host_settings(void *context)
{
    view_job *job = context;
    return &job->now.settings;
}

static mns_status host_set(void *context, const char *name, const char *value, mns_error *error)
{
    static const char *const of_start[] = {"threads",  "no-cache", "context", "script",
                                           "no-panel", "glsl",     NULL};
    view_job *job = context;
    view_words words;
    for (int i = 0; of_start[i]; i++)
        if (strcmp(name, of_start[i]) == 0)
            return app_fail(error, MNS_ERROR_USAGE, "--%s: it counts when the window opens, and no later",
                            name);
    mns_status status = copy(job, &words, error);
    if (status) return status;
    bool whole = view_words_set(&words, &job->table, name, value); /* may move what `words` holds */
    return become(job, words, whole, error);
}

static mns_status host_open(void *context, const char *const *names, size_t count, mns_error *error)
{
    static const char *const of_input[] = {"frame",
                                           "eye",
                                           "look-at",
                                           "up",
                                           "radius",
                                           "color-by",
                                           "color-range",
                                           "blend-by",
                                           "blend-range",
                                           "blend-color",
                                           "blend-mirror",
                                           "blend-transmission",
                                           "blend-absorption",
                                           NULL};
    view_job *job = context;
    view_words words;
    mns_status status = copy(job, &words, error);
    if (status) return status;
    bool whole = view_words_inputs(&words, &job->table, names, count);
    for (int i = 0; of_input[i] && whole; i++) whole = view_words_set(&words, &job->table, of_input[i], NULL);
    return become(job, words, whole, error);
}

static void host_back(void *context)
{
    view_job *job = context;
    if (!job->last.o) return;
    state_free(&job->now);
    job->now = job->last;
    memset(&job->last, 0, sizeof job->last);
}

static void host_keep(void *context)
{
    view_job *job = context;
    view_words words;
    view_state kept;
    mns_error error;
    if (copy(job, &words, &error) || state_read(&job->table, words, &kept, &error)) return;
    state_free(&job->kept);
    job->kept = kept;
}

static void host_undo(void *context)
{
    view_job *job = context;
    view_words words;
    view_state back;
    mns_error error;
    if (!view_words_copy(&words, job->kept.words.word, job->kept.words.count)) {
        view_words_free(&words);
        return;
    }
    if (state_read(&job->table, words, &back, &error)) return;
    state_free(&job->now);
    job->now = back;
}

static void host_fix_look(void *context, const mns_field *first, mns_look *look)
{
    (void)context;
    render_fix_look(first, look);
}

static char *host_command(void *context, const mns_view *view, long frame, mns_method method)
{
    static const char *const without[] = {"eye",      "look-at",  "up",      "fov",    "size",
                                          "frame",    "method",   "context", "script", "glsl",
                                          "no-panel", "patience", NULL};
    const view_job *job = context;
    const double *e = view->eye, *t = view->look_at, *u = view->up;
    char *own = view_words_shell(&job->now.words, &job->table, without), *text = NULL;
    size_t size;
    FILE *out = own ? open_memstream(&text, &size) : NULL;
    if (out) {
        fprintf(out, "meniscus render%s --eye=%.17g,%.17g,%.17g --look-at=%.17g,%.17g,%.17g", own, e[0], e[1],
                e[2], t[0], t[1], t[2]);
        fprintf(out,
                " --up=%.17g,%.17g,%.17g --fov=%.17g --size=%dx%d --frame=%ld --method=%s -o meniscus.png",
                u[0], u[1], u[2], view->fov, view->width, view->height, frame, mns_method_name(method));
        if (fclose(out)) {
            free(text);
            text = NULL;
        }
    }
    free(own);
    return text;
}

static void host_tell(void *context, const char *line)
{
    (void)context;
    puts(line);
    fflush(stdout);
}

/* ---- The command ---- */

/* Options that argp cannot hold: what scripts may say. */
static void print_actions(void)
{
    char *text = window_actions_text();
    if (text) printf("\n Actions of a script, a line each:\n\n%s", text);
    free(text);
}

static mns_status run(view_job *job, mns_error *error)
{
    const app_options *o = job->now.o;
    /* These words go with the first change of an option. */
    char *script = o->script ? strdup(o->script) : NULL, *glsl = o->glsl ? strdup(o->glsl) : NULL;
    const window_desc desc = {.host = {job, host_settings, host_set, host_open, host_back, host_keep,
                                       host_undo, host_fix_look, host_command, host_tell},
                              .context = o->window_context,
                              .script = script,
                              .glsl = glsl,
                              .panel = !o->no_panel};
    if (o->threads) omp_set_num_threads(o->threads);
    host_keep(job);
    mns_status status = (o->script && !script) || (o->glsl && !glsl)
                            ? app_fail(error, MNS_ERROR_MEMORY, "out of memory opening a window")
                            : window_run(&desc, error);
    free(script);
    free(glsl);
    return status;
}

int app_view(int argc, char **argv)
{
    view_job job = {.table = view_options()};
    view_words words = {0};
    mns_error error;
    mns_status status = MNS_OK;
    if (!job.table.rows || !view_words_copy(&words, argv, (size_t)argc)) {
        status = app_fail(&error, MNS_ERROR_MEMORY, "out of memory reading the command line");
        view_words_free(&words);
    }
    if (!status) status = state_read(&job.table, words, &job.now, &error);
    if (!status && job.now.o->help)
        print_actions();
    else if (!status)
        status = run(&job, &error);
    state_free(&job.now);
    state_free(&job.last);
    state_free(&job.kept);
    free((option_row *)(uintptr_t)job.table.rows);
    return status ? app_report(&error) : APP_DONE;
}
