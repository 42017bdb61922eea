/* The method tile draws the list's picture: the same hits at the same places, whatever is asked for, from
 * wherever it is seen. */
#include "plan/plan.h"
#include "support/exact.h"
#include "support/host_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static mns_options tile_options(void)
{
    return (mns_options){.method = MNS_METHOD_TILE};
}

/* ---- Fields and views ---- */

static const cloud gains = {400, 0, 0.11, 0.11, 0.1, 2};
static const cloud thick = {400, 0, 0.2, 0.2, 0.12, 0.19}; /* no core, long lists */

/* With a column of numbers. */
static mns_field *hot_field(void)
{
    enum { HOT = 300 };
    static double position[3 * HOT], heat[HOT];
    uint64_t random = 23;
    for (size_t i = 0; i < 3 * (size_t)HOT; i++) position[i] = draw_random(&random);
    for (size_t i = 0; i < HOT; i++) heat[i] = position[3 * i];
    const mns_column_desc column = {"heat", {.data = heat}};
    const mns_field_desc desc = {.count = HOT,
                                 .position = {.data = position},
                                 .uniform_radius = 0.13,
                                 .columns = &column,
                                 .column_count = 1};
    mns_field *field;
    mns_error error;
    if (mns_field_create(&desc, &field, &error) != MNS_OK) fail_msg("%s", error.text);
    return field;
}

/* From a point of the cube that lies in a ball, inside the surface or outside. */
static mns_view within(const mns_field *field, bool inside)
{
    mns_view view = exact_view();
    view.fov = 90;
    exact_eye(field, inside, view.eye);
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
    mns_view view = exact_view();
    for (int kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel += all_of(d) ? 1 : 4) {
        mns_field *field = cloud_field(&cloud_plain, (mns_kernel)kernel);
        compare(d, field, &view, NULL, &(mns_options){0}, mns_kernel_name((mns_kernel)kernel));
        mns_field_destroy(field);
    }
}

static void every_solver_draws_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    mns_view view = exact_view();
    mns_field *field = draw_generated("dense:700", MNS_KERNEL_POLY3);
    view.look_at[0] = 1, view.eye[0] = 1;
    compare(d, field, &view, NULL, &(mns_options){.solver = MNS_SOLVER_CUBIC}, "cubic");
    if (all_of(d)) compare(d, field, &view, NULL, &(mns_options){.solver = MNS_SOLVER_EXACT}, "exact, dense");
    mns_field_destroy(field);
}

static void radii_and_strengths_draw_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    static const cloud *const clouds[] = {&cloud_radii, &gains, &cloud_signs, &thick};
    static const char *const names[] = {"radii", "strengths", "both signs", "no cores"};
    mns_view view = exact_view();
    for (size_t i = 0; i < 4; i += all_of(d) ? 1 : 2) {
        mns_field *field = cloud_field(clouds[i], MNS_KERNEL_POLY3);
        compare(d, field, &view, NULL, &(mns_options){0}, names[i]);
        mns_field_destroy(field);
    }
}

static void colours_draw_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    mns_view view = exact_view();
    mns_field *field = hot_field();
    compare(d, field, &view, &(mns_look){.color_by = "heat"}, &(mns_options){0}, "numbers");
    mns_field_destroy(field);
    if (!all_of(d)) return;
    field = draw_generated("molecule:300", MNS_KERNEL_POLY3);
    compare(d, field, &(mns_view){.width = EXACT_WIDE, .height = EXACT_HIGH},
            &(mns_look){.color_by = "element"}, &(mns_options){0}, "labels");
    mns_field_destroy(field);
}

static void every_place_of_the_eye_draws_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = cloud_field(&cloud_plain, MNS_KERNEL_POLY3),
              *both = cloud_field(&cloud_signs, MNS_KERNEL_POLY3);
    mns_view view = within(field, true);
    compare(d, field, &view, NULL, &(mns_options){0}, "eye inside the surface");
    if (all_of(d)) {
        view = within(both, true);
        compare(d, both, &view, NULL, &(mns_options){0}, "eye inside, both signs");
        view = within(field, false);
        compare(d, field, &view, NULL, &(mns_options){0}, "eye in a ball");
    }
    view = draw_view((const double[3]){48, 60, 64}, (const double[3]){0.5, 0.5, 0.5}, 0.9, EXACT_WIDE,
                     EXACT_HIGH);
    compare(d, field, &view, NULL, &(mns_options){0}, "far");
    view = draw_view((const double[3]){0.5, 0.5, 1.2}, (const double[3]){0.4, 0.5, 0.5}, 150, EXACT_WIDE,
                     EXACT_HIGH);
    compare(d, field, &view, NULL, &(mns_options){0}, "150 degrees");
    mns_field_destroy(field);
    mns_field_destroy(both);
}

/* A static field's lists were made for pixels' centres; samples beside them want their own. */
static void samples_draw_what_the_list_draws(void **state)
{
    draw_fixture *d = *state;
    mns_view view = exact_view();
    mns_field *field = draw_generated("scattered:3000", MNS_KERNEL_POLY3);
    mns_options one = {.samples = 1, .method = MNS_METHOD_TILE},
                four = {.samples = 4, .method = MNS_METHOD_TILE};
    mns_image *before = draw_image(d, field, &view, NULL, &one);
    mns_image *after_one = draw_image(d, field, &view, NULL, &four);
    compare(d, field, &view, NULL, &(mns_options){.samples = 4}, "samples");
    mns_image *fresh = draw_image(d, field, &view, NULL, &four);
    draw_expect_same(after_one, fresh, "samples after one sample");
    size_t smooth = 0;
    for (size_t i = 0; i < (size_t)EXACT_WIDE * EXACT_HIGH; i++)
        smooth += before->rgba[4 * i] != fresh->rgba[4 * i];
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
    mns_view view = exact_view();
    mns_field *one = draw_field(1, centre, NULL, 0.5, NULL, MNS_KERNEL_POLY3);
    mns_field *none = draw_field(0, NULL, NULL, 1, NULL, MNS_KERNEL_POLY3);
    compare(d, one, &view, NULL, &(mns_options){0}, "one ball");
    mns_options tile = tile_options();
    mns_image *empty = draw_image(d, none, &view, NULL, &tile);
    assert_int_equal(draw_count_hits(empty), 0);
    for (size_t i = 0; i < (size_t)EXACT_WIDE * EXACT_HIGH; i++) assert_true(empty->certain[i] == 1);
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
    mns_view view = exact_view();
    mns_options tile = tile_options();
    exact_expect_cloud(*state, &tile, "tile, mixed radii", &cloud_radii, MNS_KERNEL_POLY3, &view);
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
    };
    return cmocka_run_group_tests_name("gl_tile", tests, draw_fixture_setup, draw_fixture_teardown);
}
