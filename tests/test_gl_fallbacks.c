/* Nothing is lost to a fixed size: each slower path of the list renderer is made to happen, is counted, and
 * leaves the picture as it was. */
#include "render/render.h"
#include "support/brute_image.h"
#include "support/draw_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDE = 160, HIGH = 120, BALLS = 400 };

/* The unit cube's cloud that the tests disturb: so weak that no ball alone reaches L, nothing is hidden by
 * cores, and 30 balls are on many a list. */
static mns_field *thick_cloud(mns_kernel kernel)
{
    static double position[3 * BALLS], strength[BALLS];
    uint64_t random = 11;
    for (size_t i = 0; i < 3 * (size_t)BALLS; i++) position[i] = draw_random(&random);
    for (size_t i = 0; i < BALLS; i++) strength[i] = 0.12 + 0.07 * draw_random(&random);
    return draw_field(BALLS, position, NULL, 0.2, strength, kernel);
}

static mns_view front(void)
{
    return draw_view((const double[3]){0.5, 0.8, 3}, (const double[3]){0.5, 0.5, 0.5}, 40, WIDE, HIGH);
}

/* What a path that solves in doubles must keep: every hit; t to a few of a float's roundings, except where
 * the ray meets the surface at a very flat angle, which magnifies them; the normal. */
static void expect_close(const mns_image *a, const mns_image *b, const char *what)
{
    size_t hits = 0, flat = 0;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        if (isfinite(a->t[i]) != isfinite(b->t[i]))
            fail_msg("%s: pixel %zu,%zu: t is %g and %g", what, i % WIDE, i / WIDE, (double)a->t[i],
                     (double)b->t[i]);
        if (!isfinite(a->t[i])) continue;
        double error = fabs((double)a->t[i] - (double)b->t[i]) / (double)a->t[i], along = 0;
        for (size_t c = 0; c < 3; c++) along += (double)a->normal[3 * i + c] * (double)b->normal[3 * i + c];
        hits++;
        flat += error > 2e-6;
        if (error > 1e-4)
            fail_msg("%s: pixel %zu,%zu: t differs by %g of itself", what, i % WIDE, i / WIDE, error);
        if (along < 0.9999)
            fail_msg("%s: pixel %zu,%zu: the normals' cosine is %g", what, i % WIDE, i / WIDE, along);
    }
    if (flat > hits / 1000)
        fail_msg("%s: t differs by more than 2e-6 of itself at %zu of %zu pixels", what, flat, hits);
}

/* ---- The node pool ---- */

static void a_pool_too_small_grows_once(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    mns_field *field = thick_cloud(MNS_KERNEL_POLY3);
    mns_image *first = draw_image(d, field, &view, NULL, NULL);
    assert_int_equal(d->stats.fallbacks.pool_grown, 1);
    assert_int_equal(d->stats.tiles, 1);
    uint64_t nodes = d->stats.list_nodes;
    mns_image *second = draw_image(d, field, &view, NULL, NULL);
    assert_int_equal(d->stats.fallbacks.pool_grown + d->stats.fallbacks.tiled, 0);
    assert_int_equal(d->stats.list_nodes, nodes);
    draw_expect_same(first, second, "a grown pool");
    mns_image_destroy(first);
    mns_image_destroy(second);
    mns_field_destroy(field);
}

/* Tiles of many rows, of one row, and of a part of a row. */
static void lists_past_the_pools_limit_are_drawn_in_tiles(void **state)
{
    draw_fixture *d = *state;
    static const size_t most[] = {60000, 4000, 900};
    mns_view view = front();
    mns_field *field = thick_cloud(MNS_KERNEL_POLY3);
    mns_image *whole = draw_image(d, field, &view, NULL, NULL);
    uint64_t nodes = d->stats.list_nodes, tiles = 1;
    for (size_t i = 0; i < 3; i++) {
        mns_image *tiled = draw_image(d, field, &view, NULL, &(mns_options){.max_pool_nodes = most[i]});
        assert_true(d->stats.fallbacks.tiled > 0);
        assert_int_equal(d->stats.tiles, d->stats.fallbacks.tiled + 1);
        assert_true(d->stats.tiles > tiles && d->stats.tiles >= nodes / most[i]);
        tiles = d->stats.tiles;
        assert_int_equal(d->stats.list_nodes, nodes);
        draw_expect_same(whole, tiled, "tiles");
        mns_image_destroy(tiled);
    }
    assert_true(tiles > HIGH);
    mns_image_destroy(whole);
    mns_field_destroy(field);
}

