/* The second material of a look: checked, filled in from the first, and kept only where some ball has a part
 * of it. */
#include "base/status.h"
#include "plan/plan.h"

#include <stdio.h>
#include <string.h>

/* Of a ball's place between the materials, either way: sums of such floats, weighted, are numbers. */
#define PLACE_MOST 1e30

static bool is_given(const mns_blend *b, unsigned bit, const double *v, int count)
{
    bool some = b->set & bit;
    for (int i = 0; i < count; i++) some = some || v[i] != 0;
    return some;
}

static mns_status check(const mns_blend *b, mns_error *error)
{
    for (int c = 0; c < 3; c++) {
        if (!(b->color[c] >= 0 && b->color[c] <= 1))
            return status_fail(error, MNS_ERROR_USAGE, "blend: colours are numbers from 0 to 1");
        if (!(b->absorption[c] >= 0 && isfinite(b->absorption[c])))
            return status_fail(error, MNS_ERROR_USAGE, "blend: absorption %g; take numbers of 0 or more",
                               b->absorption[c]);
    }
    if (!(b->mirror >= 0 && b->mirror <= 1 && b->transmission >= 0 && b->transmission <= 1))
        return status_fail(error, MNS_ERROR_USAGE, "blend: mirror %g, transmission %g; shares are 0 to 1",
                           b->mirror, b->transmission);
    bool whole = b->range[0] == 0 && b->range[1] == 0;
    if (!whole && !(isfinite(b->range[0]) && isfinite(b->range[1]) && b->range[0] < b->range[1]))
        return status_fail(error, MNS_ERROR_USAGE, "blend: range %g to %g; the lower comes first",
                           b->range[0], b->range[1]);
    return MNS_OK;
}

/* The column, whose numbers say how much of the second material a ball has. */
static mns_status find_column(mns_plan *plan, const mns_field *field, mns_error *error)
{
    const char *name = plan->look.blend.by;
    mns_status status = plan_find_column(field, name, "blend materials", &plan->blend_column, error);
    if (status) return status;
    if (field->p.column[plan->blend_column].label)
        return status_fail(error, MNS_ERROR_USAGE,
                           "look: column \"%s\" holds labels; materials are blended by numbers", name);
    snprintf(plan->blend_by, sizeof plan->blend_by, "%s", name);
    return MNS_OK;
}

/* What is open is as the first material has it, whose lengths are in the field's unit already. */
static void fill(mns_blend *b, const mns_look *look, double unit)
{
    const mns_effects *e = &look->effects;
    bool colored = is_given(b, MNS_LOOK_COLOR, b->color, 3);
    if (!is_given(b, MNS_LOOK_MIRROR, &b->mirror, 1)) b->mirror = e->mirror;
    if (!is_given(b, MNS_LOOK_TRANSMISSION, &b->transmission, 1)) b->transmission = e->transmission;
    if (!e->refractions) b->transmission = 0;
    if (is_given(b, MNS_LOOK_ABSORPTION, b->absorption, 3))
        for (int c = 0; c < 3; c++) b->absorption[c] *= unit;
    else
        memcpy(b->absorption, e->absorption, sizeof b->absorption);
    if (!colored) memcpy(b->color, look->color, sizeof b->color);
    b->set = colored ? MNS_LOOK_COLOR : 0;
    if (b->range[0] == 0 && b->range[1] == 0) b->range[1] = 1;
}

/* The second material in the place of the first. */
static void take_over(mns_look *look)
{
    const mns_blend *b = &look->blend;
    look->effects.mirror = b->mirror;
    look->effects.transmission = b->transmission;
    memcpy(look->effects.absorption, b->absorption, sizeof b->absorption);
    if (!(b->set & MNS_LOOK_COLOR)) return;
    memcpy(look->color, b->color, sizeof look->color);
    look->color_by = NULL;
}

static void become_first(mns_plan *plan, const char *reason)
{
    plan->look.blend = (mns_blend){.range = {0, 0}};
    plan->no_blend = reason;
    fill(&plan->look.blend, &plan->look, plan->unit);
}

mns_status plan_blend(mns_plan *plan, const mns_field *field, mns_error *error)
{
    mns_blend *b = &plan->look.blend;
    bool by = b->by && *b->by, ranged = b->range[0] != 0 || b->range[1] != 0;
    mns_status status = check(b, error);
    if (status) return status;
    if (!by &&
        (ranged || is_given(b, MNS_LOOK_COLOR, b->color, 3) || is_given(b, MNS_LOOK_MIRROR, &b->mirror, 1) ||
         is_given(b, MNS_LOOK_TRANSMISSION, &b->transmission, 1) ||
         is_given(b, MNS_LOOK_ABSORPTION, b->absorption, 3)))
        return status_fail(
            error, MNS_ERROR_USAGE,
            "look: a second material, and no column to blend it by; name one by blend.by (--blend-by)");
    if (!by || !field->p.count) {
        become_first(plan, by ? "there are no balls" : "nobody asks for it");
        return MNS_OK;
    }
    status = find_column(plan, field, error);
    if (status) return status;
    b->by = NULL; /* was borrowed for the call */
    fill(b, &plan->look, plan->unit);
    const particles_column *column = &field->p.column[plan->blend_column];
    if (column->max <= b->range[0]) {
        become_first(plan, "no ball has any of it");
    } else if (column->min >= b->range[1]) {
        take_over(&plan->look);
        become_first(plan, "it is every ball's, and so the only one");
    } else {
        plan->no_blend = "it is seen nowhere, or as the first is";
    }
    return MNS_OK;
}

bool plan_blend_is_seen(const mns_plan *plan)
{
    const mns_look *look = &plan->look;
    const mns_effects *e = &look->effects;
    const mns_blend *b = &look->blend;
    bool other_color = b->set & MNS_LOOK_COLOR && ((look->color_by && *look->color_by) ||
                                                   memcmp(b->color, look->color, sizeof b->color));
    return other_color || b->mirror != e->mirror || b->transmission != e->transmission ||
           (plan->features & FEATURE_ABSORPTION &&
            memcmp(b->absorption, e->absorption, sizeof b->absorption) != 0);
}

double plan_blend_place(const mns_plan *plan, const mns_field *field, size_t ball)
{
    const double *range = plan->look.blend.range;
    double value = field->p.column[plan->blend_column].value[ball];
    return fmin(fmax((value - range[0]) / (range[1] - range[0]), -PLACE_MOST), PLACE_MOST);
}
