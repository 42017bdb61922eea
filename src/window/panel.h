/* The panel over the picture, by Dear ImGui behind a C face; panel_missing.c where that was not built in. All
 * that a hand changes in it becomes an action, as of a script. */
#ifndef MNS_WINDOW_PANEL_H
#define MNS_WINDOW_PANEL_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct panel panel;

enum { PANEL_PHASES = 12, PANEL_LINES = 24, PANEL_LINE = 200 };

/* A choice by name: the action "set NAME VALUE", or "NAME VALUE" where it is one of the window's own. */
typedef struct panel_choice {
    const char *label, *action; /* "method", "set method" */
    const char *const *names;
    size_t count;
    const char *chosen;
} panel_choice;

typedef struct panel_phase {
    const char *name;
    double ms;
} panel_phase;

/* What the panel shows: made anew for every showing. */
typedef struct panel_content {
    const panel_choice *choice;
    size_t choice_count;
    double iso, radius_scale, fov;
    int samples;
    int shadows, reflections, refractions, occlusion;
    panel_phase phase[PANEL_PHASES]; /* of the last draw, those that took time */
    size_t phase_count;
    double total_ms;
    size_t draws;                       /* changes when there is a new frame for the graph */
    char line[PANEL_LINES][PANEL_LINE]; /* figures: lists, memory, the sequence, errors */
    size_t line_count;
    const char *left_out; /* lines "part: reason" */
    const char *status;
    bool compares;
    long frame, frames;
    bool plays, loops;
    double speed, scale;
} panel_content;

typedef struct panel_desc {
    void *window; /* GLFWwindow */
    void (*act)(void *context, const char *line);
    void *context;
    const char *help; /* keys and what they do */
} panel_desc;

/* False: not built in. */
bool panel_is_built_in(void);
/* NULL where it is not built in, or cannot start. After the window's callbacks are set. */
panel *panel_open(const panel_desc *desc);
void panel_close(panel *p);
void panel_show(panel *p, const panel_content *content);
/* The cursor, or the keys, are the panel's. */
bool panel_takes_mouse(const panel *p);
bool panel_takes_keys(const panel *p);
/* Whether the phases are to be measured. */
bool panel_measures(const panel *p);
void panel_help(panel *p, bool open);

#ifdef __cplusplus
}
#endif

#endif
