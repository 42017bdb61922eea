/* What the plan leaves out is never made: programs, buffers, textures and passes, counted in a real context;
 * and what did not change is not made again. */
#include "render/render.h"
#include "support/draw_fixture.h"
#include "support/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define PROGRAM(name)  (1u << SHADER_##name)
#define BASE_PROGRAMS  (PROGRAM(CORE_POINTS) | PROGRAM(GATHER_POINTS) | PROGRAM(CAST) | PROGRAM(SHADE))
#define LARGE_PROGRAMS (PROGRAM(CORE_QUADS) | PROGRAM(GATHER_QUADS))
#define SMALL          .width = 64, .height = 48

/* What only some scenes need, of what a renderer and a frame hold. */
enum {
    BUFFER_CORES = 1,
    BUFFER_COLORS = 2,
    BUFFER_FAR = 4,
    TEXTURE_CORE_DEPTH = 8,
    TEXTURE_HOST_DEPTH = 16,
    PLANE_COLOR = 32,
    PLANE_LIT = 64,
    BUFFER_LIGHTS = 128,
    BUFFER_WALKS = 256,
    TREE = 512,
    BUFFERS = BUFFER_CORES | BUFFER_COLORS | BUFFER_FAR | BUFFER_LIGHTS | BUFFER_WALKS
};
/* Balls, their backward indices, nodes, node counter, pixels to resolve, view, shading; and of a tree its
 * balls, pairs of boxes, leaves, references. */
enum { BASE_BUFFERS = 7, TREE_BUFFERS = 4 };

typedef struct leave_out_case {
    scene s;
    unsigned programs; /* a bit a plan_shader */
    unsigned objects;
    unsigned passes;
} leave_out_case;

#define ONE .desc = {.count = 1, .position = {.data = scene_row}, .uniform_radius = 1}

#define LIT_PROGRAMS (BASE_PROGRAMS | PROGRAM(EFFECTS_LIST))
#define LIT_OBJECTS  (TEXTURE_CORE_DEPTH | PLANE_LIT | BUFFER_LIGHTS)
static const mns_light lamp = {.kind = MNS_LIGHT_POINT, .position = {3, 4, 5}};

static const leave_out_case cases[] = {
    {{"one ball", ONE, .view = {SMALL}}, BASE_PROGRAMS, TEXTURE_CORE_DEPTH, 7},
    {{"no core", .desc = {.count = 1, .position = {.data = scene_row}, .uniform_radius = 1, .iso = 1.5},
      .view = {SMALL}},
     PROGRAM(GATHER_POINTS) | PROGRAM(CAST) | PROGRAM(SHADE),
     0,
     6},
    {{"a negative strength", .desc = {SCENE_UNIT, .strength = {.data = scene_carving}}, .view = {SMALL}},
     PROGRAM(GATHER_POINTS) | PROGRAM(CAST) | PROGRAM(SHADE),
     0,
     6},
    {{"no balls", .view = {SMALL}},
     PROGRAM(GATHER_QUADS) | PROGRAM(GATHER_POINTS) | PROGRAM(CAST) | PROGRAM(SHADE),
     0,
     6},
    {{"strengths", .desc = {SCENE_UNIT, .strength = {.data = scene_gains}}, .view = {SMALL}},
     BASE_PROGRAMS,
     TEXTURE_CORE_DEPTH | BUFFER_CORES,
     7},
    {{"colours", .desc = {SCENE_UNIT}, .view = {SMALL}, .look = {.color_by = "heat"}},
     BASE_PROGRAMS,
     TEXTURE_CORE_DEPTH | BUFFER_COLORS | PLANE_COLOR,
     7},
    {{"far", ONE,
      .view = {SMALL, .set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT, .eye = {-1, 0, 100}, .look_at = {-1, 0, 0},
               .fov = 1}},
     BASE_PROGRAMS,
     TEXTURE_CORE_DEPTH | BUFFER_FAR,
     7},
    {{"near", ONE,
      .view = {SMALL, .set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT, .eye = {-1, 0, 0.9}, .look_at = {-1, 0, 0}}},
     BASE_PROGRAMS | LARGE_PROGRAMS,
     TEXTURE_CORE_DEPTH,
     7},
    {{"shuffled", ONE, .view = {SMALL}, .options = {.shuffle = 3}},
     BASE_PROGRAMS | PROGRAM(SHUFFLE),
     TEXTURE_CORE_DEPTH,
     8},
    {{"a host", ONE, .view = {SMALL}, .host = true},
     BASE_PROGRAMS | PROGRAM(HOST_DEPTH) | PROGRAM(HOST_DRAW),
     TEXTURE_CORE_DEPTH | TEXTURE_HOST_DEPTH,
     9},
    {{"a lamp, and no rays", ONE, .view = {SMALL}, .look = {.lights = &lamp, .light_count = 1}},
     LIT_PROGRAMS | PROGRAM(EFFECTS_PLAIN),
     LIT_OBJECTS,
     8},
    {{"a mirror", ONE, .view = {SMALL}, .look = {.effects = {.reflections = 1}}},
     LIT_PROGRAMS | PROGRAM(EFFECTS),
     LIT_OBJECTS | BUFFER_WALKS | TREE,
     9},
    {{"shadows", ONE, .view = {SMALL},
      .look = {.light = MNS_LIGHT_DIRECTIONAL, .effects = {.shadows = true}}},
     LIT_PROGRAMS | PROGRAM(EFFECTS) | PROGRAM(EFFECTS_ANY),
     LIT_OBJECTS | BUFFER_WALKS | TREE,
     9},
};

