/* The scene file of a view, as mns_scene_load reads it. */
#ifndef MNS_WINDOW_SCENE_JSON_H
#define MNS_WINDOW_SCENE_JSON_H

#include "window/window.h"

/* Writes what `meniscus render` needs to draw this view of this frame, beside the name and renamed. Errors:
 * IO, MEMORY, UNSUPPORTED (a name is not UTF-8). */
mns_status scene_json_write(const window_settings *s, const mns_look *look, const mns_view *view, long frame,
                            const char *path, mns_error *error);

#endif
