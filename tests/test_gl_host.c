/* Drawing into a host's framebuffer: the nearer one wins, depth is the host's projection's, lists are clipped
 * by what the host drew, and the host finds its GL state as it was. */
#include "support/draw_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDE = 120, HIGH = 90, HOST_WIDE = 170, HOST_HIGH = 130, HOST_PIXELS = HOST_WIDE * HOST_HIGH };
enum { BALLS = 300 };

static mns_field *cloud(void)
{
    static double position[3 * BALLS];
    uint64_t random = 21;
    for (size_t i = 0; i < 3 * (size_t)BALLS; i++) position[i] = draw_random(&random);
    return draw_field(BALLS, position, NULL, 0.14, NULL, MNS_KERNEL_POLY3);
}

static mns_view front(void)
{
    return draw_view((const double[3]){0.5, 0.8, 2.4}, (const double[3]){0.5, 0.5, 0.5}, 40, WIDE, HIGH);
}

/* ---- A host ---- */

typedef struct host {
    GLuint framebuffer, color, depth;
    bool has_stencil;
} host;

static host host_make(draw_fixture *d, bool stencil)
{
    const GladGLContext *gl = &d->gl.gl;
    host h = {.has_stencil = stencil};
    gl->GenTextures(1, &h.color);
    gl->BindTexture(GL_TEXTURE_2D, h.color);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, HOST_WIDE, HOST_HIGH);
    gl->GenTextures(1, &h.depth);
    gl->BindTexture(GL_TEXTURE_2D, h.depth);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, stencil ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT32F, HOST_WIDE,
                     HOST_HIGH);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    gl->GenFramebuffers(1, &h.framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, h.framebuffer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, h.color, 0);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                             GL_TEXTURE_2D, h.depth, 0);
    assert_int_equal(gl->CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    return h;
}

static void host_free(draw_fixture *d, host *h)
{
    GLuint textures[2] = {h->color, h->depth};
    d->gl.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    d->gl.gl.DeleteFramebuffers(1, &h->framebuffer);
    d->gl.gl.DeleteTextures(2, textures);
}

static double window_depth(double z, double near, double far)
{
    return far * (z - near) / (z * (far - near));
}

/* Magenta everywhere, at the far plane; in a rectangle blue, at depth z along the view. */
static void host_paint(draw_fixture *d, const host *h, const int rectangle[4], double z, double near,
                       double far)
{
    static const GLfloat magenta[4] = {1, 0, 1, 1}, blue[4] = {0, 0, 1, 1};
    const GladGLContext *gl = &d->gl.gl;
    const GLfloat farthest = 1, here = (float)window_depth(z, near, far);
    gl->BindFramebuffer(GL_FRAMEBUFFER, h->framebuffer);
    gl->Disable(GL_SCISSOR_TEST);
    gl->ClearBufferfv(GL_COLOR, 0, magenta);
    gl->ClearBufferfv(GL_DEPTH, 0, &farthest);
    if (!rectangle) return;
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(rectangle[0], rectangle[1], rectangle[2], rectangle[3]);
    gl->ClearBufferfv(GL_COLOR, 0, blue);
    gl->ClearBufferfv(GL_DEPTH, 0, &here);
    gl->Disable(GL_SCISSOR_TEST);
}

typedef struct pixels { /* of a host's framebuffer, row 0 at the bottom */
    uint8_t color[HOST_PIXELS][4];
    float depth[HOST_PIXELS];
} pixels;

static pixels *host_read(draw_fixture *d, const host *h)
{
    pixels *p = malloc(sizeof *p);
    assert_non_null(p);
    d->gl.gl.BindFramebuffer(GL_FRAMEBUFFER, h->framebuffer);
    d->gl.gl.ReadPixels(0, 0, HOST_WIDE, HOST_HIGH, GL_RGBA, GL_UNSIGNED_BYTE, p->color);
    d->gl.gl.ReadPixels(0, 0, HOST_WIDE, HOST_HIGH, GL_DEPTH_COMPONENT, GL_FLOAT, p->depth);
    return p;
}

static void draw_on(draw_fixture *d, const mns_field *field, const mns_view *view, const mns_target *target)
{
    mns_error error;
    if (mns_renderer_draw_on(d->renderer, field, view, NULL, NULL, target, d->frame, &error) != MNS_OK)
        fail_msg("%s", error.text);
    d->stats = *mns_frame_stats(d->frame);
}

