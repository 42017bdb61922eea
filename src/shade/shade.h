/* Planes to colour. */
#ifndef MNS_SHADE_SHADE_H
#define MNS_SHADE_SHADE_H

#include "gl/buffer.h"
#include "plan/plan.h"

/* An sRGB number in linear light. */
float shade_linear(double srgb);

/* Fills the uniforms that shading reads (glsl/lighting.glsl). Errors: MEMORY. */
mns_status shade_send(gl_device *device, gl_buffer *uniforms, const mns_plan *plan, const double jitter[2],
                      mns_error *error);

/* One sample's planes (textures t, normal, color or 0) into `target`; the first sample replaces what is
 * there, the others add. */
mns_status shade_pass(gl_device *device, gl_buffer *uniforms, GLuint vertex_array, const mns_plan *plan,
                      GLuint program, const GLuint plane[3], GLuint target, int sample,
                      const double jitter[2], mns_error *error);

#endif
