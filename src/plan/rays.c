/* The plan of what is traced beyond the first hit on the GPU, whatever found that: the tree that carries it.
 */
#include "plan/plan.h"

#include "base/status.h"
#include "base/vec.h"

void plan_tree_place(const mns_field *field, double origin[3])
{
    for (int axis = 0; axis < 3; axis++)
        origin[axis] = field->p.count ? field->lo[axis] + 0.5 * (field->hi[axis] - field->lo[axis]) : 0;
}

bool plan_tree_texels(const mns_plan *plan, const mns_field *field)
{
    const fbvh_options *tree = &plan->tree;
    double texels = plan->limits.max_texture_buffer,
           references = tree->references_a_ball * (double)field->p.count;
    const size_t whole_words = tree->max_block_bytes / sizeof(uint32_t);
    double words = (double)whole_words;
    return (references < words ? references : words) + 1 < texels && 5.0 * (double)field->p.count < texels;
}

/* Whether any ray is traced: a mirrored one is, where there are levels for it. */
static bool is_traced(const mns_plan *plan)
{
    return plan->features & (FEATURE_SHADOWS | FEATURE_OCCLUSION | FEATURE_REFRACTION) ||
           plan->look.effects.reflections > 0;
}

mns_status plan_rays(mns_plan *plan, const mns_field *field, mns_error *error)
{
    bool tree = plan->features & FEATURE_TREE;
    plan_tree_place(field, plan->tree_origin);
    if (plan->features & FEATURE_LIT && is_traced(plan)) plan->features |= FEATURE_RAYS;
    if (!(plan->features & FEATURE_RAYS)) {
        plan_leave_out(plan, tree ? "rays beyond the first" : "FBVH", "no secondary rays are asked for");
        if (tree || !plan->options.tree || !*plan->options.tree) return MNS_OK;
        return status_fail(
            error, MNS_ERROR_USAGE,
            "options: %s builds no tree without rays beyond the first (shadows, mirrors and so "
            "on); leave tree, or take fbvh or bvh",
            mns_method_name(plan->options.method));
    }
    if (tree) return MNS_OK;
    mns_status status = plan_tree_options(&plan->options, &plan->limits, &plan->tree, error);
    if (!status && plan->features & FEATURE_TEXELS && !plan_tree_texels(plan, field)) {
        plan->features &= ~FEATURE_TEXELS;
        plan_leave_out(plan, "reading by texels", "this driver's buffer textures are too small for the tree");
    }
    return status;
}
