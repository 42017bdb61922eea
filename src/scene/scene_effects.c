/* Lights, effects and the second material of a scene file. */
#include "scene/scene_object.h"

#include "base/memory.h"
#include "base/status.h"

#include <stdio.h>
#include <string.h>

/* ---- Numbers ---- */

static mns_status read_levels(scene_reader *r, const char *key, const json_t *value, void *target)
{
    return scene_read_whole(r, key, value, 0, 8, target);
}

static mns_status read_surfaces(scene_reader *r, const char *key, const json_t *value, void *target)
{
    return scene_read_whole(r, key, value, 0, 16, target);
}

static mns_status read_rays(scene_reader *r, const char *key, const json_t *value, void *target)
{
    return scene_read_whole(r, key, value, 0, 4096, target);
}

static mns_status read_share(scene_reader *r, const char *key, const json_t *value, void *target)
{
    double share = json_number_value(value);
    if (!json_is_number(value) || !(share >= 0 && share <= 1))
        return scene_wrong(r, key, value, "a number from 0 to 1");
    *(double *)target = share;
    return MNS_OK;
}

static mns_status read_index(scene_reader *r, const char *key, const json_t *value, void *target)
{
    double index = json_number_value(value);
    if (!json_is_number(value) || !(index == 0 || (index >= 1 && index <= 100)))
        return scene_wrong(r, key, value, "a number from 1 to 100, or 0");
    *(double *)target = index;
    return MNS_OK;
}

static mns_status read_absorption(scene_reader *r, const char *key, const json_t *value, void *target)
{
    const double *v = target;
    mns_status status = scene_read_point(r, key, value, target);
    if (!status && !(v[0] >= 0 && v[1] >= 0 && v[2] >= 0))
        return scene_wrong(r, key, value, "three numbers of 0 or more");
    return status;
}

static mns_status read_seed(scene_reader *r, const char *key, const json_t *value, void *target)
{
    json_int_t seed = json_is_integer(value) ? json_integer_value(value) : -1;
    if (seed < 0 || seed > UINT32_MAX)
        return scene_wrong(r, key, value, "a whole number from 0 to 4294967295");
    *(uint32_t *)target = (uint32_t)seed;
    return MNS_OK;
}

/* ---- Lights ---- */

static mns_status read_kind(scene_reader *r, const char *key, const json_t *value, void *target)
{
    static const char *const names[] = {"head", "directional", "point", "area"};
    const char *text = json_string_value(value);
    for (size_t i = 0; text && i < SCENE_COUNT(names); i++)
        if (strcmp(names[i], text) == 0) {
            *(mns_light_kind *)target = (mns_light_kind)i;
            return MNS_OK;
        }
    return scene_wrong(r, key, value, "one of head directional point area");
}

static const scene_key LIGHT_KEYS[] = {
    {"kind", read_kind, offsetof(mns_light, kind), 0, 0},
    {"direction", scene_read_direction, offsetof(mns_light, direction), 0, 0},
    {"position", scene_read_point, offsetof(mns_light, position), 0, 0},
    {"radius", scene_read_positive, offsetof(mns_light, radius), 0, 0},
    {"color", scene_read_color, offsetof(mns_light, color), 0, 0},
    {"strength", scene_read_positive, offsetof(mns_light, strength), 0, 0},
};

/* Without a kind, what is given tells it: a position with a radius, a position, a direction. */
static mns_status read_one_light(scene_reader *r, const char *key, const json_t *value, mns_light *light)
{
    mns_status status = scene_read_object(r, key, value, LIGHT_KEYS, SCENE_COUNT(LIGHT_KEYS), light);
    if (status) return status;
    bool placed = json_object_get(value, "position"), wide = json_object_get(value, "radius");
    if (!json_object_get(value, "kind"))
        light->kind = placed && wide                        ? MNS_LIGHT_AREA
                      : placed                              ? MNS_LIGHT_POINT
                      : json_object_get(value, "direction") ? MNS_LIGHT_DIRECTIONAL
                                                            : MNS_LIGHT_HEAD;
    if ((light->kind == MNS_LIGHT_POINT || light->kind == MNS_LIGHT_AREA) && !placed)
        return scene_wrong(r, key, value, "a light of this kind to have a position");
    if (light->kind == MNS_LIGHT_AREA && !wide)
        return scene_wrong(r, key, value, "an area light to have a radius");
    return MNS_OK;
}

