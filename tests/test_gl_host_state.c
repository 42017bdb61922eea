/* A host's GL state: whatever it is, it is in nobody's way, and the host finds it as it was. */
#include "support/host_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const struct {
    GLenum name;
    int count;
} STATES[] = {
    {GL_CURRENT_PROGRAM, 1},
    {GL_VERTEX_ARRAY_BINDING, 1},
    {GL_DRAW_FRAMEBUFFER_BINDING, 1},
    {GL_READ_FRAMEBUFFER_BINDING, 1},
    {GL_ACTIVE_TEXTURE, 1},
    {GL_ARRAY_BUFFER_BINDING, 1},
    {GL_ELEMENT_ARRAY_BUFFER_BINDING, 1},
    {GL_UNIFORM_BUFFER_BINDING, 1},
    {GL_SHADER_STORAGE_BUFFER_BINDING, 1},
    {GL_ATOMIC_COUNTER_BUFFER_BINDING, 1},
    {GL_PIXEL_PACK_BUFFER_BINDING, 1},
    {GL_PIXEL_UNPACK_BUFFER_BINDING, 1},
    {GL_COPY_READ_BUFFER_BINDING, 1},
    {GL_COPY_WRITE_BUFFER_BINDING, 1},
    {GL_TEXTURE_BUFFER, 1},
    {GL_VIEWPORT, 4},
    {GL_SCISSOR_BOX, 4},
    {GL_DEPTH_RANGE, 2},
    {GL_DEPTH_FUNC, 1},
    {GL_DEPTH_WRITEMASK, 1},
    {GL_COLOR_WRITEMASK, 4},
    {GL_DEPTH_CLEAR_VALUE, 1},
    {GL_COLOR_CLEAR_VALUE, 4},
    {GL_BLEND_SRC_RGB, 1},
    {GL_BLEND_DST_RGB, 1},
    {GL_BLEND_SRC_ALPHA, 1},
    {GL_BLEND_DST_ALPHA, 1},
    {GL_BLEND_EQUATION_RGB, 1},
    {GL_BLEND_EQUATION_ALPHA, 1},
    {GL_POLYGON_MODE, 1},
    {GL_POLYGON_OFFSET_FACTOR, 1},
    {GL_POINT_SIZE, 1},
    {GL_PRIMITIVE_RESTART_INDEX, 1},
    {GL_PACK_ALIGNMENT, 1},
    {GL_PACK_ROW_LENGTH, 1},
    {GL_PACK_SKIP_ROWS, 1},
    {GL_PACK_SKIP_PIXELS, 1},
    {GL_UNPACK_ALIGNMENT, 1},
    {GL_UNPACK_ROW_LENGTH, 1},
    {GL_CULL_FACE, 1},
    {GL_BLEND, 1},
    {GL_DEPTH_TEST, 1},
    {GL_STENCIL_TEST, 1},
    {GL_SCISSOR_TEST, 1},
    {GL_POLYGON_OFFSET_FILL, 1},
    {GL_PRIMITIVE_RESTART, 1},
    {GL_PRIMITIVE_RESTART_FIXED_INDEX, 1},
    {GL_PROGRAM_POINT_SIZE, 1},
    {GL_RASTERIZER_DISCARD, 1},
    {GL_DEPTH_CLAMP, 1},
    {GL_FRAMEBUFFER_SRGB, 1},
    {GL_COLOR_LOGIC_OP, 1},
    {GL_SAMPLE_MASK, 1},
    {GL_SAMPLE_ALPHA_TO_COVERAGE, 1},
    {GL_SAMPLE_COVERAGE, 1},
    {GL_CLIP_DISTANCE0, 1},
};

enum { STATE_COUNT = sizeof STATES / sizeof *STATES, UNITS = 5 };

typedef struct state_list {
    GLfloat value[STATE_COUNT][4];
    GLint texture[UNITS], texels[UNITS], sampler[UNITS], image[UNITS][6];
    GLint64 storage[UNITS][3], uniforms[UNITS][3], counters[3], clip[2];
} state_list;

static void query_indexed(const GladGLContext *gl, GLenum buffer, GLenum start, GLenum size, GLuint at,
                          GLint64 to[3])
{
    GLint name = 0;
    gl->GetIntegeri_v(buffer, at, &name);
    to[0] = name;
    gl->GetInteger64i_v(start, at, &to[1]);
    gl->GetInteger64i_v(size, at, &to[2]);
}

