#include "plan/plan.h"

#include "base/status.h"
#include "field/kernel.h"

#include <stdlib.h>
#include <string.h>

/* Of OpenGL 4.3: the least that every driver offers. */
static const mns_limits least_limits = {
    .max_storage_block = 1u << 24,
    .max_texture_size = 16384,
    .max_texture_buffer = 65536,
    .max_viewport = {16384, 16384},
    .max_point_size = 1,
};

/* A far eye: float rays would be off by more than detail before they reach the field (DESIGN, law 1). */
#define FAR_RADII 30.0

/* From so many balls on the core pass costs more than the longer lists that flat cores leave
 * (docs/decisions.md). */
#define FLAT_CORES_FROM 20000

void plan_leave_out(mns_plan *plan, const char *part, const char *reason)
{
    if (plan->left_out_count < PLAN_PARTS)
        plan->left_out[plan->left_out_count++] = (mns_left_out){part, reason};
}

/* What a caller leaves at zero is the least. */
static mns_limits resolve_limits(const mns_limits *limits)
{
    if (!limits) return least_limits;
    mns_limits l = *limits;
    if (!l.max_storage_block) l.max_storage_block = least_limits.max_storage_block;
    if (l.max_texture_size <= 0) l.max_texture_size = least_limits.max_texture_size;
    if (l.max_texture_buffer <= 0) l.max_texture_buffer = least_limits.max_texture_buffer;
    for (int i = 0; i < 2; i++)
        if (l.max_viewport[i] <= 0) l.max_viewport[i] = least_limits.max_viewport[i];
    if (!(l.max_point_size > 0)) l.max_point_size = least_limits.max_point_size;
    return l;
}

/* x y z [R] [q] */
static size_t ball_numbers(const mns_plan *plan)
{
    return 3 + (plan->features & FEATURE_RADII ? 1 : 0) + (plan->features & FEATURE_STRENGTHS ? 1 : 0);
}

size_t plan_tree_floats(const mns_plan *plan)
{
    size_t floats = ball_numbers(plan);
    return floats < 4 ? 4 : floats; /* a texel of four is read in less time than one of three */
}

void plan_balls(mns_plan *plan, const mns_field *field)
{
    if (field->p.radius)
        plan->features |= FEATURE_RADII;
    else
        plan_leave_out(plan, "a radius a ball", "all are equal");
    if (field->p.strength && (field->strength_min != 1 || field->strength_max != 1))
        plan->features |= FEATURE_STRENGTHS;
    else
        plan_leave_out(plan, "a strength a ball", "all are 1");
    plan->ball_floats = ball_numbers(plan);
}

void plan_eye(mns_plan *plan, const mns_field *field)
{
    const plan_facts *facts = &plan->facts;
    const view_frame *frame = &plan->frame;
    vec3 origin = frame->eye;
    if (facts->eye_in_ball)
        plan->features |= FEATURE_EYE_IN_BALL;
    else
        plan_leave_out(plan, "rays that start inside a ball", "the eye is outside every effective sphere");
    if (facts->eye_value > field->iso)
        plan->features |= FEATURE_EYE_INSIDE;
    else
        plan_leave_out(plan, "the way out of the surface",
                       facts->eye_value < field->iso ? "f(eye) < L" : "f(eye) = L");
    if (facts->eye_value == field->iso && facts->eye_bend > 0)
        plan->features |= FEATURE_EYE_ON;
    else
        plan_leave_out(plan, "a start on the surface", "f(eye) is not L");
    if (facts->eye_distance > FAR_RADII * field->radius_max) {
        plan->features |= FEATURE_FAR;
        origin = vec3_load(facts->nearest_point);
        plan->plane_depth = facts->plane_depth * (1 - 1e-9);
    } else {
        plan_leave_out(plan, "rays that begin at the box", "the eye is within 30 radii of the field's box");
    }
    if (plan->features & FEATURE_TREE) { /* stands still, so that the tree does */
        plan_tree_place(field, plan->origin);
        origin = vec3_load(plan->origin);
        plan->reach = vec3_length(vec3_sub(frame->eye, origin));
        if (plan->features & FEATURE_FAR) plan->reach = 0;
    }
    plan->radius_max = field->radius_max;
    vec3_store(plan->origin, origin);
    plan->depth_range = fmax(facts->farthest - plan->plane_depth, 1e-300) * 1.0001;
    /* A little beyond the frame's corners: samples are jittered by up to a pixel. */
    double up = plan->plane_depth * frame->tan_half * (1 + 2.0 / frame->height);
    double across = up * (frame->width + 2.0) / frame->height;
    for (int corner = 0; corner < 4 && plan->features & FEATURE_FAR; corner++) {
        vec3 at = vec3_along(frame->eye, plan->plane_depth, frame->forward);
        at = vec3_along(at, corner & 1 ? across : -across, frame->right);
        at = vec3_along(at, corner & 2 ? up : -up, frame->up);
        plan->reach = fmax(plan->reach, vec3_length(vec3_sub(at, origin)));
    }
}

