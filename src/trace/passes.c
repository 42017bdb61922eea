#include "trace/passes.h"

#include "base/memory.h"
#include "base/status.h"
#include "shade/ball_colors.h"

#include <stddef.h>
#include <string.h>

enum { BINDING_BLOCKS = 7 };
enum { UNIFORM_BASE = 0, UNIFORM_CELL = 1, UNIFORM_ROOT = 2, UNIFORM_REGION = 3, UNIFORM_SECANT_STEPS = 4 };

/* ---- What is traced ---- */

static mns_status map(gl_device *device, const mns_plan *plan, gl_buffer *buffer, const char *what,
                      size_t size, void **data, mns_error *error)
{
    if (!size) size = 16;
    mns_status status = gl_buffer_reserve(device, buffer, what, size, plan->limits.max_storage_block, error);
    return status ? status : gl_buffer_map(device, buffer, size, data, error);
}

static mns_status upload_nodes(trace_passes *t, gl_device *device, const mns_plan *plan,
                               const fbvh_tree *tree, mns_error *error)
{
    void *pair, *leaf;
    bool kept;
    t->grid = trace_grid_of(tree);
    do {
        mns_status status =
            map(device, plan, &t->pairs, "the tree", t->grid.pair_count * sizeof(trace_pair), &pair, error);
        if (status) return status;
        status = map(device, plan, &t->leaves, "the tree's leaves", t->grid.leaf_count * sizeof(trace_leaf),
                     &leaf, error);
        if (!status) trace_pack_nodes(tree, &t->grid, pair, leaf);
        kept = gl_buffer_unmap(device, &t->pairs);
        if (status) return status;
        kept = gl_buffer_unmap(device, &t->leaves) && kept;
    } while (!kept);
    return MNS_OK;
}

static mns_status upload_references(trace_passes *t, gl_device *device, const mns_plan *plan,
                                    const fbvh_tree *tree, mns_error *error)
{
    uint32_t *data;
    size_t count = tree->reference_count;
    do {
        mns_status status = map(device, plan, &t->references, "the tree's references",
                                (count + 1) * sizeof *data, (void **)&data, error);
        if (status) return status;
        if (count) memcpy(data, tree->reference, count * sizeof *data);
        data[count] = 0; /* looked at past the last leaf's end */
    } while (!gl_buffer_unmap(device, &t->references));
    return MNS_OK;
}

static mns_status upload_balls(trace_passes *t, gl_device *device, const mns_plan *plan,
                               const fbvh_tree *tree, mns_error *error)
{
    void *data;
    size_t size = tree->ball_count * plan_tree_floats(plan) * sizeof(float);
    do {
        mns_status status = map(device, plan, &t->balls, "balls", size, &data, error);
        if (status) return status;
        trace_pack_balls(tree, plan, data);
    } while (!gl_buffer_unmap(device, &t->balls));
    return MNS_OK;
}

static mns_status keep_index(trace_passes *t, const fbvh_tree *tree, mns_error *error)
{
    if (tree->ball_count > t->index_capacity) {
        uint32_t *larger = memory_resize(t->index, tree->ball_count, sizeof *larger);
        if (!larger) return status_no_memory(error, "while sending a tree");
        t->index = larger;
        t->index_capacity = tree->ball_count;
    }
    if (tree->ball_count) memcpy(t->index, tree->index, tree->ball_count * sizeof *t->index);
    t->count = tree->ball_count;
    return MNS_OK;
}

mns_status trace_upload(trace_passes *t, gl_device *device, const mns_plan *plan, const fbvh_tree *tree,
                        mns_error *error)
{
    mns_status status = keep_index(t, tree, error);
    if (!status) status = trace_blocks_take(&t->blocks, tree, error);
    if (!status) status = upload_nodes(t, device, plan, tree, error);
    if (!status) status = upload_references(t, device, plan, tree, error);
    if (!status) status = upload_balls(t, device, plan, tree, error);
    return status;
}

mns_status trace_upload_colors(trace_passes *t, gl_device *device, const mns_plan *plan,
                               const mns_field *field, mns_error *error)
{
    void *data;
    size_t size = t->count * ball_colors_words(plan) * sizeof(uint32_t);
    do {
        mns_status status = map(device, plan, &t->colors, "colours", size, &data, error);
        if (status) return status;
        trace_pack_colors(t->index, t->count, field, plan, data);
    } while (!gl_buffer_unmap(device, &t->colors));
    return MNS_OK;
}

mns_status trace_upload_low(trace_passes *t, gl_device *device, const mns_plan *plan, const mns_field *field,
                            mns_error *error)
{
    void *data;
    size_t size = t->count * plan_tree_floats(plan) * sizeof(float);
    do {
        mns_status status = map(device, plan, &t->balls_low, "balls", size, &data, error);
        if (status) return status;
        trace_pack_low(t->index, t->count, field, plan, data);
    } while (!gl_buffer_unmap(device, &t->balls_low));
    return MNS_OK;
}

/* ---- Passes ---- */

static void bind_texels(gl_device *device, GLuint *texture, GLenum unit, GLenum format,
                        const gl_buffer *buffer)
{
    const GladGLContext *gl = &device->gl;
    if (!*texture) gl->GenTextures(1, texture);
    gl->ActiveTexture(unit);
    gl->BindTexture(GL_TEXTURE_BUFFER, *texture);
    gl->TexBuffer(GL_TEXTURE_BUFFER, format, buffer->id);
}

