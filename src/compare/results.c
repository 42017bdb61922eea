#include "compare/results.h"

#include "base/json.h"
#include "base/memory.h"
#include "base/status.h"
#include "commit.h" /* made by the build */
#include "compare/machine.h"

#include <errno.h>
#include <string.h>
#include <time.h>

/* ---- Values ---- */

static json_t *point(const double v[3])
{
    return json_pack("[f, f, f]", v[0], v[1], v[2]);
}

/* ---- A run ---- */

static json_t *spread(const metrics_spread *s)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o}", "median", json_number(s->median), "p99",
                     json_number(s->p99), "p999", json_number(s->p999), "max", json_number(s->max), "rms",
                     json_number(s->rms));
}

/* The phases that the whole is made of: shading and reading back are not in it. */
static json_t *times(const run_times *ms)
{
    json_t *phases = json_object();
    for (int p = 0; p < MNS_PHASE_SHADE && ms->has_phases; p++)
        json_object_set_new(phases, mns_phase_name((mns_phase)p), json_number(ms->phase[p]));
    return json_pack("{s:o, s:o, s:o, s:o}", "median", json_number(ms->median), "min", json_number(ms->min),
                     "max", json_number(ms->max), "phases", phases);
}

static void put_effects(json_t *object, const metrics_effects *e)
{
    json_object_set_new(object, "effects_compared", e->any ? json_count(e->compared) : json_null());
    json_object_set_new(object, "effects_undecided", e->any ? json_count(e->undecided) : json_null());
    for (truth_term term = 0; term < TRUTH_TERMS; term++) {
        char name[24];
        snprintf(name, sizeof name, "%s_wrong", metrics_term_name(term));
        json_object_set_new(object, name, e->has[term] ? json_count(e->wrong[term]) : json_null());
    }
}

static json_t *errors(const metrics *m)
{
    json_t *object = json_object();
    json_object_set_new(object, "pixels", json_count(m->pixels));
    json_object_set_new(object, "hits", json_count(m->hits));
    json_object_set_new(object, "missed", json_count(m->missed));
    json_object_set_new(object, "invented", json_count(m->invented));
    json_object_set_new(object, "missed_decided", json_count(m->missed_decided));
    json_object_set_new(object, "invented_decided", json_count(m->invented_decided));
    json_object_set_new(object, "wrong_root", json_count(m->wrong_root));
    json_object_set_new(object, "undecided", json_count(m->undecided));
    json_object_set_new(object, "compared", json_count(m->compared));
    put_effects(object, &m->effects);
    json_object_set_new(object, "t", spread(&m->t));
    json_object_set_new(object, "footprint", spread(&m->footprint));
    json_object_set_new(object, "residual", spread(&m->residual));
    json_object_set_new(object, "normal", spread(&m->normal));
    json_object_set_new(object, "psnr", json_number(m->psnr));
    return object;
}

static json_t *worst(const metrics *m)
{
    json_t *list = json_array();
    for (size_t i = 0; i < m->worst_count; i++) {
        const metrics_pixel *p = &m->worst[i];
        json_array_append_new(list, json_pack("{s:i, s:i, s:s, s:o, s:o, s:o}", "x", p->x, "y", p->y, "kind",
                                              metrics_kind_name(p->kind), "t", json_number(p->t), "truth",
                                              json_number(p->truth), "error", json_number(p->error)));
    }
    return list;
}

json_t *results_run(const run_result *run)
{
    const run_spec *spec = &run->spec;
    bool failed = run->status != MNS_OK;
    json_t *settings = json_object();
    for (size_t i = 0; i < spec->setting_count; i++)
        json_object_set_new(settings, spec->setting[i].key, json_string(spec->setting[i].value));
    return json_pack("{s:o, s:s, s:s, s:o, s:i, s:o, s:o, s:o, s:b, s:o}", "name", json_text(spec->name),
                     "method", spec->method, "solver", spec->solver, "settings", settings, "frames",
                     run->ms.frames, "failed", failed ? json_text(run->error.text) : json_null(), "ms",
                     failed ? json_null() : times(&run->ms), "errors",
                     failed ? json_null() : errors(&run->errors), "pareto", (int)run->pareto, "worst",
                     failed ? json_array() : worst(&run->errors));
}

/* ---- What it is of ---- */

static json_t *input(const results_about *about)
{
    if (!about->field) return json_null();
    mns_field_info info;
    char hash[TRUTH_HASH_SIZE];
    mns_field_get_info(about->field, &info);
    truth_hash_field(about->field, hash);
    return json_pack("{s:o, s:o, s:s, s:f, s:s}", "name", json_text(about->input), "count",
                     json_count(info.count), "kernel", mns_kernel_name(info.kernel), "iso", info.iso, "hash",
                     hash);
}

static json_t *view(const mns_view *v)
{
    if (!v) return json_null();
    return json_pack("{s:o, s:o, s:o, s:f, s:i, s:i}", "eye", point(v->eye), "look_at", point(v->look_at),
                     "up", point(v->up), "fov", v->fov, "width", v->width, "height", v->height);
}

static json_t *truth_figures(const truth_planes *t)
{
    if (!t) return json_null();
    return json_pack("{s:o, s:o, s:o, s:b}", "ms", json_number(t->ms), "hits", json_count(t->hits),
                     "undecided", json_count(t->undecided), "cached", (int)t->cached);
}

static json_t *now(void)
{
    char text[32];
    time_t seconds = time(NULL);
    struct tm parts;
    if (!gmtime_r(&seconds, &parts)) return json_null();
    strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return json_string(text);
}

mns_status results_document(const results_about *about, const run_result *runs, size_t count,
                            json_t **document, mns_error *error)
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) json_array_append_new(list, results_run(&runs[i]));
    bool whole = json_array_size(list) == count;
    json_t *made =
        json_pack("{s:i, s:o, s:o, s:o, s:o, s:o, s:o, s:s, s:o, s:o, s:o, s:o, s:n}", "schema", 1, "command",
                  json_text(about->command), "created", now(), "machine", machine_describe(), "renderer",
                  json_text(about->renderer), "backend", json_text(about->backend), "version",
                  json_text(mns_version()), "commit", MNS_COMMIT, "input", input(about), "view",
                  view(about->view), "truth", truth_figures(about->truth), "runs", list, "suite");
    if (!made || !whole) {
        json_decref(made);
        return status_no_memory(error, "writing down the results");
    }
    *document = made;
    return MNS_OK;
}

mns_status results_write_json(const json_t *document, const char *path, mns_error *error)
{
    char reason[96];
    errno = 0;
    if (!json_dump_file(document, path, JSON_INDENT(2) | JSON_REAL_PRECISION(9))) return MNS_OK;
    return status_fail(error, MNS_ERROR_IO, "%.300s: cannot write: %s", path,
                       strerror_r(errno ? errno : EIO, reason, sizeof reason));
}
