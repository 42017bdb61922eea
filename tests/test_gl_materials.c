/* Two materials that a column blends: every method against the truth, the ends against either material alone,
 * and what is kept from draw to draw. */
#include "support/light_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { BALLS = 40 };

static const double eye[3] = {0.4, 0.6, 5}, at[3] = {0, 0, 0};

/* ---- Scenes ---- */

/* A ring of balls; `low` and `high` are what the column `share` has at its two sides. `heat` is for colours.
 */
static mns_field *ring(double low, double high)
{
    double position[3 * BALLS], share[BALLS], heat[BALLS];
    for (int i = 0; i < BALLS; i++) {
        double angle = 2 * 3.14159265358979 * i / BALLS, part = 0.5 + 0.5 * cos(angle);
        position[3 * i] = 1.2 * cos(angle);
        position[3 * i + 1] = 1.2 * sin(angle);
        position[3 * i + 2] = 0.3 * sin(3 * angle);
        share[i] = low + part * (high - low);
        heat[i] = i % 7;
    }
    const mns_column_desc columns[] = {{"share", {.data = share}}, {"heat", {.data = heat}}};
    const mns_field_desc desc = {.count = BALLS,
                                 .position = {.data = position},
                                 .uniform_radius = 0.6,
                                 .columns = columns,
                                 .column_count = 2};
    mns_field *field = NULL;
    mns_error error;
    if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
    return field;
}

static const mns_light sun = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 2, 1.5}};
#define SUN .lights = &sun, .light_count = 1

/* Matt and mirror; glass and lacquer, of a colour each; colours alone. */
static const mns_look mirrors = {SUN, .set = MNS_LOOK_MIRROR,
                                 .effects = {.shadows = true, .reflections = 2, .environment = "sky"},
                                 .blend = {.by = "share", .mirror = 0.7}},
                      glass = {SUN, .color_by = "heat",
                               .effects = {.shadows = true,
                                           .reflections = 1,
                                           .refractions = 3,
                                           .index = 1.3,
                                           .transmission = 0.9,
                                           .absorption = {0.5, 0.25, 0},
                                           .environment = "sky"},
                               .blend = {.set = MNS_LOOK_TRANSMISSION,
                                         .by = "share",
                                         .color = {0.8, 0.3, 0.1},
                                         .mirror = 0.2,
                                         .absorption = {0, 0.5, 2}}},
                      paint = {.color_by = "heat", .blend = {.by = "share", .color = {1, 0.1, 0.1}}},
                      plain_paint = {.blend = {.by = "share", .color = {1, 0.1, 0.1}}};

/* The second material in the place of the first. */
static mns_look second_alone(mns_look look)
{
    const mns_blend *b = &look.blend;
    bool colored = b->color[0] + b->color[1] + b->color[2] > 0;
    look.effects.mirror = b->mirror;
    look.set |= MNS_LOOK_MIRROR;
    if (b->set & MNS_LOOK_TRANSMISSION) look.effects.transmission = 0, look.set |= MNS_LOOK_TRANSMISSION;
    memcpy(look.effects.absorption, b->absorption, sizeof b->absorption);
    if (colored) {
        memcpy(look.color, b->color, sizeof look.color);
        look.set |= MNS_LOOK_COLOR;
        look.color_by = NULL;
    }
    look.blend = (mns_blend){.by = NULL};
    return look;
}

static mns_look first_alone(mns_look look)
{
    look.blend = (mns_blend){.by = NULL};
    return look;
}

/* ---- The truth ---- */

/* Of a term that `want` has: a blend traces what one of its ends does not. */
static bool is_off(const float *got, const float *want, int i, double allowed)
{
    return want && light_differs(got, want, i, allowed);
}

/* No pixel that both are sure of has another term or colour. */
static void expect_close(const mns_image *got, const mns_image *want, const char *what)
{
    int hits = 0, wrong = 0, off = 0, open = 0;
    for (int i = 0; i < LIGHT_PIXELS; i++) {
        hits += !isinf(want->t[i]);
        if (light_is_open(got, want, i)) {
            open++;
            continue;
        }
        wrong += is_off(got->shadow, want->shadow, i, 1e-5) ||
                 is_off(got->mirror_t, want->mirror_t, i, 1e-4) ||
                 is_off(got->refract_t, want->refract_t, i, 1e-4);
        off += light_colors_differ(got, want, i, 4e-3);
    }
    if (hits < 300 || wrong || off || open > hits / 20)
        fail_msg("%s: of %d hits %d open, %d wrong, %d of another colour", what, hits, open, wrong, off);
}

