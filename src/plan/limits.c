/* What of a frame floats and the driver can hold. */
#include "base/status.h"
#include "plan/plan.h"

#include <float.h>

/* What shaders can square in floats, and the square again. */
#define FLOATS_LEAST 1e-15
#define FLOATS_MOST  1e15

void plan_enter_unit(mns_plan *plan, const mns_field *field)
{
    const double *eye = plan->view.eye, unit = field_unit(field);
    plan->unit = unit;
    /* Divided, not scaled: one over the least unit is no double. */
    plan->frame.eye = vec3_make(eye[0] / unit, eye[1] / unit, eye[2] / unit);
}

static bool floats_serve(const mns_plan *plan, const mns_field *field)
{
    return !field->p.count || (field->radius_min >= FLOATS_LEAST && plan->facts.farthest <= FLOATS_MOST);
}

void plan_lengths(mns_plan *plan, const mns_field *field, const mns_options *options, bool host)
{
    bool asked = options && plan_required(options).method != MNS_METHOD_AUTO;
    plan->t_unit = domain_lengths_hold(field, plan->facts.farthest) ? 1 : plan->unit;
    if (asked || host || plan->options.solver != MNS_SOLVER_EXACT || floats_serve(plan, field)) return;
    plan->options.method = MNS_METHOD_REFERENCE; /* has doubles */
    plan->method_reason = "auto: floats do not hold these lengths";
}

/* The planes' distances are floats. */
static mns_status check_planes(const mns_plan *plan, const mns_field *field, mns_error *error)
{
    double farthest = plan->facts.farthest * (plan->unit / plan->t_unit);
    if (!field->p.count || farthest <= FLT_MAX) return MNS_OK;
    const double *eye = plan->view.eye;
    return status_fail(
        error, MNS_ERROR_UNSUPPORTED,
        "an eye at %g,%g,%g before radii from %g: distances from it are no floats; expected it "
        "within %g of the field",
        eye[0], eye[1], eye[2], field->radius_min * plan->unit, FLT_MAX * plan->t_unit);
}

mns_status plan_check_frame(const mns_plan *plan, const mns_field *field, mns_error *error)
{
    const mns_limits *limits = &plan->limits;
    int width = plan->frame.width, height = plan->frame.height;
    int most_x = limits->max_texture_size < limits->max_viewport[0] ? limits->max_texture_size
                                                                    : limits->max_viewport[0];
    int most_y = limits->max_texture_size < limits->max_viewport[1] ? limits->max_texture_size
                                                                    : limits->max_viewport[1];
    if (width > most_x || height > most_y)
        return status_fail(error, MNS_ERROR_UNSUPPORTED, "size %dx%d: this driver draws at most %dx%d", width,
                           height, most_x, most_y);
    return check_planes(plan, field, error);
}

mns_status plan_check_limits(const mns_plan *plan, const mns_field *field, mns_error *error)
{
    const mns_limits *limits = &plan->limits;
    if (!floats_serve(plan, field))
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "radii from %g and distances to %g: floats hold %g to %g here; take the method "
                           "reference, or an eye nearer to the field",
                           field->radius_min * plan->unit, plan->facts.farthest * plan->unit,
                           FLOATS_LEAST * plan->unit, FLOATS_MOST * plan->unit);
    size_t most = limits->max_storage_block / (plan->ball_floats * sizeof(float));
    if (plan->features & FEATURE_QUADS) most /= 2;         /* rectangles are kept twice */
    if (plan->features & FEATURE_TILES) most = 0x7fffffff; /* what no tile lists is not kept */
    if (field->p.count > most || field->p.count > 0x7fffffff)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "%zu balls: this driver's storage blocks hold %zu of this field", field->p.count,
                           most);
    return MNS_OK;
}
