#include "list/passes.h"

#include <math.h>
#include <stddef.h>

enum {
    UNIFORM_LAST_BALL = 0,
    UNIFORM_CAPACITY = 1,
    UNIFORM_SEED = 0,
    UNIFORM_TWO = 0,
    UNIFORM_INNER = 2,
    UNIFORM_REGION = 1,
    UNIFORM_TILE_GRID = 3,
    UNIFORM_SQUARE_VIEW = 4
};

static void scissor(gl_device *device, const list_passes *p, list_region region)
{
    device->gl.Viewport(0, 0, p->width, p->height);
    bool whole = region.width == p->width && region.height == p->height;
    if (whole)
        device->gl.Disable(GL_SCISSOR_TEST);
    else
        device->gl.Enable(GL_SCISSOR_TEST);
    device->gl.Scissor(region.x, region.y, region.width, region.height);
}

/* The vertex array reads balls [first, ...): a vertex each for points, an instance each for rectangles. */
static void attributes(list_passes *p, gl_device *device, const mns_plan *plan, size_t first, bool instanced)
{
    const GladGLContext *gl = &device->gl;
    size_t stride = plan->ball_floats * sizeof(float), at = first * stride;
    gl->BindVertexArray(p->vertex_array);
    gl->BindBuffer(GL_ARRAY_BUFFER, p->balls.id);
    gl->EnableVertexAttribArray(0);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, (GLsizei)stride, (const void *)at);
    gl->VertexAttribDivisor(0, instanced);
    if (plan->features & FEATURE_RADII) {
        gl->EnableVertexAttribArray(1);
        gl->VertexAttribPointer(1, 1, GL_FLOAT, GL_FALSE, (GLsizei)stride,
                                (const void *)(at + 3 * sizeof(float)));
        gl->VertexAttribDivisor(1, instanced);
    } else {
        gl->DisableVertexAttribArray(1);
    }
    if (plan->features & FEATURE_CORE_RADII) {
        gl->BindBuffer(GL_ARRAY_BUFFER, p->cores.id);
        gl->EnableVertexAttribArray(2);
        gl->VertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, 0, (const void *)(first * sizeof(float)));
        gl->VertexAttribDivisor(2, instanced);
    } else {
        gl->DisableVertexAttribArray(2);
    }
    gl->BindBuffer(GL_ARRAY_BUFFER, 0);
}

/* Points nearest first, or farthest first so that lists, which grow at their head, begin with the nearest. */
static void draw_points(list_passes *p, gl_device *device, const mns_plan *plan, const list_order *order,
                        bool backwards)
{
    const GladGLContext *gl = &device->gl;
    GLsizei count = (GLsizei)(order->count - order->quads);
    attributes(p, device, plan, 0, false);
    if (!backwards) {
        gl->DrawArrays(GL_POINTS, (GLint)order->quads, count);
        return;
    }
    size_t skipped = p->backwards.size / sizeof(uint32_t) - order->count;
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, p->backwards.id);
    gl->DrawElements(GL_POINTS, count, GL_UNSIGNED_INT, (const void *)(skipped * sizeof(uint32_t)));
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
}

/* Every ball in view as its rectangle or point: for the core pass, then for gather, which counts nodes. */
static void draw_balls(list_passes *p, gl_device *device, const mns_plan *plan, const list_order *order,
                       GLuint quads, GLuint points, bool gather)
{
    const GladGLContext *gl = &device->gl;
    bool some_points = order->count > order->quads;
    if (some_points && gather) {
        gl->UseProgram(points);
        gl->Uniform1ui(UNIFORM_CAPACITY, (GLuint)p->node_capacity);
        draw_points(p, device, plan, order, true);
    }
    if (order->quads) {
        gl->UseProgram(quads);
        if (gather) gl->Uniform1ui(UNIFORM_LAST_BALL, (GLuint)order->quads - 1);
        if (gather) gl->Uniform1ui(UNIFORM_CAPACITY, (GLuint)p->node_capacity);
        /* Their copies in reverse follow the balls. */
        attributes(p, device, plan, gather ? order->count : 0, true);
        gl->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, (GLsizei)order->quads);
    }
    if (some_points && !gather) {
        gl->UseProgram(points);
        draw_points(p, device, plan, order, false);
    }
    gl->BindVertexArray(0);
}