static void every_method_blends_as_the_truth(void **state)
{
    static const struct {
        const char *name;
        const mns_look *look;
        mns_method method;
    } cases[] = {
        {"paint, tile", &plain_paint, MNS_METHOD_TILE}, {"paint, list", &paint, MNS_METHOD_LIST},
        {"paint, bvh", &paint, MNS_METHOD_BVH},         {"mirrors, tile", &mirrors, MNS_METHOD_TILE},
        {"glass, fbvh", &glass, MNS_METHOD_FBVH},
    };
    draw_fixture *d = *state;
    const mns_view view = draw_view(eye, at, 45, LIGHT_WIDTH, LIGHT_HEIGHT);
    mns_field *field = ring(-0.25, 1.25);
    for (size_t i = 0; i < (light_is_second(d) ? 1 : sizeof cases / sizeof *cases); i++) {
        const mns_options options = {.method = cases[i].method};
        mns_image *want = draw_image(d, field, &view, cases[i].look, &light_truth);
        mns_image *got = draw_image(d, field, &view, cases[i].look, &options);
        expect_close(got, want, cases[i].name);
        mns_image_destroy(want);
        mns_image_destroy(got);
    }
    mns_field_destroy(field);
}

/* Walks that are saved between two rays, as occlusion has it, and rays in doubles, where a search may have
 * one step, know of the materials too. */
static void walks_that_wait_keep_their_materials(void **state)
{
    draw_fixture *d = *state;
    const mns_view view = draw_view(eye, at, 45, LIGHT_WIDTH, LIGHT_HEIGHT);
    const mns_options options = {.method = MNS_METHOD_FBVH, .root_steps = 1};
    mns_look look = glass;
    look.effects.occlusion_rays = 8;
    if (light_is_second(d)) skip();
    mns_field *field = ring(-0.25, 1.25);
    mns_image *want = draw_image(d, field, &view, &look, &light_truth);
    mns_image *got = draw_image(d, field, &view, &look, &options);
    expect_close(got, want, "one step");
    mns_image_destroy(want);
    mns_image_destroy(got);
    mns_field_destroy(field);
}

/* A ball beside a heap of more, in one place, than a leaf has room for: what is seen of it in the mirror is
 * found in doubles. */
static void what_doubles_find_has_its_material(void **state)
{
    enum { HEAP = 80 };
    draw_fixture *d = *state;
    double position[3 * (HEAP + 1)], share[HEAP + 1], strength[HEAP + 1];
    for (int i = 0; i <= HEAP; i++) {
        const bool heaped = i < HEAP;
        position[3 * i] = heaped ? 0.9 : -0.7;
        position[3 * i + 1] = 0;
        position[3 * i + 2] = heaped ? 0.6 : 0;
        strength[i] = heaped ? 1.0 / HEAP : 1;
        share[i] = heaped ? 1 : 0;
    }
    const mns_column_desc column = {"share", {.data = share}};
    const mns_field_desc desc = {.count = HEAP + 1,
                                 .position = {.data = position},
                                 .strength = {.data = strength},
                                 .uniform_radius = 0.9,
                                 .columns = &column,
                                 .column_count = 1};
    const mns_view view = draw_view(eye, at, 30, LIGHT_WIDTH, LIGHT_HEIGHT);
    const mns_options options = {.method = MNS_METHOD_FBVH};
    mns_look look = mirrors;
    mns_field *field = NULL;
    mns_error error;
    if (light_is_second(d)) skip();
    look.effects.mirror = 0.75;
    look.blend.mirror = 0.125;
    if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
    mns_image *want = draw_image(d, field, &view, &look, &light_truth);
    mns_image *got = draw_image(d, field, &view, &look, &options);
    expect_close(got, want, "a heap");
    mns_image_destroy(want);
    mns_image_destroy(got);
    mns_field_destroy(field);
}

/* ---- The ends ---- */

/* Where no ball has any of the second material, and where none has any of the first, the picture is that of
 * one material: what of it is not there is not drawn. */
