/* On which side of the surface a ray starts whose eye lies inside some effective sphere. */
#ifndef MNS_REFERENCE_START_H
#define MNS_REFERENCE_START_H

#include "reference/piece.h"

typedef struct reference_start {
    double side; /* 1 inside, -1 outside */
    double from; /* the sign of f - L is side from the eye (not counted) up to here, and here */
    bool certain;
} reference_start;

reference_start reference_start_of(const piece_balls *balls, const mns_field *field,
                                   const reference_ray *ray);

/* The same of a ray that leaves a point of the surface, known to rounding, towards `side`: from its start to
 * start.from f - L moves towards that side all the way, and there it is on it for certain. So the only change
 * of sign that is passed over is that of the start itself, be the point a little before or behind it. */
reference_start reference_start_from(const piece_balls *balls, const reference_ray *ray, double side);

#endif
