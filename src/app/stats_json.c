#include "app/stats_json.h"

#include "app/app.h"
#include "base/json.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Milliseconds a phase in the order of their names in the design, "load" first and "total" last. */
static json_t *milliseconds(const double ms[MNS_PHASE_COUNT], double total, const stats_frame *frame)
{
    json_t *object = json_object();
    json_object_set_new(object, "load", json_number(frame->load_ms));
    for (int phase = 0; phase < MNS_PHASE_COUNT; phase++)
        json_object_set_new(object, mns_phase_name((mns_phase)phase),
                            json_number(phase == MNS_PHASE_READBACK ? frame->readback_ms : ms[phase]));
    json_object_set_new(object, "encode", json_number(frame->encode_ms));
    json_object_set_new(object, "total", json_number(total));
    return object;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double stats_median(const mns_stats *runs, size_t n, size_t member)
{
    double *value = calloc(n, sizeof *value);
    if (!value) return NAN;
    for (size_t i = 0; i < n; i++) memcpy(&value[i], (const char *)&runs[i] + member, sizeof *value);
    qsort(value, n, sizeof *value, by_value);
    double middle = 0.5 * (value[(n - 1) / 2] + value[n / 2]);
    free(value);
    return middle;
}

/* First and median of the runs; each phase has a median of its own, so they need not add up to the total's.
 */
static json_t *repeats(const stats_frame *frame)
{
    const mns_stats *runs = frame->runs;
    double ms[MNS_PHASE_COUNT];
    for (size_t phase = 0; phase < MNS_PHASE_COUNT; phase++)
        ms[phase] = stats_median(runs, frame->run_count, offsetof(mns_stats, ms) + phase * sizeof *ms);
    double total = stats_median(runs, frame->run_count, offsetof(mns_stats, ms_total));
    return json_pack("{s:I, s:{s:o}, s:{s:o}}", "n", (json_int_t)frame->run_count, "first", "ms",
                     milliseconds(runs[0].ms, runs[0].ms_total, frame), "median", "ms",
                     milliseconds(ms, total, frame));
}

static json_t *counts(const stats_frame *frame)
{
    const mns_stats *s = frame->stats;
    json_t *object = json_object();
    json_object_set_new(object, "balls", json_count(s->balls));
    json_object_set_new(object, "balls_in_view", json_count(s->balls_in_view));
    json_object_set_new(object, "pixels", json_count((uint64_t)s->width * (uint64_t)s->height));
    json_object_set_new(object, "pixels_hit", json_count(s->pixels_hit));
    json_object_set_new(object, "pixels_undecided", json_count(s->pixels_undecided));
    json_object_set_new(object, "effects_rays", json_count(s->effects_rays));
    json_object_set_new(object, "effects_undecided", json_count(s->effects_undecided));
    json_object_set_new(object, "list_nodes", json_count(s->list_nodes));
    json_object_set_new(object, "tiles", json_count(s->tiles));
    json_object_set_new(object, "passes", json_count(s->passes));
    json_object_set_new(object, "programs", json_count(s->programs));
    json_object_set_new(object, "programs_kept", json_count(s->programs_kept));
    json_object_set_new(object, "buffers", json_count(s->buffers));
    json_object_set_new(object, "driver_messages", json_count(frame->messages));
    return object;
}

static json_t *fallbacks(const mns_stats *s)
{
    json_t *object = json_object();
    json_object_set_new(object, "pool_grown", json_count(s->fallbacks.pool_grown));
    json_object_set_new(object, "tiled", json_count(s->fallbacks.tiled));
    json_object_set_new(object, "lists_sorted", json_count(s->fallbacks.lists_sorted));
    json_object_set_new(object, "active_overflow", json_count(s->fallbacks.active_overflow));
    json_object_set_new(object, "root_cap", json_count(s->fallbacks.root_cap));
    json_object_set_new(object, "undecided_float", json_count(s->fallbacks.undecided_float));
    return object;
}

static json_t *left_out(const mns_plan *plan)
{
    size_t n = 0;
    const mns_left_out *parts = plan ? mns_plan_left_out(plan, &n) : NULL;
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++)
        json_array_append_new(list,
                              json_pack("{s:s, s:s}", "part", parts[i].part, "reason", parts[i].reason));
    return list;
}

static json_t *warnings(const mns_plan *plan)
{
    size_t n = 0;
    const char *const *lines = plan ? mns_plan_warnings(plan, &n) : NULL;
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++) json_array_append_new(list, json_string(lines[i]));
    return list;
}

/* What was built; null for methods that build no tree. */
static json_t *tree(const mns_stats *s)
{
    const mns_tree_stats *t = &s->tree;
    if (!t->balls) return json_null();
    return json_pack("{s:I, s:I, s:I, s:I, s:I, s:f, s:I, s:I, s:I, s:b, s:f, s:f}", "balls",
                     (json_int_t)t->balls, "leaves", (json_int_t)t->leaves, "depth", (json_int_t)t->depth,
                     "references", (json_int_t)t->references, "leaf_largest", (json_int_t)t->leaf_largest,
                     "leaf_mean", t->leaf_mean, "discarded", (json_int_t)t->discarded, "leaves_bounded",
                     (json_int_t)t->leaves_bounded, "bytes", (json_int_t)t->bytes, "made_smaller",
                     t->made_smaller, "build_ms", t->build_ms, "sort_ms", t->sort_ms);
}

