/* The parts that a pixel's walk through the scene is made of. */
#ifndef MNS_EFFECTS_WALK_H
#define MNS_EFFECTS_WALK_H

#include "effects/effects.h"

typedef struct effects_walk {
    const effects_scene *scene;
    reference_scratch *scratch;
    effects_pixel *pixel;
    bool failed; /* out of memory */
} effects_walk;

/* A place of the surface, or of a solid, that some ray met. */
typedef struct effects_surface {
    vec3 at, normal, to_viewer; /* units; the normal is turned to the viewer */
    bool inside;                /* the viewer is in the medium */
    bool solid;                 /* of a mesh: all that leaves it stays on the viewer's side */
    double albedo[3];
    double weight; /* of the second material; of a mesh none */
    uint32_t path; /* its number on the way (glsl/samples.glsl) */
} effects_surface;

/* light.c: what the surface shows of the lights: `shaded`, which hangs on its own colour, and `shine`. Where
 * not NULL *shadow and *occlusion become the terms. */
typedef struct effects_lit {
    double shaded[3], shine[3];
    double shadow, occlusion;
} effects_lit;
void effects_light(effects_walk *walk, const effects_surface *surface, bool needs_shaded, effects_lit *lit);

/* Asks for the ray that leaves a surface along the unit direction `way`, up to `reach`. False: out of memory,
 * noted in the walk. */
bool effects_ask(effects_walk *walk, const effects_surface *surface, vec3 way, double reach,
                 effects_met *met);
/* Whether such a ray goes through the medium. */
bool effects_inwards(const effects_surface *surface, vec3 way);

#endif