static void draw_screen(list_passes *p, gl_device *device, GLuint program)
{
    const GladGLContext *gl = &device->gl;
    gl->UseProgram(program);
    gl->BindVertexArray(p->vertex_array);
    for (GLuint i = 0; i < 3; i++) gl->DisableVertexAttribArray(i);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->BindVertexArray(0);
}

static void set_inner(gl_device *device, const GLuint program[SHADER_COUNT], float inner)
{
    const GladGLContext *gl = &device->gl;
    const plan_shader both[] = {SHADER_CORE_QUADS, SHADER_CORE_POINTS};
    for (int i = 0; i < 2; i++) {
        if (!program[both[i]]) continue;
        gl->UseProgram(program[both[i]]);
        gl->Uniform1f(UNIFORM_INNER, inner);
    }
}

void list_core_depth(list_passes *p, gl_device *device, const mns_plan *plan, const list_order *order,
                     const GLuint program[SHADER_COUNT], list_region region)
{
    const GladGLContext *gl = &device->gl;
    const GLfloat farthest = 1;
    gl->BindFramebuffer(GL_FRAMEBUFFER, p->depth_target);
    scissor(device, p, region);
    gl->DepthMask(GL_TRUE);
    gl->ClearBufferfv(GL_DEPTH, 0, &farthest);
    gl->Enable(GL_DEPTH_TEST);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, p->view.id);
    if (plan->features & FEATURE_HOST) {
        gl->DepthFunc(GL_ALWAYS);
        gl->ActiveTexture(GL_TEXTURE0);
        gl->BindTexture(GL_TEXTURE_2D, p->host_depth);
        draw_screen(p, device, program[SHADER_HOST_DEPTH]);
    }
    if (!(plan->features & FEATURE_CORE)) return;
    gl->DepthFunc(GL_LESS);
    if (!(plan->features & FEATURE_FLAT_CORES)) {
        draw_balls(p, device, plan, order, program[SHADER_CORE_QUADS], program[SHADER_CORE_POINTS], false);
        return;
    }
    /* Each sphere as a stack of squares, wide and deep to small and near: without a fragment shader several
     * cost less than the one sphere. */
    static const float inner[] = {0.97f, 0.75f};
    for (size_t i = 0; i < sizeof inner / sizeof *inner; i++) {
        set_inner(device, program, inner[i]);
        draw_balls(p, device, plan, order, program[SHADER_CORE_QUADS], program[SHADER_CORE_POINTS], false);
    }
}

size_t list_gather(list_passes *p, gl_device *device, const mns_plan *plan, const list_order *order,
                   const GLuint program[SHADER_COUNT], list_region region)
{
    const GladGLContext *gl = &device->gl;
    bool tested = plan->features & (FEATURE_CORE | FEATURE_HOST), paper = plan->features & FEATURE_PAPER;
    const GLuint none[4] = {0, 0, 0, 0}, zero = 0;
    gl->BindFramebuffer(GL_FRAMEBUFFER, p->heads_target);
    scissor(device, p, region);
    gl->ClearBufferuiv(GL_COLOR, 0, none);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, p->nodes.id);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof none,
                      none); /* node 0 is looked at past every list's end */
    gl->BindBuffer(GL_ATOMIC_COUNTER_BUFFER, p->counter.id);
    gl->BufferSubData(GL_ATOMIC_COUNTER_BUFFER, 0, sizeof zero, &zero);
    gl->BindFramebuffer(GL_FRAMEBUFFER, tested && !paper ? p->depth_target : p->bare_target);
    gl->DepthMask(GL_FALSE); /* early tests would write depth even for discarded fragments */
    gl->DepthFunc(GL_LEQUAL);
    if (tested && !paper)
        gl->Enable(GL_DEPTH_TEST);
    else
        gl->Disable(GL_DEPTH_TEST);
    if (tested && paper) {
        gl->ActiveTexture(GL_TEXTURE1);
        gl->BindTexture(GL_TEXTURE_2D, p->core_depth);
    }
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, p->view.id);
    gl->BindBufferBase(GL_ATOMIC_COUNTER_BUFFER, 0, p->counter.id);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, p->nodes.id);
    gl->BindImageTexture(0, p->heads, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
    gl->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    draw_balls(p, device, plan, order, program[SHADER_GATHER_QUADS], program[SHADER_GATHER_POINTS], true);
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_ATOMIC_COUNTER_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                      GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    GLuint wanted = 0;
    gl_buffer_fetch(device, p->counter.id, sizeof wanted, &wanted);
    gl->Disable(GL_DEPTH_TEST);
    return (size_t)wanted + 1; /* node 0 ends the lists */
}

