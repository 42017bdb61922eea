#include "reference/reference.h"

#include "base/memory.h"
#include "base/status.h"
#include "reference/bound.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Of a ball's w. Where rounding hides more, halving pieces of the ray tells nothing of the ball, and the ray
 * is undecided from there on. */
#define BLUR_MOST 0.25

/* Squares and their errors stay within double's range up to here. */
#define FARTHEST 1e60

/* What lengths given back in scene units can lose by being too small for doubles. */
#define SUBNORMAL 0x1p-1074

mns_status mns_reference_create(const mns_field *field, mns_reference **reference, mns_error *error)
{
    if (!field || !reference)
        return status_fail(error, MNS_ERROR_USAGE, "reference: no field, or nowhere to put it");
    mns_reference *made = calloc(1, sizeof *made);
    if (!made) return status_no_memory(error, "making a reference");
    made->field = field;
    if (!reference_tree_build(&made->tree, field)) {
        mns_reference_destroy(made);
        return status_no_memory(error, "making a reference");
    }
    *reference = made;
    return MNS_OK;
}

void mns_reference_destroy(mns_reference *reference)
{
    if (!reference) return;
    reference_tree_free(&reference->tree);
    free(reference);
}

void reference_scratch_free(reference_scratch *scratch)
{
    free(scratch->ball.item);
    free(scratch->active.item);
    free(scratch->chord);
    memset(scratch, 0, sizeof *scratch);
}

/* ---- A ray ---- */

static bool collect(const mns_reference *reference, reference_scratch *scratch, const reference_ray *ray,
                    double reach)
{
    double origin[3], direction[3], pad[3];
    for (int a = 0; a < 3; a++) {
        const double *lo = reference->field->effective_lo, *hi = reference->field->effective_hi;
        origin[a] = ray->origin[a].hi;
        direction[a] = ray->direction[a].hi;
        /* The boxes, the ray's origin and the way to them are each good to a few roundings of these; and a
         * ray that starts at `base` has left nothing of the field behind it. */
        pad[a] = 0x1p-48 * (fabs(origin[a]) + fmax(fabs(lo[a]), fabs(hi[a])) + (hi[a] - lo[a]));
        reach += pad[a];
    }
    if (!reference_tree_collect(&reference->tree, origin, direction, pad, reach, &scratch->ball))
        return false;
    scratch->chord_count = 0;
    scratch->vague = INFINITY;
    if (scratch->ball.count > scratch->chord_capacity) {
        size_t capacity = scratch->ball.capacity;
        reference_chord *chord = memory_resize(scratch->chord, capacity, sizeof *chord);
        if (!chord) return false;
        scratch->chord = chord;
        scratch->chord_capacity = capacity;
    }
    for (size_t i = 0; i < scratch->ball.count; i++) {
        reference_chord *chord = &scratch->chord[scratch->chord_count];
        if (!reference_chord_make(chord, ray, reference->field, scratch->ball.item[i])) continue;
        if (chord->blur <= BLUR_MOST)
            scratch->chord_count++;
        else
            scratch->vague = fmin(scratch->vague, chord->enter);
    }
    return true;
}

double reference_share(const reference_chord *chord, mns_kernel kernel, double s)
{
    double y = reference_chord_at(chord, s);
    return chord->strength * bound_value(kernel, fmin(chord->peak - y * y, 1));
}

/* Normal and ball of a hit at s. */
static void describe(const reference_scratch *scratch, const mns_field *field, const reference_ray *ray,
                     double s, mns_hit *hit)
{
    double gradient[3] = {0, 0, 0}, strongest = -1;
    for (size_t i = 0; i < scratch->chord_count; i++) {
        const reference_chord *c = &scratch->chord[i];
        double y = reference_chord_at(c, s), w = fmin(c->peak - y * y, 1);
        if (w < 0) continue;
        double share = fabs(reference_share(c, field->kernel, s));
        if (share > strongest || (share == strongest && c->ball < hit->ball)) {
            strongest = share;
            hit->ball = c->ball;
        }
        double slope = c->strength * density_slope_over_v((int)field->kernel, 1 - w) * c->inverse;
        for (int a = 0; a < 3; a++)
            gradient[a] += slope * (c->aside[a] * c->inverse + y * ray->direction[a].hi);
    }
    double largest = fmax(fabs(gradient[0]), fmax(fabs(gradient[1]), fabs(gradient[2])));
    if (!(largest > 0)) return;
    for (int a = 0; a < 3; a++) gradient[a] /= largest;
    double length = sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2]);
    for (int a = 0; a < 3; a++) hit->normal[a] = -gradient[a] / length;
}

