/* The method tile draws the list's picture: the same hits at the same places, whatever is asked for, in parts
 * or whole; and does nothing twice that has not changed. */
#include "render/render.h"
#include "support/brute_image.h"
#include "support/draw_fixture.h"
#include "support/host_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDE = 160, HIGH = 120, BALLS = 400, RAYS = 2000 };

static mns_options tile_options(void)
{
    return (mns_options){.method = MNS_METHOD_TILE};
}

/* ---- Fields and views ---- */

/* Balls in the unit cube; equal bounds: one radius for all; both strengths 0: 1. With a column to colour by.
 */
typedef struct cloud {
    double radius_low, radius_high, strength_low, strength_high;
} cloud;

static mns_field *cloud_field(const cloud *c, mns_kernel kernel)
{
    static double position[3 * BALLS], radius[BALLS], strength[BALLS], heat[BALLS];
    uint64_t random = 23;
    for (size_t i = 0; i < BALLS; i++) {
        for (size_t a = 0; a < 3; a++) position[3 * i + a] = draw_random(&random);
        radius[i] = c->radius_low * pow(c->radius_high / c->radius_low, draw_random(&random));
        strength[i] = c->strength_low + (c->strength_high - c->strength_low) * draw_random(&random);
        heat[i] = position[3 * i];
    }
    const mns_column_desc column = {"heat", {.data = heat}};
    mns_field_desc desc = {.count = BALLS,
                           .position = {.data = position},
                           .uniform_radius = c->radius_low,
                           .kernel = kernel,
                           .columns = &column,
                           .column_count = 1};
    if (c->radius_low != c->radius_high) desc.radius.data = radius;
    if (c->strength_low != c->strength_high) desc.strength.data = strength;
    mns_field *field;
    mns_error error;
    if (mns_field_create(&desc, &field, &error) != MNS_OK) fail_msg("%s", error.text);
    return field;
}

static const cloud plain = {0.11, 0.11, 0, 0};
static const cloud radii = {0.02, 0.25, 0, 0};
static const cloud gains = {0.11, 0.11, 0.1, 2};
static const cloud signs = {0.05, 0.2, -1.5, 2.5};
static const cloud thick = {0.2, 0.2, 0.12, 0.19}; /* no core, long lists */

static mns_view front(void)
{
    return draw_view((const double[3]){0.5, 0.8, 2.4}, (const double[3]){0.5, 0.5, 0.5}, 40, WIDE, HIGH);
}

/* A point of the cube where f is on the wanted side of L and some ball is near. */
static mns_view within(const mns_field *field, bool inside)
{
    brute *oracle = brute_create(field);
    mns_view view = front();
    mns_field_info info;
    uint64_t random = 3;
    assert_non_null(oracle);
    mns_field_get_info(field, &info);
    view.fov = 90;
    for (int tries = 0; tries < 10000; tries++) {
        long double at[3];
        for (int a = 0; a < 3; a++) view.eye[a] = 0.3 + 0.4 * draw_random(&random), at[a] = view.eye[a];
        long double value = brute_value(oracle, at);
        if (inside ? value < 1.5 * info.iso : value < 0.01 || value > 0.8 * info.iso) continue;
        brute_destroy(oracle);
        return view;
    }
    fail_msg("no eye found");
    return view;
}

/* ---- Against the list ---- */

/* Chords are cut from another form of the same ray: t within a millionth of itself and of a radius, but for
 * a ray in a thousand that meets the surface at a very flat angle. */
