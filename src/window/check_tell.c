/* What the check against the reference came to, told once. */
#include "window/viewer.h"

void check_tell(viewer *v)
{
    bool ran = v->check.running;
    check_state state = check_poll(&v->check);
    int rows = atomic_load(&v->check.rows);
    if (!ran) return;
    if (v->panel && (state != CHECK_RUNS || rows / 64 != v->rows_told / 64)) v->stale = true;
    v->rows_told = rows;
    if (state == CHECK_FAILED) viewer_tell_error(v, &v->check.error);
    if (state != CHECK_DONE) return;
    for (int i = 0; i < drawing_sides(v); i++) {
        char text[STATUS_SIZE - 40];
        check_text(&v->check, i, text, sizeof text);
        viewer_tell(v, "%s: %s", i ? v->other_name : mns_frame_stats(v->side[0].frame)->method, text);
    }
}
