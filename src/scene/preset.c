/* Looks by name: what a preset has, where the look itself says nothing. */
#include "base/status.h"

#include <stdio.h>
#include <string.h>

typedef struct preset {
    const char *name;
    mns_look look; /* `set` tells the members that it brings, beside those that are not 0 */
} preset;

static const preset presets[] = {
    {"plain", {0}},
    {"clay",
     {.set = MNS_LOOK_COLOR | MNS_LOOK_AMBIENT | MNS_LOOK_DIFFUSE | MNS_LOOK_SPECULAR,
      .light = MNS_LIGHT_DIRECTIONAL,
      .color = {0.83, 0.77, 0.71},
      .ambient = 0.4,
      .diffuse = 0.7,
      .effects = {.shadows = true, .occlusion_rays = 32}}},
    {"water",
     {.set = MNS_LOOK_COLOR | MNS_LOOK_AMBIENT | MNS_LOOK_SPECULAR,
      .light = MNS_LIGHT_DIRECTIONAL,
      .color = {0.16, 0.42, 0.52},
      .ambient = 0.35,
      .specular = 0.6,
      .shininess = 200,
      .effects =
          {.reflections = 1, .refractions = 4, .index = 1.333, .transmission = 0.75, .environment = "sky"}}},
    {"molecule",
     {.set = MNS_LOOK_AMBIENT | MNS_LOOK_DIFFUSE | MNS_LOOK_SPECULAR,
      .ambient = 0.6,
      .diffuse = 0.5,
      .specular = 0.1,
      .effects = {.occlusion_rays = 64}}},
    {"glass",
     {.set = MNS_LOOK_SPECULAR,
      .light = MNS_LIGHT_DIRECTIONAL,
      .specular = 0.8,
      .shininess = 300,
      .effects = {.reflections = 2, .refractions = 8, .index = 1.5, .environment = "sky"}}},
};

enum { PRESETS = sizeof presets / sizeof *presets };

const char *mns_look_preset_name(size_t index)
{
    return index < PRESETS ? presets[index].name : NULL;
}

static bool is_zero(const double *v, int count)
{
    for (int i = 0; i < count; i++)
        if (v[i] != 0) return false;
    return true;
}

/* Numbers that are open become the preset's: open are zeros whose bit is not set. */
static void lay(mns_look *look, const mns_look *under, unsigned bit, double *to, const double *from,
                int count)
{
    if (look->set & bit || !is_zero(to, count)) return;
    memcpy(to, from, (size_t)count * sizeof *to);
    look->set |= under->set & bit;
}

static void lay_surface(mns_look *look, const mns_look *under)
{
    if (!look->color_by) lay(look, under, MNS_LOOK_COLOR, look->color, under->color, 3);
    lay(look, under, MNS_LOOK_AMBIENT, &look->ambient, &under->ambient, 1);
    lay(look, under, MNS_LOOK_DIFFUSE, &look->diffuse, &under->diffuse, 1);
    lay(look, under, MNS_LOOK_SPECULAR, &look->specular, &under->specular, 1);
    if (look->shininess == 0) look->shininess = under->shininess;
    bool lit = look->set & MNS_LOOK_LIGHT || look->light_count || look->light != MNS_LIGHT_HEAD;
    if (!lit) look->light = under->light;
}

static void lay_effects(mns_look *look, const mns_look *under)
{
    mns_effects *to = &look->effects;
    const mns_effects *from = &under->effects;
    if (!(look->set & MNS_LOOK_SHADOWS) && !to->shadows) to->shadows = from->shadows;
    if (!(look->set & MNS_LOOK_REFLECTIONS) && !to->reflections) to->reflections = from->reflections;
    if (!(look->set & MNS_LOOK_REFRACTIONS) && !to->refractions) to->refractions = from->refractions;
    lay(look, under, MNS_LOOK_MIRROR, &to->mirror, &from->mirror, 1);
    lay(look, under, MNS_LOOK_INDEX, &to->index, &from->index, 1);
    lay(look, under, MNS_LOOK_TRANSMISSION, &to->transmission, &from->transmission, 1);
    lay(look, under, MNS_LOOK_ABSORPTION, to->absorption, from->absorption, 3);
    if (!(look->set & MNS_LOOK_OCCLUSION) && !to->occlusion_rays) to->occlusion_rays = from->occlusion_rays;
    if (!(look->set & MNS_LOOK_ENVIRONMENT) && !(to->environment && *to->environment))
        to->environment = from->environment;
}

mns_status mns_look_preset(const char *name, mns_look *look, mns_error *error)
{
    char known[120] = "";
    size_t used = 0;
    if (!name || !look) return status_fail(error, MNS_ERROR_USAGE, "look: no preset's name, or no look");
    for (size_t i = 0; i < PRESETS; i++) {
        if (strcmp(presets[i].name, name) != 0) {
            used += (size_t)snprintf(known + used, sizeof known - used, " %s", presets[i].name);
            continue;
        }
        lay_surface(look, &presets[i].look);
        lay_effects(look, &presets[i].look);
        return MNS_OK;
    }
    return status_fail(error, MNS_ERROR_USAGE, "look: no preset \"%.60s\"; expected one of%s", name, known);
}
