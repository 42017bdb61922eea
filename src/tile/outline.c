#include "tile/outline.h"

/* Of a core's radius, the circle that is taken to hide: wider hides more pixels, but only what is deeper. */
#define CORE_PART 0.9

tile_lens tile_lens_of(const mns_plan *plan)
{
    const view_frame *f = &plan->frame;
    return (tile_lens){.frame = *f,
                       .eye = vec3_sub(f->eye, vec3_load(plan->origin)),
                       .pixels = f->height / (2 * f->tan_half),
                       .middle = {0.5 * f->width - 0.5, 0.5 * f->height - 0.5},
                       .plane_depth = plan->plane_depth,
                       .reach = plan->reach,
                       .margin = plan->options.samples > 1 ? 1 : 0};
}

/* From the eye, in the camera's axes. */
static vec3 place_of(const tile_lens *lens, const float at[3])
{
    vec3 d = vec3_sub((vec3){at[0], at[1], at[2]}, lens->eye);
    return (vec3){vec3_dot(d, lens->frame.right), vec3_dot(d, lens->frame.up),
                  vec3_dot(d, lens->frame.forward)};
}

/* What float's rounding of positions, rays and chords may amount to, as in glsl/billboard.vert.glsl. */
static double slack_of(const tile_lens *lens, const float at[3])
{
    return 4e-6 * (fabsf(at[0]) + fabsf(at[1]) + fabsf(at[2]) + 2 * lens->reach);
}

/* Bounds of x / z over a circle of `radius` around (x, z), z > radius: the tangents from the eye. */
static void span(double x, double z, double radius, double pixels, double middle, float *low, float *high)
{
    double square = (z - radius) * (z + radius), root = radius * sqrt(fmax(x * x + square, 0));
    *low = (float)((x * z - root) / square * pixels + middle);
    *high = (float)((x * z + root) / square * pixels + middle);
}

tile_outline tile_outline_of(const tile_lens *lens, const float at[3], double radius)
{
    vec3 c = place_of(lens, at);
    double slack = slack_of(lens, at), cover = radius * (1 + 1e-6) + slack, away = vec3_length(c);
    tile_outline o = {.low = {-1e9f, -1e9f}, .high = {1e9f, 1e9f}, .reach = INFINITY};
    o.near = (float)((lens->plane_depth > 0 ? away - lens->plane_depth : away) - radius - slack);
    if (!(c.z > cover * 1.001)) return o;
    double edge = lens->margin + 0.02;
    span(c.x, c.z, cover, lens->pixels, lens->middle[0], &o.low[0], &o.high[0]);
    span(c.y, c.z, cover, lens->pixels, lens->middle[1], &o.low[1], &o.high[1]);
    /* The image is an ellipse; the squares of a box's half sides sum to those of the half axes, and the
     * lesser axis is at least the sphere's width at its depth. */
    double half_x = 0.5 * (o.high[0] - o.low[0]), half_y = 0.5 * (o.high[1] - o.low[1]);
    double least = radius * lens->pixels / c.z;
    o.reach = (float)(1.0001 * sqrt(fmax(half_x * half_x + half_y * half_y - least * least, 0)) + edge);
    for (int axis = 0; axis < 2; axis++) {
        o.centre[axis] = 0.5f * (o.low[axis] + o.high[axis]);
        o.low[axis] -= (float)edge;
        o.high[axis] += (float)edge;
    }
    return o;
}

bool tile_core_of(const tile_lens *lens, const float at[3], double radius, tile_core *core)
{
    vec3 c = place_of(lens, at);
    double slack = slack_of(lens, at), inner = CORE_PART * radius;
    if (!(c.z > 1.001 * radius && inner > slack)) return false;
    /* No ray through the disc that faces the camera passes the centre farther away than `inner`. */
    double away = vec3_length(c), scale = lens->pixels / c.z;
    core->centre[0] = (float)(c.x * scale + lens->middle[0]);
    core->centre[1] = (float)(c.y * scale + lens->middle[1]);
    core->reach = (float)((inner - slack) * scale - lens->margin - 0.02);
    double far_part = lens->plane_depth > 0 ? away - lens->plane_depth : away;
    core->depth = (float)(far_part - sqrt(1 - CORE_PART * CORE_PART) * radius + slack);
    return core->reach > 0.5f;
}
