/* A host's framebuffer: its depth taken over, the surface drawn on it. */
#ifndef MNS_RENDER_HOST_H
#define MNS_RENDER_HOST_H

#include "list/passes.h"

/* Copies the view's rectangle of the host's depth into the passes' host_depth texture. */
void host_depth_take(list_passes *p, gl_device *device, const mns_plan *plan, const mns_target *target);

/* Draws the shaded surface with its depth, tested against the host's. */
void host_draw(list_passes *p, gl_device *device, const mns_plan *plan, const mns_target *target,
               GLuint program, GLuint shaded, GLuint t);

#endif
