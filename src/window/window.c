/* The GLFW window: opened, waited on, closed. All else is in the parts that viewer.h names. */
#include "window/viewer.h"

#include "base/clock.h"
#include "base/status.h"
#include "window/keys.h"
#include "window/panel_fill.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double FLICKER_MS = 400;

/* ---- Telling ---- */

void viewer_tell(viewer *v, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(v->status, sizeof v->status, format, arguments);
    va_end(arguments);
    v->desc->host.tell(v->desc->host.context, v->status);
    v->stale = true;
}

void viewer_tell_error(viewer *v, const mns_error *error)
{
    viewer_tell(v, "error: %s", error->text);
}

void viewer_wake(void)
{
    glfwPostEmptyEvent();
}

static void show_title(viewer *v)
{
    char title[sizeof v->title];
    const side *a = &v->side[0], *b = &v->side[1];
    const char *input = v->settings->input_count ? v->settings->inputs[0] : "";
    const char *slash = strrchr(input, '/');
    size_t used = (size_t)snprintf(title, sizeof title, "%.60s", slash ? slash + 1 : input);
    if (v->now->timeline.frames > 1 && used < sizeof title)
        used += (size_t)snprintf(title + used, sizeof title - used, " [%ld/%ld]", v->now->timeline.shown,
                                 v->now->timeline.frames - 1);
    if (v->now->timeline.dropped && used < sizeof title)
        used += (size_t)snprintf(title + used, sizeof title - used, " %ld dropped", v->now->timeline.dropped);
    if (a->is_drawn && used < sizeof title)
        used += (size_t)snprintf(title + used, sizeof title - used, " - %s %s %.1f ms",
                                 mns_frame_stats(a->frame)->method, mns_frame_stats(a->frame)->solver, a->ms);
    if (v->compare != COMPARE_OFF && b->is_drawn && used < sizeof title)
        used += (size_t)snprintf(title + used, sizeof title - used, " | %s %.1f ms", v->other_name, b->ms);
    if (v->compare != COMPARE_OFF && v->difference.is_known && used < sizeof title)
        used +=
            (size_t)snprintf(title + used, sizeof title - used, ": %zu pixels differ", v->difference.pixels);
    const char *last = v->hover.is_on && *v->hover.text ? v->hover.text : v->status;
    if (*last && used < sizeof title) snprintf(title + used, sizeof title - used, " - %.160s", last);
    if (strcmp(title, v->title) == 0) return;
    memcpy(v->title, title, sizeof title);
    glfwSetWindowTitle(v->window, title);
}

void viewer_present(viewer *v)
{
    drawing_show(v);
    if (v->panel) panel_fill(v);
}

static void present(viewer *v)
{
    mns_error error;
    double start = clock_ms();
    viewer_present(v);
    v->screen.gl.Finish(); /* the buffers' swap waits for the display: that is nobody's time */
    v->show_ms = clock_ms() - start;
    if (screen_check(&v->screen, "putting the picture on the window", &error)) viewer_tell_error(v, &error);
    glfwSwapBuffers(v->window);
    spin_shown(&v->spin, clock_ms());
    show_title(v);
    v->stale = false;
}

void viewer_resize(viewer *v, int width, int height)
{
    if (width < 1 || height < 1 || (width == v->width && height == v->height))
        return; /* 0: it is iconified */
    v->width = width;
    v->height = height;
    drawing_change(v, true);
}

/* ---- The panel ---- */

static void act(void *context, const char *line)
{
    action_do(context, line);
}

/* The keys in lines, for the caller to free. */
static char *keys_text(void)
{
    static const char mouse[] = "drag: orbit; with shift, or the right button: pan; with ctrl: look around\n"
                                "wheel: zoom to the cursor; double click: centre; W A S D Q E: fly\n";
    size_t size = sizeof mouse, used;
    const key_row *row;
    for (int i = 0; (row = key_at(i)); i++) size += strlen(row->name) + strlen(row->doc) + 16;
    char *text = malloc(size);
    if (!text) return NULL;
    used = (size_t)snprintf(text, size, "%s", mouse);
    for (int i = 0; (row = key_at(i)); i++)
        used += (size_t)snprintf(text + used, size - used, "%-9s %s\n", row->name, row->doc);
    return text;
}

bool viewer_open_panel(viewer *v)
{
    if (v->desc->context == WINDOW_OSMESA)
        return false; /* ImGui finds its own OpenGL, which is another one */
    const panel_desc desc = {.window = v->window, .act = act, .context = v, .help = v->keys};
    v->panel = panel_open(&desc);
    v->polish = 3;
    return v->panel != NULL;
}

void viewer_close_panel(viewer *v)
{
    panel_close(v->panel);
    v->panel = NULL;
    v->panel_goes = false;
    v->stale = true;
}

void viewer_help(viewer *v)
{
    if (v->panel || viewer_open_panel(v))
        panel_help(v->panel, true);
    else if (v->keys)
        v->desc->host.tell(v->desc->host.context, v->keys);
    v->polish = 3;
}