static void expect_like_the_list(const mns_image *list, const mns_image *tile, const char *what)
{
    size_t hits = 0, flat = 0, pixels = (size_t)list->width * (size_t)list->height;
    assert_true(list->width == tile->width && list->height == tile->height);
    for (size_t i = 0; i < pixels; i++) {
        int x = (int)(i % (size_t)list->width), y = (int)(i / (size_t)list->width);
        if (isfinite(list->t[i]) != isfinite(tile->t[i]) || list->certain[i] != tile->certain[i])
            fail_msg("%s: pixel %d,%d: t is %g and %g, certain %g and %g", what, x, y, (double)list->t[i],
                     (double)tile->t[i], (double)list->certain[i], (double)tile->certain[i]);
        if (!isfinite(list->t[i])) continue;
        double a = (double)list->t[i] + (double)list->t_lo[i], b = (double)tile->t[i] + (double)tile->t_lo[i];
        double error = fabs(a - b) / (a + 0.1), along = 0;
        for (size_t c = 0; c < 3; c++)
            along += (double)list->normal[3 * i + c] * (double)tile->normal[3 * i + c];
        hits++;
        flat += error > 1e-6;
        if (error > 1e-4 || along < 0.9999)
            fail_msg("%s: pixel %d,%d: t differs by %g of itself, the normals' cosine is %g", what, x, y,
                     error, along);
        for (size_t c = 0; c < 4; c++)
            if (!(fabsf(list->rgba[4 * i + c] - tile->rgba[4 * i + c]) < 4e-3f))
                fail_msg("%s: pixel %d,%d: colours differ", what, x, y);
    }
    if (hits < 500 || flat > hits / 1000)
        fail_msg("%s: %zu hits, t differs at %zu of them", what, hits, flat);
}

static void compare(draw_fixture *d, const mns_field *field, const mns_view *view, const mns_look *look,
                    const mns_options *options, const char *what)
{
    mns_options list = *options, tile = *options;
    list.method = MNS_METHOD_LIST;
    tile.method = MNS_METHOD_TILE;
    mns_image *a = draw_image(d, field, view, look, &list), *b = draw_image(d, field, view, look, &tile);
    assert_string_equal(d->stats.method, "tile");
    expect_like_the_list(a, b, what);
    mns_image_destroy(a);
    mns_image_destroy(b);
    draw_fixture_check(d);
}

/* The second back end has the same rasteriser behind it, and compiling takes longest: a few are enough. */
static bool all_of(const draw_fixture *d)
{
    return d->gl.backend != MNS_BACKEND_OSMESA;
}

static void every_kernel_draws_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel += all_of(d) ? 1 : 4) {
        mns_field *field = cloud_field(&plain, (mns_kernel)kernel);
        compare(d, field, &view, NULL, &(mns_options){0}, mns_kernel_name((mns_kernel)kernel));
        mns_field_destroy(field);
    }
}

static void every_solver_draws_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    mns_field *field = draw_generated("dense:700", MNS_KERNEL_POLY3);
    view.look_at[0] = 1, view.eye[0] = 1;
    compare(d, field, &view, NULL, &(mns_options){.solver = MNS_SOLVER_CUBIC}, "cubic");
    if (all_of(d)) compare(d, field, &view, NULL, &(mns_options){.solver = MNS_SOLVER_EXACT}, "exact, dense");
    mns_field_destroy(field);
}

static void radii_and_strengths_draw_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    static const cloud *const clouds[] = {&radii, &gains, &signs, &thick};
    static const char *const names[] = {"radii", "strengths", "both signs", "no cores"};
    mns_view view = front();
    for (size_t i = 0; i < 4; i++) {
        mns_field *field = cloud_field(clouds[i], MNS_KERNEL_POLY3);
        compare(d, field, &view, NULL, &(mns_options){0}, names[i]);
        mns_field_destroy(field);
    }
}

static void colours_draw_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    mns_field *field = cloud_field(&plain, MNS_KERNEL_POLY3);
    compare(d, field, &view, &(mns_look){.color_by = "heat"}, &(mns_options){0}, "numbers");
    mns_field_destroy(field);
    if (!all_of(d)) return;
    field = draw_generated("molecule:300", MNS_KERNEL_POLY3);
    compare(d, field, &(mns_view){.width = WIDE, .height = HIGH}, &(mns_look){.color_by = "element"},
            &(mns_options){0}, "labels");
    mns_field_destroy(field);
}