/* A host's framebuffer of the small size: colour and depth, cleared. */
typedef struct host_canvas {
    GLuint framebuffer, buffer[2];
} host_canvas;

static host_canvas host_begin(const GladGLContext *gl)
{
    host_canvas c;
    const GLenum format[] = {GL_RGBA8, GL_DEPTH_COMPONENT32F},
                 point[] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
    gl->GenFramebuffers(1, &c.framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, c.framebuffer);
    gl->GenRenderbuffers(2, c.buffer);
    for (int i = 0; i < 2; i++) {
        gl->BindRenderbuffer(GL_RENDERBUFFER, c.buffer[i]);
        gl->RenderbufferStorage(GL_RENDERBUFFER, format[i], 64, 48);
        gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, point[i], GL_RENDERBUFFER, c.buffer[i]);
    }
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    return c;
}

static void host_end(const GladGLContext *gl, host_canvas *c)
{
    gl->DeleteFramebuffers(1, &c->framebuffer);
    gl->DeleteRenderbuffers(2, c->buffer);
}

static mns_stats draw_scene(draw_fixture *d, const scene *s, const mns_field *field)
{
    mns_error error;
    mns_status status;
    const mns_options options = draw_by_lists(&s->options);
    if (s->host) {
        host_canvas canvas = host_begin(&d->gl.gl);
        mns_target target = {.framebuffer = canvas.framebuffer, .near = 0.1, .far = 100};
        status =
            mns_renderer_draw_on(d->renderer, field, &s->view, &s->look, &options, &target, d->frame, &error);
        host_end(&d->gl.gl, &canvas);
    } else {
        status = mns_renderer_draw(d->renderer, field, &s->view, &s->look, &options, d->frame, &error);
    }
    if (status) fail_msg("%s: %s", s->name, error.text);
    return *mns_frame_stats(d->frame);
}

/* The late programs and buffers that the frame's own counts say were needed. */
static unsigned late_programs(const draw_fixture *d, const mns_stats *stats)
{
    unsigned late = 0;
    if (d->renderer->trace.balls_low.id) late |= PROGRAM(EFFECTS_RESOLVE);
    if (stats->fallbacks.active_overflow + stats->fallbacks.root_cap) late |= PROGRAM(WALK);
    if (stats->fallbacks.undecided_float) late |= PROGRAM(RESOLVE);
    if (stats->fallbacks.lists_sorted) late |= PROGRAM(ORDER);
    return late;
}

static unsigned late_buffers(const draw_fixture *d, const mns_stats *stats)
{
    unsigned low = stats->fallbacks.undecided_float ? 1 : 0, tree_low = d->renderer->trace.balls_low.id != 0;
    return low + tree_low + (low || tree_low); /* low words, and the view as doubles */
}

/* Asking for the program of each expected shader makes no new one; and there are no others. */
static void expect_programs(draw_fixture *d, const char *name, unsigned programs)
{
    mns_renderer *r = d->renderer;
    size_t count = r->programs.count;
    if (count != (size_t)__builtin_popcount(programs))
        fail_msg("%s: %zu programs, expected %d", name, count, __builtin_popcount(programs));
    for (int i = 0; i < SHADER_COUNT; i++) {
        char defines[PLAN_DEFINES];
        gl_shader shader = {.defines = defines};
        GLuint id;
        if (!(programs >> i & 1)) continue;
        plan_shader_files((plan_shader)i, &shader.vertex, &shader.fragment, &shader.compute);
        plan_shader_defines(d->frame->plan, (plan_shader)i, defines);
        assert_int_equal(gl_program_get(&r->device, &r->programs, &shader, &id, NULL), MNS_OK);
        if (r->programs.count != count) fail_msg("%s: shader %d was not made", name, i);
    }
}

