#include "shade/solids.h"

#include "base/status.h"
#include "shade/shade.h"
#include "trace/passes.h"

#include <string.h>

enum { UNIT_TEXELS = 10, UNIT_MESH = 11, UNIFORM_REGION = 3, UNIFORM_RADIUS = 4 };

/* Places of which floats hold products of two, and their sums; glsl/solids.glsl multiplies no such product by
 * another. */
#define FLOATS_MOST 1e15

typedef uint32_t texel[4];

static uint32_t bits(float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    return word;
}

static float outwards(double value, float towards)
{
    float near = (float)value;
    bool within = towards < 0 ? (double)near > value : (double)near < value;
    return within ? nextafterf(near, towards) : near;
}

static void put_node(texel *to, const solid_node *node, const double origin[3])
{
    for (int a = 0; a < 3; a++) {
        to[0][a] = bits(outwards(node->lo[a] - origin[a], -INFINITY));
        to[1][a] = bits(outwards(node->hi[a] - origin[a], INFINITY));
    }
    to[0][3] = node->first;
    to[1][3] = node->count;
}

static void put_corner(texel *to, const double corner[3], const double origin[3])
{
    float low[3];
    for (int a = 0; a < 3; a++) {
        double place = corner[a] - origin[a];
        float high = (float)place;
        to[0][a] = bits(high);
        low[a] = (float)(place - (double)high);
    }
    to[0][3] = bits(low[0]);
    to[1][0] = bits(low[1]), to[1][1] = bits(low[2]), to[1][2] = to[1][3] = 0;
}

static void put_triangle(texel *to, const solid_triangle *t)
{
    for (int k = 0; k < 3; k++) to[0][k] = t->corner[k], to[1][k] = t->beside[k];
    to[0][3] = t->mesh;
    to[1][3] = 0;
}

/* The colours come last, and anew each time. */
static void fill(const shade_solids *s, const solid_set *set, const mns_plan *plan, texel *to)
{
    const double *origin = plan->tree_origin;
    for (size_t i = 0; i < set->node_count; i++) put_node(to + 2 * i, &set->node[i], origin);
    for (size_t i = 0; i < set->triangle_count; i++)
        put_triangle(to + s->place[0] + 2 * i, &set->triangle[i]);
    for (size_t i = 0; i < set->corner_count; i++)
        put_corner(to + s->place[1] + 2 * i, set->corner[i], origin);
}

static mns_status check(const solid_set *set, const mns_plan *plan, size_t texels, mns_error *error)
{
    size_t most = (size_t)plan->limits.max_texture_buffer;
    double farthest = 0;
    if (texels > most)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "meshes of %zu triangles: %zu texels, this driver's buffer textures hold %zu",
                           set->triangle_count, texels, most);
    for (int a = 0; a < 3; a++)
        farthest = fmax(
            farthest, fmax(fabs(set->lo[a] - plan->tree_origin[a]), fabs(set->hi[a] - plan->tree_origin[a])));
    if (farthest <= FLOATS_MOST) return MNS_OK;
    return status_fail(error, MNS_ERROR_UNSUPPORTED,
                       "a mesh that reaches %g from the field: floats hold %g; take the method reference",
                       farthest * plan->unit, FLOATS_MOST * plan->unit);
}

static mns_status send(shade_solids *s, gl_device *device, const mns_plan *plan, const solid_set *set,
                       mns_error *error)
{
    void *data;
    size_t texels = 2 * set->node_count + 2 * set->triangle_count + 2 * set->corner_count;
    size_t size = (texels + plan->look.mesh_count) * sizeof(texel);
    s->version = 0;
    s->place[0] = (uint32_t)(2 * set->node_count);
    s->place[1] = (uint32_t)(s->place[0] + 2 * set->triangle_count);
    s->place[2] = (uint32_t)texels;
    s->place[3] = (uint32_t)set->node_count;
    mns_status status = check(set, plan, texels + plan->look.mesh_count, error);
    if (!status) status = gl_buffer_reserve(device, &s->buffer, "meshes", size, 0, error);
    do {
        if (!status) status = gl_buffer_map(device, &s->buffer, size, &data, error);
        if (status) return status;
        fill(s, set, plan, data);
    } while (!gl_buffer_unmap(device, &s->buffer));
    memcpy(s->origin, plan->tree_origin, sizeof s->origin);
    return MNS_OK;
}

mns_status shade_solids_send(shade_solids *s, gl_device *device, const mns_plan *plan,
                             const solid_files *files, mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    if (s->version != files->version || memcmp(s->origin, plan->tree_origin, sizeof s->origin)) {
        mns_status status = send(s, device, plan, &files->set, error);
        if (status) return status;
        s->version = files->version;
    }
    gl->BindBuffer(GL_ARRAY_BUFFER, s->buffer.id);
    for (size_t i = 0; i < plan->look.mesh_count; i++) {
        float color[4] = {0, 0, 0, 1};
        for (int c = 0; c < 3; c++) color[c] = shade_linear(plan->mesh[i].color[c]);
        gl->BufferSubData(GL_ARRAY_BUFFER, (GLintptr)((s->place[2] + i) * sizeof(texel)), sizeof color,
                          color);
    }
    gl->BindBuffer(GL_ARRAY_BUFFER, 0);
    return gl_check(device, "meshes", error);
}

void shade_solids_bind(const shade_solids *s, gl_device *device, GLuint mesh)
{
    const GladGLContext *gl = &device->gl;
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_TEXELS);
    gl->BindTexture(GL_TEXTURE_BUFFER, s->texture);
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_MESH);
    gl->BindTexture(GL_TEXTURE_2D, mesh);
}

void shade_solids_first(shade_solids *s, list_passes *p, gl_device *device, const mns_plan *plan,
                        GLuint program, GLuint block, const GLuint plane[3], uint64_t *undecided)
{
    static const GLenum format[3] = {GL_RG32F, GL_RGBA32F, GL_R32UI};
    const GladGLContext *gl = &device->gl;
    const list_counts none = {0};
    list_counts counts;
    int width = plan->frame.width, height = plan->frame.height;
    if (!s->texture) gl->GenTextures(1, &s->texture);
    gl->ActiveTexture(GL_TEXTURE0 + UNIT_TEXELS);
    gl->BindTexture(GL_TEXTURE_BUFFER, s->texture);
    gl->TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32UI, s->buffer.id);
    for (GLuint i = 0; i < 3; i++)
        gl->BindImageTexture(1 + i, plane[i], 0, GL_FALSE, 0, GL_READ_WRITE, format[i]);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 1, block);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, p->redo.id);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, p->redo.id);
    gl->BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof none, &none);
    gl->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    gl->UseProgram(program);
    gl->Uniform4i(UNIFORM_REGION, 0, 0, width, height);
    gl->Uniform1d(UNIFORM_RADIUS, plan->radius_max);
    gl->DispatchCompute((GLuint)(width + 7) / 8, (GLuint)(height + 7) / 8, 1);
    trace_finish(p, device, &counts);
    *undecided += counts.undecided;
}

void shade_solids_free(shade_solids *s, gl_device *device)
{
    gl_buffer_free(device, &s->buffer);
    if (s->texture) device->gl.DeleteTextures(1, &s->texture);
    *s = (shade_solids){0};
}
