/* Two methods on one window: side by side, in turn, or as a difference. */
#include "compare/run.h"
#include "window/viewer.h"

#include "base/memory.h"
#include "base/status.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* No tree is built for the other side any longer: what it is built of may go. */
static void settle_other(viewer *v)
{
    if (v->side[1].renderer) mns_renderer_prepare(v->side[1].renderer, NULL, NULL, NULL);
}

mns_status divider_other(viewer *v, const char *name, mns_error *error)
{
    run_spec *runs = NULL;
    size_t count = 0;
    mns_status status = run_parse(name, &runs, &count, error);
    if (!status && count != 1)
        status = status_fail(error, MNS_ERROR_USAGE, "compare %.80s: expected one METHOD:SOLVER", name);
    if (!status) {
        settle_other(v);
        v->other = runs[0].options;
        snprintf(v->other_name, sizeof v->other_name, "%s", runs[0].name);
    }
    free(runs);
    return status;
}

void divider_mode(viewer *v, compare_mode mode)
{
    bool had = v->compare != COMPARE_OFF;
    v->compare = mode;
    v->stale = true;
    v->flicker_b = false;
    if (mode != COMPARE_OFF && !had) drawing_renew(v);
    if (mode != COMPARE_OFF) return;
    v->difference.is_known = false;
    settle_other(v);
}

bool divider_is_near(const viewer *v, double x)
{
    return v->compare == COMPARE_DIVIDER && fabs(x - v->place * v->width) < 6 * v->dots;
}

/* By default what shows the rounding of floats: a hundred-thousandth of the distance looked at. */
double divider_scale(const viewer *v)
{
    if (v->scale > 0) return v->scale;
    return 1e-5 * vec3_length(vec3_sub(v->camera.target, v->camera.eye));
}

static float *distances(viewer *v, const side *s, size_t pixels)
{
    const GladGLContext *gl = &v->screen.gl;
    float *t = memory_array(pixels, 2 * sizeof *t);
    if (!t) return NULL;
    gl->BindTexture(GL_TEXTURE_2D, mns_frame_texture(s->frame, MNS_PLANE_DEPTH));
    gl->GetTexImage(GL_TEXTURE_2D, 0, GL_RG, GL_FLOAT, t);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    return t;
}

void divider_count(viewer *v)
{
    const side *a = &v->side[0], *b = &v->side[1];
    difference *d = &v->difference;
    *d = (difference){0};
    if (!a->is_drawn || !b->is_drawn) return;
    size_t pixels = (size_t)v->width * (size_t)v->height;
    const double unit_a = mns_frame_stats(a->frame)->t_unit, unit_b = mns_frame_stats(b->frame)->t_unit;
    float *of_a = distances(v, a, pixels), *of_b = distances(v, b, pixels);
    for (size_t i = 0; of_a && of_b && i < pixels; i++) {
        bool hit_a = isfinite(of_a[2 * i]), hit_b = isfinite(of_b[2 * i]);
        if (hit_a != hit_b) d->pixels++;
        if (!hit_a || !hit_b) continue;
        double t = (of_a[2 * i] + (double)of_a[2 * i + 1]) * unit_a;
        double apart = fabs((of_b[2 * i] + (double)of_b[2 * i + 1]) * unit_b - t);
        if (apart > 1e-5 * t) d->pixels++;
        d->most = fmax(d->most, apart);
    }
    d->is_known = of_a && of_b;
    free(of_a);
    free(of_b);
}
