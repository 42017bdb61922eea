#include "list/uniforms.h"

static void put(double *block, int at, vec3 v, double w)
{
    vec3_store(block + 4 * at, v);
    block[4 * at + 3] = w;
}

/* The raw direction through GL's pixel (0, 0), the lower left corner, and its change a pixel; forward
 * component 1. */
static void raw_direction(const view_frame *f, vec3 *corner, vec3 *step_x, vec3 *step_y)
{
    double unit = 2 * f->tan_half / f->height;
    *step_x = vec3_scale(f->right, unit);
    *step_y = vec3_scale(f->up, unit);
    *corner = vec3_along(f->forward, -0.5 * f->width, *step_x);
    *corner = vec3_along(*corner, -0.5 * f->height, *step_y);
}

void list_view_block(const mns_plan *plan, const mns_field *field, const double jitter[2],
                     const mns_target *host, double wide[VIEW_VECTORS * 4], float narrow[VIEW_VECTORS * 4])
{
    const view_frame *f = &plan->frame;
    vec3 corner, step_x, step_y, eye = vec3_sub(f->eye, vec3_load(plan->origin));
    double depth = plan->plane_depth, radius = field->uniform_radius;
    raw_direction(f, &corner, &step_x, &step_y);
    put(wide, 0, corner, 0);
    put(wide, 1, step_x, 0);
    put(wide, 2, step_y, 0);
    put(wide, 3, vec3_along(eye, depth, corner), 0);
    put(wide, 4, vec3_scale(step_x, depth), 0);
    put(wide, 5, vec3_scale(step_y, depth), 0);
    /* Along forward the eye stands at the plane where rays begin, so that a far eye's depths stay small. */
    put(wide, 6, f->right, vec3_dot(eye, f->right));
    put(wide, 7, f->up, vec3_dot(eye, f->up));
    put(wide, 8, f->forward, vec3_dot(eye, f->forward) + depth);
    double cot = 1 / f->tan_half;
    put(wide, 9, (vec3){cot * f->height / f->width, cot, f->width}, f->height);
    put(wide, 10, (vec3){1 / plan->depth_range, depth, jitter[0]}, jitter[1]);
    put(wide, 11, (vec3){field->iso, radius, radius > 0 ? 1 / (radius * radius) : 0}, plan->reach);
    put(wide, 12, (vec3){plan->core_ratio, radius > 0 ? 1 / radius : 0, 2}, plan->facts.eye_reach);
    double step = 2 * f->tan_half / f->height;
    put(wide, 13,
        (vec3){step, depth * step, vec3_dot(eye, f->right) + depth * step * (jitter[0] - 0.5 * f->width)},
        vec3_dot(eye, f->up) + depth * step * (jitter[1] - 0.5 * f->height));
    put(wide, 14, vec3_load(plan->facts.eye_gradient), plan->facts.eye_bend);
    put(wide, 15, (vec3){host ? host->near : 0, host ? host->far : 1, host ? host->x : 0},
        host ? host->y : 0);
    for (int i = 0; i < VIEW_VECTORS * 4; i++) narrow[i] = (float)wide[i];
}

void list_view_loose(const gl_device *device, const float narrow[VIEW_VECTORS * 4])
{
    enum { UNIFORM_VIEW = 8 }; /* of the first; what a program does not read is passed over by GL */
    for (int i = 0; i < VIEW_VECTORS; i++) device->gl.Uniform4fv(UNIFORM_VIEW + i, 1, narrow + 4 * i);
}

void list_far_block(const mns_plan *plan, double block[FAR_VECTORS * 4])
{
    vec3 corner, step_x, step_y;
    raw_direction(&plan->frame, &corner, &step_x, &step_y);
    put(block, 0, corner, 0);
    put(block, 1, step_x, 0);
    put(block, 2, step_y, 0);
    put(block, 3, (vec3){plan->plane_depth, 0, 0}, 0);
}

void list_jitter(int index, int count, double jitter[2])
{
    if (count <= 1) {
        jitter[0] = jitter[1] = 0;
        return;
    }
    double whole;
    jitter[0] = modf(0.5 + index * 0.7548776662466927, &whole) - 0.5;
    jitter[1] = modf(0.5 + index * 0.5698402909980532, &whole) - 0.5;
}