/* Means of a ray's work; null where it was not counted. */
static json_t *work(const mns_stats *s)
{
    static const char *const names[MNS_WORK_COUNT] = {"nodes", "leaves", "balls", "rounds"};
    if (!s->counted) return json_null();
    json_t *object = json_object();
    for (int i = 0; i < MNS_WORK_COUNT; i++) json_object_set_new(object, names[i], json_number(s->work[i]));
    return object;
}

/* The legend of the colour map; null where the surface has one colour. */
static json_t *legend(const mns_stats *s)
{
    if (!s->color_by || !*s->color_by) return json_null();
    json_t *object = json_object(), *range = json_array();
    json_object_set_new(object, "by", json_text(s->color_by));
    json_object_set_new(object, "map", json_string(s->color_map));
    json_array_append_new(range, json_number(s->color_range[0]));
    json_array_append_new(range, json_number(s->color_range[1]));
    json_object_set_new(object, "range", range);
    return object;
}

/* The most memory the process has held, in bytes; 0 where the system does not tell. */
static json_int_t peak_memory(void)
{
    FILE *status = fopen("/proc/self/status", "r");
    char line[160];
    long long kib = 0;
    while (status && fgets(line, sizeof line, status))
        if (sscanf(line, "VmHWM: %lld kB", &kib) == 1) break;
    if (status) fclose(status);
    return (json_int_t)kib * 1024;
}

json_t *stats_json_frame(const stats_frame *frame)
{
    const mns_stats *s = frame->stats;
    json_t *object = json_object();
    json_object_set_new(object, "frame", json_integer(frame->index));
    json_object_set_new(object, "method", json_string(s->method));
    const char *reason;
    mns_plan_method(frame->plan, &reason);
    json_object_set_new(object, "method_reason", json_string(reason));
    json_object_set_new(object, "solver", json_string(s->solver));
    json_object_set_new(object, "gather", json_string(s->gather));
    json_object_set_new(object, "renderer", json_string(frame->renderer));
    json_object_set_new(object, "context", json_string(frame->context));
    json_object_set_new(object, "size", json_pack("[i, i]", s->width, s->height));
    json_object_set_new(object, "timed", json_boolean(s->timed));
    json_object_set_new(object, "t_unit", json_number(s->t_unit));
    json_object_set_new(object, "ms", milliseconds(s->ms, s->ms_total, frame));
    if (frame->runs) json_object_set_new(object, "repeat", repeats(frame));
    json_object_set_new(object, "counts", counts(frame));
    json_object_set_new(object, "lists",
                        json_pack("{s:o, s:o, s:o}", "mean", json_number(s->list_mean), "p99",
                                  json_number(s->list_p99), "max", json_count(s->list_max)));
    json_object_set_new(object, "memory", json_pack("{s:I}", "peak_rss_bytes", peak_memory()));
    json_object_set_new(object, "left_out", left_out(frame->plan));
    json_object_set_new(object, "warnings", warnings(frame->plan));
    json_object_set_new(object, "fallbacks", fallbacks(s));
    json_object_set_new(object, "noise",
                        json_pack("{s:f, s:f}", "shadow", s->noise_shadow, "occlusion", s->noise_occlusion));
    json_object_set_new(object, "work", work(s));
    json_object_set_new(object, "tree", tree(s));
    json_object_set_new(object, "color", legend(s));
    return object;
}

/* Writes the document beside `path`, then gives it its name. */
static mns_status write_file(const char *path, const json_t *document, mns_error *error)
{
    size_t size = strlen(path) + 40;
    char *beside = malloc(size);
    if (!beside) return app_fail(error, MNS_ERROR_MEMORY, "out of memory writing %.300s", path);
    snprintf(beside, size, "%s.meniscus-%ld.part", path, (long)getpid());
    mns_status status = MNS_OK;
    errno = 0;
    if (json_dump_file(document, beside, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) || rename(beside, path)) {
        status =
            app_fail(error, MNS_ERROR_IO, "%.300s: cannot write: %s", path, strerror(errno ? errno : EIO));
        unlink(beside);
    }
    free(beside);
    return status;
}

mns_status stats_json_write(const char *path, const json_t *frames, mns_error *error)
{
    size_t n = json_array_size(frames);
    json_t *document = json_pack("{s:i}", "schema", 1);
    if (document) json_object_update(document, json_array_get(frames, n - 1));
    if (document && n > 1) json_object_set(document, "frames", (json_t *)frames);
    if (!document) return app_fail(error, MNS_ERROR_MEMORY, "out of memory writing %.300s", path);
    mns_status status = write_file(path, document, error);
    json_decref(document);
    return status;
}
