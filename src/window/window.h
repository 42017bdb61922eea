/* The window of `meniscus view`: the same library and the same plan as `meniscus render`, drawn into a frame
 * that is then put on the window. It stands on the public API; what is to be drawn it asks of its host, the
 * program. */
#ifndef MNS_WINDOW_WINDOW_H
#define MNS_WINDOW_WINDOW_H

#include "meniscus.h"

/* What is to be drawn, as it was asked for. */
typedef struct window_settings {
    const char *const *inputs;
    size_t input_count;
    mns_input_options field;
    mns_view view; /* not resolved */
    mns_look look;
    mns_options draw;
    long frame;
    bool no_cache;
    double patience_ms; /* what takes longer is drawn whole only when it is asked for */
    int threads;        /* 0: OpenMP's own choice */
} window_settings;

/* The program that opened the window. What `settings` gives lives until the next `set`, `open`,
 * `back` or `undo`. */
typedef struct window_host {
    void *context;
    const window_settings *(*settings)(void *context);
    /* Option `name` of `meniscus view` becomes `value`; NULL: as if it were not given. Errors: USAGE; then
     * nothing has changed. */
    mns_status (*set)(void *context, const char *name, const char *value, mns_error *error);
    /* Other inputs, or another scene. Errors: USAGE, IO, INPUT; then nothing has changed. */
    mns_status (*open)(void *context, const char *const *names, size_t count, mns_error *error);
    /* The last `set` or `open` is taken back; once. */
    void (*back)(void *context);
    /* The settings as they are can be drawn; and back to those that could. */
    void (*keep)(void *context);
    void (*undo)(void *context);
    /* What of a look hangs on frame 0 of a sequence, as `meniscus render` has it. */
    void (*fix_look)(void *context, const mns_field *first, mns_look *look);
    /* The `meniscus render` that draws this view of this frame, for the caller to free; NULL: out of memory.
     */
    char *(*command)(void *context, const mns_view *view, long frame, mns_method method);
    /* A line for the user's terminal. */
    void (*tell)(void *context, const char *line);
} window_host;

typedef enum window_context { WINDOW_NATIVE = 0, WINDOW_EGL, WINDOW_OSMESA } window_context;

typedef struct window_desc {
    window_host host;
    window_context context; /* which of GLFW's ways makes the GL context */
    const char *script;     /* a file of actions to replay; NULL: none */
    const char *glsl;       /* a folder that shaders are read from when they are reloaded; NULL: none */
    bool panel;             /* begin with the panel open, where there is one */
} window_desc;

/* Opens the window and stays until it is closed. Main thread only. Errors: GL (no display, a driver
 * below 4.3), IO and USAGE (the script). What cannot be
 * drawn is told, and the window stays. */
mns_status window_run(const window_desc *desc, mns_error *error);

/* The actions of scripts and keys, a line each, as --help prints them; for free(). NULL: out of memory. */
char *window_actions_text(void);

#endif