/* ---- What the host should hold ---- */

/* Depth along the view of a pixel's hit; infinite on a miss. */
static double hit_depth(const mns_view *view, const mns_image *image, int x, int y)
{
    size_t at = (size_t)y * WIDE + (size_t)x;
    double high = 2 * tan(view->fov * 3.14159265358979323846 / 360) / view->height;
    double across = (x + 0.5 - 0.5 * WIDE) * high, up = (0.5 * HIGH - y - 0.5) * high;
    return ((double)image->t[at] + (double)image->t_lo[at]) / sqrt(1 + across * across + up * up);
}

static int to_srgb8(double c)
{
    return (int)floor(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055) + 0.5);
}

static bool same_color(const uint8_t got[4], const float linear[4])
{
    for (int c = 0; c < 3; c++)
        if (abs(got[c] - to_srgb8(fmin((double)linear[c], 1))) > 1) return false;
    return got[3] == 255;
}

static bool is_host(const uint8_t got[4], bool in_rectangle)
{
    return got[0] == (in_rectangle ? 0 : 255) && got[1] == 0 && got[2] == 255 && got[3] == 255;
}

typedef struct outcome {
    size_t ours, behind,
        kept; /* pixels that we drew; that hit, but behind the host; that missed or lie outside */
} outcome;

/* Every pixel of the host's framebuffer against the plain draw: which one is nearer, its colour, its depth.
 */
static outcome expect_nearer_wins(const pixels *got, const mns_image *plain, const mns_view *view,
                                  const mns_target *target, const int rectangle[4], double z,
                                  double depth_slack)
{
    outcome seen = {0};
    for (int y = 0; y < HOST_HIGH; y++)
        for (int x = 0; x < HOST_WIDE; x++) {
            size_t at = (size_t)y * HOST_WIDE + (size_t)x;
            int vx = x - target->x, vy = HIGH - 1 - (y - target->y);
            bool in_view = vx >= 0 && vx < WIDE && vy >= 0 && vy < HIGH;
            bool covered = rectangle && x >= rectangle[0] && x < rectangle[0] + rectangle[2] &&
                           y >= rectangle[1] && y < rectangle[1] + rectangle[3];
            double host_z = covered ? z : target->far,
                   ours = in_view ? hit_depth(view, plain, vx, vy) : INFINITY;
            if (fabs(ours - host_z) < 1e-5 * host_z) continue; /* rounding may say either */
            bool drawn = ours < host_z && ours > target->near;
            double depth = drawn     ? window_depth(ours, target->near, target->far)
                           : covered ? window_depth(z, target->near, target->far)
                                     : 1;
            const float *color = &plain->rgba[in_view ? 4 * ((size_t)vy * WIDE + (size_t)vx) : 0];
            if (drawn ? !same_color(got->color[at], color) : !is_host(got->color[at], covered))
                fail_msg("pixel %d,%d: colour %d,%d,%d; hit at %g, host at %g", x, y, got->color[at][0],
                         got->color[at][1], got->color[at][2], ours, host_z);
            if (fabs((double)got->depth[at] - depth) > depth_slack)
                fail_msg("pixel %d,%d: depth %.9g, expected %.9g", x, y, (double)got->depth[at], depth);
            seen.ours += drawn;
            seen.behind += !drawn && isfinite(ours);
            seen.kept += !isfinite(ours);
        }
    return seen;
}

/* ---- The tests ---- */

static const int in_the_middle[4] = {45, 40, 70, 50};

/* Over a 32-bit and over a 24-bit depth buffer, the view in the middle of the framebuffer. */
static void the_nearer_one_wins_at_every_pixel(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    mns_field *field = cloud();
    mns_image *plain = draw_image(d, field, &view, NULL, NULL);
    for (int stencil = 0; stencil < 2; stencil++) {
        host h = host_make(d, stencil);
        mns_target target = {.framebuffer = h.framebuffer, .x = 23, .y = 17, .near = 0.1, .far = 10};
        host_paint(d, &h, in_the_middle, 1.5, target.near, target.far);
        draw_on(d, field, &view, &target);
        pixels *got = host_read(d, &h);
        outcome seen = expect_nearer_wins(got, plain, &view, &target, in_the_middle, 1.5, 1e-6);
        if (seen.ours < 1000 || seen.behind < 300) fail_msg("%zu ours, %zu behind", seen.ours, seen.behind);
        free(got);
        host_free(d, &h);
        draw_fixture_check(d);
    }
    mns_image_destroy(plain);
    mns_field_destroy(field);
}

