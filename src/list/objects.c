/* Textures, framebuffers and buffers of the list passes. */
#include "list/passes.h"
#include "list/uniforms.h"

static void texture_make(gl_device *device, GLuint *texture, GLenum format, int width, int height)
{
    const GladGLContext *gl = &device->gl;
    if (!*texture) gl->GenTextures(1, texture);
    gl->BindTexture(GL_TEXTURE_2D, *texture);
    bool integer = format == GL_R32UI;
    gl->TexImage2D(GL_TEXTURE_2D, 0, (GLint)format, width, height, 0,
                   integer ? GL_RED_INTEGER : GL_DEPTH_COMPONENT, integer ? GL_UNSIGNED_INT : GL_FLOAT, NULL);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl->BindTexture(GL_TEXTURE_2D, 0);
}

static void target_make(gl_device *device, GLuint *target, GLenum attachment, GLuint texture)
{
    const GladGLContext *gl = &device->gl;
    if (!*target) gl->GenFramebuffers(1, target);
    gl->BindFramebuffer(GL_FRAMEBUFFER, *target);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
    GLenum none = GL_NONE, color = GL_COLOR_ATTACHMENT0;
    gl->DrawBuffers(1, attachment == GL_COLOR_ATTACHMENT0 ? &color : &none);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
}

/* A framebuffer with no attachment: fragments run for their stores alone. */
static void target_make_bare(gl_device *device, GLuint *target, int width, int height)
{
    const GladGLContext *gl = &device->gl;
    if (!*target) gl->GenFramebuffers(1, target);
    gl->BindFramebuffer(GL_FRAMEBUFFER, *target);
    gl->FramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
    gl->FramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
    GLenum none = GL_NONE;
    gl->DrawBuffers(1, &none);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
}

static mns_status buffers(list_passes *p, gl_device *device, const mns_plan *plan, mns_error *error)
{
    size_t pixels = (size_t)p->width * (size_t)p->height;
    size_t block = plan->limits.max_storage_block, entry = 4 * sizeof(uint32_t);
    p->redo_capacity = (block - sizeof(list_counts)) / entry; /* a larger frame is drawn in parts */
    if (p->redo_capacity > pixels) p->redo_capacity = pixels;
    struct {
        gl_buffer *buffer;
        const char *what;
        size_t size;
    } wanted[] = {
        {&p->redo, "list of pixels to resolve", sizeof(list_counts) + p->redo_capacity * entry},
        {&p->view, "view", VIEW_VECTORS * 4 * sizeof(float)},
        {&p->nodes, "node pool", plan->pool_nodes * LIST_NODE},
        {&p->counter, "node counter", sizeof(uint32_t)},
    };
    size_t count = plan->features & (FEATURE_TILES | FEATURE_TREE) ? 2 : sizeof wanted / sizeof *wanted;
    for (size_t i = 0; i < count; i++) {
        mns_status status =
            gl_buffer_reserve(device, wanted[i].buffer, wanted[i].what, wanted[i].size, block, error);
        if (status) return status;
    }
    if (!(plan->features & FEATURE_FAR)) return MNS_OK;
    return gl_buffer_reserve(device, &p->far_block, "far view", FAR_VECTORS * 4 * sizeof(double), block,
                             error);
}

mns_status list_passes_prepare(list_passes *p, gl_device *device, const mns_plan *plan, mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    int width = plan->frame.width, height = plan->frame.height;
    bool tiles = plan->features & (FEATURE_TILES | FEATURE_TREE), host = plan->features & FEATURE_HOST;
    bool depth = !tiles && plan->features & (FEATURE_CORE | FEATURE_HOST);
    bool resized = width != p->width || height != p->height;
    if (!p->vertex_array) gl->GenVertexArrays(1, &p->vertex_array);
    if (resized) { /* what this plan leaves out must not come back in the old size */
        gl->DeleteTextures(1, &p->heads);
        gl->DeleteTextures(1, &p->core_depth);
        gl->DeleteTextures(1, &p->host_depth);
        gl->DeleteFramebuffers(1, &p->depth_target);
        gl->DeleteFramebuffers(1, &p->heads_target);
        gl->DeleteFramebuffers(1, &p->bare_target);
        p->heads = p->core_depth = p->host_depth = 0;
        p->depth_target = p->heads_target = p->bare_target = 0;
    }
    if (!tiles && !p->heads) {
        texture_make(device, &p->heads, GL_R32UI, width, height);
        target_make(device, &p->heads_target, GL_COLOR_ATTACHMENT0, p->heads);
    }
    if (depth && !p->core_depth) {
        texture_make(device, &p->core_depth, GL_DEPTH_COMPONENT32F, width, height);
        target_make(device, &p->depth_target, GL_DEPTH_ATTACHMENT, p->core_depth);
    }
    if (!tiles && !p->bare_target) target_make_bare(device, &p->bare_target, width, height);
    if (host && !p->host_depth) texture_make(device, &p->host_depth, GL_DEPTH_COMPONENT32F, width, height);
    p->width = width;
    p->height = height;
    mns_status status = buffers(p, device, plan, error);
    p->node_capacity =
        p->nodes.size / LIST_NODE < plan->pool_most ? p->nodes.size / LIST_NODE : plan->pool_most;
    if (!status) status = gl_check(device, "list buffers", error);
    if (status) p->width = p->height = 0; /* made anew by the next draw */
    return status;
}

void list_passes_free(list_passes *p, gl_device *device)
{
    const GladGLContext *gl = &device->gl;
    gl_buffer *all[] = {&p->balls,     &p->balls_low,  &p->cores,  &p->colors,    &p->nodes,
                        &p->counter,   &p->redo,       &p->view,   &p->view_wide, &p->far_block,
                        &p->backwards, &p->tile_heads, &p->squares};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) gl_buffer_free(device, all[i]);
    GLuint textures[] = {p->heads,       p->core_depth,  p->host_depth,
                         p->ball_texels, p->node_texels, p->head_texels};
    GLuint targets[] = {p->heads_target, p->depth_target, p->bare_target};
    gl->DeleteTextures(sizeof textures / sizeof *textures, textures);
    gl->DeleteFramebuffers(sizeof targets / sizeof *targets, targets);
    gl->DeleteVertexArrays(1, &p->vertex_array);
    *p = (list_passes){0};
}

mns_status list_passes_compile(gl_device *device, gl_programs *programs, const mns_plan *plan,
                               GLuint program[SHADER_COUNT], mns_error *error)
{
    for (int i = 0; i < SHADER_COUNT; i++) {
        char defines[PLAN_DEFINES];
        gl_shader shader = {.defines = defines};
        program[i] = 0;
        /* What only some pixels or balls may need is compiled when they do. */
        if (!plan_needs(plan, i) || i == SHADER_WALK || i == SHADER_RESOLVE || i == SHADER_ORDER ||
            i == SHADER_TREE_WALK || i == SHADER_TREE_RESOLVE || i == SHADER_EFFECTS_RESOLVE)
            continue;
        plan_shader_files(i, &shader.vertex, &shader.fragment, &shader.compute);
        plan_shader_defines(plan, i, defines);
        mns_status status = gl_program_get(device, programs, &shader, &program[i], error);
        if (status) return status;
    }
    return MNS_OK;
}
