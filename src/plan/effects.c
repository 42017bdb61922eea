/* Lights and effects of a look: checked, filled in, and only what does something kept. */
#include "base/memory.h"
#include "base/status.h"
#include "plan/plan.h"

#include <string.h>

/* Of a light's place and radius, in the field's unit: what doubles can square. */
#define LIGHT_MOST 1e60

enum { LIGHTS_MOST = 256, MESHES_MOST = 256, RAYS_MOST = 4096, REFLECTIONS_MOST = 8, REFRACTIONS_MOST = 16 };

/* ---- Checks ---- */

static bool is_share(double x)
{
    return x >= 0 && x <= 1;
}

static mns_status check_light(const mns_light *light, size_t i, mns_error *error)
{
    if ((unsigned)light->kind > MNS_LIGHT_AREA)
        return status_fail(error, MNS_ERROR_USAGE,
                           "light %zu: no kind %d; take head, directional, point or area", i, light->kind);
    if (!vec3_is_finite(vec3_load(light->direction)) || !vec3_is_finite(vec3_load(light->position)))
        return status_fail(error, MNS_ERROR_USAGE, "light %zu: direction and position must be finite", i);
    if (light->kind == MNS_LIGHT_AREA && !(light->radius > 0 && isfinite(light->radius)))
        return status_fail(error, MNS_ERROR_USAGE,
                           "light %zu: radius %g; an area light is a sphere, of a radius above 0", i,
                           light->radius);
    if (!(light->strength >= 0 && isfinite(light->strength)))
        return status_fail(error, MNS_ERROR_USAGE, "light %zu: strength %g; take a number of 0 or more", i,
                           light->strength);
    for (int c = 0; c < 3; c++)
        if (!is_share(light->color[c]))
            return status_fail(error, MNS_ERROR_USAGE, "light %zu: colours are numbers from 0 to 1", i);
    return MNS_OK;
}

static mns_status check_count(const char *what, int count, int most, mns_error *error)
{
    if (count >= 0 && count <= most) return MNS_OK;
    return status_fail(error, MNS_ERROR_USAGE, "effects: %d %s; take 0 to %d", count, what, most);
}

static mns_status check_effects(const mns_effects *e, mns_error *error)
{
    mns_status status = check_count("shadow samples", e->shadow_samples, RAYS_MOST, error);
    if (!status) status = check_count("occlusion rays", e->occlusion_rays, RAYS_MOST, error);
    if (!status) status = check_count("reflections", e->reflections, REFLECTIONS_MOST, error);
    if (!status) status = check_count("refractions", e->refractions, REFRACTIONS_MOST, error);
    if (status) return status;
    if (!is_share(e->mirror) || !is_share(e->transmission))
        return status_fail(error, MNS_ERROR_USAGE, "effects: mirror %g, transmission %g; shares are 0 to 1",
                           e->mirror, e->transmission);
    if (e->index != 0 && !(e->index >= 1 && e->index <= 100))
        return status_fail(error, MNS_ERROR_USAGE, "effects: index of refraction %g; take 1 to 100, or 0",
                           e->index);
    for (int c = 0; c < 3; c++)
        if (!(e->absorption[c] >= 0 && isfinite(e->absorption[c])))
            return status_fail(error, MNS_ERROR_USAGE, "effects: absorption %g; take numbers of 0 or more",
                               e->absorption[c]);
    if (!(e->occlusion_reach >= 0 && isfinite(e->occlusion_reach)))
        return status_fail(error, MNS_ERROR_USAGE,
                           "effects: occlusion's reach %g; take a length above 0, or 0", e->occlusion_reach);
    return MNS_OK;
}

/* ---- Defaults ---- */

static void fill_light(mns_light *light)
{
    static const double white[3] = {1, 1, 1}, from[3] = {1, 2, 1.5};
    if (light->strength == 0) light->strength = 1;
    if (light->color[0] == 0 && light->color[1] == 0 && light->color[2] == 0)
        memcpy(light->color, white, sizeof white);
    if (light->direction[0] == 0 && light->direction[1] == 0 && light->direction[2] == 0)
        memcpy(light->direction, from, sizeof from);
}

