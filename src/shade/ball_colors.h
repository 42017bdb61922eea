/* Colours and materials of balls as the shaders read them (glsl/surface.glsl). With FEATURE_COLORS a word a
 * ball: a value in [0, 1] of the colour map as float, or with FEATURE_LABELS an rgba8. With FEATURE_MATERIALS
 * a word more: its place between the two, as float. */
#ifndef MNS_SHADE_BALL_COLORS_H
#define MNS_SHADE_BALL_COLORS_H

#include "field/field.h"
#include "plan/plan.h"

typedef struct ball_colors {
    const mns_field *field;
    const mns_plan *plan;
    size_t words;                   /* a ball */
    const particles_column *column; /* to colour by; NULL without */
    bool labels, elements;
    double low, span;
} ball_colors;

/* Of a plan with some of FEATURE_BLENDS. It refers to both. */
ball_colors ball_colors_of(const mns_field *field, const mns_plan *plan);

/* Words that a ball has. */
size_t ball_colors_words(const mns_plan *plan);
/* Those of the field's ball `index`. */
void ball_colors_put(const ball_colors *colors, uint32_t index, uint32_t *word);

#endif
