/* What is behind one open window, handed from part to part. */
#ifndef MNS_WINDOW_VIEWER_H
#define MNS_WINDOW_VIEWER_H

#include "window/camera.h"
#include "window/check.h"
#include "window/pace.h"
#include "window/panel.h"
#include "window/player.h"
#include "window/screen.h"
#include "window/script.h"
#include "window/spin.h"
#include "window/timeline.h"
#include "window/window.h"

enum { SIDES = 2, STATUS_SIZE = 480 };

/* How two pictures share the window. */
typedef enum compare_mode {
    COMPARE_OFF = 0,
    COMPARE_DIVIDER,
    COMPARE_FLICKER,
    COMPARE_DIFFERENCE,
    COMPARE_COUNT
} compare_mode;

/* One picture: that of the settings, or, to compare with, that of another method. */
typedef struct side {
    mns_renderer *renderer;
    mns_frame *frame;
    bool is_drawn; /* the frame holds a picture, if that before one that failed */
    int sum;       /* samples that are summed in it */
    int samples;   /* that its colours were weighted for */
    double ms;     /* of its last draw */
} side;

/* How far the picture of the present view is. */
typedef enum stage {
    STAGE_DONE = 0,
    STAGE_CHANGED, /* nothing of it is drawn yet */
    STAGE_COARSE,  /* it moved: fewer pixels than the window has */
    STAGE_SUMMED   /* one sample a pixel at least */
} stage;

/* Where it differs, once both pictures are whole. */
typedef struct difference {
    bool is_known;
    size_t pixels; /* one side alone hits, or the distances are further apart than 1e-5 of them */
    double most;   /* of the distances, scene units */
} difference;

/* The point under the cursor. */
typedef struct hover {
    bool is_on, is_known;
    char text[STATUS_SIZE];
} hover;

/* What is looked at: an input that was opened, and where in it. */
typedef struct subject {
    player player;
    mns_field *field, *ahead; /* of timeline.shown; the next one, which was prepared */
    mns_field *first;         /* frame 0 of a sequence; else NULL */
    long ahead_frame;
    mns_reference *reference; /* of `field`, made when it is first asked for */
    mns_input_options opened; /* what the input was opened with */
    timeline timeline;
    long wanted; /* a frame that was asked for by hand; -1: none */
    double read_ms;
} subject;

/* Settings that have changed, and by which nothing was drawn yet: what there was before them. */
typedef struct trial {
    bool is_on;
    subject *before; /* NULL: the same one */
    camera camera, home;
    mns_view seen;
    stage stage; /* how far its picture was, at this size; */
    bool is_coarse;
    int width, height;
    char opens[STATUS_SIZE]; /* what is told once it is drawn; "": nothing */
} trial;

typedef struct viewer {
    const window_desc *desc;
    const window_settings *settings;
    struct GLFWwindow *window;
    mns_get_proc get_proc;
    screen screen;
    panel *panel;    /* NULL: closed, or not built in */
    bool panel_goes; /* at the next turn: its own callbacks may be what asked for it */
    char *keys;      /* their list */
    char title[320];
    char status[STATUS_SIZE]; /* the last thing that was told */
    bool closing;

    /* what is shown */
    subject *now;
    mns_look look; /* the settings' one, its range fixed by frame 0 */
    mns_view seen; /* the settings' view that the camera comes from */
    trial trial;
    camera camera, home;
    int width, height; /* of the window's framebuffer, pixels */
    double dots;       /* framebuffer pixels a unit of the window: 2 on many a fine display */

    /* how it is drawn */
    side side[SIDES];
    stage stage;
    pace pace;
    double moving_ms[2]; /* what the last two pictures took that moved */
    double moved_ms;     /* when it last moved */
    bool held;           /* a hand holds the camera */
    bool failed;         /* it could not be drawn: what is shown is the picture before */
    bool patient;        /* however long it takes, it is drawn whole */
    bool is_coarse;      /* it is left as it was drawn while it moved */
    bool is_new;         /* other settings or another input: what it costs is not known */
    int asked;           /* how often, how long it would take */
    int coarse_step;     /* the scale of the last coarse picture, see pace.h */
    bool stale;          /* the window shows less than is drawn */
    int polish;          /* how often more to show the panel before it rests */
    size_t draws;        /* pictures drawn so far, and put on the window */
    size_t shows;
    double show_ms; /* of putting it there */
    compare_mode compare;
    mns_options other; /* of the second side */
    char other_name[96];
    double place; /* of the divider, part of the width */
    double scale; /* of the difference, scene units; 0: by the view */
    bool flicker_b;
    double flicker_ms;
    difference difference;
    check check;
    int rows_told; /* of it, when the panel last showed them */

    /* the hand */
    double x, y; /* of the cursor, framebuffer pixels */
    int drag;    /* which drag goes on, see events.c */
    double press_x, press_y, click_ms, click_x, click_y;
    bool scrolls; /* towards there, and nothing was drawn since */
    vec3 towards;
    double fly_ms; /* when the flight was last moved on */
    hover hover;
    script script;
    spin spin;
} viewer;