static unsigned objects_of(const draw_fixture *d)
{
    const list_passes *p = &d->renderer->passes;
    return (p->cores.id ? BUFFER_CORES : 0u) | (p->colors.id ? BUFFER_COLORS : 0u) |
           (p->far_block.id ? BUFFER_FAR : 0u) | (p->core_depth ? TEXTURE_CORE_DEPTH : 0u) |
           (p->host_depth ? TEXTURE_HOST_DEPTH : 0u) | (d->frame->color ? PLANE_COLOR : 0u) |
           (d->frame->lit ? PLANE_LIT : 0u) | (d->renderer->effects.block.id ? BUFFER_LIGHTS : 0u) |
           (d->renderer->effects.store.id ? BUFFER_WALKS : 0u) | (d->renderer->trace.balls.id ? TREE : 0u);
}

/* A renderer without a past. */
static void renew(draw_fixture *d)
{
    mns_frame_destroy(d->frame);
    mns_renderer_destroy(d->renderer);
    assert_int_equal(mns_renderer_create(mns_context_get_proc(d->gl.context), &d->renderer, NULL), MNS_OK);
    assert_int_equal(mns_frame_create(d->renderer, &d->frame, NULL), MNS_OK);
}

static void nothing_is_made_before_the_first_frame(void **state)
{
    draw_fixture *d = *state;
    list_passes none = {0};
    assert_int_equal(d->renderer->programs.count, 0);
    assert_memory_equal(&d->renderer->passes, &none, sizeof none);
    assert_int_equal(d->renderer->shade.id, 0);
    assert_int_equal(mns_frame_texture(d->frame, MNS_PLANE_COLOR), 0);
}

static void each_scene_makes_what_it_needs_and_no_more(void **state)
{
    draw_fixture *d = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const leave_out_case *c = &cases[i];
        scene s = c->s;
        if (i > 0) s.options.solver = MNS_SOLVER_CUBIC; /* which drivers compile sooner */
        renew(d);
        mns_field *field = scene_field(&s);
        mns_stats stats = draw_scene(d, &s, field);
        expect_programs(d, c->s.name, c->programs | late_programs(d, &stats));
        unsigned objects = objects_of(d);
        if (objects != c->objects)
            fail_msg("%s: objects 0x%x, expected 0x%x", c->s.name, objects, c->objects);
        unsigned buffers = BASE_BUFFERS + (c->objects & TREE ? TREE_BUFFERS : 0) +
                           (unsigned)__builtin_popcount(c->objects & BUFFERS) + late_buffers(d, &stats);
        if (stats.buffers != buffers)
            fail_msg("%s: %llu buffers, expected %u", c->s.name, (unsigned long long)stats.buffers, buffers);
        assert_int_equal(stats.passes, c->passes);
        assert_int_equal(stats.programs, d->renderer->programs.count);
        mns_field_destroy(field);
        draw_fixture_check(d);
    }
}

/* What a later scene needs more is added to what is there, and what is shared is not made twice. */
static void a_scene_adds_only_what_is_new(void **state)
{
    draw_fixture *d = *state;
    renew(d);
    unsigned late = 0, objects = 0, programs = 0;
    static const size_t sequence[] = {
        0, 8, 9}; /* of cases: one ball, shuffled, a host: each reads what the first reads, but the cast */
    for (size_t i = 0; i < 3; i++) {
        const leave_out_case *c = &cases[sequence[i]];
        scene s = c->s;
        s.options.solver = MNS_SOLVER_CUBIC;
        mns_field *field = scene_field(&s);
        mns_stats stats = draw_scene(d, &s, field);
        late |= late_programs(d, &stats);
        programs |= c->programs;
        objects |= c->objects;
        assert_int_equal(objects_of(d), objects);
        unsigned host_variants =
            c->s.host ? 1u + (late_programs(d, &stats) & PROGRAM(RESOLVE) ? 1u : 0u) : 0u;
        unsigned want =
            (unsigned)__builtin_popcount(programs) + (unsigned)__builtin_popcount(late) + host_variants;
        if (stats.programs != want)
            fail_msg("%s: %llu programs, expected %u", c->s.name, (unsigned long long)stats.programs, want);
        mns_field_destroy(field);
    }
    draw_fixture_check(d);
}