static void read_counts(list_passes *p, gl_device *device, list_counts *counts)
{
    const GladGLContext *gl = &device->gl;
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    gl_buffer_fetch(device, p->redo.id, sizeof *counts, counts);
}

/* A compute pass over a region's lists, a pixel an invocation. */
static void visit_lists(list_passes *p, gl_device *device, list_region region)
{
    const GladGLContext *gl = &device->gl;
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, p->nodes.id);
    gl->BindImageTexture(0, p->heads, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
    gl->Uniform4i(UNIFORM_REGION, region.x, region.y, region.width, region.height);
    gl->DispatchCompute((GLuint)(region.width + 7) / 8, (GLuint)(region.height + 7) / 8, 1);
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

void list_sort_nodes(list_passes *p, gl_device *device, GLuint program, list_region region,
                     list_counts *counts)
{
    const GladGLContext *gl = &device->gl;
    const list_counts none = {0};
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, p->redo.id);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof none, &none);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, p->redo.id);
    gl->UseProgram(program);
    gl->Uniform1i(UNIFORM_TWO, 2);
    visit_lists(p, device, region);
    read_counts(p, device, counts);
}

void list_shuffle(list_passes *p, gl_device *device, const mns_plan *plan, const GLuint program[SHADER_COUNT],
                  list_region region)
{
    const GladGLContext *gl = &device->gl;
    gl->UseProgram(program[SHADER_SHUFFLE]);
    gl->Uniform1ui(UNIFORM_SEED, plan->options.shuffle);
    visit_lists(p, device, region);
}

static void bind_texels(gl_device *device, GLuint *texture, GLenum unit, GLenum format, GLuint buffer)
{
    const GladGLContext *gl = &device->gl;
    if (!*texture) gl->GenTextures(1, texture);
    gl->ActiveTexture(unit);
    gl->BindTexture(GL_TEXTURE_BUFFER, *texture);
    gl->TexBuffer(GL_TEXTURE_BUFFER, format, buffer);
}

static void bind_tiles(list_passes *p, gl_device *device, const mns_plan *plan, GLuint program)
{
    const GladGLContext *gl = &device->gl;
    gl->UseProgram(program);
    gl->Uniform4iv(UNIFORM_TILE_GRID, 1, p->tile_grid);
    if (plan->features & FEATURE_TEXELS)
        bind_texels(device, &p->head_texels, GL_TEXTURE4, GL_RG32UI, p->tile_heads.id);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, p->tile_heads.id);
}

/* What both the cast and resolve read. */
static void bind_lists(list_passes *p, gl_device *device, const mns_plan *plan, GLuint program)
{
    static const GLenum formats[] = {[3] = GL_RGB32F, [4] = GL_RGBA32F, [5] = GL_R32F};
    const GladGLContext *gl = &device->gl;
    if (plan->features & FEATURE_TEXELS) {
        bind_texels(device, &p->ball_texels, GL_TEXTURE2, formats[plan->ball_floats], p->balls.id);
        if (p->nodes.id) bind_texels(device, &p->node_texels, GL_TEXTURE3, GL_RGBA32UI, p->nodes.id);
    }
    if (p->far_block.id) gl->BindBufferBase(GL_UNIFORM_BUFFER, 1, p->far_block.id);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, p->balls.id);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, p->nodes.id);
    if (plan->features & FEATURE_TILES) bind_tiles(p, device, plan, program);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, p->redo.id);
    if (p->colors.id) gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, p->colors.id);
    if (p->heads) gl->BindImageTexture(0, p->heads, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, p->host_depth);
}

