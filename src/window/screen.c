#include "window/screen.h"

#include "base/color.h"
#include "base/memory.h"
#include "base/status.h"
#include "gl/glsl_text.h"

#include <string.h>

extern const glsl_text window_glsl_texts[]; /* glsl/window/, and what it includes */

static const char *text_of(const char *name)
{
    for (const glsl_text *file = window_glsl_texts; file->name; file++)
        if (strcmp(file->name, name) == 0) return file->text;
    return "";
}

static mns_status compile(screen *s, GLenum kind, const char *name, const char *before, mns_error *error)
{
    const GladGLContext *gl = &s->gl;
    const GLchar *const parts[] = {"#version 430 core\n", before, text_of(name)};
    GLuint shader = gl->CreateShader(kind);
    GLint good = GL_FALSE;
    char log[256] = "";
    gl->ShaderSource(shader, 3, parts, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    gl->AttachShader(s->program, shader);
    gl->DeleteShader(shader);
    if (good) return MNS_OK;
    return status_fail(error, MNS_ERROR_GL, "window: %s does not compile: %s", name, log);
}

static mns_status make_program(screen *s, mns_error *error)
{
    const GladGLContext *gl = &s->gl;
    s->program = gl->CreateProgram();
    mns_status status = compile(s, GL_VERTEX_SHADER, "screen.vert.glsl", "", error);
    if (!status) status = compile(s, GL_FRAGMENT_SHADER, "screen.frag.glsl", text_of("color.glsl"), error);
    if (status) return status;
    GLint good = GL_FALSE;
    gl->LinkProgram(s->program);
    gl->GetProgramiv(s->program, GL_LINK_STATUS, &good);
    if (good) return MNS_OK;
    char log[256] = "";
    gl->GetProgramInfoLog(s->program, sizeof log, NULL, log);
    return status_fail(error, MNS_ERROR_GL, "window: screen.frag.glsl does not link: %s", log);
}

mns_status screen_open(screen *s, mns_get_proc get_proc, mns_error *error)
{
    memset(s, 0, sizeof *s);
    if (!gladLoadGLContext(&s->gl, (GLADloadfunc)get_proc))
        return status_fail(error, MNS_ERROR_GL, "window: its context gives no OpenGL functions");
    const GladGLContext *gl = &s->gl;
    gl->GenVertexArrays(1, &s->vertex_array);
    gl->GenFramebuffers(1, &s->read_target);
    gl->GenFramebuffers(1, &s->small_target);
    gl->GenSamplers(2, s->sampler);
    for (int i = 0; i < 2; i++) {
        GLint filter = i ? GL_LINEAR : GL_NEAREST;
        gl->SamplerParameteri(s->sampler[i], GL_TEXTURE_MIN_FILTER, filter);
        gl->SamplerParameteri(s->sampler[i], GL_TEXTURE_MAG_FILTER, filter);
        gl->SamplerParameteri(s->sampler[i], GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl->SamplerParameteri(s->sampler[i], GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    mns_status status = make_program(s, error);
    if (status) screen_close(s);
    return status;
}

void screen_close(screen *s)
{
    const GladGLContext *gl = &s->gl;
    if (!s->vertex_array) return;
    gl->DeleteProgram(s->program);
    gl->DeleteSamplers(2, s->sampler);
    gl->DeleteFramebuffers(1, &s->read_target);
    gl->DeleteFramebuffers(1, &s->small_target);
    gl->DeleteTextures(1, &s->small);
    gl->DeleteVertexArrays(1, &s->vertex_array);
    memset(s, 0, sizeof *s);
}

static GLuint texture_of(const screen_picture *picture, mns_plane plane)
{
    return picture->frame ? mns_frame_texture(picture->frame, plane) : 0;
}

static bool is_smaller(const screen_desc *desc)
{
    return desc->drawn_width != desc->width || desc->drawn_height != desc->height;
}

/* The pictures into the framebuffer that is bound, `width` pixels wide. */
static void draw(screen *s, const screen_desc *desc, int width, int height)
{
    const GladGLContext *gl = &s->gl;
    const GLuint texture[4] = {texture_of(&desc->a, MNS_PLANE_COLOR), texture_of(&desc->b, MNS_PLANE_COLOR),
                               texture_of(&desc->a, MNS_PLANE_DEPTH), texture_of(&desc->b, MNS_PLANE_DEPTH)};
    const double square = 12.0 * width / desc->width;
    for (GLuint i = 0; i < 4; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->BindTexture(GL_TEXTURE_2D, texture[i]);
        gl->BindSampler(i, s->sampler[i < 2 && is_smaller(desc) && width == desc->width]);
    }
    gl->Viewport(0, 0, width, height);
    gl->UseProgram(s->program);
    gl->Uniform4f(0, (float)width, (float)height, (float)desc->place, (float)desc->line);
    gl->Uniform4f(1, (float)desc->a.gain, (float)desc->b.gain, (float)desc->a.t_unit, (float)desc->b.t_unit);
    gl->Uniform1f(2, (float)desc->scale);
    gl->Uniform1i(3, (GLint)desc->mode);
    gl->Uniform1f(4, (float)square);
    gl->BindVertexArray(s->vertex_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->BindVertexArray(0);
    gl->UseProgram(0);
    for (GLuint i = 0; i < 4; i++) {
        gl->BindSampler(i, 0);
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->BindTexture(GL_TEXTURE_2D, 0);
    }
    gl->ActiveTexture(GL_TEXTURE0);
}

/* The picture in its own few pixels, in bytes; what a blit makes larger costs a software renderer little. */
static void make_small(screen *s, int width, int height)
{
    const GladGLContext *gl = &s->gl;
    if (!s->small || s->small_width != width || s->small_height != height) {
        gl->DeleteTextures(1, &s->small);
        gl->GenTextures(1, &s->small);
        gl->BindTexture(GL_TEXTURE_2D, s->small);
        gl->TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, width, height);
        gl->BindTexture(GL_TEXTURE_2D, 0);
        s->small_width = width;
        s->small_height = height;
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, s->small_target);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, s->small, 0);
}

void screen_show(screen *s, const screen_desc *desc)
{
    const GladGLContext *gl = &s->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    if (!texture_of(&desc->a, MNS_PLANE_COLOR)) {
        gl->ClearColor(0.5f, 0.5f, 0.5f, 1);
        gl->Clear(GL_COLOR_BUFFER_BIT);
        return;
    }
    if (!is_smaller(desc) || desc->mode > SCREEN_B) {
        draw(s, desc, desc->width, desc->height);
        return;
    }
    make_small(s, desc->drawn_width, desc->drawn_height);
    draw(s, desc, desc->drawn_width, desc->drawn_height);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, s->small_target);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl->BlitFramebuffer(0, 0, desc->drawn_width, desc->drawn_height, 0, 0, desc->width, desc->height,
                        GL_COLOR_BUFFER_BIT, GL_LINEAR);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl->Viewport(0, 0, desc->width, desc->height);
}

double screen_distance(screen *s, const mns_frame *frame, int width, int height, int x, int y)
{
    const GladGLContext *gl = &s->gl;
    GLuint texture = mns_frame_texture(frame, MNS_PLANE_DEPTH);
    float t[2] = {INFINITY, 0};
    if (!texture || x < 0 || y < 0 || x >= width || y >= height) return INFINITY;
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, s->read_target);
    gl->FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    gl->ReadPixels(x, height - 1 - y, 1, 1, GL_RG, GL_FLOAT, t);
    gl->FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    return (double)t[0] + (double)t[1];
}

mns_status screen_grab(screen *s, int width, int height, const char *path, mns_error *error)
{
    const GladGLContext *gl = &s->gl;
    size_t pixels = (size_t)width * (size_t)height;
    unsigned char *bytes = memory_array(pixels, 4);
    mns_image image = {.width = width, .height = height, .rgba = memory_array(pixels, 4 * sizeof(float))};
    mns_status status =
        bytes && image.rgba ? MNS_OK : status_no_memory(error, "while taking a picture of the window");
    if (!status) {
        gl->BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
        gl->ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
        for (size_t i = 0; i < pixels * 4; i++) {
            size_t row = (size_t)height - 1 - i / 4 / (size_t)width;
            size_t from = (row * (size_t)width + i / 4 % (size_t)width) * 4 + i % 4;
            image.rgba[i] = i % 4 == 3 ? 1 : (float)color_linear(bytes[from] / 255.0);
        }
        status = mns_image_write(&image, path, error);
    }
    free(image.rgba);
    free(bytes);
    return status;
}

mns_status screen_check(screen *s, const char *where, mns_error *error)
{
    GLenum code = s->gl.GetError();
    if (code == GL_NO_ERROR) return MNS_OK;
    while (s->gl.GetError() != GL_NO_ERROR) {}
    return status_fail(error, MNS_ERROR_GL, "window: GL error 0x%x while %s", code, where);
}
