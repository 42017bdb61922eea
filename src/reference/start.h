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

#endif
