/* How the walks of light's ways are led on the GPU: in parts of a frame, over dispatches and into doubles;
 * what is told of them: doubt, noise, and that there are none. */
#include "render/render.h"
#include "support/light_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

/* Blocks that hold the walks of but a few rows: the frame is lit in parts. */
static void a_frame_is_lit_in_parts(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_FBVH};
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    size_t *block = &d->renderer->device.limits.max_storage_block, whole = *block;
    mns_image *at_once = draw_image(d, field, &light_view, &light_soft.look, &options);
    uint64_t rays = d->stats.effects_rays;
    *block = 1 << 17;
    mns_image *in_parts = draw_image(d, field, &light_view, &light_soft.look, &options);
    *block = whole;
    draw_expect_same(at_once, in_parts, "in parts");
    assert_true(d->stats.effects_rays == rays);
    mns_image_destroy(at_once);
    mns_image_destroy(in_parts);
    mns_field_destroy(field);
}

/* Of a ball's middle column a light stands so low that its rays leave along the surface: doubles cannot tell
 * either. */
static void what_nobody_can_decide_is_told(void **state)
{
    draw_fixture *d = *state;
    enum { SIDE = 9 };
    static const double middle[3] = {0, 0, 0}, eye[3] = {0, 0, 4};
    const mns_light low = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 0, 1e-15}};
    const mns_look look = {.lights = &low, .light_count = 1, .effects = {.shadows = true}};
    const mns_view view = draw_view(eye, middle, 30, SIDE, SIDE);
    mns_field *field = draw_field(1, middle, NULL, 1, NULL, MNS_KERNEL_POLY3);
    for (int k = 0; k < 2; k++) {
        const mns_options options = {.method = k ? MNS_METHOD_FBVH : MNS_METHOD_REFERENCE};
        mns_image *image = draw_image(d, field, &view, &look, &options);
        uint64_t open = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            const bool grazed = i % SIDE == SIDE / 2 && !isinf(image->t[i]);
            assert_true(image->effects_certain[i] == (grazed ? 0 : 1));
            open += grazed;
        }
        assert_true(open >= 3 && d->stats.effects_undecided == open);
        mns_image_destroy(image);
    }
    mns_field_destroy(field);
}

/* Walks that wait for another dispatch, for doubles and in parts of the frame come to the same. */
static void however_a_walk_is_led_it_ends_the_same(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    light_look look = light_soft;
    look.look.effects.occlusion_rays = 96; /* past a dispatch's budget */
    mns_options options = {.method = MNS_METHOD_FBVH};
    light_expect_truth(d, field, &light_view, &look, &options, 1e-4, 0, "many rays");
    options.root_steps = light_is_second(d) ? 0 : 1; /* what has to be cut is left to doubles */
    mns_image *one = draw_image(d, field, &light_view, &look.look, &options);
    mns_image *two = draw_image(d, field, &light_view, &look.look, &options);
    draw_expect_same(one, two, "again");
    if (!light_is_second(d)) light_expect_truth(d, field, &light_view, &look, &options, 1e-4, 0, "one step");
    mns_image_destroy(one);
    mns_image_destroy(two);
    mns_field_destroy(field);
}

/* Noise goes by the root of the rays, in however many samples of the pixel they come. */
static void noise_is_told_of_what_is_sampled(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    double shadow = 0, occlusion = 0;
    for (int k = 0; k < 3; k++) {
        light_look look = light_soft;
        mns_options options = {.method = MNS_METHOD_FBVH, .samples = k == 2 ? 4 : 1};
        look.look.effects.shadow_samples *= k == 1 ? 4 : 1;
        look.look.effects.occlusion_rays *= k == 1 ? 4 : 1;
        mns_image_destroy(draw_image(d, field, &light_view, &look.look, &options));
        const mns_stats *s = mns_frame_stats(d->frame);
        if (k == 0) {
            shadow = s->noise_shadow, occlusion = s->noise_occlusion;
            assert_true(shadow > 0.01 && shadow < 0.5 && occlusion > 0.01 && occlusion < 0.5);
            continue;
        }
        assert_true(fabs(s->noise_shadow / shadow - 0.5) < 0.1);
        assert_true(fabs(s->noise_occlusion / occlusion - 0.5) < 0.1);
    }
    /* Two lights in one place are sampled twice. */
    const mns_light twice[2] = {light_lamps[1], light_lamps[1]};
    for (size_t count = 1; count <= 2; count++) {
        const mns_look look = {
            .lights = twice, .light_count = count, .effects = {.shadows = true, .shadow_samples = 4}};
        mns_image_destroy(
            draw_image(d, field, &light_view, &look, &(mns_options){.method = MNS_METHOD_FBVH}));
        const double noise = mns_frame_stats(d->frame)->noise_shadow;
        if (count > 1) assert_true(fabs(noise / shadow - sqrt(0.5)) < 0.1);
        shadow = noise;
    }
    mns_image_destroy(draw_image(d, field, &light_view, &light_hard.look, NULL));
    assert_true(mns_frame_stats(d->frame)->noise_shadow == 0 &&
                mns_frame_stats(d->frame)->noise_occlusion == 0);
    mns_field_destroy(field);
}

static void what_has_no_rays_builds_no_tree(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    light_look look = {"sky",
                       {.set = MNS_LOOK_MIRROR | MNS_LOOK_BACKGROUND,
                        .background = {0, 0, 0, 0.5},
                        .effects = {.mirror = 0.5, .environment = "sky"}}};
    const mns_options options = {.method = MNS_METHOD_TILE};
    light_expect_truth(d, field, &light_tilted_view, &look, &options, 1e-4, 0, "sky");
    assert_true(d->stats.tree.balls == 0 && d->stats.effects_rays == 0);
    light_expect_truth(d, field, &light_view, &light_hard, &options, 1e-4, 0, "shadows");
    assert_true(d->stats.tree.balls == 500);
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_is_lit_in_parts),
        cmocka_unit_test(what_nobody_can_decide_is_told),
        cmocka_unit_test(however_a_walk_is_led_it_ends_the_same),
        cmocka_unit_test(noise_is_told_of_what_is_sampled),
        cmocka_unit_test(what_has_no_rays_builds_no_tree),
    };
    return cmocka_run_group_tests_name("light's walks", tests, draw_fixture_setup, draw_fixture_teardown);
}
