/* The pass that lights a frame's planes with all that light does beyond the first hit (glsl/effects.glsl). */
#ifndef MNS_SHADE_EFFECTS_H
#define MNS_SHADE_EFFECTS_H

#include "shade/solids.h"
#include "trace/passes.h"

#include <sys/stat.h>

enum { LOOSE_DOUBLES = 6, LOOSE_FLOATS = 5 };

/* What of the lights and numbers all walks read: uniforms of their own, in this order. */
typedef struct shade_loose {
    double wide[LOOSE_DOUBLES][4];
    float narrow[LOOSE_FLOATS][4];
    int32_t counts[4];
    uint32_t levels[4];
    int32_t size[4];
    uint32_t solids[4]; /* of nodes 0: there are none */
} shade_loose;

/* Its GL objects. Zeroed is empty. */
typedef struct shade_effects {
    gl_buffer block, store; /* lights and numbers; walks that wait */
    shade_loose loose;
    shade_solids solids;
    size_t room;    /* walks that can wait */
    GLuint map;     /* the environment's */
    char *map_name; /* of its file, as that was when it was read: */
    struct timespec map_time;
    off_t map_size;
} shade_effects;

/* A region's walks that wait with a ray, in float or for doubles; which halves of their lists hold them; what
 * was traced so far. */
typedef struct shade_walks {
    size_t waiting, waiting_wide, half[2];
    bool cast; /* the ray that those in float wait with is to be cast: bounds did not tell */
    uint64_t rays, undecided;
} shade_walks;

/* What one sample is lit from, and to. */
typedef struct shade_planes {
    GLuint t, normal, color, mesh, lit, terms, settled;
} shade_planes;

/* Reads the environment's map, unless it is there as it is. Errors: as image_picture_read, UNSUPPORTED (too
 * large for the driver), MEMORY, GL. */
mns_status shade_effects_map(shade_effects *e, gl_device *device, const mns_plan *plan, mns_error *error);
/* Sends what one sample's light hangs on. Errors: MEMORY. */
mns_status shade_effects_send(shade_effects *e, gl_device *device, const mns_plan *plan,
                              const double jitter[2], int sample, mns_error *error);
/* The most pixels that one region may have, so that every walk in it can wait. */
size_t shade_effects_most(const mns_plan *plan);
/* Room for the lists of so many pixels. Errors: MEMORY, UNSUPPORTED. */
mns_status shade_effects_reserve(shade_effects *e, list_passes *p, gl_device *device, const mns_plan *plan,
                                 size_t pixels, mns_error *error);
/* Binds all that the passes read and write; `shading` is filled by shade_send. */
void shade_effects_bind(shade_effects *e, trace_passes *t, list_passes *p, gl_device *device,
                        const mns_plan *plan, const gl_buffer *shading, const shade_planes *planes);
/* Fills the planes of `target` (lit, terms, settled) with what pixels have that see no surface. */
void shade_effects_clear(gl_device *device, const mns_plan *plan, GLuint target);
/* Begins the walks of a region's pixels. Errors: MEMORY, UNSUPPORTED. */
mns_status shade_effects_begin(shade_effects *e, list_passes *p, gl_device *device, const mns_plan *plan,
                               const GLuint program[SHADER_COUNT], list_region region, shade_walks *walks,
                               mns_error *error);
/* Goes on with all that wait in float; or where none does, with those that wait for doubles, for which
 * SHADER_EFFECTS_RESOLVE must be there. */
void shade_effects_go_on(shade_effects *e, trace_passes *t, list_passes *p, gl_device *device,
                         const GLuint program[SHADER_COUNT], shade_walks *walks);
void shade_effects_free(shade_effects *e, gl_device *device);

#endif
