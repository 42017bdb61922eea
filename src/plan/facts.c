#include "field/kernel.h"
#include "plan/plan.h"

/* f(eye), and whether the eye is inside some effective sphere. */
static void sum_at_eye(const mns_field *field, vec3 eye, plan_facts *facts)
{
    double value = 0;
    int inside = 0;
    const double *x = field->p.axis[0], *y = field->p.axis[1], *z = field->p.axis[2];
    /* One thread adds: the sum's bits decide which side the eye is on, and must not hang on the number of
     * threads. */
    for (size_t i = 0; i < field->p.count; i++) {
        double r = field_radius(field, i);
        double dx = (x[i] - eye.x) / r, dy = (y[i] - eye.y) / r, dz = (z[i] - eye.z) / r;
        double u = dx * dx + dy * dy + dz * dz;
        if (u >= 1) continue;
        inside = 1;
        value += field_strength(field, i) * density_value((int)field->kernel, u);
    }
    facts->eye_in_ball = inside;
    facts->eye_value = value;
}

/* Slope and bend of f about an eye that is on the surface. */
static void bend_at_eye(const mns_field *field, vec3 eye, plan_facts *facts)
{
    const double *x = field->p.axis[0], *y = field->p.axis[1], *z = field->p.axis[2];
    vec3 gradient = {0, 0, 0};
    facts->eye_reach = field->radius_min / 16;
    facts->eye_bend = 0;
    for (size_t i = 0; i < field->p.count; i++) {
        double r = field_radius(field, i), q = field_strength(field, i);
        vec3 d = vec3_scale(vec3_sub(eye, (vec3){x[i], y[i], z[i]}), 1 / r);
        double v = vec3_length(d);
        if (v >= 1 + facts->eye_reach / r) continue;
        facts->eye_bend += fabs(q) * density_curvature_bound((int)field->kernel, 1) / (r * r);
        if (v < 1)
            gradient = vec3_along(gradient, q * density_slope_over_v((int)field->kernel, v * v) / r, d);
    }
    vec3_store(facts->eye_gradient, gradient);
}

void plan_facts_of(const mns_field *field, const view_frame *frame, plan_facts *facts)
{
    *facts = (plan_facts){.strongest = field->strength_max, .negative = field->strength_min < 0};
    if (!field->p.count) return;
    vec3 near_point = frame->eye, lo = vec3_load(field->effective_lo), hi = vec3_load(field->effective_hi);
    near_point.x = fmin(fmax(near_point.x, lo.x), hi.x);
    near_point.y = fmin(fmax(near_point.y, lo.y), hi.y);
    near_point.z = fmin(fmax(near_point.z, lo.z), hi.z);
    vec3_store(facts->nearest_point, near_point);
    facts->eye_distance = vec3_length(vec3_sub(near_point, frame->eye));
    double shallowest = INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        vec3 at = {corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z};
        vec3 from_eye = vec3_sub(at, frame->eye);
        facts->farthest = fmax(facts->farthest, vec3_length(from_eye));
        shallowest = fmin(shallowest, vec3_dot(from_eye, frame->forward));
    }
    facts->plane_depth = fmax(0, shallowest);
    if (facts->eye_distance <= 0) sum_at_eye(field, frame->eye, facts);
    if (facts->eye_value == field->iso) bend_at_eye(field, frame->eye, facts);
}
