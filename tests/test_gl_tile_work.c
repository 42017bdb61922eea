/* How the method tile goes about it: in parts where lists grow too long, by texels or by storage blocks, the
 * slower ways, each the same picture; nothing made that is not needed, nothing done twice that has not
 * changed. */
#include "render/render.h"
#include "support/exact.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const cloud gains = {400, 0, 0.11, 0.11, 0.1, 2};
static const cloud thick = {400, 0, 0.2, 0.2, 0.12, 0.19}; /* no core, long lists */

static mns_options tile_options(void)
{
    return (mns_options){.method = MNS_METHOD_TILE};
}

/* ---- In parts, by blocks, through the slower ways ---- */

static void a_frame_in_parts_has_the_same_bits(void **state)
{
    draw_fixture *d = *state;
    static const size_t most[] = {6000, 700, 200};
    mns_view view = exact_view();
    mns_field *field = cloud_field(&thick, MNS_KERNEL_POLY3);
    mns_options tile = tile_options();
    mns_image *whole = draw_image(d, field, &view, NULL, &tile);
    uint64_t parts = 1;
    assert_int_equal(d->stats.tiles, 1);
    for (size_t i = 0; i < 3; i++) {
        tile.max_pool_nodes = most[i];
        for (int again = 0; again < 2; again++) {
            mns_image *image = draw_image(d, field, &view, NULL, &tile);
            assert_true(d->stats.tiles > parts);
            draw_expect_same(whole, image, "parts");
            mns_image_destroy(image);
        }
        parts = d->stats.tiles;
    }
    tile.max_pool_nodes = 0;
    mns_image *after = draw_image(d, field, &view, NULL, &tile);
    assert_int_equal(d->stats.tiles, 1);
    draw_expect_same(whole, after, "whole after parts");
    mns_image_destroy(after);
    mns_image_destroy(whole);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

static void a_pixel_whose_list_alone_passes_the_limit_is_refused(void **state)
{
    draw_fixture *d = *state;
    mns_view view = exact_view();
    mns_error error;
    mns_field *field = cloud_field(&thick, MNS_KERNEL_POLY3);
    mns_options few = {.method = MNS_METHOD_TILE, .max_pool_nodes = 8};
    assert_int_equal(mns_renderer_draw(d->renderer, field, &view, NULL, &few, d->frame, &error),
                     MNS_ERROR_UNSUPPORTED);
    if (!strstr(error.text, "pixel")) fail_msg("\"%s\"", error.text);
    few.max_pool_nodes = 0;
    mns_image *image = draw_image(d, field, &view, NULL, &few);
    assert_true(draw_count_hits(image) > 1000);
    mns_image_destroy(image);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

static void texels_and_storage_blocks_give_the_same_bits(void **state)
{
    draw_fixture *d = *state;
    int texels = d->renderer->device.limits.max_texture_buffer;
    mns_view view = exact_view();
    mns_field *field = cloud_field(&cloud_signs, MNS_KERNEL_POLY3);
    mns_options tile = tile_options();
    mns_image *by_texels = draw_image(d, field, &view, NULL, &tile);
    if (mns_renderer_limits(d->renderer)->is_software) /* a card's pool may pass its buffer textures */
        assert_true(mns_plan_features(mns_frame_plan(d->frame)) & FEATURE_TEXELS);
    d->renderer->device.limits.max_texture_buffer = 1;
    mns_image *by_blocks = draw_image(d, field, &view, NULL, &tile);
    assert_false(mns_plan_features(mns_frame_plan(d->frame)) & FEATURE_TEXELS);
    d->renderer->device.limits.max_texture_buffer = texels;
    draw_expect_same(by_texels, by_blocks, "texels");
    mns_image_destroy(by_texels);
    mns_image_destroy(by_blocks);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

static void squares_and_the_whole_frame_give_the_same_bits(void **state)
{
    draw_fixture *d = *state;
    double point = d->renderer->device.limits.max_point_size;
    if (point < SQUARE_MOST) skip();
    mns_view view = exact_view();
    mns_look look = {.color_by = "speed"};
    mns_field *field = draw_generated("tornado:300", MNS_KERNEL_POLY3);
    view.width = 131, view.height = 77;
    mns_options tile = tile_options();
    mns_image *squares = draw_image(d, field, &view, &look, &tile);
    assert_true(mns_plan_features(mns_frame_plan(d->frame)) & FEATURE_SQUARES);
    d->renderer->device.limits.max_point_size = 1;
    mns_image *whole = draw_image(d, field, &view, &look, &tile);
    assert_false(mns_plan_features(mns_frame_plan(d->frame)) & FEATURE_SQUARES);
    d->renderer->device.limits.max_point_size = point;
    draw_expect_same(squares, whole, "squares");
    mns_image_destroy(squares);
    mns_image_destroy(whole);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* What a path that goes on elsewhere must keep: every hit, and t to a few of a float's roundings. */
static void expect_close(const mns_image *a, const mns_image *b, const char *what)
{
    size_t hits = 0, flat = 0;
    for (size_t i = 0; i < (size_t)EXACT_WIDE * EXACT_HIGH; i++) {
        if (isfinite(a->t[i]) != isfinite(b->t[i]))
            fail_msg("%s: pixel %zu,%zu", what, i % EXACT_WIDE, i / EXACT_WIDE);
        if (!isfinite(a->t[i])) continue;
        double error = fabs((double)a->t[i] - (double)b->t[i]) / (double)a->t[i];
        hits++;
        flat += error > 2e-6; /* only where the ray meets the surface at a very flat angle */
        if (error > 1e-4)
            fail_msg("%s: pixel %zu,%zu: t differs by %g of itself", what, i % EXACT_WIDE, i / EXACT_WIDE,
                     error);
    }
    if (hits < 1000 || flat > hits / 1000) fail_msg("%s: %zu hits, %zu flat", what, hits, flat);
}

static void the_slower_ways_draw_the_same_picture(void **state)
{
    draw_fixture *d = *state;
    mns_view view = exact_view();
    mns_field *field = cloud_field(&thick, MNS_KERNEL_POLY3);
    mns_options tile = tile_options();
    mns_image *usual = draw_image(d, field, &view, NULL, &tile);
    tile.slots = 2;
    mns_image *slots = draw_image(d, field, &view, NULL, &tile);
    assert_true(d->stats.fallbacks.active_overflow > 1000);
    assert_int_equal(d->stats.pixels_undecided, 0);
    expect_close(usual, slots, "two slots");
    tile = tile_options();
    tile.root_steps = 1;
    mns_image *steps = draw_image(d, field, &view, NULL, &tile);
    assert_true(d->stats.fallbacks.root_cap > 20);
    assert_int_equal(d->stats.pixels_undecided, 0);
    expect_close(usual, steps, "one step");
    mns_image_destroy(usual);
    mns_image_destroy(slots);
    mns_image_destroy(steps);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* ---- What is made, and made again ---- */

static void renew(draw_fixture *d)
{
    mns_frame_destroy(d->frame);
    mns_renderer_destroy(d->renderer);
    assert_int_equal(mns_renderer_create(mns_context_get_proc(d->gl.context), &d->renderer, NULL), MNS_OK);
    assert_int_equal(mns_frame_create(d->renderer, &d->frame, NULL), MNS_OK);
}

static void nothing_of_the_gathering_is_made(void **state)
{
    draw_fixture *d = *state;
    mns_view view = {.width = 64, .height = 48};
    mns_field *field = draw_generated("scattered:300", MNS_KERNEL_POLY3);
    mns_options tile = {.method = MNS_METHOD_TILE, .solver = MNS_SOLVER_CUBIC};
    renew(d);
    mns_image_destroy(draw_image(d, field, &view, NULL, &tile));
    const list_passes *p = &d->renderer->passes;
    uint64_t late = (d->stats.fallbacks.active_overflow + d->stats.fallbacks.root_cap > 0) +
                    (d->stats.fallbacks.undecided_float > 0);
    assert_int_equal(d->stats.programs, 2 + late); /* cast, shade */
    assert_int_equal(d->stats.passes, 6);
    assert_true(p->tile_heads.id && p->balls.id);
    mns_field *strong = cloud_field(&gains, MNS_KERNEL_POLY3);
    mns_image_destroy(draw_image(d, strong, &view, NULL, &tile));
    assert_true(mns_plan_features(mns_frame_plan(d->frame)) & FEATURE_CORE_RADII);
    mns_field_destroy(strong);
    assert_false(p->nodes.id || p->counter.id || p->backwards.id || p->cores.id);
    assert_false(p->heads || p->core_depth || p->host_depth || p->heads_target || p->depth_target ||
                 p->bare_target);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* The phases' times are 0 where nothing ran. */
static void what_has_not_moved_is_binned_once(void **state)
{
    draw_fixture *d = *state;
    mns_view view = exact_view();
    mns_field *field = draw_generated("scattered:2000", MNS_KERNEL_POLY3);
    mns_options tile = {.method = MNS_METHOD_TILE, .measure = true};
    mns_image *first = draw_image(d, field, &view, NULL, &tile);
    double list_mean = d->stats.list_mean;
    uint64_t nodes = d->stats.list_nodes;
    assert_true(d->stats.ms[MNS_PHASE_SORT] > 0 && d->stats.ms[MNS_PHASE_BIN] > 0 &&
                d->stats.ms[MNS_PHASE_UPLOAD] > 0);
    list_passes passes = d->renderer->passes;
    for (int i = 0; i < 3; i++) {
        tile.moved = i == 2;
        mns_look look = {.set = i == 1 ? MNS_LOOK_AMBIENT : 0, .ambient = 0.3};
        mns_image *next = draw_image(d, field, &view, &look, &tile);
        static const mns_phase phases[] = {MNS_PHASE_SORT, MNS_PHASE_BIN, MNS_PHASE_UPLOAD};
        for (int k = 0; k < 3; k++) assert_true((d->stats.ms[phases[k]] > 0) == tile.moved);
        assert_true(d->stats.ms[MNS_PHASE_CAST] > 0);
        assert_true(d->stats.list_nodes == nodes && d->stats.list_mean == list_mean);
        assert_memory_equal(&d->renderer->passes, &passes, sizeof passes);
        if (i != 1) draw_expect_same(first, next, "again");
        mns_image_destroy(next);
    }
    tile.moved = false;
    view.eye[0] += 0.01;
    mns_image_destroy(draw_image(d, field, &view, NULL, &tile));
    assert_true(d->stats.ms[MNS_PHASE_BIN] > 0);
    mns_image_destroy(first);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* Lists of either method, of either size, in turn through one renderer. */
static void methods_and_sizes_in_turn_do_not_disturb_each_other(void **state)
{
    draw_fixture *d = *state;
    mns_view large = exact_view(), small = exact_view();
    small.width = 77, small.height = 51;
    mns_field *field = cloud_field(&cloud_plain, MNS_KERNEL_POLY3);
    mns_options tile = tile_options(), list = {.method = MNS_METHOD_LIST};
    renew(d);
    mns_image *want[4], *got[4];
    const mns_view *views[4] = {&large, &small, &large, &small};
    const mns_options *options[4] = {&tile, &tile, &list, &list};
    for (int i = 0; i < 4; i++) want[i] = draw_image(d, field, views[i], NULL, options[i]);
    static const int turns[] = {2, 0, 1, 3, 0, 2, 1};
    for (size_t i = 0; i < sizeof turns / sizeof *turns; i++) {
        int turn = turns[i];
        got[turn] = draw_image(d, field, views[turn], NULL, options[turn]);
        draw_expect_same(want[turn], got[turn], "in turn");
        mns_image_destroy(got[turn]);
    }
    for (int i = 0; i < 4; i++) mns_image_destroy(want[i]);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_in_parts_has_the_same_bits),
        cmocka_unit_test(a_pixel_whose_list_alone_passes_the_limit_is_refused),
        cmocka_unit_test(texels_and_storage_blocks_give_the_same_bits),
        cmocka_unit_test(squares_and_the_whole_frame_give_the_same_bits),
        cmocka_unit_test(the_slower_ways_draw_the_same_picture),
        cmocka_unit_test(nothing_of_the_gathering_is_made),
        cmocka_unit_test(what_has_not_moved_is_binned_once),
        cmocka_unit_test(methods_and_sizes_in_turn_do_not_disturb_each_other),
    };
    return cmocka_run_group_tests_name("gl_tile_work", tests, draw_fixture_setup, draw_fixture_teardown);
}
