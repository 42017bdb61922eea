/* What stands around the scene: a colour, the built-in sky, or a map. */
#ifndef MNS_EFFECTS_ENVIRONMENT_H
#define MNS_EFFECTS_ENVIRONMENT_H

#include "base/vec.h"
#include "image/picture.h"
#include "plan/plan.h"

typedef struct environment {
    bool sky;
    image_picture map;    /* rgb NULL: none */
    double color[3];      /* the background's, linear, where there is neither */
    vec3 right, up, back; /* the environment's x, y and z in the scene */
} environment;

/* All of it but the map. */
environment environment_of(const mns_plan *plan);
/* Reads the plan's map, if it has one. Errors: as image_picture_read. */
mns_status environment_begin(environment *e, const mns_plan *plan, mns_error *error);
void environment_end(environment *e);
/* Linear light from the unit direction `way`. */
void environment_color(const environment *e, vec3 way, double color[3]);

#endif