static void plan_core(mns_plan *plan, const mns_field *field)
{
    const plan_facts *facts = &plan->facts;
    if (!field->p.count)
        plan_leave_out(plan, "core depth", "there are no balls");
    else if (facts->strongest <= field->iso)
        plan_leave_out(plan, "core depth", "no ball alone reaches L");
    else if (facts->negative)
        plan_leave_out(plan, "core depth", "a negative strength could carve a core");
    else if (facts->eye_value >= field->iso)
        plan_leave_out(plan, "core depth", "f(eye) >= L: the way out may lie behind a core");
    else
        plan->features |= FEATURE_CORE;
    if (!(plan->features & FEATURE_CORE)) return;
    if (plan->features & FEATURE_STRENGTHS)
        plan->features |= FEATURE_CORE_RADII;
    else
        plan->core_ratio = kernel_core_radius(field->kernel, field->iso);
}

/* At least the diameter in pixels of any ball's image, between the tangents from the eye: that of the largest
 * ball, as near as any, at the frame's edge. */
static double widest_image(const mns_plan *plan, const mns_field *field)
{
    const view_frame *f = &plan->frame;
    double nearest = plan->facts.plane_depth, radius = field->radius_max;
    if (!(nearest > 0.011 * radius)) return INFINITY;
    double edge = f->tan_half * ((f->width > f->height ? f->width : f->height) + 2.0) /
                  f->height; /* samples are jittered */
    double aside = (nearest + radius) * edge + radius * sqrt(1 + edge * edge);
    double square = nearest * (nearest + 2 * radius);
    return 1.005 * radius * sqrt(aside * aside + square) / square * f->height / f->tan_half;
}

/* Balls come to their pixels through the tiles' lists, not through the rasteriser. */
static void plan_tiles(mns_plan *plan)
{
    static const char binned[] = "tiles are binned on the CPU";
    if (plan->ball_floats == 3)
        plan->ball_floats = 4; /* a texel of four is read in less time than one of three */
    plan->features |= FEATURE_TILES;
    const mns_limits *limits = &plan->limits;
    if (limits->max_point_size >= SQUARE_MOST &&
        limits->max_viewport[0] >= plan_square_round(plan->frame.width) &&
        limits->max_viewport[1] >= plan_square_round(plan->frame.height))
        plan->features |= FEATURE_SQUARES;
    else
        plan_leave_out(plan, "pixels to be cast as squares",
                       "this driver's points or viewports are too small");
    plan_leave_out(plan, "billboards", binned);
    plan_leave_out(plan, "gather", binned);
    plan_leave_out(plan, "core depth as a pass", "cores close the tiles' masks");
}

/* Points for balls that fit one: a vertex each instead of four. */
static void plan_billboards(mns_plan *plan, const mns_field *field)
{
    bool points = plan->limits.max_point_size >= 4;
    if (points) plan->features |= FEATURE_POINTS;
    if (!points || widest_image(plan, field) >= plan->limits.max_point_size - 1)
        plan->features |= FEATURE_QUADS;
    if (!points) plan_leave_out(plan, "points for small balls", "this driver's points are too small");
    if (!(plan->features & FEATURE_QUADS))
        plan_leave_out(plan, "rectangles for large balls", "every ball fits a point");
}