static void a_pixel_whose_list_alone_passes_the_pool_is_refused(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    mns_error error = {0};
    mns_field *field = thick_cloud(MNS_KERNEL_POLY3);
    mns_image *before = draw_image(d, field, &view, NULL, NULL);
    mns_options few = {.method = MNS_METHOD_LIST, .max_pool_nodes = 8};
    assert_int_equal(mns_renderer_draw(d->renderer, field, &view, NULL, &few, d->frame, &error),
                     MNS_ERROR_UNSUPPORTED);
    assert_int_equal(error.status, MNS_ERROR_UNSUPPORTED);
    if (!strstr(error.text, "pixel") || !strstr(error.text, "8 nodes")) fail_msg("\"%s\"", error.text);
    draw_fixture_check(d);
    mns_image *after = draw_image(d, field, &view, NULL, NULL);
    draw_expect_same(before, after, "after a refusal");
    mns_image_destroy(before);
    mns_image_destroy(after);
    mns_field_destroy(field);
}

/* ---- The cast ---- */

static void more_balls_than_slots_take_the_lists_in_place(void **state)
{
    draw_fixture *d = *state;
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY3, MNS_KERNEL_WENDLAND};
    mns_view view = front();
    for (size_t i = 0; i < 2; i++) {
        mns_field *field = thick_cloud(kernels[i]);
        mns_image *plain = draw_image(d, field, &view, NULL, NULL);
        if (mns_renderer_limits(d->renderer)->is_software) /* of a card the slots are fewer */
            assert_int_equal(d->stats.fallbacks.active_overflow, 0);
        mns_image *few = draw_image(d, field, &view, NULL, &(mns_options){.slots = 2});
        assert_true(d->stats.fallbacks.active_overflow > 1000);
        assert_int_equal(d->stats.pixels_undecided, 0);
        expect_close(plain, few, "two slots");
        mns_image_destroy(plain);
        mns_image_destroy(few);
        mns_field_destroy(field);
    }
}

static void a_root_search_that_is_cut_short_is_made_again_in_doubles(void **state)
{
    draw_fixture *d = *state;
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY2, MNS_KERNEL_PERLIN};
    mns_view view = front();
    for (size_t i = 0; i < 2; i++) {
        mns_field *field = thick_cloud(kernels[i]);
        mns_image *plain = draw_image(d, field, &view, NULL, NULL);
        assert_true(d->stats.fallbacks.root_cap < 20);
        mns_image *cut = draw_image(d, field, &view, NULL, &(mns_options){.root_steps = 1});
        assert_true(d->stats.fallbacks.root_cap > 20);
        assert_int_equal(d->stats.pixels_undecided, 0);
        expect_close(plain, cut, "one step");
        mns_image_destroy(plain);
        mns_image_destroy(cut);
        mns_field_destroy(field);
    }
}

/* ---- The order of the lists ---- */

static void lists_in_any_order_give_the_same_bits(void **state)
{
    draw_fixture *d = *state;
    static const uint32_t seeds[] = {1, 2, 0xdeadbeef};
    mns_view view = front();
    mns_field *field = thick_cloud(MNS_KERNEL_POLY3);
    mns_image *plain = draw_image(d, field, &view, NULL, NULL);
    uint64_t sorted = d->stats.fallbacks.lists_sorted;
    /* a card's are sorted always, for it promises no order */
    assert_int_equal(sorted, !mns_renderer_limits(d->renderer)->is_software);
    for (size_t i = 0; i < 3; i++) {
        mns_image *shuffled = draw_image(d, field, &view, NULL, &(mns_options){.shuffle = seeds[i]});
        assert_true(d->stats.fallbacks.lists_sorted > 0);
        draw_expect_same(plain, shuffled, "shuffled lists");
        mns_image_destroy(shuffled);
    }
    mns_image *tiles =
        draw_image(d, field, &view, NULL, &(mns_options){.shuffle = 5, .max_pool_nodes = 60000});
    assert_true(d->stats.tiles > 1 && d->stats.fallbacks.lists_sorted >= d->stats.tiles);
    draw_expect_same(plain, tiles, "shuffled lists in tiles");
    mns_image_destroy(tiles);
    mns_image_destroy(plain);
    mns_field_destroy(field);
}

