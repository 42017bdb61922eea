#include "reference/start.h"

#include "reference/bound.h"

#include <fenv.h>

/* f(eye) = L exactly: the sum comes to L, and no operation on the way there was rounded. The volatile numbers
 * keep the compiler from moving arithmetic across the questions to the machine. */
static bool is_on_surface(const piece_balls *balls, const mns_field *field, const double eye[3])
{
    fenv_t before;
    volatile double sum = 0;
    if (feholdexcept(&before)) return false;
    for (size_t i = 0; i < balls->count; i++) {
        size_t ball = balls->chord[balls->item[i]].ball;
        volatile double square = 0, r = field_radius(field, ball), q = field_strength(field, ball);
        for (int a = 0; a < 3; a++) {
            volatile double d = field->p.axis[a][ball] - eye[a];
            square = square + d * d;
        }
        volatile double u = square / (r * r);
        if (u < 1) {
            volatile double k = density_value((int)field->kernel, u);
            sum = sum + q * k;
        }
    }
    bool exact = sum == field->iso && !fetestexcept(FE_INEXACT | FE_UNDERFLOW);
    fesetenv(&before);
    return exact;
}

/* 1 or -1 where f - L rises or falls all over the piece, else 0. */
static int trend(const piece *p)
{
    double least = INFINITY, most = -INFINITY, margin = 2 * p->rounding + p->slope_model;
    for (int j = 1; j <= p->degree; j++) {
        least = fmin(least, p->c[j] - p->c[j - 1]);
        most = fmax(most, p->c[j] - p->c[j - 1]);
    }
    return least > margin ? 1 : most < -margin ? -1 : 0;
}

/* The sign just after a point on the surface: that of the slope, where one is proven on some piece beside it.
 */
static bool side_after(const piece_balls *balls, double at, reference_start *start)
{
    double length = 0;
    for (size_t i = 0; i < balls->count; i++) length = fmax(length, balls->chord[balls->item[i]].radius);
    for (int i = 0; i < 60; i++, length *= 0.5) {
        piece p;
        if (!(at + length > at)) break;
        piece_make(balls, at, at + length, &p);
        int rises = trend(&p);
        if (!rises) continue;
        start->side = rises;
        start->from = at + length;
        return true;
    }
    return false;
}

reference_start reference_start_of(const piece_balls *balls, const mns_field *field, const reference_ray *ray)
{
    reference_start start = {.from = -ray->base, .certain = true};
    piece_point at;
    piece_point_at(balls, -ray->base, &at);
    start.side = at.value > 0 ? 1 : -1;
    if (fabs(at.value) > at.error) return start;
    start.certain = is_on_surface(balls, field, ray->eye);
    if (!side_after(balls, -ray->base, &start)) {
        start.side = at.slope >= 0 ? 1 : -1;
        start.certain = false;
    }
    return start;
}

/* The nearest of doubling steps at which the sign is proven to be the side's: a guess at where a ray is free
 * of the surface that it leaves, where its slope is too near 0 to tell. */
static double free_from(const piece_balls *balls, double at, double side)
{
    double longest = 0;
    for (size_t i = 0; i < balls->count; i++) longest = fmax(longest, balls->chord[balls->item[i]].radius);
    for (double step = longest * 0x1p-50; step < longest * 0x1p-8; step *= 2) {
        piece_point there;
        piece_point_at(balls, at + step, &there);
        if (side * there.value > there.error) return at + step;
    }
    return at;
}

reference_start reference_start_from(const piece_balls *balls, const reference_ray *ray, double side)
{
    reference_start start = {.side = side, .from = -ray->base};
    piece_point at;
    if (side_after(balls, -ray->base, &start) && start.side == side) {
        piece_point_at(balls, start.from, &at);
        start.certain = side * at.value > at.error;
        if (start.certain) return start;
    }
    return (reference_start){.side = side, .from = free_from(balls, -ray->base, side)};
}