/* Shading by another light or colour, and a second frame of the same, reuse all that is there. */
static void the_same_again_makes_and_moves_nothing(void **state)
{
    draw_fixture *d = *state;
    renew(d);
    scene s = {"again", .generator = "molecule:200", .view = {SMALL}, .look = {.color_by = "element"},
               .options = {.solver = MNS_SOLVER_CUBIC, .measure = true}};
    mns_field *field = scene_field(&s);
    mns_stats first = draw_scene(d, &s, field);
    assert_true(first.ms[MNS_PHASE_SORT] > 0 && first.ms[MNS_PHASE_UPLOAD] > 0 &&
                first.ms[MNS_PHASE_CAST] > 0);
    list_passes passes = d->renderer->passes;
    GLuint planes[] = {d->frame->t, d->frame->normal, d->frame->color, d->frame->shaded};
    for (int i = 0; i < 3; i++) {
        if (i == 1)
            s.look.set = MNS_LOOK_AMBIENT | MNS_LOOK_DIFFUSE, s.look.ambient = 0.3, s.look.diffuse = 0.5;
        if (i == 2) s.options.moved = true;
        mns_stats next = draw_scene(d, &s, field);
        assert_true(next.programs == first.programs && next.buffers == first.buffers &&
                    next.passes == first.passes);
        assert_memory_equal(&d->renderer->passes, &passes, sizeof passes);
        const GLuint now[] = {d->frame->t, d->frame->normal, d->frame->color, d->frame->shaded};
        assert_memory_equal(now, planes, sizeof planes);
        bool moved = i == 2;
        assert_true((next.ms[MNS_PHASE_SORT] > 0) == moved && (next.ms[MNS_PHASE_UPLOAD] > 0) == moved);
        assert_true(next.ms[MNS_PHASE_GATHER] > 0 && next.ms[MNS_PHASE_CAST] > 0);
        assert_true(next.pixels_hit == first.pixels_hit && next.list_nodes == first.list_nodes);
    }
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* What the order of the balls hangs on: another eye, another field. */
static void what_changed_is_sorted_and_uploaded_again(void **state)
{
    draw_fixture *d = *state;
    renew(d);
    scene s = {"change", .generator = "scattered:300", .view = {SMALL},
               .options = {.solver = MNS_SOLVER_CUBIC, .measure = true}};
    mns_field *field = scene_field(&s);
    draw_scene(d, &s, field);
    s.view.fov = 50; /* moves the eye that fits the field */
    assert_true(draw_scene(d, &s, field).ms[MNS_PHASE_SORT] > 0);
    assert_true(draw_scene(d, &s, field).ms[MNS_PHASE_SORT] == 0);
    mns_field_destroy(field);
    field = scene_field(&s); /* the same balls, perhaps at the same address, but not the same field */
    assert_true(draw_scene(d, &s, field).ms[MNS_PHASE_UPLOAD] > 0);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* Frames of another size whose plan has no core depth lie between two that have it. */
static void a_part_left_out_meanwhile_comes_back_in_the_new_size(void **state)
{
    draw_fixture *d = *state;
    scene small = {"small", .generator = "scattered:300", .view = {SMALL},
                   .options = {.solver = MNS_SOLVER_CUBIC}},
          large = small;
    large.view.width = 128;
    large.view.height = 96;
    mns_field *field = scene_field(&small);
    mns_input_options no_core = {.iso = 1.5};
    mns_input *input;
    mns_field *bare;
    assert_int_equal(mns_input_open(&small.generator, 1, &no_core, &input, NULL), MNS_OK);
    assert_int_equal(mns_input_read(input, 0, &bare, NULL), MNS_OK);
    renew(d);
    mns_image *want = draw_image(d, field, &large.view, NULL, &large.options);
    renew(d);
    draw_scene(d, &small, field);
    draw_scene(d, &large, bare);
    mns_image *got = draw_image(d, field, &large.view, NULL, &large.options);
    assert_true(draw_count_hits(want) > 1000);
    draw_expect_same(want, got, "a frame after one of another size");
    mns_image_destroy(want);
    mns_image_destroy(got);
    mns_input_close(input);
    mns_field_destroy(bare);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_made_before_the_first_frame),
        cmocka_unit_test(each_scene_makes_what_it_needs_and_no_more),
        cmocka_unit_test(a_scene_adds_only_what_is_new),
        cmocka_unit_test(the_same_again_makes_and_moves_nothing),
        cmocka_unit_test(what_changed_is_sorted_and_uploaded_again),
        cmocka_unit_test(a_part_left_out_meanwhile_comes_back_in_the_new_size),
    };
    return cmocka_run_group_tests_name("leave_out", tests, draw_fixture_setup, draw_fixture_teardown);
}