static void every_place_of_the_eye_draws_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = cloud_field(&plain, MNS_KERNEL_POLY3), *both = cloud_field(&signs, MNS_KERNEL_POLY3);
    mns_view view = within(field, false);
    compare(d, field, &view, NULL, &(mns_options){0}, "eye in a ball");
    view = within(field, true);
    compare(d, field, &view, NULL, &(mns_options){0}, "eye inside the surface");
    if (all_of(d)) {
        view = within(both, true);
        compare(d, both, &view, NULL, &(mns_options){0}, "eye inside, both signs");
    }
    view = draw_view((const double[3]){48, 60, 64}, (const double[3]){0.5, 0.5, 0.5}, 0.9, WIDE, HIGH);
    compare(d, field, &view, NULL, &(mns_options){0}, "far");
    view = draw_view((const double[3]){0.5, 0.5, 1.2}, (const double[3]){0.4, 0.5, 0.5}, 150, WIDE, HIGH);
    compare(d, field, &view, NULL, &(mns_options){0}, "150 degrees");
    mns_field_destroy(field);
    mns_field_destroy(both);
}

/* A static field's lists were made for pixels' centres; samples beside them want their own. */
static void samples_draw_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
    mns_field *field = draw_generated("scattered:3000", MNS_KERNEL_POLY3);
    mns_options one = {.samples = 1, .method = MNS_METHOD_TILE},
                four = {.samples = 4, .method = MNS_METHOD_TILE};
    mns_image *before = draw_image(d, field, &view, NULL, &one);
    mns_image *after_one = draw_image(d, field, &view, NULL, &four);
    compare(d, field, &view, NULL, &(mns_options){.samples = 4}, "samples");
    mns_image *fresh = draw_image(d, field, &view, NULL, &four);
    draw_expect_same(after_one, fresh, "samples after one sample");
    size_t smooth = 0;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) smooth += before->rgba[4 * i] != fresh->rgba[4 * i];
    assert_true(smooth > 1000);
    mns_image_destroy(before);
    mns_image_destroy(after_one);
    mns_image_destroy(fresh);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

static void few_balls_and_none_draw_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    static const double centre[3] = {0.5, 0.5, 0.5};
    mns_view view = front();
    mns_field *one = draw_field(1, centre, NULL, 0.5, NULL, MNS_KERNEL_POLY3);
    mns_field *none = draw_field(0, NULL, NULL, 1, NULL, MNS_KERNEL_POLY3);
    compare(d, one, &view, NULL, &(mns_options){0}, "one ball");
    mns_options tile = tile_options();
    mns_image *empty = draw_image(d, none, &view, NULL, &tile);
    assert_int_equal(draw_count_hits(empty), 0);
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) assert_true(empty->certain[i] == 1);
    mns_image_destroy(empty);
    view.look_at[2] = 9; /* all behind the eye */
    empty = draw_image(d, one, &view, NULL, &tile);
    assert_int_equal(draw_count_hits(empty), 0);
    mns_image_destroy(empty);
    mns_field_destroy(one);
    mns_field_destroy(none);
    draw_fixture_check(d);
}

