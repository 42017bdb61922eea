/* The plan of a frame that is traced through a tree over the balls. */
#include "base/status.h"
#include "plan/plan.h"

#include <string.h>

static const char traced[] = "rays are traced through a tree";

/* Every array of the tree must fit a block, and a buffer texture where it is read as one: else it is made
 * smaller. */
mns_status plan_tree_options(const mns_options *options, const mns_limits *limits, fbvh_options *tree,
                             mns_error *error)
{
    memset(tree, 0, sizeof *tree); /* two are compared as bytes */
    mns_status status = fbvh_options_parse(options->tree, tree, error);
    if (status) return status;
    if (tree->references_a_ball == 0) tree->references_a_ball = FBVH_REFERENCES; /* as the builder's own */
    tree->kind = options->method == MNS_METHOD_BVH ? FBVH_OVERLAPPING : FBVH_FITTED;
    size_t block = limits->max_storage_block - 64; /* the references have one more */
    if (!tree->max_block_bytes || tree->max_block_bytes > block) tree->max_block_bytes = block;
    return MNS_OK;
}

static mns_status plan_tree(mns_plan *plan, const mns_field *field, mns_error *error)
{
    mns_status status = plan_tree_options(&plan->options, &plan->limits, &plan->tree, error);
    if (status) return status;
    if (plan_tree_texels(plan, field))
        plan->features |= FEATURE_TEXELS;
    else
        plan_leave_out(plan, "reading by texels", "this driver's buffer textures are too small");
    return MNS_OK;
}

static void plan_rest(mns_plan *plan, bool host)
{
    static const char *const parts[] = {
        "sort", "core depth", "points for small balls", "rectangles for large balls", "gather", "cast"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) plan_leave_out(plan, parts[i], traced);
    if (host) {
        plan->features |= FEATURE_HOST;
        plan->look.background[3] = 0; /* what stands behind is the host's */
    } else {
        plan_leave_out(plan, "a host's depth", "no host framebuffer");
    }
    if (plan->options.counters)
        plan->features |= FEATURE_COUNTERS;
    else
        plan_leave_out(plan, "counts of a ray's work", "nobody asks for them");
    if (plan->options.solver != MNS_SOLVER_EXACT)
        plan_leave_out(plan, "certification", "the solver is not certified");
    plan_look_left_out(plan);
}

static void plan_passes(mns_plan *plan)
{
    bool host = plan->features & FEATURE_HOST, lit = plan->features & FEATURE_LIT;
    bool solids = plan->features & FEATURE_SOLIDS;
    const struct {
        const char *name;
        bool wanted;
    } all[] = {{"build", true},  {"upload", true},  {"host_depth", host},
               {"trace", true},  {"resolve", true}, {"solids", solids},
               {"effects", lit}, {"shade", true},   {"host_draw", host}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].wanted) plan->pass[plan->pass_count++] = all[i].name;
}

mns_status plan_trees(mns_plan *plan, const mns_field *field, bool host, mns_error *error)
{
    plan->features |= FEATURE_TREE;
    if (plan->options.method == MNS_METHOD_BVH) plan->features |= FEATURE_OVERLAPS;
    plan_balls(plan, field);
    plan->ball_floats = plan_tree_floats(plan);
    plan_eye(plan, field);
    mns_status status = plan_tree(plan, field, error);
    if (!status) status = plan_check_limits(plan, field, error);
    if (status) return status;
    plan_rest(plan, host);
    status = plan_rays(plan, field, error);
    if (!status) plan_passes(plan);
    return status;
}
