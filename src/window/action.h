/* The actions: what keys, the panel and scripts can do, a line each. */
#ifndef MNS_WINDOW_ACTION_H
#define MNS_WINDOW_ACTION_H

#include "window/viewer.h"

/* The words behind an action's name. */
typedef struct words {
    double number[5];
    const char *text; /* all of them, "" where there are none */
} words;

typedef mns_status act(viewer *v, const words *w, mns_error *error);

act action_orbit, action_turn, action_pan, action_zoom, action_fly, action_fit, action_home, action_spin,
    action_side_of, action_fov, action_widen, action_set, action_unset, action_next, action_open_input,
    action_compare, action_other, action_divider, action_scale, action_check_it, action_hover_on, action_play,
    action_pause_it, action_step, action_frame, action_speed, action_loop, action_size, action_save,
    action_whole, action_grab, action_copy, action_reload, action_panel_toggle, action_help, action_quit,
    action_key, action_drag, action_move, action_scroll, action_centre, action_rest, action_sleep_ms,
    action_tell;

#endif
