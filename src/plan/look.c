#include "base/status.h"
#include "plan/plan.h"

#include <stdio.h>
#include <string.h>

static mns_status check(const mns_look *look, mns_error *error)
{
    if (look->light != MNS_LIGHT_HEAD && look->light != MNS_LIGHT_DIRECTIONAL)
        return status_fail(error, MNS_ERROR_USAGE,
                           "look: no light of kind %d; take head or directional, or others by lights",
                           look->light);
    if (!vec3_is_finite(vec3_load(look->light_direction)))
        return status_fail(error, MNS_ERROR_USAGE, "look: the light's direction must be finite");
    if (look->shading != MNS_SHADING_SMOOTH && look->shading != MNS_SHADING_CEL)
        return status_fail(error, MNS_ERROR_USAGE, "look: no shading %d; take smooth or cel", look->shading);
    if (look->cel_bands < 0 || look->cel_bands > 64)
        return status_fail(error, MNS_ERROR_USAGE, "look: %d cel bands; take 1 to 64", look->cel_bands);
    if ((unsigned)look->color_map >= MNS_COLOR_MAP_COUNT)
        return status_fail(error, MNS_ERROR_USAGE, "look: no colour map %d", look->color_map);
    double numbers[] = {look->ambient, look->diffuse, look->specular, look->shininess};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (!(numbers[i] >= 0) || !isfinite(numbers[i]))
            return status_fail(error, MNS_ERROR_USAGE,
                               "look: ambient, diffuse, specular and shininess must be 0 or more");
    for (int i = 0; i < 4; i++) {
        double c = i < 3 ? look->color[i] : 0, b = look->background[i];
        if (!(c >= 0 && c <= 1 && b >= 0 && b <= 1))
            return status_fail(error, MNS_ERROR_USAGE, "look: colours are numbers from 0 to 1");
    }
    return MNS_OK;
}

static void resolve_defaults(mns_look *look)
{
    static const double color[3] = {0.35, 0.62, 0.86}, white[4] = {1, 1, 1, 1};
    if (!(look->set & MNS_LOOK_COLOR)) memcpy(look->color, color, sizeof color);
    if (!(look->set & MNS_LOOK_BACKGROUND)) memcpy(look->background, white, sizeof white);
    if (!(look->set & MNS_LOOK_AMBIENT)) look->ambient = 0.15;
    if (!(look->set & MNS_LOOK_DIFFUSE)) look->diffuse = 0.85;
    if (!(look->set & MNS_LOOK_SPECULAR)) look->specular = 0.25;
    if (look->shininess == 0) look->shininess = 40;
    if (look->cel_bands == 0) look->cel_bands = 3;
}

mns_status plan_find_column(const mns_field *field, const char *name, const char *purpose, size_t *index,
                            mns_error *error)
{
    char known[200] = "";
    size_t used = 0;
    for (size_t i = 0; i < field->p.column_count; i++) {
        if (strcmp(field->p.column[i].name, name) == 0) {
            *index = i;
            return MNS_OK;
        }
        if (used + 40 < sizeof known)
            used += (size_t)snprintf(known + used, sizeof known - used, "%s%.32s", i ? ", " : "",
                                     field->p.column[i].name);
    }
    return status_fail(error, MNS_ERROR_USAGE, "look: no column \"%s\" to %s by; the input has %s", name,
                       purpose, field->p.column_count ? known : "none");
}

/* The column to colour by: `color_by` is its name; "element" also finds a PDB's or XYZ's element column. */
static mns_status find_column(mns_plan *plan, const mns_field *field, mns_error *error)
{
    const mns_look *look = &plan->look;
    mns_status status = plan_find_column(field, look->color_by, "colour", &plan->color_column, error);
    if (status) return status;
    const particles_column *column = &field->p.column[plan->color_column];
    plan->features |= FEATURE_COLORS | (column->label ? FEATURE_LABELS : 0);
    plan->color_range[0] = look->set & MNS_LOOK_RANGE ? look->range[0] : column->min;
    plan->color_range[1] = look->set & MNS_LOOK_RANGE ? look->range[1] : column->max;
    snprintf(plan->color_by, sizeof plan->color_by, "%s", column->name);
    if (!isfinite(plan->color_range[0]) || !isfinite(plan->color_range[1]))
        return status_fail(error, MNS_ERROR_USAGE, "look: the colour range must be finite");
    return MNS_OK;
}

mns_status plan_look(const mns_look *look, const mns_field *field, mns_plan *plan, mns_error *error)
{
    plan->look = look ? *look : (mns_look){0};
    const char *preset = plan->look.preset;
    mns_status status = check(&plan->look, error);
    if (!status && preset && *preset) status = mns_look_preset(preset, &plan->look, error);
    plan->look.preset = NULL; /* was borrowed for the call */
    if (status) return status;
    resolve_defaults(&plan->look);
    status = plan_effects(plan, field, error);
    if (status) return status;
    if (plan->look.color_by && plan->look.color_by[0] && field->p.count)
        status = find_column(plan, field, error);
    plan->look.color_by = NULL; /* was borrowed for the call */
    if (plan->look.shading == MNS_SHADING_CEL) plan->features |= FEATURE_CEL;
    if (plan->look.specular > 0) plan->features |= FEATURE_SPECULAR;
    return status;
}