/* window.c: one line for the user: in the title, the panel and on the terminal. */
void viewer_tell(viewer *v, const char *format, ...) __attribute__((format(printf, 2, 3)));
void viewer_tell_error(viewer *v, const mns_error *error);
/* open.c: makes the window and its context, current from then on. Errors: GL. */
mns_status viewer_open_window(viewer *v, mns_error *error);
/* Framebuffer pixels a unit of the window, which another monitor may change. */
void viewer_measure(viewer *v);
/* Asks the window system for a framebuffer of that size; 0: as by default. */
void viewer_set_size(viewer *v, int width, int height);
/* The size of the window's framebuffer, as it has become. */
void viewer_resize(viewer *v, int width, int height);
/* listen.c: sets GLFW's callbacks, of which the panel's come after. */
void viewer_listen(viewer *v);
/* Wakes the loop, from whichever thread. */
void viewer_wake(void);
/* Whether fly keys are held, and in which direction. */
bool viewer_flies(const viewer *v, double way[3]);

/* The picture and the panel, into the back buffer. */
void viewer_present(viewer *v);
bool viewer_open_panel(viewer *v); /* false: there is none */
void viewer_close_panel(viewer *v);
void viewer_help(viewer *v);

/* subject.c: opens what the settings name, from their frame on, and puts what was looked at aside until it is
 * drawn; on failure all stays as it is. `fits`: look at the whole of it. Errors: as mns_input_open and
 * mns_input_read. */
mns_status subject_open(viewer *v, bool fits, mns_error *error);
/* What is being made ahead of a field has come to its end, and the field may go. */
void subject_settle(viewer *v);
void subject_free(viewer *v, subject *s);
/* What the settings say after a change of one: opens the input anew only where it must. On failure all stays
 * as it is. Errors: as subject_open. */
mns_status subject_follow(viewer *v, mns_error *error);
/* The look that is drawn becomes that of the settings. */
void subject_look(viewer *v);
/* The reference of the field that is shown; NULL where there is none. */
mns_reference *subject_reference(viewer *v);
/* What hangs on the field that is shown goes, and the field. */
void subject_drop_field(viewer *v, subject *s);

/* frames.c: goes to a frame by hand. */
void frames_go(viewer *v, long frame);
void frames_play(viewer *v, bool plays);
/* Takes frames that were read, and shows the one that is due. Returns when to come again, milliseconds;
 * INFINITY: when woken. */
double frames_step(viewer *v);

/* drawing.c: makes renderers and frames. Errors: GL, MEMORY. */
mns_status drawing_begin(viewer *v, mns_error *error);
void drawing_end(viewer *v);
/* The picture is another one; `moves`: and goes on moving. */
void drawing_change(viewer *v, bool moves);
/* It is one by other settings, of which nobody knows what it costs. */
void drawing_renew(viewer *v);
/* Draws the next bit of it, if there is one. Returns when to come again; INFINITY: it is whole. Errors: as
 * mns_renderer_draw; then the picture before stays. */
mns_status drawing_step(viewer *v, double *again_ms, mns_error *error);
/* Draws all that is left of it. */
mns_status drawing_finish(viewer *v, mns_error *error);
/* Puts it on the window. */
void drawing_show(viewer *v);
/* The view as it is drawn at the window's full size. */
mns_view drawing_view(const viewer *v);
/* Sides in use. */
int drawing_sides(const viewer *v);
mns_options drawing_options(const viewer *v, int which);
/* The point of the surface under a pixel of the window; false: there is none. */
bool drawing_point(viewer *v, double x, double y, vec3 *point);

/* divider.c: sets the second side's method as `compare --runs` names it. Errors: USAGE. */
mns_status divider_other(viewer *v, const char *name, mns_error *error);
/* How two pictures share the window; the second is drawn where it is needed. */
void divider_mode(viewer *v, compare_mode mode);
bool divider_is_near(const viewer *v, double x);
/* Counts where two whole pictures differ. */
void divider_count(viewer *v);
double divider_scale(const viewer *v);

/* events.c: what a hand does; x and y in framebuffer pixels. Names as GLFW has them. */
void events_press(viewer *v, int button, bool pressed, int mods);
void events_move(viewer *v, double x, double y);
void events_scroll(viewer *v, double across, double by);
void events_key(viewer *v, int key, int mods, bool repeats);
void events_type(viewer *v, unsigned character);
/* Moves a flight on; true while there is one. */
bool events_fly(viewer *v);
/* Moves a spin on, and tells what it came to at its end; true while there is one. */
bool events_spin(viewer *v);
/* Says what is under the cursor, once it rests. */
void events_hover(viewer *v);

/* settings.c: an option of the program's becomes `value` (NULL: is not given), and is followed. Errors: as
 * subject_follow; then all is as it was. */
mns_status settings_change(viewer *v, const char *name, const char *value, mns_error *error);
/* Opens other inputs, or a scene; on failure all is as it was. */
mns_status settings_open(viewer *v, const char *const *names, size_t count, mns_error *error);
/* They were drawn: they stay. */
void settings_kept(viewer *v);
/* What could not be drawn is taken back: words, input, frame and camera. */
void settings_refused(viewer *v);

/* action.c: does one line of a script, such as "orbit 30 0". Errors: USAGE, and what the action gives. */
mns_status action_run(viewer *v, const char *line, mns_error *error);
/* The same, an error being told to the user. */
void action_do(viewer *v, const char *line);

/* check_tell.c: says what the check came to, once. */
void check_tell(viewer *v);

/* save.c: .png and .exr: the picture; .json: the scene. Errors: as their writing. */
mns_status save_as(viewer *v, const char *path, mns_error *error);
/* The command line of this view, to the clipboard and the terminal. */
mns_status save_copy(viewer *v, mns_error *error);

#endif
