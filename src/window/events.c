/* What a hand does: drags, the wheel, keys, and flying. */
#include "base/clock.h"
#include "window/keys.h"
#include "window/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>
#include <stdio.h>

enum { DRAG_NONE = 0, DRAG_ORBIT, DRAG_PAN, DRAG_TURN, DRAG_DIVIDER };

static const double PI_ = 3.14159265358979323846;
/* A second press within this time and this many units is a double click. */
static const double DOUBLE_MS = 350, DOUBLE_UNITS = 4;

static int drag_of(const viewer *v, int button, int mods)
{
    if (button == GLFW_MOUSE_BUTTON_LEFT && divider_is_near(v, v->x)) return DRAG_DIVIDER;
    if (button == GLFW_MOUSE_BUTTON_LEFT && mods & GLFW_MOD_CONTROL) return DRAG_TURN;
    if (button == GLFW_MOUSE_BUTTON_LEFT && !(mods & GLFW_MOD_SHIFT)) return DRAG_ORBIT;
    return DRAG_PAN;
}

static void centre(viewer *v)
{
    vec3 point;
    if (!drawing_point(v, v->x, v->y, &point)) {
        viewer_tell(v, "there is no surface under the cursor");
        return;
    }
    camera_centre(&v->camera, point);
    drawing_change(v, true);
}

void events_press(viewer *v, int button, bool pressed, int mods)
{
    if (!pressed) {
        if (v->drag == DRAG_DIVIDER) viewer_tell(v, "divider at %.3f", v->place);
        v->drag = DRAG_NONE;
        v->held = false;
        v->moved_ms = clock_ms();
        return;
    }
    double now = clock_ms(), apart = hypot(v->x - v->click_x, v->y - v->click_y);
    v->drag = drag_of(v, button, mods);
    v->held = v->drag != DRAG_DIVIDER;
    if (button != GLFW_MOUSE_BUTTON_LEFT || v->drag == DRAG_DIVIDER) return;
    if (now - v->click_ms < DOUBLE_MS && apart < DOUBLE_UNITS * v->dots) {
        v->drag = DRAG_NONE;
        v->held = false;
        centre(v);
        now = 0; /* a third press is a first one again */
    }
    v->click_ms = now;
    v->click_x = v->x;
    v->click_y = v->y;
}

void events_move(viewer *v, double x, double y)
{
    double right = (x - v->x) / v->height, down = (y - v->y) / v->height;
    v->x = x;
    v->y = y;
    v->hover.is_known = false;
    switch (v->drag) {
    case DRAG_ORBIT: /* across the frame's height: half a turn */
        camera_orbit(&v->camera, -right * PI_, down * PI_);
        break;
    case DRAG_PAN:
        camera_pan(&v->camera, -right, down);
        break;
    case DRAG_TURN:
        camera_turn(&v->camera, right * v->camera.fov * PI_ / 180, -down * v->camera.fov * PI_ / 180);
        break;
    case DRAG_DIVIDER:
        v->place = fmax(0, fmin(1, x / v->width));
        v->stale = true;
        return;
    default:
        return;
    }
    drawing_change(v, true);
}

/* Two fingers on a trackpad go across as well: a step is a twentieth of the frame's height. */
static void scroll_across(viewer *v, double by)
{
    if (by == 0) return;
    camera_pan(&v->camera, -0.05 * by, 0);
    drawing_change(v, true);
}

/* The surface under the cursor; beside it, the plane through the target. */
static vec3 under_cursor(viewer *v)
{
    vec3 point, right, up, forward;
    double direction[3];
    if (drawing_point(v, v->x, v->y, &point)) return point;
    mns_view view = drawing_view(v);
    camera_axes(&v->camera, &right, &up, &forward);
    mns_view_ray(&view, v->x, v->y, direction);
    double depth = vec3_length(vec3_sub(v->camera.target, v->camera.eye));
    return vec3_along(v->camera.eye, depth / vec3_dot(vec3_load(direction), forward), vec3_load(direction));
}

void events_scroll(viewer *v, double across, double by)
{
    bool again = v->scrolls;
    scroll_across(v, across);
    if (by == 0) return;
    /* Of several steps before the next picture all go where the first one did. */
    vec3 towards = again ? v->towards : under_cursor(v);
    camera_zoom(&v->camera, pow(0.88, by), towards);
    drawing_change(v, true);
    v->towards = towards;
    v->scrolls = true;
}

void events_key(viewer *v, int key, int mods, bool repeats)
{
    const key_row *row = key_of(key, mods);
    if (row && (row->repeats || !repeats)) action_do(v, row->action);
}

void events_type(viewer *v, unsigned character)
{
    const key_row *row = key_typed(character);
    if (row) action_do(v, row->action);
}

bool events_fly(viewer *v)
{
    double way[3], now = clock_ms(), before = v->fly_ms;
    if (!viewer_flies(v, way)) {
        if (before > 0) v->held = false;
        v->fly_ms = 0;
        return false;
    }
    v->fly_ms = now;
    v->held = true;
    if (before > 0) { /* a second crosses what is looked at */
        double by = 1e-3 * (now - before) * vec3_length(vec3_sub(v->camera.target, v->camera.eye));
        camera_fly(&v->camera, way[0] * by, way[1] * by, way[2] * by);
        drawing_change(v, true);
    }
    return true;
}

bool events_spin(viewer *v)
{
    double median, p95, now = clock_ms();
    if (spin_end(&v->spin, now, &median, &p95)) {
        v->held = false;
        v->moved_ms = now;
        viewer_tell(v, "spin: %zu pictures, median %.1f ms, p95 %.1f ms, at last %dx%d of %dx%d",
                    v->spin.count, median, p95, pace_size(&v->pace, v->width), pace_size(&v->pace, v->height),
                    v->width, v->height);
    }
    if (!v->spin.until_ms) return false;
    v->held = true;
    camera_orbit(&v->camera, spin_step(&v->spin, now), 0);
    drawing_change(v, true);
    return true;
}

/* ---- Under the cursor ---- */

static void tell_columns(const viewer *v, size_t ball, char *text, size_t size)
{
    mns_column_info column;
    size_t used = 0;
    for (size_t i = 0; i < 8 && mns_field_get_column(v->now->field, i, &column) && used < size; i++) {
        double value = mns_field_value(v->now->field, i, ball);
        bool labelled = column.is_label && value >= 0 && value < (double)column.label_count;
        used += (size_t)(labelled ? snprintf(text + used, size - used, ", %.24s %.24s", column.name,
                                             column.labels[(size_t)value])
                                  : snprintf(text + used, size - used, ", %.24s %.6g", column.name, value));
    }
}

void events_hover(viewer *v)
{
    hover *h = &v->hover;
    vec3 point;
    size_t ball;
    if (!h->is_on || h->is_known || v->stage != STAGE_DONE || v->drag) return;
    h->is_known = true;
    v->stale = true;
    h->text[0] = '\0';
    const mns_reference *reference = drawing_point(v, v->x, v->y, &point) ? subject_reference(v) : NULL;
    if (!reference) return;
    double at[3], f;
    char columns[240] = "";
    vec3_store(at, point);
    f = mns_reference_value(reference, at, NULL, &ball);
    if (ball != SIZE_MAX) tell_columns(v, ball, columns, sizeof columns);
    snprintf(h->text, sizeof h->text, "at %.6g, %.6g, %.6g: density %.6g, ball %zd%s", at[0], at[1], at[2], f,
             ball == SIZE_MAX ? -1 : (ssize_t)ball, columns);
}
