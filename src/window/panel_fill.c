#include "window/panel_fill.h"

#include "window/choices.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

enum { CHOICES = 16, LEFT_OUT = 4096 };

static void line(panel_content *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void line(panel_content *p, const char *format, ...)
{
    va_list arguments;
    if (p->line_count == PANEL_LINES) return;
    va_start(arguments, format);
    vsnprintf(p->line[p->line_count++], PANEL_LINE, format, arguments);
    va_end(arguments);
}

static void phases(const mns_stats *s, panel_content *p)
{
    for (int k = 0; k < MNS_PHASE_COUNT && p->phase_count < PANEL_PHASES; k++)
        if (s->ms[k] > 0.005)
            p->phase[p->phase_count++] = (panel_phase){mns_phase_name((mns_phase)k), s->ms[k]};
}

static void figures(const viewer *v, const mns_stats *s, panel_content *p)
{
    struct rusage usage;
    const char *reason;
    mns_plan_method(mns_frame_plan(v->side[0].frame), &reason);
    line(p, "%s %s (%s)", s->method, s->solver, reason);
    line(p, "%dx%d, %llu balls, %llu in view", s->width, s->height, (unsigned long long)s->balls,
         (unsigned long long)s->balls_in_view);
    if (s->timed && s->list_max)
        line(p, "lists: mean %.1f, p99 %.0f, longest %llu", s->list_mean, s->list_p99,
             (unsigned long long)s->list_max);
    if (s->tree.balls)
        line(p, "tree: %llu leaves of %.1f, %.1f MiB", (unsigned long long)s->tree.leaves, s->tree.leaf_mean,
             (double)s->tree.bytes / 1048576);
    if (!getrusage(RUSAGE_SELF, &usage)) line(p, "memory: %.0f MiB at most", (double)usage.ru_maxrss / 1024);
    if (s->pixels_undecided) line(p, "%llu pixels undecided", (unsigned long long)s->pixels_undecided);
    if (*s->color_map) line(p, "%s: %.6g to %.6g", s->color_by, s->color_range[0], s->color_range[1]);
}

static void compared(viewer *v, panel_content *p)
{
    const difference *d = &v->difference;
    char text[PANEL_LINE];
    p->compares = v->compare != COMPARE_OFF;
    p->scale = divider_scale(v);
    if (p->compares) line(p, "A %.1f ms, B %s %.1f ms", v->side[0].ms, v->other_name, v->side[1].ms);
    if (p->compares && d->is_known) line(p, "%zu pixels differ, by %.3g at most", d->pixels, d->most);
    switch (check_last(&v->check)) {
    case CHECK_RUNS:
        line(p, "reference: row %d of %d", atomic_load(&v->check.rows), v->check.view.height);
        break;
    case CHECK_DONE:
        for (int i = 0; i < drawing_sides(v); i++) {
            check_text(&v->check, i, text, sizeof text);
            line(p, "%c %s", 'A' + i, text);
        }
        break;
    default:
        break;
    }
}

static void sequence(const viewer *v, panel_content *p)
{
    const timeline *t = &v->now->timeline;
    p->frame = v->now->wanted >= 0 ? v->now->wanted : t->shown;
    p->frames = t->frames;
    p->plays = t->playing;
    p->loops = t->loops;
    p->speed = t->speed;
    if (t->frames > 1)
        line(p, "frame %ld of %ld, %ld dropped, read in %.1f ms", t->shown, t->frames, t->dropped,
             v->now->read_ms);
}

static void left_out(const viewer *v, char text[LEFT_OUT])
{
    size_t count, used = 0;
    const mns_left_out *parts = mns_plan_left_out(mns_frame_plan(v->side[0].frame), &count);
    text[0] = '\0';
    for (size_t i = 0; i < count && used < LEFT_OUT; i++)
        used += (size_t)snprintf(text + used, LEFT_OUT - used, "%s: %s\n", parts[i].part, parts[i].reason);
}

void panel_fill(viewer *v)
{
    choice choices[CHOICES];
    panel_choice shown[CHOICES];
    char text[LEFT_OUT] = "";
    panel_content p = {.choice = shown, .fov = v->camera.fov, .draws = v->draws, .status = v->status};
    mns_field_info info;
    mns_field_get_info(v->now->field, &info);
    while (p.choice_count < CHOICES && choice_at(v, (int)p.choice_count, &choices[p.choice_count])) {
        const choice *c = &choices[p.choice_count];
        shown[p.choice_count++] = (panel_choice){c->label, c->action, c->names, (size_t)c->count,
                                                 c->now < 0 ? "" : c->names[c->now]};
    }
    const mns_effects *e = &v->look.effects;
    p.iso = info.iso;
    p.radius_scale = v->settings->field.radius_scale > 0 ? v->settings->field.radius_scale : 1;
    p.shadows = e->shadows;
    p.reflections = e->reflections;
    p.refractions = e->refractions;
    p.occlusion = e->occlusion_rays;
    p.total_ms = v->side[0].ms;
    if (v->side[0].is_drawn) {
        phases(mns_frame_stats(v->side[0].frame), &p);
        figures(v, mns_frame_stats(v->side[0].frame), &p);
        left_out(v, text);
    }
    p.left_out = text;
    compared(v, &p);
    sequence(v, &p);
    if (v->hover.is_on && *v->hover.text) line(&p, "%.190s", v->hover.text);
    panel_show(v->panel, &p);
}
