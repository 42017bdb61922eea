/* What light does beyond the first hit, on the CPU: every ray by the certified tracer, all sums in doubles.
 * The truth that a quicker way of drawing it is held against. */
#ifndef MNS_EFFECTS_EFFECTS_H
#define MNS_EFFECTS_EFFECTS_H

#include "effects/environment.h"
#include "effects/meet.h"

/* The linear colour of the surface where a ray met it, whose chords are still in the scratch. Returns how
 * much of the second material it has (MATERIALS). */
typedef double effects_albedo(const void *user, const reference_scratch *scratch, double s, double color[3]);

/* So far from the first material's to the second's; at the ends exactly theirs. */
static inline double effects_between(double first, double second, double weight)
{
    return weight >= 1 ? second : first + weight * (second - first);
}

/* The same for all pixels, and for all threads. */
typedef struct effects_scene {
    const mns_plan *plan;
    const mns_reference *reference;
    const solid_set *solids;  /* NULL: none */
    double (*solid_color)[3]; /* a mesh of the plan's, linear */
    effects_albedo *albedo;
    const void *user;
    environment environment;
    double (*radiance)[3]; /* a light of the plan's: colour times strength, linear */
} effects_scene;

/* Reads the environment's map; `solids` are the plan's meshes, NULL where it has none. End with effects_end,
 * also after a failure. Errors: as image_picture_read. */
mns_status effects_begin(effects_scene *scene, const mns_plan *plan, const mns_reference *reference,
                         const solid_set *solids, effects_albedo *albedo, const void *user, mns_error *error);
/* What the ray from the eye along `way` (unit) meets first. False: out of memory. */
bool effects_first(const effects_scene *scene, reference_scratch *scratch, vec3 way, effects_met *first);
void effects_end(effects_scene *scene);

/* One sample of a pixel, and what it comes to. */
typedef struct effects_pixel {
    uint32_t x, y; /* from the top left */
    uint32_t sample;
    double color[4];                             /* linear, premultiplied */
    double shadow, occlusion, mirror, refracted; /* as mns_image has them */
    bool certain;
    uint64_t rays;
} effects_pixel;

/* Colours the pixel whose ray along `way` (unit) from the eye found `first`, the last that was asked of the
 * scratch. False: out of memory. */
bool effects_shade(const effects_scene *scene, reference_scratch *scratch, vec3 way, const effects_met *first,
                   effects_pixel *pixel);

#endif