bool reference_ask(const mns_reference *reference, reference_scratch *scratch, const reference_query *query,
                   reference_answer *answer)
{
    const mns_field *field = reference->field;
    reference_ray ray;
    search_result found;
    reference_ray_start(&ray, field, query->origin, query->direction);
    if (!collect(reference, scratch, &ray, query->reach - ray.base)) return false;
    if (!reference_search(scratch, field, &ray, query->side, query->reach, &found)) return false;
    double seen = found.found ? found.hi : fmin(query->reach - ray.base, DBL_MAX);
    bool certain = found.certain && seen < scratch->vague;
    *answer = (reference_answer){.hit = {.hit = found.found, .certain = certain, .t = INFINITY}};
    if (!found.found) return true;
    real2 t = real2_sum(ray.base, found.at);
    mns_hit *hit = &answer->hit;
    hit->t = t.hi;
    hit->t_error = (fmax(found.hi - found.at, found.at - found.lo) + fabs(t.lo) + ray.blur) * (1 + 8 * ROUND);
    describe(scratch, field, &ray, found.at, hit);
    answer->s = found.at;
    for (int a = 0; a < 3; a++) {
        real2 way = real2_multiply((real2){found.at, 0}, ray.direction[a]);
        answer->point[a] = real2_add(ray.origin[a], way).hi;
    }
    return true;
}

bool reference_trace(const mns_reference *reference, reference_scratch *scratch, const double origin[3],
                     const double direction[3], mns_hit *hit, double *s)
{
    reference_query query = {.reach = INFINITY};
    reference_answer answer;
    memcpy(query.origin, origin, sizeof query.origin);
    memcpy(query.direction, direction, sizeof query.direction);
    if (!reference_ask(reference, scratch, &query, &answer)) return false;
    *hit = answer.hit;
    *s = answer.s;
    return true;
}

mns_status mns_reference_trace(const mns_reference *reference, const double origin[3],
                               const double direction[3], mns_hit *hit, mns_error *error)
{
    double s, from[3];
    bool near = true, finite = true, zero = true;
    if (!reference || !origin || !direction || !hit)
        return status_fail(error, MNS_ERROR_USAGE, "reference: an argument is NULL");
    const double unit = field_unit(reference->field);
    for (int a = 0; a < 3; a++) {
        from[a] = origin[a] / unit;
        near = near && fabs(from[a]) <= FARTHEST;
        finite = finite && isfinite(direction[a]);
        zero = zero && direction[a] == 0;
    }
    if (!near)
        return status_fail(error, MNS_ERROR_USAGE,
                           "a ray's origin %g,%g,%g: expected three numbers within %g", origin[0], origin[1],
                           origin[2], FARTHEST * unit);
    if (!finite || zero)
        return status_fail(error, MNS_ERROR_USAGE,
                           "a ray's direction %g,%g,%g: expected three finite numbers, not all 0",
                           direction[0], direction[1], direction[2]);
    reference_scratch scratch = {0};
    bool done = reference_trace(reference, &scratch, from, direction, hit, &s);
    reference_scratch_free(&scratch);
    if (done && unit != 1) {
        hit->t *= unit;
        hit->t_error = hit->hit ? hit->t_error * unit + SUBNORMAL : 0;
    }
    return done ? MNS_OK : status_no_memory(error, "tracing a ray");
}

/* ---- A point ---- */

typedef struct point_sum {
    const mns_field *field;
    const double *point;
    real2 value;
    double gradient[3], strongest;
    size_t ball;
} point_sum;

static void add_ball(void *user, size_t ball)
{
    point_sum *sum = user;
    const mns_field *f = sum->field;
    double inverse = 1 / field_radius(f, ball), q = field_strength(f, ball), d[3], u = 0;
    for (int a = 0; a < 3; a++) {
        d[a] = (sum->point[a] - f->p.axis[a][ball]) * inverse;
        u += d[a] * d[a];
    }
    if (!(u < 1)) return;
    double k = density_value((int)f->kernel, u), share = fabs(q) * k;
    real2 term = real2_sum(sum->value.hi, q * k);
    sum->value = (real2){term.hi, sum->value.lo + term.lo};
    double slope = q * density_slope_over_v((int)f->kernel, u) * inverse;
    for (int a = 0; a < 3; a++) sum->gradient[a] += slope * d[a];
    if (share > sum->strongest || (share == sum->strongest && ball < sum->ball)) {
        sum->strongest = share;
        sum->ball = ball;
    }
}

double mns_reference_value(const mns_reference *reference, const double point[3], double gradient[3],
                           size_t *ball)
{
    const double unit = field_unit(reference->field);
    const double at[3] = {point[0] / unit, point[1] / unit, point[2] / unit};
    point_sum sum = {.field = reference->field, .point = at, .strongest = -1, .ball = SIZE_MAX};
    reference_tree_around(&reference->tree, at, add_ball, &sum);
    for (int a = 0; gradient && a < 3; a++) gradient[a] = sum.gradient[a] / unit;
    if (ball) *ball = sum.ball;
    return sum.value.hi + sum.value.lo;
}
