/* Options: checked, and zeros made what they mean. */
#include "base/status.h"
#include "plan/plan.h"

static mns_status check_options(const mns_options *options, mns_error *error)
{
    bool tree = options->method == MNS_METHOD_FBVH || options->method == MNS_METHOD_BVH;
    if ((unsigned)options->method > MNS_METHOD_BVH)
        return status_fail(error, MNS_ERROR_USAGE,
                           "options: method %d is not in this build; take list, tile, fbvh, bvh or reference",
                           options->method);
    if (options->method == MNS_METHOD_REFERENCE && options->solver != MNS_SOLVER_EXACT)
        return status_fail(error, MNS_ERROR_USAGE, "options: solver %s; reference has one solver: exact",
                           (unsigned)options->solver > MNS_SOLVER_SECANT ? "?"
                                                                         : mns_solver_name(options->solver));
    if ((unsigned)options->solver > MNS_SOLVER_SECANT)
        return status_fail(error, MNS_ERROR_USAGE, "options: no solver %d", options->solver);
    if (options->solver != MNS_SOLVER_EXACT && tree != (options->solver == MNS_SOLVER_SECANT))
        return status_fail(error, MNS_ERROR_USAGE, "options: solver %s is not of this method; take exact%s",
                           mns_solver_name(options->solver),
                           tree ? " or secant" : ", cubic or cubic-monomial");
    if (options->secant_steps < 0 || options->secant_steps > 4096)
        return status_fail(error, MNS_ERROR_USAGE, "options: %d secant steps; take 1 to 4096",
                           options->secant_steps);
    if (options->counters && !tree)
        return status_fail(error, MNS_ERROR_USAGE, "options: only fbvh and bvh count a ray's work");
    if (options->tree && *options->tree && options->method == MNS_METHOD_REFERENCE)
        return status_fail(error, MNS_ERROR_USAGE, "options: reference has a tree of its own; leave tree");
    if (tree && (options->gather != MNS_GATHER_EARLY_Z || options->shuffle))
        return status_fail(error, MNS_ERROR_USAGE,
                           "options: a tree is not gathered: leave gather and shuffle, or take list");
    if ((unsigned)options->gather > MNS_GATHER_PAPER)
        return status_fail(error, MNS_ERROR_USAGE, "options: no gather %d", options->gather);
    if (options->method == MNS_METHOD_TILE && (options->gather != MNS_GATHER_EARLY_Z || options->shuffle))
        return status_fail(error, MNS_ERROR_USAGE,
                           "options: tiles are not gathered: leave gather and shuffle, or take list");
    if (options->samples < 0 || options->samples > 64)
        return status_fail(error, MNS_ERROR_USAGE, "options: %d samples a pixel; take 1 to 64",
                           options->samples);
    int samples = options->samples ? options->samples : 1;
    if (options->sample_first < 0 || options->sample_count < 0 || options->sample_first >= samples ||
        options->sample_count > samples - options->sample_first)
        return status_fail(error, MNS_ERROR_USAGE,
                           "options: %d samples from %d on; of %d there are no such ones",
                           options->sample_count, options->sample_first, samples);
    if (options->slots < 0 || options->slots > 1024)
        return status_fail(error, MNS_ERROR_USAGE, "options: %d slots; take 1 to 1024", options->slots);
    if (options->root_steps < 0 || options->root_steps > 4096)
        return status_fail(error, MNS_ERROR_USAGE, "options: %d root steps; take 1 to 4096",
                           options->root_steps);
    return MNS_OK;
}

/* Balls of a ray that the fast path holds at once: those around one place, or, by a tree, in one leaf. Where
 * leaves overlap, one holds all that reach any of its own balls. */
static int default_slots(const mns_options *options, const mns_limits *limits)
{
    if (options->method == MNS_METHOD_BVH) return 256;
    return limits->is_software || options->method == MNS_METHOD_FBVH ? 64 : 24;
}

mns_status plan_options(const mns_options *options, mns_plan *plan, mns_error *error)
{
    mns_options *o = &plan->options;
    *o = options ? *options : (mns_options){0};
    plan_choice chosen = plan_choose(o, &plan->limits);
    o->method = chosen.method;
    plan->method_reason = chosen.reason;
    mns_status status = check_options(o, error);
    if (status) return status;
    if (!o->samples) o->samples = 1;
    if (!o->sample_count) o->sample_count = o->samples - o->sample_first;
    if (!o->slots) o->slots = default_slots(o, &plan->limits);
    if (!o->root_steps) o->root_steps = 48;
    if (!o->secant_steps) o->secant_steps = 16;
    return MNS_OK;
}
