/* The light that falls on a place of the surface: shading, shadows, occlusion. */
#include "effects/shared.h"
#include "effects/walk.h"

#include <string.h>

/* ---- Rays that only ask whether they meet anything ---- */

bool effects_inwards(const effects_surface *surface, vec3 way)
{
    return (vec3_dot(way, surface->normal) < 0) != surface->inside;
}

bool effects_ask(effects_walk *walk, const effects_surface *surface, vec3 way, double reach, effects_met *met)
{
    reference_query query = {.reach = reach};
    /* Where a solid stands, f tells the side by itself. */
    if (!surface->solid) query.side = effects_inwards(surface, way) ? 1 : -1;
    vec3 leaves = surface->solid ? surface->normal : (vec3){0, 0, 0};
    vec3_store(query.origin, surface->at);
    vec3_store(query.direction, way);
    walk->pixel->rays++;
    const effects_scene *scene = walk->scene;
    walk->failed =
        walk->failed || !effects_meet(scene->reference, scene->solids, walk->scratch, &query, leaves, met);
    if (walk->failed) return false;
    walk->pixel->certain = walk->pixel->certain && met->answer.hit.certain;
    return true;
}

/* 1 where nothing stands in the ray's way up to `reach`, else 0. */
static double is_free(effects_walk *walk, const effects_surface *surface, vec3 way, double reach)
{
    effects_met met;
    return effects_ask(walk, surface, way, reach, &met) && !met.answer.hit.hit ? 1 : 0;
}

static uint32_t key_of(const effects_walk *walk, const effects_surface *surface, uint32_t purpose)
{
    const effects_pixel *pixel = walk->pixel;
    return samples_key(pixel->x, pixel->y, walk->scene->plan->look.effects.seed, surface->path, purpose);
}

static vec3 turned(vec3 to, const double v[3])
{
    return (vec3){samples_turned(0, to.x, to.y, to.z, v[0], v[1], v[2]),
                  samples_turned(1, to.x, to.y, to.z, v[0], v[1], v[2]),
                  samples_turned(2, to.x, to.y, to.z, v[0], v[1], v[2])};
}

/* The share of a sphere of light, `ratio` its radius over its distance, that is seen from the surface. */
static double sphere_share(effects_walk *walk, const effects_surface *surface, uint32_t light, vec3 way,
                           double distance)
{
    const mns_effects *e = &walk->scene->plan->look.effects;
    double ratio = walk->scene->plan->light[light].radius / distance, width, seen = 0;
    if (ratio >= 1) return 1; /* in its midst */
    width = samples_cone_width(ratio);
    uint32_t key = key_of(walk, surface, 1 + light), count = (uint32_t)e->shadow_samples;
    for (uint32_t i = 0; i < count && !walk->failed; i++) {
        uint32_t index = walk->pixel->sample * count + i;
        double u = samples_number(key, index, 0), v = samples_number(key, index, 1), ray[3];
        for (int a = 0; a < 3; a++) ray[a] = samples_cone(a, width, u, v);
        vec3 to = turned(way, ray);
        double reach = distance * samples_sphere_distance(ratio, u * width);
        if (vec3_dot(to, surface->normal) > 0) seen += is_free(walk, surface, to, reach);
    }
    return seen / count;
}

static double occlusion_of(effects_walk *walk, const effects_surface *surface)
{
    const mns_effects *e = &walk->scene->plan->look.effects;
    uint32_t key = key_of(walk, surface, 0), count = (uint32_t)e->occlusion_rays;
    double open = 0;
    for (uint32_t i = 0; i < count && !walk->failed; i++) {
        uint32_t index = walk->pixel->sample * count + i;
        double u = samples_number(key, index, 0), v = samples_number(key, index, 1), ray[3];
        for (int a = 0; a < 3; a++) ray[a] = samples_hemisphere(a, u, v);
        open += is_free(walk, surface, turned(surface->normal, ray), e->occlusion_reach);
    }
    return open / count;
}