void trace_bind(trace_passes *t, list_passes *p, gl_device *device, const mns_plan *plan)
{
    static const GLenum formats[] = {[4] = GL_RGBA32F, [5] = GL_R32F};
    const GladGLContext *gl = &device->gl;
    if (plan->features & FEATURE_TEXELS) {
        bind_texels(device, &t->ball_texels, GL_TEXTURE2, formats[plan_tree_floats(plan)], &t->balls);
        bind_texels(device, &t->pair_texels, GL_TEXTURE3, GL_RGBA32UI, &t->pairs);
        bind_texels(device, &t->leaf_texels, GL_TEXTURE4, GL_RGBA32UI, &t->leaves);
        bind_texels(device, &t->reference_texels, GL_TEXTURE5, GL_R32UI, &t->references);
    }
    const struct {
        GLuint binding, id;
    } blocks[] = {{0, t->balls.id},  {1, t->balls_low.id}, {2, t->pairs.id},     {3, p->redo.id},
                  {4, t->colors.id}, {5, t->leaves.id},    {6, t->references.id}};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++)
        if (blocks[i].id) gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, blocks[i].binding, blocks[i].id);
}

static void bind_tree(trace_passes *t, list_passes *p, gl_device *device, const mns_plan *plan,
                      const GLuint plane[TRACE_PLANES])
{
    const GLenum plane_formats[TRACE_PLANES] = {GL_RG32F, GL_RGBA32F, list_color_format(plan), GL_RGBA32F};
    const GladGLContext *gl = &device->gl;
    trace_bind(t, p, device, plan);
    if (p->far_block.id) gl->BindBufferBase(GL_UNIFORM_BUFFER, 1, p->far_block.id);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, p->host_depth);
    for (GLuint i = 0; i < TRACE_PLANES; i++)
        if (plane[i]) gl->BindImageTexture(1 + i, plane[i], 0, GL_FALSE, 0, GL_WRITE_ONLY, plane_formats[i]);
}

void trace_use(const trace_passes *t, gl_device *device, GLuint program)
{
    const GladGLContext *gl = &device->gl;
    gl->UseProgram(program);
    gl->Uniform3fv(UNIFORM_BASE, 1, t->grid.base);
    gl->Uniform3fv(UNIFORM_CELL, 1, t->grid.cell);
    gl->Uniform1ui(UNIFORM_ROOT, t->grid.root);
}

void trace_finish(list_passes *p, gl_device *device, list_counts *counts)
{
    const GladGLContext *gl = &device->gl;
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                      GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                      GL_FRAMEBUFFER_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT);
    gl_buffer_fetch(device, p->redo.id, sizeof *counts, counts);
}

static mns_status upload_blocks(trace_passes *t, gl_device *device, const mns_plan *plan, list_region region,
                                mns_error *error)
{
    mns_status status = trace_blocks_list(&t->blocks, plan, region, error);
    if (status) return status;
    const uint32_t *list = t->blocks.list;
    return gl_buffer_send(device, &t->block_list, "blocks of pixels", list, (list[0] + 1) * sizeof *list,
                          plan->limits.max_storage_block, error);
}

mns_status trace_cast(trace_passes *t, list_passes *p, gl_device *device, const mns_plan *plan,
                      GLuint program, GLuint target, const GLuint plane[TRACE_PLANES], list_region region,
                      list_counts *counts, mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    const list_counts none = {0};
    const GLuint most = 65535; /* groups that GL promises a side */
    mns_status status = upload_blocks(t, device, plan, region, error);
    if (status) return status;
    GLuint blocks = t->blocks.list[0];
    list_clear_planes(p, device, plan, target, region);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, p->redo.id);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof none, &none);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, p->view.id);
    bind_tree(t, p, device, plan, plane);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BLOCKS, t->block_list.id);
    trace_use(t, device, program);
    list_view_loose(device, p->view_now);
    gl->Uniform4i(UNIFORM_REGION, region.x, region.y, region.x + region.width, region.y + region.height);
    if (plan->options.solver == MNS_SOLVER_SECANT)
        gl->Uniform1i(UNIFORM_SECANT_STEPS, plan->options.secant_steps);
    gl->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    if (blocks) gl->DispatchCompute(blocks < most ? blocks : most, (blocks + most - 1) / most, 1);
    trace_finish(p, device, counts);
    return MNS_OK;
}

void trace_resolve(trace_passes *t, list_passes *p, gl_device *device, const mns_plan *plan, GLuint program,
                   bool wide, const GLuint plane[TRACE_PLANES], list_counts *counts)
{
    const GladGLContext *gl = &device->gl;
    const GLuint most = 65535; /* groups that GL promises a side */
    const uint32_t zero = 0;
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, wide ? p->view_wide.id : p->view.id);
    bind_tree(t, p, device, plan, plane);
    trace_use(t, device, program);
    do {
        GLuint groups = (counts->redo + RESOLVE_GROUP - 1) / RESOLVE_GROUP;
        gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, p->redo.id);
        gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, offsetof(list_counts, unfinished), sizeof zero, &zero);
        gl->DispatchCompute(groups < most ? groups : most, (groups + most - 1) / most, 1);
        trace_finish(p, device, counts);
    } while (counts->unfinished);
}

void trace_passes_free(trace_passes *t, gl_device *device)
{
    gl_buffer *all[] = {&t->balls,  &t->balls_low,  &t->colors,    &t->pairs,
                        &t->leaves, &t->references, &t->block_list};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) gl_buffer_free(device, all[i]);
    GLuint textures[] = {t->ball_texels, t->pair_texels, t->leaf_texels, t->reference_texels};
    device->gl.DeleteTextures(sizeof textures / sizeof *textures, textures);
    trace_blocks_free(&t->blocks);
    free(t->index);
    *t = (trace_passes){0};
}