void plan_look_left_out(mns_plan *plan)
{
    if (plan->options.samples > 1)
        plan->features |= FEATURE_SAMPLES;
    else
        plan_leave_out(plan, "samples beside the centre", "one sample a pixel");
    if (!(plan->features & FEATURE_COLORS)) plan_leave_out(plan, "colours of balls", "one colour for all");
    if (!(plan->features & FEATURE_CEL)) plan_leave_out(plan, "cel bands", "smooth shading");
    if (!(plan->features & FEATURE_DIRECTIONAL))
        plan_leave_out(plan, "a light of its own",
                       plan->features & FEATURE_POINT_LIGHTS ? "every light is at the eye or at a point"
                                                             : "the light is at the eye");
    if (!(plan->features & FEATURE_SPECULAR)) plan_leave_out(plan, "specular", "its strength is 0");
    plan_effects_left_out(plan);
}

static void plan_rest(mns_plan *plan, size_t balls, bool host)
{
    const mns_options *options = &plan->options;
    if (host) {
        plan->features |= FEATURE_HOST;
        plan->look.background[3] = 0; /* what stands behind is the host's */
    } else
        plan_leave_out(plan, "a host's depth", "no host framebuffer");
    if (options->gather == MNS_GATHER_PAPER) plan->features |= FEATURE_PAPER;
    bool many = balls >= FLAT_CORES_FROM && options->gather != MNS_GATHER_PAPER;
    if (plan->features & FEATURE_CORE && many && !(plan->features & FEATURE_TILES))
        plan->features |= FEATURE_FLAT_CORES;
    if (options->shuffle) plan->features |= FEATURE_SHUFFLE;
    if (options->solver != MNS_SOLVER_EXACT)
        plan_leave_out(plan, "certification", "the solver is a model of the field");
    if (plan->limits.has_clip_control && !(plan->features & FEATURE_TILES))
        plan->features |= FEATURE_CLIP_ZERO;
    plan_look_left_out(plan);
    plan_leave_out(plan, "balls outside the view", "they cannot be seen");
}

static void plan_passes(mns_plan *plan)
{
    uint64_t f = plan->features;
    bool tiles = f & FEATURE_TILES;
    struct {
        const char *name;
        bool wanted;
    } all[] = {
        {"sort", true},
        {"bin", tiles},
        {"build", f & FEATURE_RAYS},
        {"upload", true},
        {"host_depth", f & FEATURE_HOST && !tiles},
        {"core_depth", f & FEATURE_CORE && !tiles},
        {"gather", !tiles},
        {"shuffle", f & FEATURE_SHUFFLE},
        {"cast", true},
        {"resolve", true},
        {"solids", f & FEATURE_SOLIDS},
        {"effects", f & FEATURE_LIT},
        {"shade", true},
        {"host_draw", f & FEATURE_HOST},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].wanted) plan->pass[plan->pass_count++] = all[i].name;
}

/* Tiles of a frame, were they as small as any. */
static size_t most_tiles(const view_frame *frame)
{
    const int last = (1 << TILE_SHIFT_LEAST) - 1;
    return (size_t)((frame->width + last) >> TILE_SHIFT_LEAST) *
           (size_t)((frame->height + last) >> TILE_SHIFT_LEAST);
}

static void plan_pool(mns_plan *plan, const mns_field *field)
{
    size_t pixels = (size_t)plan->frame.width * (size_t)plan->frame.height;
    bool tiles = plan->features & FEATURE_TILES; /* whose lists hold the balls */
    size_t record = plan->ball_floats * sizeof(float);
    plan->pool_most = plan->limits.max_storage_block / (tiles ? record : LIST_NODE);
    if (plan->options.max_pool_nodes && plan->options.max_pool_nodes < plan->pool_most)
        plan->pool_most = plan->options.max_pool_nodes;
    plan->pool_nodes = pixels * 4 < 65536 ? 65536 : pixels * 4;
    if (!field->p.count) plan->pool_nodes = 1;
    if (plan->pool_nodes > plan->pool_most) plan->pool_nodes = plan->pool_most;
    size_t texels = (size_t)plan->limits.max_texture_buffer;
    size_t most = tiles ? plan->pool_most * plan->ball_floats : field->p.count * plan->ball_floats * 2;
    size_t heads = tiles ? most_tiles(&plan->frame) : 0;
    if (plan->pool_most <= texels && most <= texels && heads <= texels)
        plan->features |= FEATURE_TEXELS;
    else
        plan_leave_out(plan, "reading by texels", "this driver's buffer textures are too small");
}

