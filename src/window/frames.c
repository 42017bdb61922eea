/* Which frame of a sequence is shown. While it is drawn, the tree of the next is built, and the one after
 * that is read: three are held at most. */
#include "base/clock.h"
#include "window/viewer.h"

#include <math.h>

static void drop_ahead(viewer *v)
{
    if (!v->now->ahead) return;
    subject_settle(v);
    mns_field_destroy(v->now->ahead);
    v->now->ahead = NULL;
}

static void show_field(viewer *v, mns_field *field, long frame)
{
    subject *s = v->now;
    subject_drop_field(v, s);
    s->field = field;
    timeline_show(&s->timeline, frame, clock_ms());
    drawing_change(v, s->timeline.playing);
}

void frames_go(viewer *v, long frame)
{
    subject *s = v->now;
    timeline_pause(&s->timeline);
    s->wanted = timeline_clamp(&s->timeline, frame);
    drop_ahead(v);
    if (s->wanted == s->timeline.shown)
        s->wanted = -1;
    else
        player_ask(&s->player, s->wanted);
}

void frames_play(viewer *v, bool plays)
{
    subject *s = v->now;
    if (plays && !s->timeline.playing) {
        timeline_play(&s->timeline, clock_ms());
        drop_ahead(v); /* it may have been left behind by a pause, before another beginning */
    } else if (!plays) {
        timeline_pause(&s->timeline);
    }
    v->stale = true;
}

/* The tree of the frame that comes next is begun before the one shown now is drawn. */
static void prepare(viewer *v)
{
    mns_error error;
    for (int i = 0; i < drawing_sides(v); i++) {
        mns_options options = drawing_options(v, i);
        const mns_plan *plan = v->side[i].is_drawn ? mns_frame_plan(v->side[i].frame) : NULL;
        if (plan && options.method == MNS_METHOD_AUTO) options.method = mns_plan_method(plan, NULL);
        if (mns_renderer_prepare(v->side[i].renderer, v->now->ahead, &options, &error))
            viewer_tell_error(v, &error);
    }
}

/* What was read: the frame that was asked for by hand, or one to play, which waits until there is room. */
static void take(viewer *v)
{
    subject *s = v->now;
    mns_field *field;
    mns_status status;
    mns_error error;
    long frame;
    if (s->ahead && s->wanted < 0) return;
    if (!player_take(&s->player, &frame, &field, &s->read_ms, &status, &error)) return;
    if (status) {
        timeline_pause(&s->timeline);
        if (frame == s->wanted) s->wanted = -1;
        viewer_tell_error(v, &error);
    } else if (frame == s->wanted) {
        s->wanted = -1;
        show_field(v, field, frame);
    } else if (s->timeline.playing && s->wanted < 0) {
        s->ahead = field;
        s->ahead_frame = frame;
        prepare(v);
    } else {
        mns_field_destroy(field);
    }
}

/* The last one may be shown as soon as something of the one before is on the window. */
static bool is_free(const viewer *v)
{
    return v->stage <= STAGE_SUMMED && v->stage != STAGE_CHANGED;
}

/* Asks for the frame after those that are shown, read and waiting. */
static void ask(viewer *v)
{
    subject *s = v->now;
    double drawn = fmin(v->moving_ms[0], v->moving_ms[1]);
    long after = s->ahead ? s->ahead_frame : s->timeline.shown;
    if (player_busy(&s->player) >= 0) return;
    long next =
        timeline_next(&s->timeline, after, clock_ms(), fmax(s->read_ms, s->ahead ? 2 * drawn : drawn));
    if (next >= 0) player_ask(&s->player, next);
}

double frames_step(viewer *v)
{
    subject *s = v->now;
    take(v);
    double now = clock_ms(), due = INFINITY;
    if (!s->timeline.playing) return INFINITY;
    if (s->ahead) due = timeline_due_ms(&s->timeline, s->ahead_frame);
    if (s->ahead && now >= due && is_free(v)) {
        mns_field *field = s->ahead;
        s->ahead = NULL;
        due = INFINITY;
        show_field(v, field, s->ahead_frame);
        take(v); /* the next one's tree is built while this one is drawn */
    }
    ask(v);
    return s->ahead && due == INFINITY ? 0 : due - now;
}
