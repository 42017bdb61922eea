#include "app/render.h"

#include "app/app.h"
#include "app/names.h"
#include "app/progress.h"
#include "app/stats_json.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One run of the command: what was asked for, and what is being made of it. */
typedef struct render_job {
    const app_options *o;
    names_pattern output, aov, heat;
    mns_input *input;
    long first, last, step, total; /* frames to draw, `last` included */
    mns_field *kept;               /* the frame that fix_view read, if it is still to be drawn */
    long kept_index;
    mns_field *failed; /* the frame that could not be drawn */
    double open_ms, kept_ms;
    mns_view view; /* resolved, the same for all frames */
    mns_look look;
    mns_context *context;
    mns_renderer *renderer;
    mns_frame *frame;
    mns_stats *runs; /* of --repeat */
    json_t *frames;  /* of --stats */
    progress progress;
} render_job;

/* One frame on its way. */
typedef struct render_frame {
    long index;
    mns_field *field;
    mns_image *image;
    double load_ms, readback_ms, encode_ms;
} render_frame;

/* ---- Before anything is drawn ---- */

/* The options against one another, and the places of the outputs. */
static mns_status check_outputs(render_job *job, mns_error *error)
{
    const app_options *o = job->o;
    if (!o->output && !o->aov && !o->stats && !o->explain)
        return app_fail(error, MNS_ERROR_USAGE, "nothing to write: expected -o FILE.png or -o FILE.exr");
    const char *path[] = {o->output, o->aov, o->heat, o->stats};
    const char *option[] = {"--output", "--aov", "--heat", "--stats"};
    names_pattern *pattern[] = {&job->output, &job->aov, &job->heat, NULL};
    for (int i = 0; i < 4; i++) {
        mns_status status = MNS_OK;
        if (!path[i]) continue;
        for (int j = 0; j < i; j++)
            if (path[j] && strcmp(path[i], path[j]) == 0)
                return app_fail(error, MNS_ERROR_USAGE, "%s and %s are both %.200s: give two names",
                                option[j], option[i], path[i]);
        for (size_t k = 0; k < o->input_count; k++)
            if (strcmp(path[i], o->inputs[k]) == 0)
                return app_fail(error, MNS_ERROR_USAGE, "%s %.200s: is an input; give another name",
                                option[i], path[i]);
        if (pattern[i]) status = names_check_ending(option[i], path[i], i == 1, error);
        if (!status && pattern[i]) status = names_parse(option[i], path[i], pattern[i], error);
        if (!status && !o->explain) status = names_check_place(path[i], error);
        if (status) return status;
    }
    return MNS_OK;
}

/* Which frames are drawn, now that the input tells how many it has. */
static mns_status choose_frames(render_job *job, mns_error *error)
{
    const parse_frames_range *asked = &job->o->frames;
    long count = (long)mns_input_frames(job->input);
    bool numbered = job->output.is_numbered || job->aov.is_numbered;
    job->first = asked->given ? asked->first : 0;
    job->last = asked->given ? asked->last : numbered ? count - 1 : 0;
    job->step = asked->given ? asked->step : 1;
    if (job->last >= count)
        return app_fail(error, MNS_ERROR_USAGE, "--frame %ld: the input has %ld frame%s, counted from 0",
                        job->last, count, count == 1 ? "" : "s");
    job->total = (job->last - job->first) / job->step + 1;
    if (job->total == 1) return MNS_OK;
    const char *unnumbered = job->o->output && !job->output.is_numbered ? job->o->output
                             : job->o->aov && !job->aov.is_numbered     ? job->o->aov
                             : job->o->heat && !job->heat.is_numbered   ? job->o->heat
                                                                        : NULL;
    if (unnumbered)
        return app_fail(error, MNS_ERROR_USAGE,
                        "%.200s: one name for %ld frames; expected %%04d in it for the frame's number",
                        unnumbered, job->total);
    return MNS_OK;
}

void render_note_field(const char *name, const mns_field *field)
{
    mns_field_info info;
    mns_field_get_info(field, &info);
    if (info.count && strcmp(info.radius_source, "default spacing") == 0)
        app_note("%.300s: no radii in it; each is %.6g, by the spacing of the particles (--radius sets it)",
                 name, info.radius_median);
    if (info.rows_skipped)
        app_note("%.200s: %zu rows skipped: %.160s", name, info.rows_skipped, info.rows_skipped_why);
}