/* The plan's own lights; one that is as plain as the look's is the look's. */
static mns_status take_lights(mns_plan *plan, mns_error *error)
{
    mns_look *look = &plan->look;
    size_t count = look->light_count ? look->light_count : 1;
    mns_light one = {.kind = look->light};
    memcpy(one.direction, look->light_direction, sizeof one.direction);
    const mns_light *from = look->light_count ? look->lights : &one;
    if (!from) return status_fail(error, MNS_ERROR_USAGE, "look: %zu lights, and no array of them", count);
    if (count > LIGHTS_MOST)
        return status_fail(error, MNS_ERROR_UNSUPPORTED, "look: %zu lights; at most %d can be drawn", count,
                           LIGHTS_MOST);
    plan->light = memory_array(count, sizeof *plan->light);
    if (!plan->light) return status_no_memory(error, "while planning a frame");
    memcpy(plan->light, from, count * sizeof *plan->light);
    look->lights = plan->light;
    look->light_count = count;
    for (size_t i = 0; i < count; i++) {
        mns_status status = check_light(&plan->light[i], i, error);
        if (status) return status;
        fill_light(&plan->light[i]);
    }
    look->light = plan->light[0].kind;
    memcpy(look->light_direction, plan->light[0].direction, sizeof look->light_direction);
    return MNS_OK;
}

static mns_status take_environment(mns_plan *plan, mns_error *error)
{
    const char *name = plan->look.effects.environment;
    plan->look.effects.environment = NULL; /* was borrowed for the call */
    if (!name || !*name) return MNS_OK;
    if (strcmp(name, "sky") == 0) {
        plan->features |= FEATURE_SKY;
        return MNS_OK;
    }
    plan->features |= FEATURE_ENVIRONMENT;
    plan->environment = strdup(name);
    return plan->environment ? MNS_OK : status_no_memory(error, "while planning a frame");
}

/* The plan's own meshes. */
static mns_status take_meshes(mns_plan *plan, mns_error *error)
{
    const mns_mesh *from = plan->look.meshes;
    size_t count = plan->look.mesh_count;
    plan->look.meshes = NULL; /* was borrowed for the call */
    plan->look.mesh_count = 0;
    if (!count) return MNS_OK;
    if (!from) return status_fail(error, MNS_ERROR_USAGE, "look: %zu meshes, and no array of them", count);
    if (count > MESHES_MOST)
        return status_fail(error, MNS_ERROR_UNSUPPORTED, "look: %zu meshes; at most %d can be drawn", count,
                           MESHES_MOST);
    plan->look.meshes = plan->mesh = memory_array(count, sizeof *plan->mesh);
    if (!plan->mesh) return status_no_memory(error, "while planning a frame");
    for (size_t i = 0; i < count; i++) {
        mns_mesh *mesh = &plan->mesh[i];
        if (!from[i].file || !*from[i].file)
            return status_fail(error, MNS_ERROR_USAGE, "mesh %zu: no file's name", i);
        *mesh = from[i];
        for (int c = 0; c < 3; c++) {
            if (!mesh->has_color) mesh->color[c] = 0.8;
            if (!is_share(mesh->color[c]))
                return status_fail(error, MNS_ERROR_USAGE, "mesh %zu: colours are numbers from 0 to 1", i);
        }
        mesh->file = strdup(from[i].file);
        if (!mesh->file) return status_no_memory(error, "while planning a frame");
        plan->look.mesh_count++;
    }
    plan->features |= FEATURE_SOLIDS;
    return MNS_OK;
}