static void a_hosts_framebuffer_is_drawn_on(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = host_cloud();
    mns_view view = host_view();
    size_t count;
    host h = host_make(d, false);
    const mns_target target = {.framebuffer = h.framebuffer, .x = 23, .y = 17, .near = 0.1, .far = 10};
    const double z = 1.7;
    mns_options tile = tile_options();
    mns_error error;
    mns_image *plain_image = draw_image(d, field, &view, NULL, NULL);
    host_paint(d, &h, host_rectangle, z, target.near, target.far);
    if (mns_renderer_draw_on(d->renderer, field, &view, NULL, &tile, &target, d->frame, &error) != MNS_OK)
        fail_msg("%s", error.text);
    mns_plan_passes(mns_frame_plan(d->frame), &count);
    assert_true(count == 7 && !plan_needs(mns_frame_plan(d->frame), SHADER_HOST_DEPTH));
    host_pixels *got = host_read(d, &h);
    host_outcome outcome = host_expect_nearer_wins(got, plain_image, &view, &target, host_rectangle, z, 2e-6);
    assert_true(outcome.ours > 1000 && outcome.behind > 50);
    free(got);
    mns_image_destroy(plain_image);
    host_free(d, &h);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* ---- Against the oracle ---- */

static void rays_hit_where_the_oracle_says(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front(), resolved;
    mns_field *field = cloud_field(&radii, MNS_KERNEL_POLY3);
    mns_options tile = tile_options();
    mns_image *image = draw_image(d, field, &view, NULL, &tile);
    brute *oracle = brute_create(field);
    brute_tally *tally = brute_tally_create();
    assert_true(oracle && tally && mns_view_resolve(&view, field, &resolved, NULL) == MNS_OK);
    assert_true(brute_tally_add(tally, oracle, &resolved, image, RAYS, 0x1p-40, 1));
    brute_report r = brute_tally_report(tally);
    if (r.missed + r.invented + r.later || r.t_p999 > 2e-6 || r.normal_p999 > 0.1 || r.hits < RAYS / 4)
        fail_msg("%zu hits, %zu missed, %zu invented, %zu later, t p99.9 %g, normal %g", r.hits, r.missed,
                 r.invented, r.later, r.t_p999, r.normal_p999);
    brute_tally_destroy(tally);
    brute_destroy(oracle);
    mns_image_destroy(image);
    mns_field_destroy(field);
}

/* ---- In parts, by blocks, through the slower ways ---- */

static void a_frame_in_parts_has_the_same_bits(void **state)
{
    draw_fixture *d = *state;
    static const size_t most[] = {6000, 700, 200};
    mns_view view = front();
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
    mns_view view = front();
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
    mns_view view = front();
    mns_field *field = cloud_field(&signs, MNS_KERNEL_POLY3);
    mns_options tile = tile_options();
    mns_image *by_texels = draw_image(d, field, &view, NULL, &tile);
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

/* What a path that goes on elsewhere must keep: every hit, and t to a few of a float's roundings. */
static void expect_close(const mns_image *a, const mns_image *b, const char *what)
{
    size_t hits = 0, flat = 0;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        if (isfinite(a->t[i]) != isfinite(b->t[i])) fail_msg("%s: pixel %zu,%zu", what, i % WIDE, i / WIDE);
        if (!isfinite(a->t[i])) continue;
        double error = fabs((double)a->t[i] - (double)b->t[i]) / (double)a->t[i];
        hits++;
        flat += error > 2e-6; /* only where the ray meets the surface at a very flat angle */
        if (error > 1e-4)
            fail_msg("%s: pixel %zu,%zu: t differs by %g of itself", what, i % WIDE, i / WIDE, error);
    }
    if (hits < 1000 || flat > hits / 1000) fail_msg("%s: %zu hits, %zu flat", what, hits, flat);
}

static void the_slower_ways_draw_the_same_picture(void **state)
{
    draw_fixture *d = *state;
    mns_view view = front();
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
    assert_true(p->entries.id && p->tile_heads.id && p->balls.id);
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
    mns_view view = front();
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
    mns_view large = front(), small = front();
    small.width = 77, small.height = 51;
    mns_field *field = cloud_field(&plain, MNS_KERNEL_POLY3);
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
        cmocka_unit_test(every_kernel_draws_what_the_list_draws),
        cmocka_unit_test(every_solver_draws_what_the_list_draws),
        cmocka_unit_test(radii_and_strengths_draw_what_the_list_draws),
        cmocka_unit_test(colours_draw_what_the_list_draws),
        cmocka_unit_test(every_place_of_the_eye_draws_what_the_list_draws),
        cmocka_unit_test(samples_draw_what_the_list_draws),
        cmocka_unit_test(few_balls_and_none_draw_what_the_list_draws),
        cmocka_unit_test(a_hosts_framebuffer_is_drawn_on),
        cmocka_unit_test(rays_hit_where_the_oracle_says),
        cmocka_unit_test(a_frame_in_parts_has_the_same_bits),
        cmocka_unit_test(a_pixel_whose_list_alone_passes_the_limit_is_refused),
        cmocka_unit_test(texels_and_storage_blocks_give_the_same_bits),
        cmocka_unit_test(the_slower_ways_draw_the_same_picture),
        cmocka_unit_test(nothing_of_the_gathering_is_made),
        cmocka_unit_test(what_has_not_moved_is_binned_once),
        cmocka_unit_test(methods_and_sizes_in_turn_do_not_disturb_each_other),
    };
    return cmocka_run_group_tests_name("gl_tile", tests, draw_fixture_setup, draw_fixture_teardown);
}