/* The value range of a column of numbers; false where there is none to hold on to. */
static bool column_range(const mns_field *field, const char *name, double range[2])
{
    mns_column_info column;
    for (size_t i = 0; mns_field_get_column(field, i, &column); i++) {
        if (strcmp(column.name, name)) continue;
        range[0] = column.min;
        range[1] = column.max;
        return !column.is_label && column.min < column.max;
    }
    return false;
}

void render_fix_look(const mns_field *first, mns_look *look)
{
    if (look->color_by && !(look->set & MNS_LOOK_RANGE) && column_range(first, look->color_by, look->range))
        look->set |= MNS_LOOK_RANGE;
}

/* A note of the first frame's radii alone would read as if they were every frame's. */
static void note_radii(const render_job *job)
{
    mns_field_info info;
    mns_field_get_info(job->kept, &info);
    if (info.count && mns_input_frames(job->input) > 1 && !strcmp(info.radius_source, "default spacing"))
        app_note("every frame has the radius of its own spacing; --radius keeps one for all");
}

/* Camera and colour range are those of the input's frame 0, whichever frames are drawn: a frame is the same
 * picture in whatever run it is drawn. */
static mns_status fix_view(render_job *job, mns_error *error)
{
    const app_options *o = job->o;
    const unsigned whole = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT;
    bool wants_range =
        o->look.color_by && !(o->look.set & MNS_LOOK_RANGE) && mns_input_frames(job->input) > 1;
    job->kept_index = wants_range || (o->view.set & whole) != whole ? 0 : job->first;
    double start = app_clock_ms();
    mns_status status = mns_input_read(job->input, (size_t)job->kept_index, &job->kept, error);
    job->kept_ms = app_clock_ms() - start;
    if (status) return status;
    render_note_field(o->input_count == 1 ? o->inputs[0] : "the first frame", job->kept);
    note_radii(job);
    job->look = o->look;
    if (wants_range) render_fix_look(job->kept, &job->look);
    status = mns_view_resolve(&o->view, job->kept, &job->view, error);
    if (job->kept_index == job->first) return status;
    mns_field_destroy(job->kept);
    job->kept = NULL;
    return status;
}

/* The field of frame `index`, for the caller to destroy: the one kept, or read anew. */
static mns_status load(render_job *job, long index, mns_field **field, double *ms, mns_error *error)
{
    double start = app_clock_ms();
    mns_status status = MNS_OK;
    if (job->kept && job->kept_index == index) {
        *field = job->kept;
        *ms = job->open_ms + job->kept_ms;
        job->kept = NULL;
    } else {
        status = mns_input_read(job->input, (size_t)index, field, error);
        *ms = job->open_ms + app_clock_ms() - start;
    }
    job->open_ms = 0;
    return status;
}

/* ---- Drawing ---- */

static mns_status start_renderer(render_job *job, mns_error *error)
{
    size_t repeats = job->o->repeat ? (size_t)job->o->repeat : 1;
    job->runs = calloc(repeats, sizeof *job->runs);
    job->frames = json_array();
    if (!job->runs || !job->frames)
        return app_fail(error, MNS_ERROR_MEMORY, "out of memory before drawing; try a smaller --repeat");
    mns_status status = mns_context_create(job->o->backend, &job->context, error);
    if (!status) status = mns_renderer_create(mns_context_get_proc(job->context), &job->renderer, error);
    if (!status && job->o->no_cache) mns_renderer_keep_programs(job->renderer, NULL);
    if (!status) status = mns_frame_create(job->renderer, &job->frame, error);
    return status;
}

/* What the next draw needs is begun before this one: of this field again, or, with the last of its draws, of
 * the next frame's, which is read for it. */
static mns_status prepare(render_job *job, const render_frame *f, bool again, mns_error *error)
{
    const mns_options *options = &job->o->draw;
    const mns_plan *last = mns_frame_plan(job->frame);
    bool moves = job->total > 1 || options->moved;
    bool trees = (last ? mns_plan_method(last, NULL) : options->method) >= MNS_METHOD_FBVH;
    if (!moves || !trees) return MNS_OK;
    if (again) return options->moved ? mns_renderer_prepare(job->renderer, f->field, options, error) : MNS_OK;
    long next = f->index + job->step;
    if (next > job->last || job->kept) return MNS_OK;
    double start = app_clock_ms();
    mns_status status = mns_input_read(job->input, (size_t)next, &job->kept, error);
    job->kept_index = next;
    job->kept_ms = app_clock_ms() - start;
    return status ? status : mns_renderer_prepare(job->renderer, job->kept, options, error);
}