/* ---- Opening and closing ---- */

static mns_status open_all(viewer *v, mns_error *error)
{
    mns_status status = v->desc->script ? script_read(&v->script, v->desc->script, error) : MNS_OK;
    if (!status) status = viewer_open_window(v, error);
    if (!status) status = screen_open(&v->screen, v->get_proc, error);
    if (!status) status = drawing_begin(v, error);
    if (!status) status = divider_other(v, "list:exact", error);
    if (!status) status = subject_open(v, true, error);
    if (status) return status;
    viewer_listen(v);
    const int roomy = 800; /* units, below which the panel would hide the picture */
    if (v->desc->panel && v->width >= roomy * v->dots) viewer_open_panel(v);
    return MNS_OK;
}

/* What the driver complained of, for a report of the fault. */
static void tell_messages(viewer *v)
{
    for (int i = 0; i < SIDES; i++) {
        const char *last;
        size_t count = v->side[i].renderer ? mns_renderer_messages(v->side[i].renderer, &last) : 0;
        if (count) viewer_tell(v, "the driver gave %zu messages; the last: %.360s", count, last);
    }
}

/* GLFW itself stays initialised: glfwTerminate would take windows along that are not this one. */
static void close_all(viewer *v)
{
    check_stop(&v->check);
    tell_messages(v);
    panel_close(v->panel);
    subject_free(v, v->now);
    subject_free(v, v->trial.before);
    drawing_end(v);
    screen_close(&v->screen);
    script_free(&v->script);
    spin_free(&v->spin);
    free(v->keys);
    if (v->window) glfwDestroyWindow(v->window);
}

/* ---- The loop ---- */

/* Nothing more is to come; of what plays, nothing more of its frame. */
static bool is_at_rest(const viewer *v)
{
    bool drawn = v->stage == STAGE_DONE || (v->now->timeline.playing && v->stage != STAGE_CHANGED);
    return drawn && !v->stale && v->now->wanted < 0 && !v->check.running && !v->spin.until_ms;
}

/* The next lines of the script, until one waits. Errors: as the action's, with the script's line. */
static mns_status run_script(viewer *v, mns_error *error)
{
    script *s = &v->script;
    while (s->next && !v->closing) {
        mns_error why;
        if (s->rests && !is_at_rest(v)) return MNS_OK;
        if (clock_ms() < s->until_ms) return MNS_OK;
        s->rests = false;
        const char *line = script_next(s);
        if (!line) return MNS_OK;
        mns_status status = action_run(v, line, &why);
        /* What cannot be opened or drawn is told; a line that makes no sense ends the script. */
        if (status && status != MNS_ERROR_USAGE) viewer_tell_error(v, &why);
        if (status == MNS_ERROR_USAGE)
            return status_fail(error, status, "%.100s:%zu: %.340s", s->path, s->line, why.text);
    }
    return MNS_OK;
}

/* How long the window may sleep, milliseconds: INFINITY where only a hand wakes it. */
static double turn(viewer *v, mns_status *status, mns_error *error)
{
    double now = clock_ms(), again, wait;
    mns_error why;
    *status = run_script(v, error);
    if (*status) return 0;
    if (v->panel_goes) viewer_close_panel(v);
    bool flies = events_spin(v) || events_fly(v);
    wait = frames_step(v);
    if (drawing_step(v, &again, &why)) {
        settings_refused(v);
        viewer_tell_error(v, &why);
        again = 0;
    }
    wait = fmin(flies ? 0 : wait, again);
    check_tell(v);
    events_hover(v);
    if (v->compare == COMPARE_FLICKER) {
        if (now - v->flicker_ms > FLICKER_MS) {
            v->flicker_b = !v->flicker_b;
            v->flicker_ms = now;
            v->stale = true;
        }
        wait = fmin(wait, FLICKER_MS - (now - v->flicker_ms));
    }
    if (v->panel && v->polish > 0) {
        v->polish--;
        v->stale = true;
        wait = 0;
    }
    if (v->stale) present(v);
    if (v->script.next) wait = fmin(wait, v->script.until_ms > now ? v->script.until_ms - now : 0);
    return v->stale ? 0 : wait;
}

static mns_status loop(viewer *v, mns_error *error)
{
    mns_status status = MNS_OK;
    while (!v->closing && !glfwWindowShouldClose(v->window)) {
        double wait = turn(v, &status, error);
        if (status) break;
        if (wait <= 0)
            glfwPollEvents();
        else if (isfinite(wait))
            glfwWaitEventsTimeout(wait * 1e-3 + 1e-4);
        else
            glfwWaitEvents();
    }
    return status;
}

mns_status window_run(const window_desc *desc, mns_error *error)
{
    viewer *v = calloc(1, sizeof *v);
    if (!v) return status_no_memory(error, "opening a window");
    v->desc = desc;
    v->settings = desc->host.settings(desc->host.context);
    v->keys = keys_text();
    v->place = 0.5;
    mns_status status = open_all(v, error);
    if (!status) status = loop(v, error);
    close_all(v);
    free(v);
    return status;
}
