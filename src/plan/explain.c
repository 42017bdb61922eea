#include "plan/plan.h"

#include <stdio.h>
#include <stdlib.h>

static const char *const feature_names[FEATURE_COUNT] = {
    [5] = "radii",       [6] = "strengths",     [7] = "core",        [8] = "core_radii",
    [9] = "paper",       [10] = "points",       [11] = "quads",      [12] = "eye_in_ball",
    [13] = "eye_inside", [14] = "far",          [15] = "host",       [16] = "shuffle",
    [17] = "colors",     [18] = "labels",       [19] = "cel",        [20] = "directional",
    [21] = "specular",   [22] = "samples",      [23] = "clip_zero",  [24] = "texels",
    [25] = "flat_cores", [26] = "reference",    [27] = "tiles",      [28] = "tree",
    [29] = "overlaps",   [30] = "counters",     [31] = "eye_on",     [32] = "lit",
    [33] = "lights",     [34] = "point_lights", [35] = "shadows",    [36] = "soft_shadows",
    [37] = "mirror",     [38] = "fresnel",      [39] = "refraction", [40] = "absorption",
    [41] = "occlusion",  [42] = "environment",  [43] = "sky",        [44] = "rays",
    [45] = "squares",    [46] = "solids",       [47] = "materials",
};

/* The numbers of the effects that are there. */
static void print_effects(FILE *out, const mns_plan *plan)
{
    const mns_effects *e = &plan->look.effects;
    uint64_t f = plan->features;
    if (!(f & FEATURE_LIT)) return;
    fprintf(out, "\neffects: %zu light%s", plan->look.light_count, plan->look.light_count == 1 ? "" : "s");
    if (f & FEATURE_SHADOWS) fprintf(out, ", shadows");
    if (f & FEATURE_SOFT_SHADOWS) fprintf(out, " by %d rays a sphere", e->shadow_samples);
    if (f & FEATURE_MIRROR) fprintf(out, ", mirror %g over %d levels", e->mirror, e->reflections);
    if (f & FEATURE_FRESNEL) fprintf(out, ", index %g", e->index);
    if (f & FEATURE_REFRACTION)
        fprintf(out, ", transmission %g through %d surfaces", e->transmission, e->refractions);
    if (f & FEATURE_ABSORPTION)
        fprintf(out, ", absorption %g,%g,%g", e->absorption[0] / plan->unit, e->absorption[1] / plan->unit,
                e->absorption[2] / plan->unit);
    if (f & FEATURE_OCCLUSION)
        fprintf(out, ", occlusion by %d rays of length %g", e->occlusion_rays,
                e->occlusion_reach * plan->unit);
    if (f & FEATURE_SKY) fprintf(out, ", environment sky");
    if (f & FEATURE_ENVIRONMENT) fprintf(out, ", environment %s", plan->environment);
    for (size_t i = 0; i < plan->look.mesh_count; i++) fprintf(out, ", mesh %s", plan->mesh[i].file);
    fprintf(out, ", seed %lu", (unsigned long)e->seed);
}

static void print_blend(FILE *out, const mns_plan *plan)
{
    const mns_blend *b = &plan->look.blend;
    uint64_t f = plan->features;
    if (!(f & FEATURE_MATERIALS)) return;
    fprintf(out, "\nsecond material: by %s from %g to %g", plan->blend_by, b->range[0], b->range[1]);
    if (b->set & MNS_LOOK_COLOR) fprintf(out, ", color %g,%g,%g", b->color[0], b->color[1], b->color[2]);
    if (f & FEATURE_MIRROR) fprintf(out, ", mirror %g", b->mirror);
    if (f & FEATURE_REFRACTION) fprintf(out, ", transmission %g", b->transmission);
    if (f & FEATURE_ABSORPTION)
        fprintf(out, ", absorption %g,%g,%g", b->absorption[0] / plan->unit, b->absorption[1] / plan->unit,
                b->absorption[2] / plan->unit);
}

static void print_plan(FILE *out, const mns_plan *plan, const mns_field *field)
{
    const mns_view *v = &plan->view;
    bool traced = plan->features & FEATURE_REFERENCE;
    fprintf(out, "method %s (%s), solver %s, kernel %s, L %g\n",
            traced                              ? "reference"
            : plan->features & FEATURE_OVERLAPS ? "bvh"
            : plan->features & FEATURE_TREE     ? "fbvh"
            : plan->features & FEATURE_TILES    ? "tile"
                                                : "list",
            plan->method_reason, mns_solver_name(plan->options.solver), mns_kernel_name(field->kernel),
            field->iso);
    fprintf(out, "frame %dx%d, eye %g,%g,%g, look-at %g,%g,%g, fov %g\n", v->width, v->height, v->eye[0],
            v->eye[1], v->eye[2], v->look_at[0], v->look_at[1], v->look_at[2], v->fov);
    if (plan->features & FEATURE_TREE)
        fprintf(out, "balls %zu, %zu floats each; f(eye) %g; at most %g references a ball\n", field->p.count,
                plan->ball_floats, plan->facts.eye_value, plan->tree.references_a_ball);
    else if (traced)
        fprintf(out, "balls %zu; f(eye) %g\n", field->p.count, plan->facts.eye_value);
    else
        fprintf(out, "balls %zu, %zu floats each; f(eye) %g; node pool %zu, at most %zu\n", field->p.count,
                plan->ball_floats, plan->facts.eye_value, plan->pool_nodes, plan->pool_most);
    const double *o = plan->origin, unit = plan->unit;
    fprintf(out, "coordinates from %.17g,%.17g,%.17g", o[0] * unit, o[1] * unit, o[2] * unit);
    if (unit != 1) fprintf(out, ", in units of %.17g", unit);
    fprintf(out, "\n");
    fprintf(out, "features 0x%llx:", (unsigned long long)plan->features);
    for (int bit = 0; bit < FEATURE_COUNT; bit++)
        if (plan->features >> bit & 1 && feature_names[bit]) fprintf(out, " %s", feature_names[bit]);
    fprintf(out, "\npasses:");
    for (size_t i = 0; i < plan->pass_count; i++) fprintf(out, " %s", plan->pass[i]);
    print_effects(out, plan);
    print_blend(out, plan);
    if (plan->domain.count) fprintf(out, "\nwarnings, outside the stated domain:");
    for (size_t i = 0; i < plan->domain.count; i++) fprintf(out, "\n  %s", plan->domain.line[i]);
    fprintf(out, "\nleft out:\n");
    for (size_t i = 0; i < plan->left_out_count; i++)
        fprintf(out, "  %s: %s\n", plan->left_out[i].part, plan->left_out[i].reason);
}

bool plan_explain(mns_plan *plan, const mns_field *field)
{
    size_t size = 0;
    FILE *out = open_memstream(&plan->text, &size);
    if (!out) return false;
    print_plan(out, plan, field);
    return fclose(out) == 0;
}
