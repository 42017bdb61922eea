/* A pixel's path through the scene: at each surface it is shaded, and branches into a mirrored and a
 * refracted ray. */
#include "effects/effects.h"

#include "base/color.h"
#include "base/memory.h"
#include "effects/shared.h"
#include "effects/walk.h"

#include <string.h>

mns_status effects_begin(effects_scene *scene, const mns_plan *plan, const mns_reference *reference,
                         const solid_set *solids, effects_albedo *albedo, const void *user, mns_error *error)
{
    size_t count = plan->look.light_count, meshes = plan->look.mesh_count;
    *scene = (effects_scene){
        .plan = plan, .reference = reference, .solids = solids, .albedo = albedo, .user = user};
    scene->radiance = memory_array(count, sizeof *scene->radiance);
    scene->solid_color = memory_array(meshes, sizeof *scene->solid_color);
    if (!scene->radiance || !scene->solid_color) return status_no_memory(error, "while tracing a frame");
    for (size_t i = 0; i < meshes; i++)
        for (int c = 0; c < 3; c++) scene->solid_color[i][c] = color_linear(plan->mesh[i].color[c]);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            scene->radiance[i][c] = plan->light[i].strength * color_linear(plan->light[i].color[c]);
    return environment_begin(&scene->environment, plan, error);
}

void effects_end(effects_scene *scene)
{
    free(scene->radiance);
    free(scene->solid_color);
    environment_end(&scene->environment);
    *scene = (effects_scene){0};
}

/* What a ray has left: levels, and its share of the pixel, a channel. */
typedef struct allowance {
    int reflections, refractions;
    double share[3];
} allowance;

static double largest(const double v[3])
{
    return fmax(v[0], fmax(v[1], v[2]));
}

/* `within`: the ray came through the medium, which a solid does not tell. */
static void surface_take(const effects_walk *walk, vec3 way, bool within, const effects_met *met,
                         uint32_t path, effects_surface *surface)
{
    const reference_answer *answer = &met->answer;
    vec3 outward = vec3_load(answer->hit.normal);
    surface->solid = met->mesh != 0;
    surface->inside = surface->solid ? within : vec3_dot(outward, way) > 0;
    surface->normal = vec3_dot(outward, way) > 0 ? vec3_scale(outward, -1) : outward;
    surface->to_viewer = vec3_scale(way, -1);
    surface->at = vec3_load(answer->point);
    surface->path = path;
    surface->weight = 0;
    if (surface->solid)
        memcpy(surface->albedo, walk->scene->solid_color[met->mesh - 1], sizeof surface->albedo);
    else
        surface->weight = walk->scene->albedo(walk->scene->user, walk->scratch, answer->s, surface->albedo);
}

/* Dims what came `length` through the medium, of the second material by `weight`. */
static void absorb(const mns_plan *plan, double length, double weight, double color[3])
{
    const mns_look *look = &plan->look;
    for (int c = 0; c < 3 && plan->features & FEATURE_ABSORPTION; c++)
        color[c] *=
            exp(-effects_between(look->effects.absorption[c], look->blend.absorption[c], weight) * length);
}

static void surface_color(effects_walk *walk, const effects_surface *surface, const allowance *left,
                          bool is_first, double color[3]);

/* What comes along a ray that leaves a surface; the distance of what it meets, INFINITY where that is nothing
 * or the ray is not traced. */
static double ray_color(effects_walk *walk, const effects_surface *from, vec3 way, uint32_t path, bool traced,
                        const allowance *left, double color[3])
{
    effects_met met = {.answer = {.hit = {.t = INFINITY}}};
    const mns_hit *hit = &met.answer.hit;
    effects_surface surface;
    if (traced && largest(left->share) >= optics_least_share() &&
        !effects_ask(walk, from, way, INFINITY, &met))
        return INFINITY;
    if (!hit->hit) {
        environment_color(&walk->scene->environment, way, color);
        return INFINITY;
    }
    surface_take(walk, way, effects_inwards(from, way), &met, path, &surface);
    allowance rest = *left;
    double weight = surface.solid ? from->weight : 0.5 * (from->weight + surface.weight);
    if (surface.inside) absorb(walk->scene->plan, hit->t, weight, rest.share);
    surface_color(walk, &surface, &rest, false, color);
    if (surface.inside) absorb(walk->scene->plan, hit->t, weight, color);
    return hit->t;
}

/* What a surface does to the light: shares, and how its rays are bent. */
typedef struct optics {
    double cosine, ratio, mirrored, transmission;
    bool total; /* reflection */
} optics;

static optics optics_of(const mns_plan *plan, const effects_surface *surface)
{
    const mns_effects *e = &plan->look.effects;
    const mns_blend *second = &plan->look.blend;
    double mirror = effects_between(e->mirror, second->mirror, surface->weight);
    optics o = {.cosine = fmin(vec3_dot(surface->normal, surface->to_viewer), 1),
                .ratio = 1,
                .mirrored = mirror,
                .transmission = effects_between(e->transmission, second->transmission, surface->weight)};
    if (surface->solid) o.mirrored = o.transmission = 0;
    if (surface->solid || !(plan->features & FEATURE_FRESNEL)) return o;
    o.ratio = surface->inside ? 1 / e->index : e->index;
    o.total = optics_beyond(o.ratio, o.cosine) <= 0;
    o.mirrored += (1 - mirror) * optics_fresnel(o.ratio, o.cosine);
    if (o.total) o.mirrored = 1;
    return o;
}

