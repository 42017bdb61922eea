/* The plan of a frame that the reference traces: GL only turns its planes into colours. */
#include "base/status.h"
#include "plan/plan.h"

static const char traced[] = "the reference is traced on the CPU";

mns_status plan_reference(mns_plan *plan, bool host, mns_error *error)
{
    static const char *const parts[] = {
        "sort",
        "upload",
        "core depth",
        "gather",
        "cast",
        "resolve",
        "a radius a ball",
        "a strength a ball",
        "points for small balls",
        "rectangles for large balls",
        "rays that start inside a ball",
        "the way out of the surface",
        "rays that begin at the box",
        "reading by texels",
    };
    if (host)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "the reference draws on no host's framebuffer; take the method list");
    plan->features |= FEATURE_REFERENCE;
    vec3_store(plan->origin, plan->frame.eye);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) plan_leave_out(plan, parts[i], traced);
    plan_leave_out(plan, "a host's depth", "no host framebuffer");
    plan_look_left_out(plan);
    plan_leave_out(plan, "FBVH", "the reference has a tree of its own");
    plan->pass[plan->pass_count++] = "trace";
    if (plan->features & FEATURE_LIT) plan->pass[plan->pass_count++] = "effects";
    plan->pass[plan->pass_count++] = "shade";
    return MNS_OK;
}