static void what_lies_outside_the_clip_planes_is_not_drawn(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    mns_field *field = cloud();
    mns_image *plain = draw_image(d, field, &view, NULL, NULL);
    host h = host_make(d, false);
    mns_target target = {.framebuffer = h.framebuffer, .near = 1.5, .far = 2};
    host_paint(d, &h, NULL, 0, target.near, target.far);
    draw_on(d, field, &view, &target);
    pixels *got = host_read(d, &h);
    outcome seen = expect_nearer_wins(got, plain, &view, &target, NULL, 0, 1e-6);
    assert_true(seen.ours > 1000 && seen.behind > 300);
    free(got);
    host_free(d, &h);
    mns_image_destroy(plain);
    mns_field_destroy(field);
}

/* The host covers the whole view in front of half the field: its lists are cut there, and a cover in front of
 * all of it leaves no lists at all. The frame's planes have misses behind the host. */
static void a_hosts_depth_clips_the_lists(void **state)
{
    draw_fixture *d = *state;
    static const int all[4] = {0, 0, HOST_WIDE, HOST_HIGH};
    static const double depths[] = {1.45, 1.0};
    mns_view view = front();
    mns_field *field = cloud();
    host h = host_make(d, false);
    mns_target target = {.framebuffer = h.framebuffer, .near = 0.1, .far = 10};
    host_paint(d, &h, NULL, 0, target.near, target.far);
    draw_on(d, field, &view, &target);
    uint64_t nodes = d->stats.list_nodes;
    for (int i = 0; i < 2; i++) {
        host_paint(d, &h, all, depths[i], target.near, target.far);
        draw_on(d, field, &view, &target);
        if (d->stats.list_nodes * 4 > nodes * 3)
            fail_msg("%llu nodes behind a cover at %g, %llu without", (unsigned long long)d->stats.list_nodes,
                     depths[i], (unsigned long long)nodes);
        nodes = d->stats.list_nodes;
    }
    assert_int_equal(nodes, 0);
    mns_image *image;
    mns_error error;
    assert_int_equal(mns_frame_read(d->frame, &image, &error), MNS_OK);
    assert_int_equal(draw_count_hits(image), 0);
    mns_image_destroy(image);
    host_free(d, &h);
    mns_field_destroy(field);
}

static void a_far_eye_is_tested_against_the_hosts_depth(void **state)
{
    draw_fixture *d = *state;
    const double distance = 140; /* 1000 radii */
    mns_view view = front();
    view.eye[1] = 0.5, view.eye[2] = 0.5 + distance;
    view.fov = 2 * atan(0.8 / distance) * 180 / 3.14159265358979323846;
    mns_field *field = cloud();
    mns_image *plain = draw_image(d, field, &view, NULL, NULL);
    host h = host_make(d, false);
    mns_target target = {
        .framebuffer = h.framebuffer, .x = 23, .y = 17, .near = distance - 3, .far = distance + 3};
    double z = distance - 0.35;
    host_paint(d, &h, in_the_middle, z, target.near, target.far);
    draw_on(d, field, &view, &target);
    pixels *got = host_read(d, &h);
    outcome seen = expect_nearer_wins(got, plain, &view, &target, in_the_middle, z, 1e-5);
    assert_true(seen.ours > 2000 && seen.behind > 300);
    free(got);
    host_free(d, &h);
    mns_image_destroy(plain);
    mns_field_destroy(field);
}

static void plain_draws_go_on_as_before(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    mns_field *field = cloud();
    mns_image *before = draw_image(d, field, &view, NULL, NULL);
    host h = host_make(d, false);
    mns_target target = {.framebuffer = h.framebuffer, .near = 0.1, .far = 10};
    host_paint(d, &h, in_the_middle, 1.2, target.near, target.far);
    draw_on(d, field, &view, &target);
    mns_image *after = draw_image(d, field, &view, NULL, NULL);
    draw_expect_same(before, after, "after a host");
    mns_image_destroy(before);
    mns_image_destroy(after);
    host_free(d, &h);
    mns_field_destroy(field);
}