static void the_ends_are_one_material_bit_for_bit(void **state)
{
    draw_fixture *d = *state;
    const mns_view view = draw_view(eye, at, 45, LIGHT_WIDTH, LIGHT_HEIGHT);
    const mns_look looks[] = {paint, mirrors, glass};
    mns_field *none = ring(-1, 0), *all = ring(1, 2);
    for (size_t i = 0; i < (light_is_second(d) ? 1 : 3); i++)
        for (int method = 0; method < 2; method++) {
            const mns_options options = {.method = method ? MNS_METHOD_REFERENCE : MNS_METHOD_FBVH};
            const mns_look first = first_alone(looks[i]), second = second_alone(looks[i]);
            mns_image *images[] = {
                draw_image(d, none, &view, &looks[i], &options), draw_image(d, none, &view, &first, &options),
                draw_image(d, all, &view, &looks[i], &options), draw_image(d, all, &view, &second, &options)};
            draw_expect_same(images[0], images[1], "none");
            draw_expect_same(images[2], images[3], "all");
            for (int k = 0; k < 4; k++) mns_image_destroy(images[k]);
        }
    mns_field_destroy(none);
    mns_field_destroy(all);
}

/* The same, of surfaces that are at an end while others are not: those that the eye does not look at. */
static void the_ends_of_a_blend_are_the_materials(void **state)
{
    draw_fixture *d = *state;
    double position[6] = {0, 0, 0, 0, 0, 90}, share[2];
    const mns_column_desc column = {"share", {.data = share}};
    const mns_field_desc desc = {.count = 2,
                                 .position = {.data = position},
                                 .uniform_radius = 2,
                                 .columns = &column,
                                 .column_count = 1};
    const mns_view view = draw_view(eye, at, 45, LIGHT_WIDTH, LIGHT_HEIGHT);
    mns_look look = glass;
    look.color_by = NULL;
    for (int end = 0; end < 2; end++)
        for (int method = 0; method < (light_is_second(d) ? 1 : 2); method++) {
            const mns_options options = {.method = method ? MNS_METHOD_FBVH : MNS_METHOD_REFERENCE};
            const mns_look alone = end ? second_alone(look) : first_alone(look);
            mns_field *field = NULL;
            mns_error error;
            share[0] = end, share[1] = !end;
            if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
            mns_image *got = draw_image(d, field, &view, &look, &options);
            mns_image *want = draw_image(d, field, &view, &alone, &options);
            if (method)
                expect_close(got, want, "an end, fbvh"); /* not the same program */
            else
                draw_expect_same(got, want, "an end");
            mns_image_destroy(got);
            mns_image_destroy(want);
            mns_field_destroy(field);
        }
}

/* ---- From draw to draw ---- */

static void another_range_is_sent_anew(void **state)
{
    static const mns_method methods[] = {MNS_METHOD_TILE, MNS_METHOD_FBVH};
    draw_fixture *d = *state;
    const mns_view view = draw_view(eye, at, 45, LIGHT_WIDTH, LIGHT_HEIGHT);
    mns_field *field = ring(0, 1);
    for (int m = 0; m < (light_is_second(d) ? 1 : 2); m++) {
        mns_options options = {.method = methods[m], .moved = true};
        mns_look look = paint;
        look.blend.range[0] = 0.25, look.blend.range[1] = 0.5;
        mns_image *fresh = draw_image(d, field, &view, &look, &options);
        options.moved = false;
        mns_look other = paint;
        mns_image *before = draw_image(d, field, &view, &other, &options);
        mns_image *again = draw_image(d, field, &view, &look, &options);
        draw_expect_same(again, fresh, "another range");
        assert_true(memcmp(before->rgba, again->rgba, 4 * LIGHT_PIXELS * sizeof(float)) != 0);
        look = first_alone(look); /* and with colours alone a ball has half the words */
        mns_image *one = draw_image(d, field, &view, &look, &options);
        options.moved = true;
        mns_image *colors = draw_image(d, field, &view, &look, &options);
        draw_expect_same(one, colors, "one material");
        mns_image_destroy(fresh);
        mns_image_destroy(before);
        mns_image_destroy(again);
        mns_image_destroy(one);
        mns_image_destroy(colors);
    }
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_blends_as_the_truth),
        cmocka_unit_test(walks_that_wait_keep_their_materials),
        cmocka_unit_test(what_doubles_find_has_its_material),
        cmocka_unit_test(the_ends_are_one_material_bit_for_bit),
        cmocka_unit_test(the_ends_of_a_blend_are_the_materials),
        cmocka_unit_test(another_range_is_sent_anew),
    };
    return cmocka_run_group_tests_name("two materials", tests, draw_fixture_setup, draw_fixture_teardown);
}
