#include "reference/chord.h"

#include <math.h>

/* Of the sizes of eye, base and centre. Every number met on the way to h and m is at most 4 times their sum,
 * and takes part in fewer than 20 operations of relative error 2^-102 or less. */
#define BLUR 0x1p-95

/* Where the ray enters the box of the effective spheres, roughly; 0 where it starts inside or never does.
 * Only the choice of an origin hangs on it. */
static double box_distance(const mns_field *f, const double origin[3], const real2 direction[3])
{
    double from = 0, to = INFINITY;
    for (int a = 0; a < 3; a++) {
        double d = direction[a].hi;
        if (fabs(d) < 1e-200) continue;
        double t0 = (f->effective_lo[a] - origin[a]) / d, t1 = (f->effective_hi[a] - origin[a]) / d;
        from = fmax(from, fmin(t0, t1));
        to = fmin(to, fmax(t0, t1));
    }
    return from <= to ? from : 0;
}

static void unit_direction(real2 unit[3], const double direction[3])
{
    int exponent;
    double largest = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    real2 square = {0, 0};
    frexp(largest, &exponent);
    for (int a = 0; a < 3; a++) {
        double d = ldexp(direction[a], -exponent);
        square = real2_add(square, real2_product(d, d));
    }
    real2 length = real2_root(square);
    for (int a = 0; a < 3; a++) unit[a] = real2_divide(ldexp(direction[a], -exponent), length);
}

void reference_ray_start(reference_ray *ray, const mns_field *field, const double origin[3],
                         const double direction[3])
{
    unit_direction(ray->direction, direction);
    ray->base = box_distance(field, origin, ray->direction);
    double size = ray->base;
    for (int a = 0; a < 3; a++) {
        real2 way = real2_multiply((real2){ray->base, 0}, ray->direction[a]);
        ray->origin[a] = real2_add(way, (real2){origin[a], 0});
        ray->eye[a] = origin[a];
        size += fabs(origin[a]);
    }
    ray->blur = size * BLUR;
}

bool reference_chord_make(reference_chord *chord, const reference_ray *ray, const mns_field *field,
                          size_t ball)
{
    real2 centre[3], m = {0, 0};
    double away = 0, r = field_radius(field, ball), blur = ray->blur;
    for (int a = 0; a < 3; a++) {
        blur += fabs(field->p.axis[a][ball]) * BLUR;
        centre[a] = real2_add((real2){field->p.axis[a][ball], 0}, real2_negate(ray->origin[a]));
        m = real2_add(m, real2_multiply(centre[a], ray->direction[a]));
    }
    for (int a = 0; a < 3; a++) {
        real2 h = real2_add(real2_multiply(m, ray->direction[a]), real2_negate(centre[a]));
        chord->aside[a] = h.hi;
        away += h.hi * h.hi;
    }
    away = sqrt(away);
    chord->radius = r;
    chord->inverse = 1 / r;
    /* |h| and R^-2 are good to 4 roundings each: the factors' difference to 4 |h|, the products to 6 of their
     * value. With w = peak - y^2, y good to 4, y^2 to 9 and at most 1 inside the ball, and 1 - u there and
     * back in the kernel, 26 roundings of 1 hold it all. The blur moves m and h by as much as itself. */
    chord->peak = (r - away) * chord->inverse * ((r + away) * chord->inverse);
    chord->blur = 26 * ROUND + 6 * blur * chord->inverse;
    if (chord->peak + chord->blur <= 0) return false;
    double half = r * sqrt(chord->peak + chord->blur) * (1 + 8 * ROUND) + 2 * blur;
    double slack = 4 * ROUND * (fabs(m.hi) + half);
    chord->middle = m.hi;
    chord->middle_low = m.lo;
    chord->enter = m.hi - half - slack;
    chord->leave = m.hi + half + slack;
    chord->strength = field_strength(field, ball);
    chord->ball = ball;
    return chord->leave > -ray->base;
}