/* Lengths to the field's own unit, in which light travels. */
static mns_status enter_unit(mns_plan *plan, mns_error *error)
{
    mns_effects *e = &plan->look.effects;
    for (size_t i = 0; i < plan->look.light_count; i++) {
        mns_light *light = &plan->light[i];
        double farthest = 0;
        for (int a = 0; a < 3; a++) {
            light->position[a] /= plan->unit;
            farthest = fmax(farthest, fabs(light->position[a]));
        }
        light->radius /= plan->unit;
        if (!(farthest <= LIGHT_MOST && light->radius <= LIGHT_MOST))
            return status_fail(
                error, MNS_ERROR_UNSUPPORTED,
                "light %zu: position and radius reach to more than %g; expected it nearer to the "
                "field, or a directional light",
                i, LIGHT_MOST * plan->unit);
    }
    e->occlusion_reach /= plan->unit;
    for (int c = 0; c < 3; c++) e->absorption[c] *= plan->unit;
    return MNS_OK;
}

static void fill_effects(mns_look *look, const mns_field *field)
{
    mns_effects *e = &look->effects;
    if (e->occlusion_reach == 0) {
        vec3 box = vec3_sub(vec3_load(field->effective_hi), vec3_load(field->effective_lo));
        e->occlusion_reach = field->p.count ? 0.1 * vec3_length(box) : 1;
    }
    if (e->shadow_samples == 0) e->shadow_samples = 16;
    if (e->mirror == 0 && !(look->set & MNS_LOOK_MIRROR) && e->reflections && e->index == 0) e->mirror = 0.3;
    if (e->transmission == 0 && !(look->set & MNS_LOOK_TRANSMISSION)) e->transmission = 1;
    if (!e->refractions) e->transmission = 0;
}

/* ---- What does something ---- */

/* Whether light that is neither mirrored nor passed on is seen at all. */
static bool is_shaded(const mns_plan *plan)
{
    const mns_effects *e = &plan->look.effects;
    const mns_blend *b = &plan->look.blend;
    if (plan->features & FEATURE_SOLIDS) return true;
    return fmin(e->mirror, b->mirror) < 1 &&
           !(plan->features & FEATURE_REFRACTION && e->transmission == 1 && b->transmission == 1);
}

static bool has_light(const mns_plan *plan, mns_light_kind kind)
{
    for (size_t i = 0; i < plan->look.light_count; i++)
        if (plan->light[i].kind == kind) return true;
    return false;
}

static bool casts(const mns_plan *plan)
{
    return has_light(plan, MNS_LIGHT_DIRECTIONAL) || has_light(plan, MNS_LIGHT_POINT) ||
           has_light(plan, MNS_LIGHT_AREA);
}

static bool is_lit_by_lights(const mns_plan *plan)
{
    return plan->look.specular > 0 || (plan->look.diffuse > 0 && is_shaded(plan));
}

static bool is_plain(const mns_light *light)
{
    return light->strength == 1 && light->color[0] == 1 && light->color[1] == 1 && light->color[2] == 1;
}

static void find_lights(mns_plan *plan)
{
    const mns_look *look = &plan->look;
    if (has_light(plan, MNS_LIGHT_DIRECTIONAL)) plan->features |= FEATURE_DIRECTIONAL;
    if (has_light(plan, MNS_LIGHT_POINT) || has_light(plan, MNS_LIGHT_AREA))
        plan->features |= FEATURE_POINT_LIGHTS;
    if (look->light_count > 1 || !is_plain(plan->light)) plan->features |= FEATURE_LIGHTS;
}

static void find_effects(mns_plan *plan)
{
    mns_effects *e = &plan->look.effects;
    mns_blend *b = &plan->look.blend; /* as the effects, where there is one material */
    if (e->index > 1) plan->features |= FEATURE_FRESNEL | FEATURE_MIRROR;
    if (e->mirror > 0 || b->mirror > 0) plan->features |= FEATURE_MIRROR;
    if (!(plan->features & FEATURE_MIRROR)) e->reflections = 0;
    bool passes = fmax(e->transmission, b->transmission) > 0 && fmin(e->mirror, b->mirror) < 1;
    if (e->refractions && passes) plan->features |= FEATURE_REFRACTION;
    if (!(plan->features & FEATURE_REFRACTION)) e->refractions = 0, e->transmission = b->transmission = 0;
    bool absorbs = false;
    for (int c = 0; c < 3; c++) absorbs = absorbs || e->absorption[c] > 0 || b->absorption[c] > 0;
    if (absorbs && plan->features & FEATURE_REFRACTION) plan->features |= FEATURE_ABSORPTION;
    if (e->occlusion_rays && plan->look.ambient > 0 && is_shaded(plan)) plan->features |= FEATURE_OCCLUSION;
    if (!e->shadows || !casts(plan) || !is_lit_by_lights(plan)) return;
    plan->features |= FEATURE_SHADOWS;
    if (has_light(plan, MNS_LIGHT_AREA)) plan->features |= FEATURE_SOFT_SHADOWS;
}

