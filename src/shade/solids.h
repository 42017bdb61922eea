/* The meshes of a frame on the GPU (glsl/solids.glsl), and the pass that finds where they are seen first. */
#ifndef MNS_SHADE_SOLIDS_H
#define MNS_SHADE_SOLIDS_H

#include "list/passes.h"
#include "solid/solid_files.h"

/* Zeroed is empty. */
typedef struct shade_solids {
    gl_buffer buffer;
    GLuint texture;
    uint64_t version; /* of what is there, 0: nothing; and its origin */
    double origin[3];
    uint32_t place[4]; /* texels where triangles, corners and colours begin; how many nodes there are */
} shade_solids;

/* Sends what is not there yet. Errors: MEMORY, UNSUPPORTED (more than the driver's texels or floats hold). */
mns_status shade_solids_send(shade_solids *s, gl_device *device, const mns_plan *plan,
                             const solid_files *files, mns_error *error);
/* Puts the meshes' first hits into the planes (textures t, normal, mesh), after shade_effects_send and with
 * the list of pixels there. *undecided grows by the pixels that are so because of them. */
void shade_solids_first(shade_solids *s, list_passes *p, gl_device *device, const mns_plan *plan,
                        GLuint program, GLuint block, const GLuint plane[3], uint64_t *undecided);
void shade_solids_bind(const shade_solids *s, gl_device *device, GLuint mesh);
void shade_solids_free(shade_solids *s, gl_device *device);

#endif
