#include "compare/suite.h"

#include "base/json.h"
#include "base/status.h"
#include "compare/results.h"

#include <fnmatch.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *suite_verdict_name(suite_verdict verdict)
{
    static const char *const names[] = {"holds", "fails", "outside", "refused"};
    return names[verdict];
}

/* ---- Verdicts ---- */

static void add_note(char note[200], size_t count, const char *what)
{
    size_t used = strlen(note);
    if (count) snprintf(note + used, 200 - used, "%s%zu %s", used ? ", " : "", count, what);
}

void suite_judge(const stiff_case *which, const run_result *run, suite_line *line)
{
    const metrics *m = &run->errors;
    bool inside = !*which->breaks;
    *line = (suite_line){.which = which, .run = run};
    line->gated = inside && strcmp(run->spec.solver, "exact") == 0;
    if (run->status) {
        line->verdict = inside ? SUITE_FAILS : SUITE_REFUSED;
        snprintf(line->note, sizeof line->note, "%.190s", run->error.text);
        return;
    }
    bool open =
        !(which->flags & STIFF_TOUCHES) && (double)m->undecided > SUITE_UNDECIDED_MOST * (double)m->pixels;
    bool holds = !m->missed_decided && !m->invented_decided && !m->wrong_root && !open;
    line->verdict = holds ? SUITE_HOLDS : inside ? SUITE_FAILS : SUITE_OUTSIDE;
    add_note(line->note, m->missed_decided, "missed");
    add_note(line->note, m->invented_decided, "invented");
    add_note(line->note, m->wrong_root, "at a wrong root");
    if (open) add_note(line->note, m->undecided, "undecided");
}

/* ---- As JSON ---- */

static json_t *line_json(const suite_line *line)
{
    const run_result *run = line->run;
    const metrics *m = &run->errors;
    bool failed = run->status != MNS_OK;
    json_t *object = results_run(run);
    json_object_set_new(object, "verdict", json_string(suite_verdict_name(line->verdict)));
    json_object_set_new(object, "ms", failed ? json_null() : json_number(run->ms.median));
    json_object_set_new(object, "missed", json_count(m->missed_decided));
    json_object_set_new(object, "invented", json_count(m->invented_decided));
    json_object_set_new(object, "wrong_root", json_count(m->wrong_root));
    json_object_set_new(object, "undecided", json_count(m->undecided));
    json_object_set_new(object, "pixels", json_count(m->pixels));
    json_object_set_new(object, "t_p999", failed ? json_null() : json_number(m->t.p999));
    json_t *note = json_string(line->note);
    json_object_set_new(object, "note", note ? note : json_string("refused"));
    return object;
}

/* The words of `breaks`. */
static json_t *limits_json(const char *breaks)
{
    json_t *list = json_array();
    while (*breaks) {
        size_t length = strcspn(breaks, " ");
        json_array_append_new(list, json_stringn(breaks, length));
        breaks += length + strspn(breaks + length, " ");
    }
    return list;
}

static json_t *case_json(const stiff_case *which)
{
    return json_pack("{s:s, s:s, s:b, s:o, s:b, s:[]}", "name", which->name, "why", which->why, "inside",
                     !*which->breaks, "limits", limits_json(which->breaks), "touches",
                     (which->flags & STIFF_TOUCHES) != 0, "runs");
}

/* ---- Running ---- */

/* A case under way. */
typedef struct suite_job {
    const suite_options *o;
    const stiff_case *which;
    json_t *runs; /* borrowed */
    size_t failures;
} suite_job;

static void take(suite_job *job, const run_result *run)
{
    suite_line line;
    suite_judge(job->which, run, &line);
    if (line.gated && line.verdict != SUITE_HOLDS) job->failures++;
    json_array_append_new(job->runs, line_json(&line));
    if (job->o->seen) job->o->seen(job->o->context, &line);
}

/* A case that is refused before anything can be drawn of it is refused by every run. */
static void take_refusal(suite_job *job, const mns_error *why)
{
    for (size_t i = 0; i < job->o->run_count; i++) {
        run_result run = {.spec = job->o->runs[i], .status = why->status, .error = *why};
        take(job, &run);
    }
}

/* Draws by each run; the second time, where there is one, tells the time without the compiler's. */
static mns_status draw(suite_job *job, const run_scene *scene, mns_error *error)
{
    bool once = job->o->quick || job->which->flags & STIFF_HEAVY;
    mns_status status = MNS_OK;
    for (size_t i = 0; i < job->o->run_count && !status; i++) {
        run_result run;
        status = run_measure(scene, &job->o->runs[i], &run, NULL, error);
        if (!status && !once && !run.status) status = run_measure(scene, &job->o->runs[i], &run, NULL, error);
        if (!status) take(job, &run);
    }
    return status;
}

static mns_status run_case(suite_job *job, mns_error *error)
{
    mns_field *field = NULL;
    mns_view view;
    mns_error why;
    truth_planes *truth = NULL;
    mns_reference *reference = NULL;
    mns_status status = stiff_build(job->which, &field, &view, &why);
    if (status && status != MNS_ERROR_MEMORY) {
        take_refusal(job, &why);
        return MNS_OK;
    }
    if (status) return status_no_memory(error, "building a case of the stiff suite");
    truth_desc desc = {.field = field, .view = &view, .use_cache = job->o->use_cache};
    status = truth_create(&desc, &truth, error);
    if (!status) status = mns_reference_create(field, &reference, error);
    run_scene scene = {job->o->renderer, field, &view, NULL, reference, truth, 1};
    if (!status) status = draw(job, &scene, error);
    mns_reference_destroy(reference);
    truth_destroy(truth);
    mns_field_destroy(field);
    return status;
}

static bool wanted(const suite_options *o, const stiff_case *which)
{
    if (o->quick && which->flags & STIFF_HEAVY) return false;
    if (o->kernel && which->kernel != o->kernel) return false;
    return !o->only || fnmatch(o->only, which->name, 0) == 0;
}

mns_status suite_run(const suite_options *options, json_t **suite, size_t *failures, mns_error *error)
{
    size_t count;
    const stiff_case *cases = stiff_cases(&count);
    suite_job job = {.o = options};
    mns_status status = MNS_OK;
    mns_error local; /* what is refused is kept, even where the caller wants no error */
    json_t *list = json_array();
    for (size_t i = 0; i < count && !status; i++) {
        if (!wanted(options, &cases[i])) continue;
        json_t *one = case_json(&cases[i]);
        job.which = &cases[i];
        job.runs = json_object_get(one, "runs");
        if (!list || json_array_append_new(list, one))
            status = status_no_memory(error, "running a suite");
        else
            status = run_case(&job, error ? error : &local);
    }
    if (!status && !json_array_size(list))
        status = status_fail(error, MNS_ERROR_USAGE,
                             "no case of the stiff suite is named \"%.80s\"; a name may "
                             "hold * and ?",
                             options->only ? options->only : "");
    json_t *made = status ? NULL : json_pack("{s:s, s:O}", "name", "stiff", "cases", list);
    if (!status && !made) status = status_no_memory(error, "running a suite");
    json_decref(list);
    if (status) return status;
    *suite = made;
    *failures = job.failures;
    return MNS_OK;
}
