/* The GL state that drawing changes, taken before and put back after: a host notices nothing. */
#ifndef MNS_GL_STATE_H
#define MNS_GL_STATE_H

#include "gl/device.h"

enum {
    STATE_TEXTURES = 12,
    STATE_IMAGES = 5,
    STATE_STORAGE = 8,
    STATE_UNIFORMS = 3,
    STATE_SWITCHES = 24,
    STATE_PACK = 5
};

typedef struct gl_indexed {
    GLint buffer;
    GLint64 start, size;
} gl_indexed;

typedef struct gl_state {
    GLint program, vertex_array, draw_target, read_target, active_texture, texture[STATE_TEXTURES],
        texels[STATE_TEXTURES], sampler[STATE_TEXTURES];
    GLint array_buffer, uniform_buffer, storage_buffer, counter_buffer, pack_buffer, unpack_buffer;
    gl_indexed storage[STATE_STORAGE], uniforms[STATE_UNIFORMS], counter;
    GLint image[STATE_IMAGES][6];
    GLint viewport[4], scissor[4], depth_func, blend[6], clip[2], polygon_mode[2], pack[STATE_PACK];
    GLfloat depth_range[2];
    GLboolean depth_mask, color_mask[4], switches[STATE_SWITCHES];
} gl_state;

/* Saves the state and sets what the passes count on: all switches off, colour writes on, no sampler objects.
 */
void gl_state_take(gl_device *device, gl_state *state);
void gl_state_put_back(gl_device *device, const gl_state *state);

#endif
