#include "effects/meet.h"

bool effects_meet(const mns_reference *reference, const solid_set *solids, reference_scratch *scratch,
                  const reference_query *query, vec3 leaves, effects_met *met)
{
    met->mesh = 0;
    if (!solids || !solids->node_count) return reference_ask(reference, scratch, query, &met->answer);
    const solid_ray ray = {vec3_load(query->origin), vec3_load(query->direction), query->reach, leaves};
    solid_hit solid = solid_trace(solids, &ray);
    reference_query before = *query; /* the surface counts only before the solid, or as near as rounding */
    before.reach = fmin(query->reach, solid.t + 2 * solid.t_error);
    if (!reference_ask(reference, scratch, &before, &met->answer)) return false;
    mns_hit *hit = &met->answer.hit;
    double apart = hit->t_error + solid.t_error;
    if (hit->hit && hit->t < solid.t - apart) {
        hit->certain = hit->certain && (solid.certain || hit->t + hit->t_error < solid.doubt);
        return true;
    }
    bool decided = hit->certain && solid.certain && !(hit->hit && hit->t <= solid.t + apart);
    if (solid.hit) {
        *hit = (mns_hit){.hit = true, .t = solid.t, .t_error = solid.t_error};
        vec3_store(hit->normal, solid.normal);
        vec3_store(met->answer.point, vec3_along(ray.origin, solid.t, ray.way));
        met->mesh = 1 + (size_t)solid.mesh;
    }
    hit->certain = decided;
    return true;
}
