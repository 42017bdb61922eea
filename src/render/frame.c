#include "base/clock.h"
#include "base/memory.h"
#include "base/status.h"
#include "gl/state.h"
#include "render/render.h"

#include <string.h>

mns_status mns_frame_create(mns_renderer *renderer, mns_frame **frame, mns_error *error)
{
    if (!renderer || !frame) return status_fail(error, MNS_ERROR_USAGE, "frame: the renderer is NULL");
    mns_frame *f = calloc(1, sizeof *f);
    if (!f) return status_no_memory(error, "while making a frame");
    f->renderer = renderer;
    *frame = f;
    return MNS_OK;
}

static void drop_textures(mns_frame *f)
{
    const GladGLContext *gl = &f->renderer->device.gl;
    GLuint textures[] = {f->t,   f->normal, f->color,   f->shaded, f->work,
                         f->lit, f->terms,  f->settled, f->mesh},
           targets[] = {f->planes_target, f->shaded_target, f->lit_target};
    gl->DeleteTextures(sizeof textures / sizeof *textures, textures);
    gl->DeleteFramebuffers(sizeof targets / sizeof *targets, targets);
    f->t = f->normal = f->color = f->shaded = f->work = f->planes_target = f->shaded_target = 0;
    f->lit = f->terms = f->settled = f->mesh = f->lit_target = 0;
}

void mns_frame_destroy(mns_frame *f)
{
    if (!f) return;
    drop_textures(f);
    mns_plan_destroy(f->plan);
    free(f->t_error);
    free(f);
}

