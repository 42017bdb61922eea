/* Actions of sequences, of the window and of scripts. */
#include "window/action.h"

#include "base/clock.h"
#include "base/status.h"
#include "window/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>

mns_status action_play(viewer *v, const words *w, mns_error *error)
{
    (void)w, (void)error;
    frames_play(v, !v->now->timeline.playing);
    return MNS_OK;
}

mns_status action_pause_it(viewer *v, const words *w, mns_error *error)
{
    (void)w, (void)error;
    frames_play(v, false);
    return MNS_OK;
}

/* A number of frames, however large it was written. */
static long frames_of(double number)
{
    return (long)fmax(-1e9, fmin(1e9, number));
}

mns_status action_step(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    long from = v->now->wanted >= 0 ? v->now->wanted : v->now->timeline.shown;
    frames_go(v, from + frames_of(w->number[0]));
    return MNS_OK;
}

mns_status action_frame(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    frames_go(v, frames_of(w->number[0]));
    return MNS_OK;
}

mns_status action_speed(viewer *v, const words *w, mns_error *error)
{
    if (!(w->number[0] > 0))
        return status_fail(error, MNS_ERROR_USAGE, "speed %.40s: expected a factor above 0", w->text);
    timeline_speed(&v->now->timeline, v->now->timeline.speed * w->number[0], clock_ms());
    viewer_tell(v, "speed %g: %g frames a second", v->now->timeline.speed,
                v->now->timeline.speed * v->now->timeline.rate);
    return MNS_OK;
}

mns_status action_loop(viewer *v, const words *w, mns_error *error)
{
    (void)w, (void)error;
    timeline_loop(&v->now->timeline, !v->now->timeline.loops);
    viewer_tell(v, v->now->timeline.loops ? "the sequence begins again at its end"
                                          : "the sequence stops at its end");
    return MNS_OK;
}

/* ---- The window ---- */

mns_status action_size(viewer *v, const words *w, mns_error *error)
{
    double width = w->number[0], height = w->number[1];
    if (!(width >= 1 && height >= 1 && width <= 16384 && height <= 16384))
        return status_fail(error, MNS_ERROR_USAGE, "size %.40s: expected two numbers from 1 to 16384",
                           w->text);
    viewer_set_size(v, (int)width, (int)height);
    return MNS_OK;
}

mns_status action_whole(viewer *v, const words *w, mns_error *error)
{
    (void)w;
    return drawing_finish(v, error);
}

mns_status action_save(viewer *v, const words *w, mns_error *error)
{
    return save_as(v, *w->text ? w->text : "meniscus.png", error);
}

mns_status action_grab(viewer *v, const words *w, mns_error *error)
{
    mns_status status = drawing_finish(v, error);
    if (status) return status;
    viewer_present(v);
    status = screen_grab(&v->screen, v->width, v->height, w->text, error);
    if (!status) viewer_tell(v, "saved the window as %.400s", w->text);
    return status;
}

mns_status action_copy(viewer *v, const words *w, mns_error *error)
{
    (void)w;
    return save_copy(v, error);
}

mns_status action_reload(viewer *v, const words *w, mns_error *error)
{
    (void)w;
    mns_status status = MNS_OK;
    if (!v->desc->glsl)
        return status_fail(error, MNS_ERROR_USAGE,
                           "no folder of shaders was named: open the window with --glsl DIR");
    for (int i = 0; i < SIDES && !status; i++)
        status = mns_renderer_read_shaders(v->side[i].renderer, v->desc->glsl, error);
    if (status) return status;
    viewer_tell(v, "read the shaders of %.200s again", v->desc->glsl);
    drawing_renew(v);
    return MNS_OK;
}

mns_status action_panel_toggle(viewer *v, const words *w, mns_error *error)
{
    (void)w;
    if (v->panel)
        v->panel_goes = !v->panel_goes;
    else if (!viewer_open_panel(v))
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "this build has no panel (it needs Dear ImGui); keys do it all: ?");
    v->stale = true;
    return MNS_OK;
}

mns_status action_help(viewer *v, const words *w, mns_error *error)
{
    (void)w, (void)error;
    viewer_help(v);
    return MNS_OK;
}

mns_status action_quit(viewer *v, const words *w, mns_error *error)
{
    (void)w, (void)error;
    v->closing = true;
    return MNS_OK;
}

mns_status action_key(viewer *v, const words *w, mns_error *error)
{
    const key_row *row = key_named(w->text);
    if (!row) return status_fail(error, MNS_ERROR_USAGE, "key %.40s: it stands for nothing", w->text);
    return action_run(v, row->action, error);
}

mns_status action_rest(viewer *v, const words *w, mns_error *error)
{
    (void)w, (void)error;
    v->script.rests = true;
    return MNS_OK;
}

mns_status action_sleep_ms(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    v->script.until_ms = clock_ms() + w->number[0];
    return MNS_OK;
}

mns_status action_tell(viewer *v, const words *w, mns_error *error)
{
    (void)error;
    const mns_stats *drawn = mns_frame_stats(v->side[0].frame);
    viewer_tell(v,
                "%.80s: drew %zu, showed %zu, frame %ld, dropped %ld, %dx%d of %dx%d, divider at %.3f, "
                "last in %.1f ms %s",
                w->text, v->draws, v->shows, v->now->timeline.shown, v->now->timeline.dropped, drawn->width,
                drawn->height, v->width, v->height, v->place, v->side[0].ms,
                v->hover.is_on ? v->hover.text : "");
    return MNS_OK;
}