static mns_status draw(render_job *job, const render_frame *f, mns_error *error)
{
    int repeats = job->o->repeat ? job->o->repeat : 1;
    for (int i = 0; i < repeats; i++) {
        mns_status status = prepare(job, f, i + 1 < repeats, error);
        if (!status)
            status = mns_renderer_draw(job->renderer, f->field, &job->view, &job->look, &job->o->draw,
                                       job->frame, error);
        if (status) return status;
        job->runs[i] = *mns_frame_stats(job->frame);
    }
    return MNS_OK;
}

static mns_status write_image(const render_frame *f, const mns_image *image, const names_pattern *pattern,
                              mns_error *error)
{
    if (!pattern->text || !image) return MNS_OK;
    char *path = names_expand(pattern, f->index);
    if (!path) return app_fail(error, MNS_ERROR_MEMORY, "out of memory naming a file");
    mns_status status = mns_image_write(image, path, error);
    free(path);
    return status;
}

static mns_status write_heat(render_job *job, const render_frame *f, mns_error *error)
{
    mns_image *heat = NULL;
    if (!job->o->heat) return MNS_OK;
    mns_status status = mns_image_heat(f->image, MNS_WORK_ROUNDS, job->look.color_map, &heat, NULL, error);
    if (!status) status = write_image(f, heat, &job->heat, error);
    mns_image_destroy(heat);
    return status;
}

/* Reads the planes back and writes the files that were asked for. */
static mns_status save(render_job *job, render_frame *f, mns_error *error)
{
    if (!job->o->output && !job->o->aov && !job->o->heat) return MNS_OK;
    double start = app_clock_ms();
    mns_status status = mns_frame_read(job->frame, &f->image, error);
    double read = app_clock_ms();
    if (!status) status = write_image(f, f->image, &job->output, error);
    if (!status) status = write_image(f, f->image, &job->aov, error);
    if (!status) status = write_heat(job, f, error);
    f->readback_ms = read - start;
    f->encode_ms = app_clock_ms() - read;
    return status;
}

static mns_status keep_stats(render_job *job, const render_frame *f, mns_error *error)
{
    if (!job->o->stats) return MNS_OK;
    stats_frame figures = {.index = f->index,
                           .stats = mns_frame_stats(job->frame),
                           .plan = mns_frame_plan(job->frame),
                           .renderer = mns_renderer_name(job->renderer),
                           .context = mns_context_name(job->context),
                           .messages = mns_renderer_messages(job->renderer, NULL),
                           .load_ms = f->load_ms,
                           .readback_ms = f->readback_ms,
                           .encode_ms = f->encode_ms,
                           .runs = job->o->repeat ? job->runs : NULL,
                           .run_count = (size_t)job->o->repeat};
    if (json_array_append_new(job->frames, stats_json_frame(&figures)))
        return app_fail(error, MNS_ERROR_MEMORY, "out of memory keeping the figures of frame %ld", f->index);
    return MNS_OK;
}

/* One line a frame on standard output. */
static mns_status print_frame(render_job *job, const render_frame *f, mns_error *error)
{
    const mns_stats *s = mns_frame_stats(job->frame);
    const names_pattern *pattern = job->output.text ? &job->output : &job->aov;
    char *path = pattern->text ? names_expand(pattern, f->index) : strdup("(not written)");
    if (!path) return app_fail(error, MNS_ERROR_MEMORY, "out of memory naming a file");
    progress_clear(&job->progress);
    printf("%s: %dx%d, %llu particles, %s, %s, %s, ", path, s->width, s->height, (unsigned long long)s->balls,
           s->method, s->solver, mns_renderer_name(job->renderer));
    if (job->o->repeat)
        printf("first %.1f ms, median of %d %.1f ms\n", job->runs[0].ms_total, job->o->repeat,
               stats_median(job->runs, (size_t)job->o->repeat, offsetof(mns_stats, ms_total)));
    else
        printf("%.1f ms\n", s->ms_total);
    fflush(stdout);
    free(path);
    return MNS_OK;
}

/* Where the input lies outside the stated domain; how many balls a ray meets is known only where it was
 * counted. */