void list_clear_planes(list_passes *p, gl_device *device, const mns_plan *plan, GLuint target,
                       list_region region)
{
    static const GLfloat miss[3][4] = {{INFINITY}, {0, 0, 0, 1}};
    const GladGLContext *gl = &device->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, target);
    scissor(device, p, region);
    for (int i = 0; i < (plan->features & FEATURE_BLENDS ? 3 : 2); i++)
        gl->ClearBufferfv(GL_COLOR, i, miss[i]);
}

/* Runs the cast where something is listed. */
static void draw_squares(list_passes *p, gl_device *device, GLuint program, list_region region)
{
    const GladGLContext *gl = &device->gl;
    const GLsizei width = plan_square_round(region.width), height = plan_square_round(region.height);
    gl->Viewport(region.x, region.y, width, height); /* what passes the frame's edges is cut off there */
    gl->UseProgram(program);
    gl->Uniform2f(UNIFORM_SQUARE_VIEW, (GLfloat)width, (GLfloat)height);
    gl->BindVertexArray(p->vertex_array);
    for (GLuint i = 1; i < 3; i++) gl->DisableVertexAttribArray(i);
    gl->BindBuffer(GL_ARRAY_BUFFER, p->squares.id);
    gl->EnableVertexAttribArray(0);
    gl->VertexAttribPointer(0, 3, GL_UNSIGNED_SHORT, GL_FALSE, 4 * sizeof(uint16_t), NULL);
    gl->VertexAttribDivisor(0, 0);
    gl->DrawArrays(GL_POINTS, 0, (GLsizei)p->square_count);
    gl->BindBuffer(GL_ARRAY_BUFFER, 0);
    gl->BindVertexArray(0);
}

void list_cast(list_passes *p, gl_device *device, const mns_plan *plan, const GLuint program[SHADER_COUNT],
               GLuint target, list_region region, list_counts *counts)
{
    const GladGLContext *gl = &device->gl;
    const list_counts none = {0};
    gl->BindFramebuffer(GL_FRAMEBUFFER, target);
    scissor(device, p, region);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, p->redo.id);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof none, &none);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, p->view.id);
    bind_lists(p, device, plan, program[SHADER_CAST]);
    if (plan->features & FEATURE_SQUARES) {
        list_clear_planes(p, device, plan, target, region);
        if (p->square_count) draw_squares(p, device, program[SHADER_CAST], region);
    } else
        draw_screen(p, device, program[SHADER_CAST]);
    read_counts(p, device, counts);
}

static void dispatch_resolve(list_passes *p, gl_device *device, list_counts *counts)
{
    const GladGLContext *gl = &device->gl;
    const uint32_t zero = 0;
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, p->redo.id);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, offsetof(list_counts, unfinished), sizeof zero, &zero);
    const GLuint most = 65535, groups = (counts->redo + RESOLVE_GROUP - 1) / RESOLVE_GROUP;
    gl->DispatchCompute(groups < most ? groups : most, (groups + most - 1) / most,
                        1); /* GL promises 65,535 a side */
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                      GL_PIXEL_BUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    read_counts(p, device, counts);
}

void list_resolve(list_passes *p, gl_device *device, const mns_plan *plan, GLuint program, bool wide,
                  const GLuint plane[3], list_counts *counts)
{
    const GladGLContext *gl = &device->gl;
    bind_lists(p, device, plan, program);
    gl->UseProgram(program);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, wide ? p->view_wide.id : p->view.id);
    if (wide) gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, p->balls_low.id);
    gl->BindImageTexture(1, plane[0], 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32F);
    gl->BindImageTexture(2, plane[1], 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    if (plane[2]) gl->BindImageTexture(3, plane[2], 0, GL_FALSE, 0, GL_WRITE_ONLY, list_color_format(plan));
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    do {
        dispatch_resolve(p, device, counts);
    } while (counts->unfinished);
}
