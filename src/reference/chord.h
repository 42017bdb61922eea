/* A ray moved to the field's box, and its chords through the effective spheres.
 *
 * Ray and centres are taken in numbers of twice the length, so that the eye a billion radii away, or the
 * whole field far from 0, loses nothing: what is left is rounded once, when it has become a length of the
 * order of R. With h the way from the centre to the nearest point of the ray and m the ray's parameter there,
 * 1 - r^2/R^2 along the ray is w(s) = peak - ((s - m)/R)^2, peak = (R - |h|)(R + |h|)/R^2.
 */
#ifndef MNS_REFERENCE_CHORD_H
#define MNS_REFERENCE_CHORD_H

#include "reference/real2.h"
#include "reference/tree.h"

/* Half a unit in the last place of 1: the relative error of one operation. */
#define ROUND 0x1p-53

typedef struct reference_ray {
    real2 origin[3], direction[3]; /* unit */
    double eye[3];                 /* as given */
    double base;                   /* distance from the eye to origin: t = base + s */
    double blur;                   /* bound on the error of a point of it */
} reference_ray;

typedef struct reference_chord {
    double middle, middle_low; /* m */
    double radius, inverse;    /* R and 1/R */
    double peak;               /* w at m */
    double blur;               /* bound on the error of w */
    double enter, leave;       /* w < 0 outside, for certain */
    double strength;
    double aside[3]; /* h: from the centre to the ray's point at m */
    size_t ball;
} reference_chord;

/* The ray from `origin` along `direction` (not zero, both finite and at most 1e60), begun at the box. */
void reference_ray_start(reference_ray *ray, const mns_field *field, const double origin[3],
                         const double direction[3]);
/* False: the ray passes the ball by, or has left it behind. */
bool reference_chord_make(reference_chord *chord, const reference_ray *ray, const mns_field *field,
                          size_t ball);

/* (s - m) / R, with a relative error of at most 4 ROUND beside the chord's blur. */
static inline double reference_chord_at(const reference_chord *c, double s)
{
    return ((s - c->middle) - c->middle_low) * c->inverse;
}

#endif