static void query(draw_fixture *d, state_list *s)
{
    static const GLenum image[6] = {GL_IMAGE_BINDING_NAME,  GL_IMAGE_BINDING_LEVEL,  GL_IMAGE_BINDING_LAYERED,
                                    GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT};
    const GladGLContext *gl = &d->gl.gl;
    memset(s, 0, sizeof *s);
    for (size_t i = 0; i < STATE_COUNT; i++) gl->GetFloatv(STATES[i].name, s->value[i]);
    for (GLuint i = 0; i < UNITS; i++) {
        query_indexed(gl, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                      GL_SHADER_STORAGE_BUFFER_SIZE, i, s->storage[i]);
        query_indexed(gl, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, i,
                      s->uniforms[i]);
        for (int k = 0; k < 6; k++) gl->GetIntegeri_v(image[k], i, &s->image[i][k]);
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->GetIntegerv(GL_TEXTURE_BINDING_2D, &s->texture[i]);
        gl->GetIntegerv(GL_TEXTURE_BINDING_BUFFER, &s->texels[i]);
        gl->GetIntegerv(GL_SAMPLER_BINDING, &s->sampler[i]);
    }
    query_indexed(gl, GL_ATOMIC_COUNTER_BUFFER_BINDING, GL_ATOMIC_COUNTER_BUFFER_START,
                  GL_ATOMIC_COUNTER_BUFFER_SIZE, 0, s->counters);
    if (gl->ClipControl) {
        gl->GetInteger64v(GL_CLIP_ORIGIN, &s->clip[0]);
        gl->GetInteger64v(GL_CLIP_DEPTH_MODE, &s->clip[1]);
    }
    gl->ActiveTexture((GLenum)s->value[4][0]);
}

static void expect_state(const state_list *a, const state_list *b)
{
    for (size_t i = 0; i < STATE_COUNT; i++)
        for (int k = 0; k < STATES[i].count; k++)
            if (a->value[i][k] != b->value[i][k])
                fail_msg("state 0x%04x[%d] was %g, is %g", STATES[i].name, k, (double)a->value[i][k],
                         (double)b->value[i][k]);
    assert_memory_equal(a->texture, b->texture, sizeof a->texture);
    assert_memory_equal(a->texels, b->texels, sizeof a->texels);
    assert_memory_equal(a->sampler, b->sampler, sizeof a->sampler);
    assert_memory_equal(a->image, b->image, sizeof a->image);
    assert_memory_equal(a->storage, b->storage, sizeof a->storage);
    assert_memory_equal(a->uniforms, b->uniforms, sizeof a->uniforms);
    assert_memory_equal(a->counters, b->counters, sizeof a->counters);
    assert_memory_equal(a->clip, b->clip, sizeof a->clip);
}

typedef struct host_objects {
    GLuint buffer[4], texture[2], sampler, vertex_array, program;
} host_objects;

static GLuint make_program(const GladGLContext *gl)
{
    static const char *const text = "#version 430 core\nvoid main() { gl_Position = vec4(0.0); }\n";
    GLuint program = gl->CreateProgram(), shader = gl->CreateShader(GL_VERTEX_SHADER);
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->AttachShader(program, shader);
    gl->DeleteShader(shader);
    gl->LinkProgram(program);
    return program;
}

static void bind_objects(const GladGLContext *gl, host_objects *o)
{
    gl->GenBuffers(4, o->buffer);
    for (int i = 0; i < 4; i++) {
        gl->BindBuffer(GL_COPY_WRITE_BUFFER, o->buffer[i]);
        gl->BufferData(GL_COPY_WRITE_BUFFER, 4096, NULL, GL_STATIC_DRAW);
    }
    gl->GenTextures(2, o->texture);
    gl->GenSamplers(1, &o->sampler);
    gl->SamplerParameteri(o->sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl->SamplerParameteri(o->sampler, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl->GenVertexArrays(1, &o->vertex_array);
    gl->BindVertexArray(o->vertex_array);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, o->buffer[0]);
    gl->BindBuffer(GL_ARRAY_BUFFER, o->buffer[1]);
    gl->BindTexture(GL_TEXTURE_2D, o->texture[0]);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, GL_R32UI, 4, 4);
    for (GLuint i = 0; i < UNITS; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->BindTexture(GL_TEXTURE_2D, o->texture[0]);
        gl->BindTexture(GL_TEXTURE_BUFFER, o->texture[1]);
        gl->BindSampler(i, o->sampler);
        gl->BindImageTexture(i, o->texture[0], 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32UI);
        gl->BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, o->buffer[2], 256 * i, 256);
        gl->BindBufferRange(GL_UNIFORM_BUFFER, i, o->buffer[3], 256 * i, 512);
    }
    gl->TexBuffer(GL_TEXTURE_BUFFER, GL_R32F, o->buffer[1]);
    gl->BindBufferRange(GL_ATOMIC_COUNTER_BUFFER, 0, o->buffer[0], 16, 64);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, o->buffer[1]);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, o->buffer[2]);
    gl->BindBuffer(GL_COPY_READ_BUFFER, o->buffer[3]);
    o->program = make_program(gl);
    gl->UseProgram(o->program);
}

