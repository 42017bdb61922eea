/* For tests of effects without GL: one ray through a scene, shaded by the truth. Every function ends the
 * running test when something fails. */
#ifndef MNS_TESTS_EFFECTS_FIXTURE_H
#define MNS_TESTS_EFFECTS_FIXTURE_H

#include "effects/effects.h"

typedef struct effects_fixture {
    const mns_field *field;
    mns_reference *reference;
    mns_plan *plan;
    effects_scene scene;
    reference_scratch scratch;
    double albedo[3]; /* linear, */
    double weight;    /* and how much of the second material, of any surface */
} effects_fixture;

/* The scene of a field, seen from `eye` towards `at`, by a look; free by effects_fixture_close. */
void effects_fixture_open(effects_fixture *f, const mns_field *field, vec3 eye, vec3 at,
                          const mns_look *look);
void effects_fixture_close(effects_fixture *f);
/* Shades the ray from the eye along `way`; what it first meets goes to *first where that is not NULL. */
effects_pixel effects_fixture_shade(effects_fixture *f, vec3 way, reference_answer *first);

#endif