static GLuint plane_make(const GladGLContext *gl, GLenum format, int width, int height)
{
    GLuint texture;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

static GLuint target_make(const GladGLContext *gl, const GLuint *texture, int count)
{
    static const GLenum draw[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    GLuint target;
    gl->GenFramebuffers(1, &target);
    gl->BindFramebuffer(GL_FRAMEBUFFER, target);
    for (int i = 0; i < count; i++)
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, draw[i], GL_TEXTURE_2D, texture[i], 0);
    gl->DrawBuffers(count, draw);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    return target;
}

mns_status frame_prepare(mns_frame *f, const mns_plan *plan, mns_error *error)
{
    gl_device *device = &f->renderer->device;
    const GladGLContext *gl = &device->gl;
    GLenum color = plan->features & FEATURE_BLENDS ? list_color_format(plan) : 0;
    int width = plan->frame.width, height = plan->frame.height;
    free(f->t_error);
    f->t_error = NULL;
    if (plan->features & FEATURE_REFERENCE) {
        f->t_error = memory_array((size_t)width * (size_t)height, sizeof *f->t_error);
        if (!f->t_error) return status_no_memory(error, "while making a frame");
    }
    bool same = f->t && f->width == width && f->height == height;
    bool work = plan->features & FEATURE_COUNTERS;
    f->has_work = work;
    if (same && work && !f->work) f->work = plane_make(gl, GL_RGBA32F, width, height);
    bool lit = plan->features & FEATURE_LIT, mesh = plan->features & FEATURE_SOLIDS;
    if (same && f->color_format == color && f->has_lit == lit && f->has_mesh == mesh) return MNS_OK;
    drop_textures(f);
    f->t = plane_make(gl, GL_RG32F, width, height);
    f->normal = plane_make(gl, GL_RGBA32F, width, height);
    if (color) f->color = plane_make(gl, color, width, height);
    f->shaded = plane_make(gl, GL_RGBA32F, width, height);
    if (work) f->work = plane_make(gl, GL_RGBA32F, width, height);
    if (lit) {
        f->lit = plane_make(gl, GL_RGBA32F, width, height);
        f->terms = plane_make(gl, GL_RGBA32F, width, height);
        f->settled = plane_make(gl, GL_R32F, width, height);
        GLuint light[] = {f->lit, f->terms, f->settled};
        f->lit_target = target_make(gl, light, 3);
    }
    if (mesh) f->mesh = plane_make(gl, GL_R32UI, width, height);
    GLuint planes[] = {f->t, f->normal, f->color};
    f->planes_target = target_make(gl, planes, color ? 3 : 2);
    f->shaded_target = target_make(gl, &f->shaded, 1);
    f->width = width;
    f->height = height;
    f->color_format = color;
    f->has_lit = lit;
    f->has_mesh = mesh;
    mns_status status = gl_check(device, "frame", error);
    if (status) drop_textures(f);
    return status;
}

unsigned mns_frame_texture(const mns_frame *frame, mns_plane plane)
{
    switch (plane) {
    case MNS_PLANE_COLOR:
        return frame->shaded;
    case MNS_PLANE_DEPTH:
        return frame->t;
    case MNS_PLANE_NORMAL:
        return frame->normal;
    }
    return 0;
}

const mns_stats *mns_frame_stats(const mns_frame *frame)
{
    return &frame->stats;
}

const mns_plan *mns_frame_plan(const mns_frame *frame)
{
    return frame->plan;
}

static float *plane_or_none(bool wanted, size_t pixels, size_t floats, bool *failed)
{
    float *plane = wanted ? memory_array(pixels, floats * sizeof *plane) : NULL;
    *failed = *failed || (wanted && !plane);
    return plane;
}

static mns_image *image_make(const mns_frame *f)
{
    size_t pixels = (size_t)f->width * (size_t)f->height;
    uint64_t features = f->plan->features;
    mns_image *image = calloc(1, sizeof *image);
    if (!image) return NULL;
    bool failed = false;
    *image = (mns_image){
        .width = f->width,
        .height = f->height,
        .t_unit = f->plan->t_unit,
        .rgba = plane_or_none(true, pixels, 4, &failed),
        .t = plane_or_none(true, pixels, 1, &failed),
        .t_lo = plane_or_none(true, pixels, 1, &failed),
        .normal = plane_or_none(true, pixels, 3, &failed),
        .certain = plane_or_none(true, pixels, 1, &failed),
        .t_error = plane_or_none(f->t_error != NULL, pixels, 1, &failed),
        .work = plane_or_none(f->has_work, pixels, MNS_WORK_COUNT, &failed),
        .shadow = plane_or_none(features & FEATURE_SHADOWS, pixels, 1, &failed),
        .occlusion = plane_or_none(features & FEATURE_OCCLUSION, pixels, 1, &failed),
        .mirror_t = plane_or_none(features & FEATURE_MIRROR, pixels, 1, &failed),
        .refract_t = plane_or_none(features & FEATURE_REFRACTION, pixels, 1, &failed),
        .mesh = plane_or_none(features & FEATURE_SOLIDS, pixels, 1, &failed),
        .effects_certain = plane_or_none(features & FEATURE_LIT, pixels, 1, &failed),
    };
    if (!failed) return image;
    mns_image_destroy(image);
    return NULL;
}

/* Texture to memory: GL's rows run from the bottom. */
static void fetch(const GladGLContext *gl, GLuint texture, GLenum format, float *to)
{
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->GetTexImage(GL_TEXTURE_2D, 0, format, GL_FLOAT, to);
    gl->BindTexture(GL_TEXTURE_2D, 0);
}

/* The effects' terms, each to its plane where there is one. */
static void unpack_terms(const mns_frame *f, mns_image *image, float *row_store)
{
    const GladGLContext *gl = &f->renderer->device.gl;
    float *const planes[4] = {image->shadow, image->occlusion, image->mirror_t, image->refract_t};
    size_t width = (size_t)f->width, height = (size_t)f->height;
    fetch(gl, f->terms, GL_RGBA, row_store);
    for (size_t i = 0; i < width * height; i++)
        for (size_t term = 0; term < 4; term++)
            if (planes[term])
                planes[term][i] = row_store[((height - 1 - i / width) * width + i % width) * 4 + term];
    fetch(gl, f->settled, GL_RED, row_store);
    for (size_t y = 0; y < height; y++)
        memcpy(image->effects_certain + y * width, row_store + (height - 1 - y) * width,
               width * sizeof *row_store);
}

/* Which mesh is seen where. */
static void unpack_mesh(const mns_frame *f, mns_image *image, float *row_store)
{
    const GladGLContext *gl = &f->renderer->device.gl;
    size_t width = (size_t)f->width, height = (size_t)f->height;
    uint32_t *whole = (uint32_t *)(void *)row_store;
    gl->BindTexture(GL_TEXTURE_2D, f->mesh);
    gl->GetTexImage(GL_TEXTURE_2D, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, whole);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    for (size_t i = 0; i < width * height; i++) {
        size_t row = i / width, column = i % width;
        image->mesh[i] = (float)whole[(height - 1 - row) * width + column];
    }
}

static void unpack(const mns_frame *f, mns_image *image, float *row_store)
{
    const GladGLContext *gl = &f->renderer->device.gl;
    size_t width = (size_t)f->width, height = (size_t)f->height;
    if (f->t_error) memcpy(image->t_error, f->t_error, width * height * sizeof *f->t_error);
    fetch(gl, f->shaded, GL_RGBA, row_store);
    for (size_t y = 0; y < height; y++)
        for (size_t i = 0; i < width * 4; i++)
            image->rgba[y * width * 4 + i] = row_store[(height - 1 - y) * width * 4 + i];
    fetch(gl, f->t, GL_RG, row_store);
    for (size_t y = 0; y < height; y++)
        for (size_t x = 0; x < width; x++) {
            const float *from = row_store + ((height - 1 - y) * width + x) * 2;
            image->t[y * width + x] = from[0];
            image->t_lo[y * width + x] = from[1];
        }
    fetch(gl, f->normal, GL_RGBA, row_store);
    for (size_t y = 0; y < height; y++)
        for (size_t x = 0; x < width; x++) {
            const float *from = row_store + ((height - 1 - y) * width + x) * 4;
            for (size_t axis = 0; axis < 3; axis++) image->normal[(y * width + x) * 3 + axis] = from[axis];
            image->certain[y * width + x] = from[3];
        }
    if (f->has_lit) unpack_terms(f, image, row_store);
    if (image->mesh) unpack_mesh(f, image, row_store);
    if (!f->has_work) return;
    fetch(gl, f->work, GL_RGBA, row_store);
    for (size_t y = 0; y < height; y++)
        memcpy(image->work + y * width * MNS_WORK_COUNT,
               row_store + (height - 1 - y) * width * MNS_WORK_COUNT,
               width * MNS_WORK_COUNT * sizeof *row_store);
}

mns_status mns_frame_read(mns_frame *f, mns_image **result, mns_error *error)
{
    if (!f || !result || !f->plan)
        return status_fail(error, MNS_ERROR_USAGE, "frame: nothing has been drawn into it yet");
    double begin = clock_ms();
    float *store = memory_array((size_t)f->width * (size_t)f->height, 4 * sizeof(float));
    mns_image *image = image_make(f);
    gl_state state;
    if (!store || !image) {
        free(store);
        mns_image_destroy(image);
        return status_no_memory(error, "while reading a frame");
    }
    gl_state_take(&f->renderer->device, &state);
    unpack(f, image, store);
    gl_state_put_back(&f->renderer->device, &state);
    free(store);
    mns_status status = gl_check(&f->renderer->device, "reading a frame", error);
    if (status) {
        mns_image_destroy(image);
        return status;
    }
    frame_measure_noise(f, image);
    f->stats.ms[MNS_PHASE_READBACK] = clock_ms() - begin;
    *result = image;
    return MNS_OK;
}