static void a_target_needs_clip_planes(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = cloud();
    mns_view view = front();
    mns_error error;
    const mns_target bad[] = {{.near = 0, .far = 1}, {.near = 2, .far = 1}, {.near = NAN, .far = 1}};
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(
            mns_renderer_draw_on(d->renderer, field, &view, NULL, NULL, &bad[i], d->frame, &error),
            MNS_ERROR_USAGE);
    assert_int_equal(mns_renderer_draw_on(d->renderer, field, &view, NULL, NULL, NULL, d->frame, &error),
                     MNS_ERROR_USAGE);
    mns_field_destroy(field);
}

/* ---- The host's GL state ---- */

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
    mns_view view = front();
    mns_field *field = cloud();
    mns_options options = {.moved = true};
    mns_image *plain = draw_image(d, field, &view, NULL, &options);
    host h = host_make(d, false), other = host_make(d, false);
    mns_target target = {.framebuffer = h.framebuffer, .x = 23, .y = 17, .near = 0.1, .far = 10};
    host_paint(d, &h, in_the_middle, 1.5, target.near, target.far);
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
    draw_on(d, field, &view, &target);
    query(d, &after);
    expect_state(&before, &after);
    set_odd_state(gl, false);
    unbind_objects(gl, &objects);
    draw_expect_same(plain, odd, "odd state");
    pixels *got = host_read(d, &h);
    outcome seen = expect_nearer_wins(got, plain, &view, &target, in_the_middle, 1.5, 1e-6);
    assert_true(seen.ours > 2000 && seen.behind > 300);
    free(got);
    host_free(d, &h);
    host_free(d, &other);
    mns_image_destroy(plain);
    mns_image_destroy(odd);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* ---- Two renderers ---- */

static void two_renderers_on_two_contexts_do_not_meet(void **state)
{
    draw_fixture *d = *state;
    mns_error error;
    void *second;
    mns_view view = front(), smaller = front();
    smaller.width = 64, smaller.height = 48;
    mns_field *field = cloud(),
              *one = draw_field(1, (const double[3]){0.5, 0.5, 0.5}, NULL, 0.6, NULL, MNS_KERNEL_POLY2);
    mns_image *first[3], *other[3];
    assert_int_equal(draw_fixture_setup(&second), 0);
    draw_fixture *e = second;
    for (int i = 0; i < 3; i++) {
        assert_int_equal(mns_context_make_current(d->gl.context, &error), MNS_OK);
        first[i] = draw_image(d, field, &view, NULL, &(mns_options){.moved = i == 1});
        assert_int_equal(mns_context_make_current(e->gl.context, &error), MNS_OK);
        other[i] = draw_image(e, i == 1 ? field : one, i == 1 ? &view : &smaller, NULL, NULL);
    }
    draw_expect_same(first[0], first[1], "first renderer");
    draw_expect_same(first[0], first[2], "first renderer");
    draw_expect_same(first[0], other[1], "the same scene in the second renderer");
    draw_expect_same(other[0], other[2], "second renderer");
    assert_true(draw_count_hits(other[0]) > 100);
    draw_fixture_teardown(&second);
    assert_int_equal(mns_context_make_current(d->gl.context, &error), MNS_OK);
    mns_image *last = draw_image(d, field, &view, NULL, NULL);
    draw_expect_same(first[0], last, "after the second renderer's end");
    mns_image_destroy(last);
    for (int i = 0; i < 3; i++) {
        mns_image_destroy(first[i]);
        mns_image_destroy(other[i]);
    }
    mns_field_destroy(field);
    mns_field_destroy(one);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearer_one_wins_at_every_pixel),
        cmocka_unit_test(what_lies_outside_the_clip_planes_is_not_drawn),
        cmocka_unit_test(a_hosts_depth_clips_the_lists),
        cmocka_unit_test(a_far_eye_is_tested_against_the_hosts_depth),
        cmocka_unit_test(plain_draws_go_on_as_before),
        cmocka_unit_test(a_target_needs_clip_planes),
        cmocka_unit_test(the_hosts_state_is_in_nobodys_way_and_is_put_back),
        cmocka_unit_test(two_renderers_on_two_contexts_do_not_meet),
    };
    return cmocka_run_group_tests_name("host", tests, draw_fixture_setup, draw_fixture_teardown);
}