/* State such as a host may leave behind, most of it in the way of any drawing. */
static void set_odd_state(const GladGLContext *gl, bool on)
{
    static const GLenum switches[] = {GL_CULL_FACE,         GL_BLEND,
                                      GL_DEPTH_TEST,        GL_STENCIL_TEST,
                                      GL_SCISSOR_TEST,      GL_POLYGON_OFFSET_FILL,
                                      GL_PRIMITIVE_RESTART, GL_RASTERIZER_DISCARD,
                                      GL_DEPTH_CLAMP,       GL_COLOR_LOGIC_OP,
                                      GL_SAMPLE_MASK,       GL_SAMPLE_ALPHA_TO_COVERAGE,
                                      GL_SAMPLE_COVERAGE};
    for (size_t i = 0; i < sizeof switches / sizeof *switches; i++)
        (on ? gl->Enable : gl->Disable)(switches[i]);
    gl->CullFace(on ? GL_FRONT_AND_BACK : GL_BACK);
    gl->LogicOp(on ? GL_INVERT : GL_COPY);
    gl->StencilFunc(on ? GL_NEVER : GL_ALWAYS, 1, 0xff);
    gl->BlendFuncSeparate(on ? GL_ZERO : GL_ONE, GL_ZERO, GL_DST_COLOR, GL_SRC_ALPHA);
    gl->BlendEquationSeparate(on ? GL_FUNC_REVERSE_SUBTRACT : GL_FUNC_ADD, on ? GL_MAX : GL_FUNC_ADD);
    gl->Viewport(3, 4, on ? 5 : HOST_WIDE, on ? 6 : HOST_HIGH);
    gl->Scissor(7, 8, 9, 10);
    gl->DepthRange(on ? 0.75 : 0, on ? 0.25 : 1);
    gl->DepthFunc(on ? GL_NEVER : GL_LESS);
    gl->DepthMask(!on);
    gl->ColorMask(!on, GL_TRUE, !on, !on);
    gl->ClearDepth(on ? 0.5 : 1);
    gl->ClearColor(0.1f, 0.2f, 0.3f, 0.4f);
    gl->PolygonMode(GL_FRONT_AND_BACK, on ? GL_LINE : GL_FILL);
    gl->PolygonOffset(on ? 100 : 0, on ? 1e6f : 0);
    gl->PrimitiveRestartIndex(on ? 3 : 0);
    gl->SampleMaski(0, on ? 0 : ~0u);
    gl->SampleCoverage(on ? 0 : 1, GL_FALSE);
    gl->PointSize(on ? 7 : 1);
    gl->PixelStorei(GL_PACK_ALIGNMENT, on ? 8 : 4);
    gl->PixelStorei(GL_PACK_ROW_LENGTH, on ? 999 : 0);
    gl->PixelStorei(GL_PACK_SKIP_ROWS, on ? 2 : 0);
    gl->PixelStorei(GL_PACK_SKIP_PIXELS, on ? 3 : 0);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, on ? 2 : 4);
    gl->PixelStorei(GL_UNPACK_ROW_LENGTH, on ? 77 : 0);
    if (gl->ClipControl) gl->ClipControl(on ? GL_UPPER_LEFT : GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

static void unbind_objects(const GladGLContext *gl, host_objects *o)
{
    gl->UseProgram(0);
    gl->BindVertexArray(0);
    for (GLuint i = 0; i < UNITS; i++) gl->BindSampler(i, 0);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->DeleteBuffers(4, o->buffer); /* unbinds them, as it does the textures */
    gl->DeleteTextures(2, o->texture);
    gl->DeleteSamplers(1, &o->sampler);
    gl->DeleteVertexArrays(1, &o->vertex_array);
    gl->DeleteProgram(o->program);
}

/* Whatever the host has set, the pictures are the same, plain and on the host, and all is as it was
 * afterwards. */
static void the_hosts_state_is_in_nobodys_way_and_is_put_back(void **state)
{
    draw_fixture *d = *state;
    const GladGLContext *gl = &d->gl.gl;
    mns_view view = host_view();
    mns_field *field = host_cloud();
    mns_options options = {.moved = true};
    mns_image *plain = draw_image(d, field, &view, NULL, &options);
    host h = host_make(d, false), other = host_make(d, false);
    mns_target target = {.framebuffer = h.framebuffer, .x = 23, .y = 17, .near = 0.1, .far = 10};
    host_paint(d, &h, host_rectangle, 1.5, target.near, target.far);
    host_objects objects;
    state_list before, after;
    bind_objects(gl, &objects);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, other.framebuffer);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, h.framebuffer);
    set_odd_state(gl, true);
    query(d, &before);
    mns_image *odd = draw_image(d, field, &view, NULL, &options);
    query(d, &after);
    expect_state(&before, &after);
    host_draw_on(d, field, &view, &target);
    query(d, &after);
    expect_state(&before, &after);
    set_odd_state(gl, false);
    unbind_objects(gl, &objects);
    draw_expect_same(plain, odd, "odd state");
    host_pixels *got = host_read(d, &h);
    host_outcome seen = host_expect_nearer_wins(got, plain, &view, &target, host_rectangle, 1.5, 1e-6);
    assert_true(seen.ours > 2000 && seen.behind > 300);
    free(got);
    host_free(d, &h);
    host_free(d, &other);
    mns_image_destroy(plain);
    mns_image_destroy(odd);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_hosts_state_is_in_nobodys_way_and_is_put_back),
    };
    return cmocka_run_group_tests_name("host state", tests, draw_fixture_setup, draw_fixture_teardown);
}
