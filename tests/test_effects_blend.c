/* Two materials in the truth: between them light does what it would at a material of those numbers, and a way
 * inside knows both its ends. */
#include "field/kernel.h"
#include "support/effects_fixture.h"
#include "support/reference_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* So low a level puts the surface near the edge of the effective spheres: each is a sphere of radius EDGE R.
 */
static const double iso = 1e-8;
static double edge(void)
{
    return density_core(DENSITY_POLY2, iso);
}

static mns_look dark(void) /* everything of the lights by hand */
{
    return (mns_look){.set = MNS_LOOK_AMBIENT | MNS_LOOK_DIFFUSE | MNS_LOOK_SPECULAR | MNS_LOOK_COLOR |
                             MNS_LOOK_BACKGROUND,
                      .background = {1, 1, 1, 1},
                      .color = {1, 1, 1}};
}

/* Balls that would have all or none of it, all times `size`; how much a surface has is for the fixture to
 * say. */
static mns_field *balls_of_two_materials(double size)
{
    static const double share[] = {0, 1};
    const double position[] = {0, 0, 0, 0, 3 * size, 0}, radius[] = {2 * size / edge(), size / edge()};
    const mns_column_desc column = {"share", {.data = share}};
    const mns_field_desc desc = {.count = 2,
                                 .position = {.data = position},
                                 .radius = {.data = radius},
                                 .kernel = MNS_KERNEL_POLY2,
                                 .iso = iso,
                                 .columns = &column,
                                 .column_count = 1};
    mns_field *field = NULL;
    mns_error error;
    if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
    return field;
}

static mns_look two_materials(double size)
{
    mns_look look = dark();
    look.ambient = 1;
    look.background[1] = 0.5;
    look.effects = (mns_effects){.reflections = 2,
                                 .refractions = 4,
                                 .index = 1.5,
                                 .mirror = 0.125,
                                 .transmission = 0.75,
                                 .absorption = {0, 0.25 / size, 1 / size}};
    look.blend = (mns_blend){.by = "share",
                             .mirror = 0.5,
                             .transmission = 0.25,
                             .absorption = {2 / size, 0.125 / size, 0.5 / size}};
    return look;
}

/* What a look with those numbers would be, mixed by hand. */
static mns_look mixed(double weight, double size)
{
    mns_look look = two_materials(size);
    mns_effects *e = &look.effects;
    e->mirror += weight * (look.blend.mirror - e->mirror);
    e->transmission += weight * (look.blend.transmission - e->transmission);
    for (int c = 0; c < 3; c++) e->absorption[c] += weight * (look.blend.absorption[c] - e->absorption[c]);
    look.blend = (mns_blend){.by = NULL};
    return look;
}

static void expect_blend(double size)
{
    mns_field *field = balls_of_two_materials(size);
    const vec3 eye = {0.5 * size, size, 10 * size}, at = {0, size, 0};
    for (int k = 0; k <= 4; k++) {
        effects_fixture one, two;
        const mns_look blended = two_materials(size), by_hand = mixed(0.25 * k, size);
        effects_fixture_open(&two, field, eye, at, &blended);
        effects_fixture_open(&one, field, eye, at, &by_hand);
        assert_true(two.plan->features & FEATURE_MATERIALS && !(one.plan->features & FEATURE_MATERIALS));
        two.weight = 0.25 * k;
        for (int i = 0; i < 30; i++) {
            const vec3 way = {-0.05 + 0.004 * i, -0.2 + 0.013 * i, -1};
            effects_pixel a = effects_fixture_shade(&one, way, NULL),
                          b = effects_fixture_shade(&two, way, NULL);
            assert_int_equal(a.rays, b.rays);
            assert_true(a.mirror == b.mirror && a.refracted == b.refracted);
            /* At the ends they are the same numbers, and so the same bits. */
            if (k % 4 == 0) assert_memory_equal(a.color, b.color, sizeof a.color);
            for (int c = 0; c < 3; c++) fixture_expect_close(b.color[c], a.color[c], 1e-12);
        }
        effects_fixture_close(&one);
        effects_fixture_close(&two);
    }
    mns_field_destroy(field);
}

static void a_blend_is_the_material_between(void **state)
{
    (void)state;
    expect_blend(1);
    expect_blend(0x1p-60); /* where the field's own unit is another: absorption is a unit of the scene's */
}

/* Of the first surface that is asked for none is of the second material, of those after it all. */
static double first_then_second(const void *user, const reference_scratch *scratch, double s, double color[3])
{
    int *const *calls = user;
    (void)scratch, (void)s;
    color[0] = color[1] = color[2] = 1;
    return (**calls)++ ? 1 : 0;
}

/* Through a ball from a side of the one material to a side of the other: the way is dimmed by the mean of
 * both. */
static void a_way_inside_is_dimmed_by_both_its_ends(void **state)
{
    (void)state;
    int calls = 0, *const counter = &calls;
    mns_field *field = balls_of_two_materials(1);
    mns_look look = dark();
    look.set |= MNS_LOOK_TRANSMISSION;
    look.effects = (mns_effects){.refractions = 2, .transmission = 1, .absorption = {0.25, 0, 0.5}};
    look.blend = (mns_blend){.by = "share", .set = MNS_LOOK_ABSORPTION, .absorption = {0, 0, 1}};
    effects_fixture f;
    effects_fixture_open(&f, field, (vec3){0, 0, 10}, (vec3){0, 0, 0}, &look);
    f.scene.albedo = first_then_second;
    f.scene.user = &counter;
    effects_pixel pixel = effects_fixture_shade(&f, (vec3){0, 0, -1}, NULL);
    assert_int_equal(calls, 2);
    fixture_expect_close(pixel.refracted, 4, 1e-7);
    fixture_expect_close(pixel.color[0], exp(-0.125 * 4), 1e-7);
    fixture_expect_close(pixel.color[1], 1, 1e-12);
    fixture_expect_close(pixel.color[2], exp(-0.75 * 4), 1e-7);
    effects_fixture_close(&f);
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_blend_is_the_material_between),
        cmocka_unit_test(a_way_inside_is_dimmed_by_both_its_ends),
    };
    return cmocka_run_group_tests_name("two materials in the truth", tests, NULL, NULL);
}
