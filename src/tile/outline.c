#include "tile/outline.h"

/* Of a core's radius, the circle that is taken to hide: wider hides more pixels, but only what is deeper. */
#define CORE_PART 0.9

/* Nearer than so many radii a sphere's image is too wide for floats. */
#define NEAR_RADII 4

tile_lens tile_lens_of(const mns_plan *plan)
{
    const view_frame *f = &plan->frame;
    vec3 eye = vec3_sub(f->eye, vec3_load(plan->origin));
    return (tile_lens){.frame = *f,
                       .eye = eye,
                       .shift = {-vec3_dot(eye, f->right), -vec3_dot(eye, f->up), -vec3_dot(eye, f->forward)},
                       .pixels = f->height / (2 * f->tan_half),
                       .middle = {0.5 * f->width - 0.5, 0.5 * f->height - 0.5},
                       .plane_depth = plan->plane_depth,
                       .reach = plan->reach,
                       .margin = plan->options.samples > 1 ? 0.71 : 0}; /* half a pixel across and up */
}

/* From the eye, in the camera's axes. */
static vec3 place_of(const tile_lens *lens, const float at[3])
{
    vec3 d = vec3_sub((vec3){at[0], at[1], at[2]}, lens->eye);
    return (vec3){vec3_dot(d, lens->frame.right), vec3_dot(d, lens->frame.up),
                  vec3_dot(d, lens->frame.forward)};
}

double tile_slack(const tile_lens *lens, double size)
{
    double aside = fabs(lens->shift.x) + fabs(lens->shift.y);
    return 4e-6 * (size + 2 * lens->reach) + 1e-6 * aside;
}

static double slack_of(const tile_lens *lens, const float at[3])
{
    return tile_slack(lens, fabsf(at[0]) + fabsf(at[1]) + fabsf(at[2]));
}

/* Beside the image, for the rounding of pixels: relative to the frame, whose pixels are numbered in floats.
 */
static double edge_of(const tile_lens *lens)
{
    return lens->margin + 0.02 + 4e-6 * (lens->frame.width + lens->frame.height);
}

/* Whole pixels from low to high of [0, past), as far as there are any. */
static void clip(float low, float high, int past, uint16_t *first, uint16_t *last)
{
    float most = (float)(past - 1);
    float from = low > 0 ? low : 0, to = high < most ? high : most;
    if (!(from <= most && to >= 0)) from = 1, to = 0; /* beside the frame */
    int whole = (int)from;
    *first = (uint16_t)(whole + ((float)whole < from));
    *last = (uint16_t)(int)to;
}

/* Bounds of x / z over a circle of `radius` around (x, z), z > radius: the tangents from the eye. */
static void span(double x, double z, double radius, double pixels, double middle, double *low, double *high)
{
    double square = (z - radius) * (z + radius), root = radius * sqrt(fmax(x * x + square, 0));
    *low = (x * z - root) / square * pixels + middle;
    *high = (x * z + root) / square * pixels + middle;
}

tile_outline tile_outline_of(const tile_lens *lens, const float at[3], double radius)
{
    const int past[2] = {lens->frame.width, lens->frame.height};
    vec3 c = place_of(lens, at);
    const double off[2] = {c.x, c.y};
    double cover = radius * (1 + 1e-6) + slack_of(lens, at), edge = edge_of(lens), half[2];
    tile_outline o = {.high = {(uint16_t)(past[0] - 1), (uint16_t)(past[1] - 1)}, .reach = INFINITY};
    if (!(c.z > cover * 1.001)) return o;
    for (int axis = 0; axis < 2; axis++) {
        double low, high;
        span(off[axis], c.z, cover, lens->pixels, lens->middle[axis], &low, &high);
        half[axis] = 0.5 * (high - low);
        o.centre[axis] = (float)(0.5 * (low + high));
        clip((float)(low - edge), (float)(high + edge), past[axis], &o.low[axis], &o.high[axis]);
    }
    /* The image is an ellipse; the squares of a box's half sides sum to those of the half axes, and the
     * lesser axis is at least the sphere's width at its depth. Of so wide a circle floats tell nothing. */
    double least = radius * lens->pixels / c.z;
    double reach = 1.0001 * sqrt(fmax(half[0] * half[0] + half[1] * half[1] - least * least, 0)) + edge;
    if (reach < 8192) o.reach = (float)reach;
    return o;
}

/* The same without roots: sqrt(z^2 + q - R^2) <= z + min(q / 2z, sqrt(q)). Balls too near get no circle. */
void tile_outline_block(const tile_lens *lens, const tile_block *block, size_t count, tile_outline *outline)
{
    const vec3 *r = &lens->frame.right, *u = &lens->frame.up, *f = &lens->frame.forward;
    const float rx = (float)r->x, ry = (float)r->y, rz = (float)r->z, ux = (float)u->x, uy = (float)u->y,
                uz = (float)u->z, fx = (float)f->x, fy = (float)f->y, fz = (float)f->z;
    const float shift_x = (float)lens->shift.x, shift_y = (float)lens->shift.y,
                shift_z = (float)lens->shift.z;
    const float pixels = (float)lens->pixels, edge = (float)edge_of(lens), still = (float)tile_slack(lens, 0);
    const float middle_x = (float)lens->middle[0], middle_y = (float)lens->middle[1];
    float low_x[TILE_BLOCK], low_y[TILE_BLOCK], high_x[TILE_BLOCK], high_y[TILE_BLOCK];
    for (size_t i = 0; i < count; i++) {
        float px = block->at[0][i], py = block->at[1][i], pz = block->at[2][i];
        float x = px * rx + py * ry + pz * rz + shift_x, y = px * ux + py * uy + pz * uz + shift_y;
        float z = px * fx + py * fy + pz * fz + shift_z;
        float size_x = fabsf(x), size_y = fabsf(y);
        float cover = block->radius[i] * 1.000002f + still + 4e-6f * (fabsf(px) + fabsf(py) + fabsf(pz));
        float scale = pixels / ((z - cover) * (z + cover)), half = 0.5f / z;
        float bend_x = x * x * half, bend_y = y * y * half, bend = bend_x + bend_y, size = size_x + size_y;
        float wide_x = cover * scale * (z + (bend_x < size_x ? bend_x : size_x)) + edge;
        float wide_y = cover * scale * (z + (bend_y < size_y ? bend_y : size_y)) + edge;
        float wide = cover * scale * (z + (bend < size ? bend : size)) + edge;
        float centre_x = x * z * scale + middle_x, centre_y = y * z * scale + middle_y;
        outline[i].centre[0] = centre_x, outline[i].centre[1] = centre_y;
        outline[i].reach = z > NEAR_RADII * cover ? wide : INFINITY;
        low_x[i] = centre_x - wide_x, high_x[i] = centre_x + wide_x;
        low_y[i] = centre_y - wide_y, high_y[i] = centre_y + wide_y;
    }
    for (size_t i = 0; i < count; i++) {
        clip(low_x[i], high_x[i], lens->frame.width, &outline[i].low[0], &outline[i].high[0]);
        clip(low_y[i], high_y[i], lens->frame.height, &outline[i].low[1], &outline[i].high[1]);
    }
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
    core->reach = (float)((inner - slack) * scale - edge_of(lens));
    double far_part = lens->plane_depth > 0 ? away - lens->plane_depth : away;
    core->depth = (float)(far_part - sqrt(1 - CORE_PART * CORE_PART) * radius + slack);
    return core->reach > 0;
}