mns_status plan_effects(mns_plan *plan, const mns_field *field, mns_error *error)
{
    const uint64_t lit = FEATURE_LIGHTS | FEATURE_POINT_LIGHTS | FEATURE_SHADOWS | FEATURE_MIRROR |
                         FEATURE_REFRACTION | FEATURE_OCCLUSION | FEATURE_ENVIRONMENT | FEATURE_SKY |
                         FEATURE_SOLIDS;
    mns_status status = check_effects(&plan->look.effects, error);
    if (!status) status = take_lights(plan, error);
    if (!status) status = enter_unit(plan, error);
    if (!status) status = take_environment(plan, error);
    if (!status) status = take_meshes(plan, error);
    if (status) return status;
    fill_effects(&plan->look, field);
    status = plan_blend(plan, field, error);
    if (status) return status;
    find_lights(plan);
    find_effects(plan);
    if (plan_blend_is_seen(plan)) plan->features |= FEATURE_MATERIALS;
    if (plan->features & lit) plan->features |= FEATURE_LIT;
    return MNS_OK;
}

/* ---- What does not ---- */

static const char unasked[] = "nobody asks for them";

static const char *no_shadows(const mns_plan *plan)
{
    if (!plan->look.effects.shadows) return unasked;
    return casts(plan) ? "no light's share of the picture is above 0" : "a light at the eye casts none";
}

static const char *no_occlusion(const mns_plan *plan)
{
    if (!plan->look.effects.occlusion_rays) return unasked;
    return plan->look.ambient > 0 ? "nothing is shaded: all is mirrored or goes through"
                                  : "the ambient light's strength is 0";
}

static const char *no_absorption(const mns_plan *plan)
{
    return plan->features & FEATURE_REFRACTION ? "its strength is 0" : "nothing goes through the surface";
}

void plan_effects_left_out(mns_plan *plan)
{
    uint64_t f = plan->features;
    bool map = f & FEATURE_ENVIRONMENT, sky = f & FEATURE_SKY;
    const struct {
        uint64_t feature;
        const char *part, *reason;
    } parts[] = {
        {FEATURE_LIGHTS, "several lights", "one light, white, of strength 1"},
        {FEATURE_POINT_LIGHTS, "lights at a point", "no light has a place"},
        {FEATURE_SHADOWS, "shadows", no_shadows(plan)},
        {FEATURE_SOFT_SHADOWS, "soft shadows",
         f & FEATURE_SHADOWS ? "no light is a sphere" : "there are no shadows"},
        {FEATURE_MIRROR, "mirroring", "nothing is mirrored"},
        {FEATURE_FRESNEL, "Fresnel's share", "no index of refraction above 1"},
        {FEATURE_REFRACTION, "refraction", "nothing goes through the surface"},
        {FEATURE_ABSORPTION, "absorption", no_absorption(plan)},
        {FEATURE_OCCLUSION, "occlusion", no_occlusion(plan)},
        {FEATURE_MATERIALS, "a second material", plan->no_blend},
        {FEATURE_ENVIRONMENT, "an environment's map",
         sky ? "the sky is built in" : "the background has one colour"},
        {FEATURE_SOLIDS, "meshes", unasked},
        {FEATURE_SKY, "a built-in sky", map ? "the environment is a map" : "the background has one colour"},
    };
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (!(f & parts[i].feature)) plan_leave_out(plan, parts[i].part, parts[i].reason);
}