/* Adds the mirrored ray's light. A total reflection is one of the surfaces that a ray may pass through; only
 * where none of those is left is it a mirror's level. */
static double add_mirrored(effects_walk *walk, const effects_surface *surface, const optics *o,
                           allowance left, double color[3])
{
    double seen[3] = {0, 0, 0};
    vec3 way = vec3_along(vec3_scale(surface->to_viewer, -1), 2 * o->cosine, surface->normal);
    int *level = o->total && left.refractions ? &left.refractions : &left.reflections;
    bool traced = *level > 0;
    *level -= traced;
    for (int c = 0; c < 3; c++) left.share[c] *= o->mirrored;
    double t = ray_color(walk, surface, vec3_unit(way), 2 * surface->path, traced, &left, seen);
    for (int c = 0; c < 3; c++) color[c] += o->mirrored * seen[c];
    return t;
}

static double add_refracted(effects_walk *walk, const effects_surface *surface, const optics *o, double share,
                            allowance left, double color[3])
{
    double seen[3] = {0, 0, 0};
    vec3 way = vec3_scale(surface->to_viewer, -1);
    if (o->ratio != 1)
        way = vec3_unit(
            vec3_scale(vec3_along(way, optics_bend(o->ratio, o->cosine), surface->normal), 1 / o->ratio));
    bool traced = left.refractions > 0;
    left.refractions -= traced;
    for (int c = 0; c < 3; c++) left.share[c] *= share;
    double t = ray_color(walk, surface, way, 2 * surface->path + 1, traced, &left, seen);
    for (int c = 0; c < 3; c++) color[c] += share * seen[c];
    return t;
}

static void surface_color(effects_walk *walk, const effects_surface *surface, const allowance *left,
                          bool is_first, double color[3])
{
    const mns_plan *plan = walk->scene->plan;
    optics o = optics_of(plan, surface);
    double passes = o.transmission * (1 - o.mirrored), shaded = (1 - o.transmission) * (1 - o.mirrored);
    double mirror = INFINITY, refracted = INFINITY;
    effects_lit lit;
    effects_light(walk, surface, shaded > 0, &lit);
    for (int c = 0; c < 3; c++) color[c] = lit.shine[c] + shaded * lit.shaded[c];
    if (o.mirrored > 0) mirror = add_mirrored(walk, surface, &o, *left, color);
    if (passes > 0) refracted = add_refracted(walk, surface, &o, passes, *left, color);
    if (!is_first) return;
    effects_pixel *pixel = walk->pixel;
    pixel->shadow = lit.shadow, pixel->occlusion = lit.occlusion;
    pixel->mirror = mirror, pixel->refracted = refracted;
}

bool effects_first(const effects_scene *scene, reference_scratch *scratch, vec3 way, effects_met *first)
{
    reference_query query = {.reach = INFINITY};
    vec3_store(query.origin, scene->plan->frame.eye);
    vec3_store(query.direction, way);
    return effects_meet(scene->reference, scene->solids, scratch, &query, (vec3){0, 0, 0}, first);
}

/* Whether the eye's ray along `way` begins in the medium. */
static bool begins_within(const effects_scene *scene, vec3 way)
{
    const plan_facts *facts = &scene->plan->facts;
    double above = facts->eye_value - scene->reference->field->iso;
    return above > 0 || (above == 0 && vec3_dot(vec3_load(facts->eye_gradient), way) > 0);
}

bool effects_shade(const effects_scene *scene, reference_scratch *scratch, vec3 way, const effects_met *first,
                   effects_pixel *pixel)
{
    const mns_plan *plan = scene->plan;
    effects_walk walk = {.scene = scene, .scratch = scratch, .pixel = pixel};
    allowance all = {plan->look.effects.reflections, plan->look.effects.refractions, {1, 1, 1}};
    effects_surface surface;
    pixel->certain = true;
    pixel->shadow = pixel->occlusion = 1;
    pixel->mirror = pixel->refracted = INFINITY;
    pixel->rays = 0;
    const mns_hit *hit = &first->answer.hit;
    if (!hit->hit) {
        pixel->color[3] = plan->look.background[3];
        environment_color(&scene->environment, way, pixel->color);
        for (int c = 0; c < 3; c++) pixel->color[c] *= pixel->color[3];
        return true;
    }
    surface_take(&walk, way, begins_within(scene, way), first, 1, &surface);
    if (surface.inside) absorb(plan, hit->t, surface.weight, all.share);
    surface_color(&walk, &surface, &all, true, pixel->color);
    if (surface.inside) absorb(plan, hit->t, surface.weight, pixel->color);
    pixel->color[3] = 1;
    return !walk.failed;
}
