#include "gl/state.h"

static const GLenum switches[STATE_SWITCHES] = {
    GL_DEPTH_TEST,
    GL_SCISSOR_TEST,
    GL_BLEND,
    GL_CULL_FACE,
    GL_STENCIL_TEST,
    GL_PROGRAM_POINT_SIZE,
    GL_RASTERIZER_DISCARD,
    GL_DEPTH_CLAMP,
    GL_FRAMEBUFFER_SRGB,
    GL_COLOR_LOGIC_OP,
    GL_POLYGON_OFFSET_FILL,
    GL_PRIMITIVE_RESTART,
    GL_PRIMITIVE_RESTART_FIXED_INDEX,
    GL_SAMPLE_MASK,
    GL_SAMPLE_COVERAGE,
    GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_CLIP_DISTANCE0,
    GL_CLIP_DISTANCE0 + 1,
    GL_CLIP_DISTANCE0 + 2,
    GL_CLIP_DISTANCE0 + 3,
    GL_CLIP_DISTANCE0 + 4,
    GL_CLIP_DISTANCE0 + 5,
    GL_CLIP_DISTANCE0 + 6,
    GL_CLIP_DISTANCE0 + 7,
};

/* How rows are written to memory: a host's row length would have a read run past its end. */
static const GLenum pack_names[STATE_PACK] = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS,
                                              GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES};
static const GLint pack_plain[STATE_PACK] = {4, 0, 0, 0, 0};

static const GLenum blend_names[6] = {GL_BLEND_SRC_RGB,   GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,
                                      GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};
static const GLenum image_names[6] = {GL_IMAGE_BINDING_NAME,    GL_IMAGE_BINDING_LEVEL,
                                      GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_LAYER,
                                      GL_IMAGE_BINDING_ACCESS,  GL_IMAGE_BINDING_FORMAT};

static void take_indexed(const GladGLContext *gl, gl_indexed *to, GLenum buffer, GLenum start, GLenum size,
                         GLuint at)
{
    gl->GetIntegeri_v(buffer, at, &to->buffer);
    gl->GetInteger64i_v(start, at, &to->start);
    gl->GetInteger64i_v(size, at, &to->size);
}

static void put_indexed(const GladGLContext *gl, const gl_indexed *from, GLenum target, GLuint at)
{
    if (from->buffer && from->size)
        gl->BindBufferRange(target, at, (GLuint)from->buffer, (GLintptr)from->start, (GLsizeiptr)from->size);
    else
        gl->BindBufferBase(target, at, (GLuint)from->buffer);
}

static void take_bindings(const GladGLContext *gl, gl_state *s)
{
    gl->GetIntegerv(GL_CURRENT_PROGRAM, &s->program);
    gl->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &s->vertex_array);
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s->draw_target);
    gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &s->read_target);
    gl->GetIntegerv(GL_ACTIVE_TEXTURE, &s->active_texture);
    for (GLuint i = 0; i < STATE_TEXTURES; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->GetIntegerv(GL_TEXTURE_BINDING_2D, &s->texture[i]);
        gl->GetIntegerv(GL_TEXTURE_BINDING_BUFFER, &s->texels[i]);
        gl->GetIntegerv(GL_SAMPLER_BINDING, &s->sampler[i]);
        gl->BindSampler(i, 0);
    }
    gl->GetIntegerv(GL_ARRAY_BUFFER_BINDING, &s->array_buffer);
    gl->GetIntegerv(GL_UNIFORM_BUFFER_BINDING, &s->uniform_buffer);
    gl->GetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &s->storage_buffer);
    gl->GetIntegerv(GL_ATOMIC_COUNTER_BUFFER_BINDING, &s->counter_buffer);
    gl->GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &s->pack_buffer);
    gl->GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &s->unpack_buffer);
    for (GLuint i = 0; i < STATE_STORAGE; i++)
        take_indexed(gl, &s->storage[i], GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                     GL_SHADER_STORAGE_BUFFER_SIZE, i);
    for (GLuint i = 0; i < STATE_UNIFORMS; i++)
        take_indexed(gl, &s->uniforms[i], GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
                     GL_UNIFORM_BUFFER_SIZE, i);
    take_indexed(gl, &s->counter, GL_ATOMIC_COUNTER_BUFFER_BINDING, GL_ATOMIC_COUNTER_BUFFER_START,
                 GL_ATOMIC_COUNTER_BUFFER_SIZE, 0);
    for (GLuint i = 0; i < STATE_IMAGES; i++)
        for (int k = 0; k < 6; k++) gl->GetIntegeri_v(image_names[k], i, &s->image[i][k]);
}

