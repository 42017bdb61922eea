/* The options of `meniscus view`: those of `render` that a window has a use for, and its own. */
#include "app/app.h"
#include "app/render.h"
#include "app/view.h"

#include <stdlib.h>
#include <string.h>

static const char *context_name(int i)
{
    static const char *const names[] = {"native", "egl", "osmesa"}; /* as window_context */
    return names[i];
}

static mns_status option_context(app_options *o, const char *name, const char *text, mns_error *error)
{
    int index;
    mns_status status = parse_name(name, text, context_name, WINDOW_OSMESA + 1, &index, error);
    if (!status) o->window_context = (window_context)index;
    return status;
}

static mns_status option_script(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)error;
    o->script = text;
    return MNS_OK;
}

static mns_status option_glsl(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)error;
    o->glsl = text;
    return MNS_OK;
}

static mns_status option_no_panel(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)text, (void)error;
    o->no_panel = true;
    return MNS_OK;
}

static mns_status option_patience(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_positive(name, text, &o->patience, error);
}

static const option_row OWN[] = {
    {NULL, 0, NULL, "Window:", NULL},
    {"no-panel", 0, NULL, "begin without the panel (Tab shows it)", option_no_panel},
    {"context", 0, "NAME",
     "how GLFW makes the OpenGL context: native (the default), egl or osmesa (nothing to be seen)",
     option_context},
    {"script", 0, "FILE", "replay actions, a line each, as keys and mouse would do them; see below",
     option_script},
    {"patience", 0, "SECONDS",
     "what would take longer stays coarse until Return asks for it whole (default 15)", option_patience},
    {"glsl", 0, "DIR", "a folder of shaders, which F5 reads again: glsl/ of the sources", option_glsl},
};

/* What writes files, or measures many draws, is not a window's. */
static bool is_of_render_alone(const option_row *row)
{
    static const char *const names[] = {"output", "aov",     "stats",    "repeat",  "moving",
                                        "heat",   "explain", "counters", "backend", NULL};
    for (int i = 0; names[i]; i++)
        if (row->name && strcmp(row->name, names[i]) == 0) return true;
    return !row->name && strcmp(row->doc, "Measurement:") == 0;
}

option_table view_options(void)
{
    const size_t own = sizeof OWN / sizeof *OWN;
    option_row *rows = calloc(RENDER_OPTIONS.count + own, sizeof *rows);
    size_t count = 0;
    for (size_t i = 0; rows && i < RENDER_OPTIONS.count; i++)
        if (!is_of_render_alone(&RENDER_OPTIONS.rows[i])) rows[count++] = RENDER_OPTIONS.rows[i];
    for (size_t i = 0; rows && i < own; i++) rows[count++] = OWN[i];
    return (option_table){
        .command = "view",
        .arguments = "INPUT...",
        .doc = "Opens a window on the surface of INPUT, which is as for render: drag to orbit, ? lists the "
               "keys. What is "
               "saved from it is what render draws.",
        .rows = rows,
        .count = count,
    };
}