/* In a frame of one pixel no neighbour tells that lists are out of order: the pixel itself has to notice, in
 * a renderer that has not seen it before. */
static void a_single_pixel_notices_the_order_of_its_list(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    view.width = view.height = 1;
    mns_field *field = thick_cloud(MNS_KERNEL_POLY3);
    mns_image *plain = draw_image(d, field, &view, NULL, NULL);
    assert_true(isfinite(plain->t[0]));
    for (uint32_t seed = 1; seed <= 40; seed++) {
        d->renderer->disordered = false;
        mns_image *shuffled = draw_image(d, field, &view, NULL, &(mns_options){.shuffle = seed});
        draw_expect_same(plain, shuffled, "one shuffled pixel");
        mns_image_destroy(shuffled);
    }
    mns_image_destroy(plain);
    mns_field_destroy(field);
}

/* ---- What float cannot decide ---- */

/* Many small balls far away in terms of their radius: where a ray grazes one, the rounding of its place
 * decides. */
static mns_field *small_balls(mns_kernel kernel)
{
    enum { SMALL = 2000 };
    static double position[3 * SMALL];
    uint64_t random = 5;
    for (size_t i = 0; i < 3 * (size_t)SMALL; i++) position[i] = draw_random(&random);
    return draw_field(SMALL, position, NULL, 0.02, NULL, kernel);
}

static void expect_rays_right(const mns_field *field, const mns_view *view, const mns_image *image)
{
    brute *oracle = brute_create(field);
    brute_tally *tally = brute_tally_create();
    assert_true(oracle && tally);
    assert_true(brute_tally_add(tally, oracle, view, image, 15000, 0x1p-40, 1));
    brute_report r = brute_tally_report(tally);
    if (r.missed + r.invented + r.later || r.t_p999 > 2e-6)
        fail_msg("%zu missed, %zu invented, %zu later, %zu near, t p99.9 %g", r.missed, r.invented, r.later,
                 r.near, r.t_p999);
    brute_tally_destroy(tally);
    brute_destroy(oracle);
}

static void pixels_that_float_cannot_decide_are_solved_in_doubles(void **state)
{
    draw_fixture *d = *state;
    static const mns_kernel kernels[] = {MNS_KERNEL_POLY3, MNS_KERNEL_WENDLAND};
    mns_view view =
        draw_view((const double[3]){0.5, 0.8, 2}, (const double[3]){0.5, 0.5, 0.5}, 35, 2 * WIDE, 2 * HIGH);
    uint64_t open = 0;
    for (size_t i = 0; i < 2; i++) {
        mns_field *field = small_balls(kernels[i]);
        mns_image *image = draw_image(d, field, &view, NULL, NULL);
        /* Bernstein's search may come upon such a ray as one of too many steps. */
        assert_true(d->stats.fallbacks.undecided_float + d->stats.fallbacks.root_cap > 10);
        assert_true(d->stats.pixels_undecided <= (uint64_t)4 * WIDE * HIGH / 10000);
        open += d->stats.fallbacks.undecided_float;
        expect_rays_right(field, &view, image);
        mns_image_destroy(image);
        mns_field_destroy(field);
    }
    assert_true(open > 10);
}

/* Programs are kept from test to test, since compiling them takes longest; what a renderer has learnt is not.
 */
static int forget_order(void **state)
{
    draw_fixture *d = *state;
    d->renderer->disordered = false;
    return 0;
}

static int check_after(void **state)
{
    draw_fixture_check(*state);
    return 0;
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, forget_order, check_after)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_pool_too_small_grows_once), /* first: it needs a renderer that has drawn nothing yet */
        TEST(lists_past_the_pools_limit_are_drawn_in_tiles),
        TEST(a_pixel_whose_list_alone_passes_the_pool_is_refused),
        TEST(more_balls_than_slots_take_the_lists_in_place),
        TEST(a_root_search_that_is_cut_short_is_made_again_in_doubles),
        TEST(lists_in_any_order_give_the_same_bits),
        TEST(a_single_pixel_notices_the_order_of_its_list),
        TEST(pixels_that_float_cannot_decide_are_solved_in_doubles),
    };
    return cmocka_run_group_tests_name("fallbacks", tests, draw_fixture_setup, draw_fixture_teardown);
}