/* ---- Lights ---- */

/* The unit direction towards a light, and how far it is. */
static vec3 way_to(const mns_plan *plan, const mns_light *light, vec3 at, double *distance)
{
    *distance = INFINITY;
    if (light->kind == MNS_LIGHT_DIRECTIONAL) return vec3_unit(vec3_load(light->direction));
    vec3 place = light->kind == MNS_LIGHT_HEAD ? plan->frame.eye : vec3_load(light->position);
    vec3 way = vec3_sub(place, at);
    *distance = vec3_length(way);
    return vec3_unit(way);
}

/* The share of a light that reaches the surface, on its lit side. */
static double visible(effects_walk *walk, const effects_surface *surface, uint32_t light, vec3 way,
                      double distance)
{
    const mns_plan *plan = walk->scene->plan;
    mns_light_kind kind = plan->light[light].kind;
    if (!(plan->features & FEATURE_SHADOWS) || kind == MNS_LIGHT_HEAD) return 1;
    if (kind == MNS_LIGHT_AREA) return sphere_share(walk, surface, light, way, distance);
    return is_free(walk, surface, way, distance);
}

static double banded(double facing, int bands)
{
    double most = bands > 1 ? bands - 1 : 1;
    return fmin(floor(facing * bands), bands - 1) / most;
}

/* One light's share of diffuse light and of shine. */
static void add_light(effects_walk *walk, const effects_surface *surface, uint32_t index, effects_lit *lit)
{
    const mns_plan *plan = walk->scene->plan;
    const mns_look *look = &plan->look;
    const double *radiance = walk->scene->radiance[index];
    double distance, shine = 0;
    vec3 way = way_to(plan, &plan->light[index], surface->at, &distance);
    double facing = vec3_dot(surface->normal, way);
    if (!(facing > 0)) return;
    double share = visible(walk, surface, index, way, distance);
    if (plan->light[index].kind != MNS_LIGHT_HEAD) lit->shadow += share;
    if (look->specular > 0 && !surface->solid) {
        vec3 half = vec3_unit(vec3_add(way, surface->to_viewer));
        shine = look->specular * pow(fmax(vec3_dot(surface->normal, half), 0), look->shininess);
    }
    if (look->shading == MNS_SHADING_CEL) {
        facing = banded(facing, look->cel_bands);
        shine = shine > 0 && shine >= 0.5 * look->specular ? look->specular : 0;
    }
    for (int c = 0; c < 3; c++) {
        lit->shaded[c] += look->diffuse * share * radiance[c] * facing;
        lit->shine[c] += share * radiance[c] * shine;
    }
}

void effects_light(effects_walk *walk, const effects_surface *surface, bool needs_shaded, effects_lit *lit)
{
    const mns_plan *plan = walk->scene->plan;
    uint32_t casting = 0;
    *lit = (effects_lit){.occlusion = 1};
    for (size_t i = 0; i < plan->look.light_count && !walk->failed; i++) {
        casting += plan->light[i].kind != MNS_LIGHT_HEAD;
        add_light(walk, surface, (uint32_t)i, lit);
    }
    lit->shadow = casting ? lit->shadow / casting : 1;
    if (plan->features & FEATURE_OCCLUSION && needs_shaded) lit->occlusion = occlusion_of(walk, surface);
    for (int c = 0; c < 3; c++)
        lit->shaded[c] = surface->albedo[c] * (plan->look.ambient * lit->occlusion + lit->shaded[c]);
    /* The dark contour of cel shading (glsl/shade.frag.glsl). */
    bool outlined = plan->look.shading == MNS_SHADING_CEL && !surface->solid;
    if (!outlined || vec3_dot(surface->normal, surface->to_viewer) >= 0.22) return;
    memset(lit->shaded, 0, sizeof lit->shaded);
    memset(lit->shine, 0, sizeof lit->shine);
}