static void note_domain(const mns_frame *frame)
{
    const uint64_t most_active = 10000;
    const mns_stats *stats = mns_frame_stats(frame);
    app_note_warnings(mns_frame_plan(frame));
    if (stats->timed && stats->list_max > most_active)
        app_note(
            "a ray meets %llu balls: if more than %llu of them are around one point, it lies outside the "
            "stated domain (docs/domain.md)",
            (unsigned long long)stats->list_max, (unsigned long long)most_active);
}

static bool sees_something(const mns_image *image)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++)
        if (isfinite(image->t[i])) return true;
    return false;
}

/* What was asked for and comes to nothing. */
static void note_nothing(const render_job *job, const mns_image *image)
{
    size_t count;
    const mns_left_out *out = mns_plan_left_out(mns_frame_plan(job->frame), &count);
    for (size_t i = 0; i < count && job->look.effects.shadows; i++)
        if (!strcmp(out[i].part, "shadows")) app_note("no shadows: %s (--light)", out[i].reason);
    if (image && mns_frame_stats(job->frame)->balls && !sees_something(image))
        app_note("no pixel sees the surface: f reaches the level nowhere, or not where the view looks");
}

static mns_status render_one(render_job *job, long index, mns_error *error)
{
    render_frame f = {.index = index};
    mns_status status = load(job, index, &f.field, &f.load_ms, error);
    if (!status) status = draw(job, &f, error);
    if (!status && index == job->first) note_domain(job->frame);
    if (!status) status = save(job, &f, error);
    if (!status && index == job->first) note_nothing(job, f.image);
    if (!status) status = keep_stats(job, &f, error);
    if (!status) status = print_frame(job, &f, error);
    mns_image_destroy(f.image);
    if (!status) /* else its tree may still be being built */
        mns_field_destroy(f.field);
    else
        job->failed = f.field;
    return status;
}

/* What the driver complained of, for a report of the fault. */
static void note_messages(const mns_renderer *renderer)
{
    const char *last;
    size_t count = mns_renderer_messages(renderer, &last);
    if (count) app_note("the driver gave %zu messages; the last: %.360s", count, last);
}

static mns_status render_all(render_job *job, mns_error *error)
{
    mns_status status = start_renderer(job, error);
    if (status) return status;
    progress_begin(&job->progress, "frame", job->total);
    for (long i = 0; i < job->total && !status; i++) {
        status = render_one(job, job->first + i * job->step, error);
        progress_show(&job->progress, i + 1);
    }
    progress_clear(&job->progress);
    note_messages(job->renderer);
    if (!status && job->o->stats) status = stats_json_write(job->o->stats, job->frames, error);
    return status;
}

static mns_status explain(render_job *job, mns_error *error)
{
    mns_field *field;
    double ms;
    mns_status status = load(job, job->first, &field, &ms, error);
    if (status) return status;
    status = render_explain(job->o, field, &job->view, &job->look, error);
    mns_field_destroy(field);
    return status;
}

static mns_status run(render_job *job, mns_error *error)
{
    const app_options *o = job->o;
    if (o->input_count == 0)
        return app_fail(
            error, MNS_ERROR_USAGE,
            "no input: expected a particle file, a scene with an input, or a generator such as tornado:4000");
    mns_status status = check_outputs(job, error);
    if (status) return status;
    if (o->threads) omp_set_num_threads(o->threads);
    double start = app_clock_ms();
    status = mns_input_open(o->inputs, o->input_count, &o->field, &job->input, error);
    job->open_ms = app_clock_ms() - start;
    if (!status) status = choose_frames(job, error);
    if (!status) status = fix_view(job, error);
    if (!status) status = o->explain ? explain(job, error) : render_all(job, error);
    return status;
}

int app_render(int argc, char **argv)
{
    app_options o;
    mns_error error;
    mns_status status = options_read(&RENDER_OPTIONS, argc, argv, &o, &error);
    if (!status && !o.help) {
        render_job job = {.o = &o};
        status = run(&job, &error);
        json_decref(job.frames);
        free(job.runs);
        mns_frame_destroy(job.frame);
        mns_renderer_destroy(job.renderer);
        mns_field_destroy(job.kept);
        mns_field_destroy(job.failed);
        mns_context_destroy(job.context);
        mns_input_close(job.input);
    }
    options_free(&o);
    return status ? app_report(&error) : APP_DONE;
}