mns_status scene_read_lights(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    size_t count = json_array_size(value);
    if (!count || count > 256) return scene_wrong(r, key, value, "a list of 1 to 256 lights");
    r->file->lights = memory_array(count, sizeof *r->file->lights);
    if (!r->file->lights) return status_no_memory(r->error, "reading a scene");
    memset(r->file->lights, 0, count * sizeof *r->file->lights);
    for (size_t i = 0; i < count; i++) {
        char path[SCENE_PATH_SIZE];
        snprintf(path, sizeof path, "%.30s[%zu]", key, i);
        mns_status status = read_one_light(r, path, json_array_get(value, i), &r->file->lights[i]);
        if (status) return status;
    }
    r->file->scene.look.light_count = count;
    return MNS_OK;
}

/* ---- Effects ---- */

/* true, false, or how many samples. */
static mns_status read_shadows(scene_reader *r, const char *key, const json_t *value, void *target)
{
    mns_effects *e = target;
    e->shadows = true;
    if (json_is_integer(value)) return scene_read_whole(r, key, value, 1, 4096, &e->shadow_samples);
    if (!json_is_boolean(value))
        return scene_wrong(r, key, value, "true, false, or a whole number of samples from 1 to 4096");
    e->shadows = json_is_true(value);
    return MNS_OK;
}

static const scene_key OCCLUSION_KEYS[] = {
    {"rays", read_rays, offsetof(mns_effects, occlusion_rays), 0, 0},
    {"reach", scene_read_positive, offsetof(mns_effects, occlusion_reach), 0, 0},
};

/* How many rays, or an object with their reach too. */
static mns_status read_occlusion(scene_reader *r, const char *key, const json_t *value, void *target)
{
    mns_effects *e = target;
    if (json_is_object(value))
        return scene_read_object(r, key, value, OCCLUSION_KEYS, SCENE_COUNT(OCCLUSION_KEYS), e);
    return read_rays(r, key, value, &e->occlusion_rays);
}

static mns_status read_environment(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    return scene_read_text(r, key, value, &r->file->environment);
}

#define IN_LOOK(member) offsetof(mns_look, effects.member)
#define SET(bit)        offsetof(mns_look, set), bit

static const scene_key EFFECT_KEYS[] = {
    {"shadows", read_shadows, offsetof(mns_look, effects), SET(MNS_LOOK_SHADOWS)},
    {"reflections", read_levels, IN_LOOK(reflections), SET(MNS_LOOK_REFLECTIONS)},
    {"refractions", read_surfaces, IN_LOOK(refractions), SET(MNS_LOOK_REFRACTIONS)},
    {"mirror", read_share, IN_LOOK(mirror), SET(MNS_LOOK_MIRROR)},
    {"index", read_index, IN_LOOK(index), SET(MNS_LOOK_INDEX)},
    {"transmission", read_share, IN_LOOK(transmission), SET(MNS_LOOK_TRANSMISSION)},
    {"absorption", read_absorption, IN_LOOK(absorption), SET(MNS_LOOK_ABSORPTION)},
    {"occlusion", read_occlusion, offsetof(mns_look, effects), SET(MNS_LOOK_OCCLUSION)},
    {"environment", read_environment, 0, SET(MNS_LOOK_ENVIRONMENT)},
    {"seed", read_seed, IN_LOOK(seed), 0, 0},
};

mns_status scene_read_effects(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    return scene_read_object(r, key, value, EFFECT_KEYS, SCENE_COUNT(EFFECT_KEYS), &r->file->scene.look);
}

/* ---- The second material ---- */

static mns_status read_by(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    return scene_read_text(r, key, value, &r->file->blend_by);
}

#define IN_BLEND(member, bit) offsetof(mns_blend, member), offsetof(mns_blend, set), bit

static const scene_key BLEND_KEYS[] = {
    {"by", read_by, 0, 0, 0},
    {"range", scene_read_range, offsetof(mns_blend, range), 0, 0},
    {"color", scene_read_color, IN_BLEND(color, MNS_LOOK_COLOR)},
    {"mirror", read_share, IN_BLEND(mirror, MNS_LOOK_MIRROR)},
    {"transmission", read_share, IN_BLEND(transmission, MNS_LOOK_TRANSMISSION)},
    {"absorption", read_absorption, IN_BLEND(absorption, MNS_LOOK_ABSORPTION)},
};

mns_status scene_read_blend(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    mns_status status =
        scene_read_object(r, key, value, BLEND_KEYS, SCENE_COUNT(BLEND_KEYS), &r->file->scene.look.blend);
    if (!status && !r->file->blend_by) return scene_wrong(r, key, value, "the column to blend by, under by");
    return status;
}
