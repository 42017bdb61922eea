#include "shade/shade.h"

#include "base/color.h"
#include "shade/palette.h"

#include <string.h>

/* As glsl/lighting.glsl has it. */
typedef struct shade_block {
    float surface_color[4], background[4], light[4], lighting[4], way_corner[4], way_x[4], way_y[4];
    float map[PALETTE_ANCHORS][4];
    float second_color[4], second_optics[4], second_absorption[4];
} shade_block;

float shade_linear(double srgb)
{
    return (float)color_linear(srgb);
}

static void put(float to[4], vec3 v, double w)
{
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
    to[3] = (float)w;
}

/* Absorption beyond this is sent as this: a float's infinity times no way would be no number. */
#define MOST 1e30

static void put_second(shade_block *block, const mns_blend *second)
{
    for (int c = 0; c < 3; c++) {
        block->second_color[c] = shade_linear(second->color[c]);
        block->second_absorption[c] = (float)fmin(second->absorption[c], MOST);
    }
    block->second_color[3] = second->set & MNS_LOOK_COLOR ? 1 : 0;
    block->second_optics[0] = (float)second->mirror;
    block->second_optics[1] = (float)second->transmission;
}

static void fill(shade_block *block, const mns_plan *plan, const double jitter[2])
{
    const mns_look *look = &plan->look;
    const view_frame *f = &plan->frame;
    memset(block, 0, sizeof *block);
    for (int i = 0; i < 3; i++) {
        block->surface_color[i] = shade_linear(look->color[i]);
        block->background[i] = shade_linear(look->background[i]);
    }
    block->background[3] = (float)look->background[3];
    put(block->light, vec3_unit(vec3_load(look->light_direction)), 1.0 / plan->options.samples);
    put(block->lighting, (vec3){look->ambient, look->diffuse, look->specular}, look->shininess);
    double unit = 2 * f->tan_half / f->height;
    vec3 corner = vec3_along(f->forward, unit * (jitter[0] - 0.5 * f->width), f->right);
    corner = vec3_along(corner, unit * (jitter[1] - 0.5 * f->height), f->up);
    put(block->way_corner, corner, look->cel_bands);
    put(block->way_x, vec3_scale(f->right, unit), 0);
    put(block->way_y, vec3_scale(f->up, unit), 0);
    put_second(block, &look->blend);
    const uint32_t *anchor = palette_map(look->color_map);
    for (int i = 0; i < PALETTE_ANCHORS; i++)
        put(block->map[i],
            (vec3){(anchor[i] >> 16) / 255.0, (anchor[i] >> 8 & 255) / 255.0, (anchor[i] & 255) / 255.0}, 1);
}

mns_status shade_send(gl_device *device, gl_buffer *uniforms, const mns_plan *plan, const double jitter[2],
                      mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    shade_block block;
    fill(&block, plan, jitter);
    mns_status status = gl_buffer_reserve(device, uniforms, "shading", sizeof block, 0, error);
    if (status) return status;
    gl->BindBuffer(GL_UNIFORM_BUFFER, uniforms->id);
    gl->BufferSubData(GL_UNIFORM_BUFFER, 0, sizeof block, &block);
    return MNS_OK;
}

mns_status shade_pass(gl_device *device, gl_buffer *uniforms, GLuint vertex_array, const mns_plan *plan,
                      GLuint program, const GLuint plane[3], GLuint target, int sample,
                      const double jitter[2], mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    mns_status status = shade_send(device, uniforms, plan, jitter, error);
    if (status) return status;
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms->id);
    for (GLuint i = 0; i < 3; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->BindTexture(GL_TEXTURE_2D, plane[i]);
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, target);
    gl->Viewport(0, 0, plan->frame.width, plan->frame.height);
    gl->Disable(GL_SCISSOR_TEST);
    if (sample > 0) {
        gl->Enable(GL_BLEND);
        gl->BlendEquation(GL_FUNC_ADD);
        gl->BlendFunc(GL_ONE, GL_ONE);
    }
    gl->UseProgram(program);
    gl->BindVertexArray(vertex_array);
    for (GLuint i = 0; i < 3; i++) gl->DisableVertexAttribArray(i);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->BindVertexArray(0);
    gl->Disable(GL_BLEND);
    return gl_check(device, "shade", error);
}