static mns_status plan_list(mns_plan *plan, const mns_field *field, bool host, mns_error *error)
{
    plan_balls(plan, field);
    plan_eye(plan, field);
    plan_core(plan, field);
    if (plan->options.method == MNS_METHOD_TILE)
        plan_tiles(plan);
    else
        plan_billboards(plan, field);
    mns_status status = plan_check_limits(plan, field, error);
    if (status) return status;
    plan_rest(plan, field->p.count, host);
    plan_pool(plan, field);
    status = plan_rays(plan, field, error);
    if (!status) plan_passes(plan);
    return status;
}

mns_status plan_make(const mns_field *field, const mns_view *view, const mns_look *look,
                     const mns_options *options, const mns_limits *limits, bool host, mns_plan **result,
                     mns_error *error)
{
    if (!field || !result) return status_fail(error, MNS_ERROR_USAGE, "plan: the field is NULL");
    mns_plan *plan = calloc(1, sizeof *plan);
    if (!plan) return status_no_memory(error, "while planning a frame");
    plan->limits = resolve_limits(limits);
    mns_status status = plan_options(options, plan, error);
    if (!status) status = mns_view_resolve(view, field, &plan->view, error);
    if (status) goto fail;
    view_basis(&plan->view, &plan->frame);
    plan_enter_unit(plan, field);
    plan->features = (uint64_t)field->kernel | (uint64_t)plan->options.solver << 3;
    plan_facts_of(field, &plan->frame, &plan->facts);
    plan_lengths(plan, field, options, host);
    domain_check(field, plan->facts.eye_distance, plan->facts.farthest, &plan->domain);
    status = plan_look(look, field, plan, error);
    if (!status) status = plan_check_frame(plan, field, error);
    if (!status)
        status = plan->options.method == MNS_METHOD_REFERENCE ? plan_reference(plan, host, error)
                 : plan->options.method >= MNS_METHOD_FBVH    ? plan_trees(plan, field, host, error)
                                                              : plan_list(plan, field, host, error);
    plan->options.tree = NULL; /* was borrowed for the call */
    if (status) goto fail;
    if (!plan_explain(plan, field)) {
        status = status_no_memory(error, "while planning a frame");
        goto fail;
    }
    *result = plan;
    return MNS_OK;
fail:
    mns_plan_destroy(plan);
    return status;
}

mns_status mns_plan_create(const mns_field *field, const mns_view *view, const mns_look *look,
                           const mns_options *options, const mns_limits *limits, mns_plan **plan,
                           mns_error *error)
{
    return plan_make(field, view, look, options, limits, false, plan, error);
}

void mns_plan_destroy(mns_plan *plan)
{
    if (!plan) return;
    free(plan->text);
    free(plan->light);
    free(plan->environment);
    for (size_t i = 0; plan->mesh && i < plan->look.mesh_count; i++) free((char *)plan->mesh[i].file);
    free(plan->mesh);
    free(plan);
}

mns_method mns_plan_method(const mns_plan *plan, const char **reason)
{
    if (reason) *reason = plan->method_reason;
    return plan->options.method;
}

uint64_t mns_plan_features(const mns_plan *plan)
{
    return plan->features;
}

const char *const *mns_plan_passes(const mns_plan *plan, size_t *count)
{
    *count = plan->pass_count;
    return plan->pass;
}

const mns_left_out *mns_plan_left_out(const mns_plan *plan, size_t *count)
{
    *count = plan->left_out_count;
    return plan->left_out;
}

const char *const *mns_plan_warnings(const mns_plan *plan, size_t *count)
{
    *count = plan->domain.count;
    return plan->domain.line;
}

const char *mns_plan_text(const mns_plan *plan)
{
    return plan->text;
}