void gl_state_take(gl_device *device, gl_state *s)
{
    const GladGLContext *gl = &device->gl;
    while (gl->GetError() != GL_NO_ERROR) { /* the host's own, which would be taken for ours */
    }
    take_bindings(gl, s);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl->GetIntegerv(GL_VIEWPORT, s->viewport);
    gl->GetIntegerv(GL_SCISSOR_BOX, s->scissor);
    gl->GetIntegerv(GL_DEPTH_FUNC, &s->depth_func);
    gl->GetFloatv(GL_DEPTH_RANGE, s->depth_range);
    for (int i = 0; i < STATE_PACK; i++) {
        gl->GetIntegerv(pack_names[i], &s->pack[i]);
        gl->PixelStorei(pack_names[i], pack_plain[i]);
    }
    gl->GetIntegerv(GL_POLYGON_MODE, s->polygon_mode);
    for (int i = 0; i < 6; i++) gl->GetIntegerv(blend_names[i], &s->blend[i]);
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &s->depth_mask);
    gl->GetBooleanv(GL_COLOR_WRITEMASK, s->color_mask);
    for (int i = 0; i < STATE_SWITCHES; i++) {
        s->switches[i] = gl->IsEnabled(switches[i]);
        gl->Disable(switches[i]);
    }
    gl->Enable(GL_PROGRAM_POINT_SIZE);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl->DepthRangef(0, 1);
    if (device->limits.has_clip_control) {
        gl->GetIntegerv(GL_CLIP_ORIGIN, &s->clip[0]);
        gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &s->clip[1]);
        gl->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    }
}

static void put_bindings(const GladGLContext *gl, const gl_state *s)
{
    gl->UseProgram((GLuint)s->program);
    gl->BindVertexArray((GLuint)s->vertex_array);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)s->draw_target);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)s->read_target);
    for (GLuint i = 0; i < STATE_TEXTURES; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->BindTexture(GL_TEXTURE_2D, (GLuint)s->texture[i]);
        gl->BindTexture(GL_TEXTURE_BUFFER, (GLuint)s->texels[i]);
        gl->BindSampler(i, (GLuint)s->sampler[i]);
    }
    gl->ActiveTexture((GLenum)s->active_texture);
    for (GLuint i = 0; i < STATE_STORAGE; i++) put_indexed(gl, &s->storage[i], GL_SHADER_STORAGE_BUFFER, i);
    for (GLuint i = 0; i < STATE_UNIFORMS; i++) put_indexed(gl, &s->uniforms[i], GL_UNIFORM_BUFFER, i);
    put_indexed(gl, &s->counter, GL_ATOMIC_COUNTER_BUFFER, 0);
    for (GLuint i = 0; i < STATE_IMAGES; i++) {
        const GLint *image = s->image[i];
        GLenum format = image[5] ? (GLenum)image[5] : GL_R32UI;
        gl->BindImageTexture(i, (GLuint)image[0], image[1], (GLboolean)image[2], image[3], (GLenum)image[4],
                             format);
    }
    gl->BindBuffer(GL_ARRAY_BUFFER, (GLuint)s->array_buffer);
    gl->BindBuffer(GL_UNIFORM_BUFFER, (GLuint)s->uniform_buffer);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, (GLuint)s->storage_buffer);
    gl->BindBuffer(GL_ATOMIC_COUNTER_BUFFER, (GLuint)s->counter_buffer);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, (GLuint)s->pack_buffer);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)s->unpack_buffer);
}

void gl_state_put_back(gl_device *device, const gl_state *s)
{
    const GladGLContext *gl = &device->gl;
    put_bindings(gl, s);
    gl->Viewport(s->viewport[0], s->viewport[1], s->viewport[2], s->viewport[3]);
    gl->Scissor(s->scissor[0], s->scissor[1], s->scissor[2], s->scissor[3]);
    gl->DepthFunc((GLenum)s->depth_func);
    gl->DepthMask(s->depth_mask);
    gl->ColorMask(s->color_mask[0], s->color_mask[1], s->color_mask[2], s->color_mask[3]);
    gl->BlendFuncSeparate((GLenum)s->blend[0], (GLenum)s->blend[1], (GLenum)s->blend[2], (GLenum)s->blend[3]);
    gl->BlendEquationSeparate((GLenum)s->blend[4], (GLenum)s->blend[5]);
    gl->PolygonMode(GL_FRONT_AND_BACK, (GLenum)s->polygon_mode[0]);
    gl->DepthRangef(s->depth_range[0], s->depth_range[1]);
    for (int i = 0; i < STATE_PACK; i++) gl->PixelStorei(pack_names[i], s->pack[i]);
    if (device->limits.has_clip_control) gl->ClipControl((GLenum)s->clip[0], (GLenum)s->clip[1]);
    for (int i = 0; i < STATE_SWITCHES; i++) {
        if (s->switches[i])
            gl->Enable(switches[i]);
        else
            gl->Disable(switches[i]);
    }
}
