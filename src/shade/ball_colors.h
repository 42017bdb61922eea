/* Colours of balls as the shaders read them, a word a ball: a value in [0, 1] of the colour map as float, or
 * with FEATURE_LABELS an rgba8. */
#ifndef MNS_SHADE_BALL_COLORS_H
#define MNS_SHADE_BALL_COLORS_H

#include "field/field.h"
#include "plan/plan.h"

typedef struct ball_colors {
    const particles_column *column;
    bool labels, elements;
    double low, span;
} ball_colors;

/* Of a plan with FEATURE_COLORS. It refers to the field. */
ball_colors ball_colors_of(const mns_field *field, const mns_plan *plan);

/* The word of the field's ball `index`. */
uint32_t ball_colors_word(const ball_colors *colors, uint32_t index);

#endif
