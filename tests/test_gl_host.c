/* Drawing into a host's framebuffer: the nearer one wins, depth is the host's projection's, lists are clipped
 * by what the host drew, and the host finds its GL state as it was. */
#include "support/host_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Over a 32-bit and over a 24-bit depth buffer, the view in the middle of the framebuffer. */
static void the_nearer_one_wins_at_every_pixel(void **state)
{
    draw_fixture *d = *state;
    mns_view view = host_view();
    mns_field *field = host_cloud();
    mns_image *plain = draw_image(d, field, &view, NULL, NULL);
    for (int stencil = 0; stencil < 2; stencil++) {
        host h = host_make(d, stencil);
        mns_target target = {.framebuffer = h.framebuffer, .x = 23, .y = 17, .near = 0.1, .far = 10};
        host_paint(d, &h, host_rectangle, 1.5, target.near, target.far);
        host_draw_on(d, field, &view, &target);
        host_pixels *got = host_read(d, &h);
        host_outcome seen = host_expect_nearer_wins(got, plain, &view, &target, host_rectangle, 1.5, 1e-6);
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
    mns_view view = host_view();
    mns_field *field = host_cloud();
    mns_image *plain = draw_image(d, field, &view, NULL, NULL);
    host h = host_make(d, false);
    mns_target target = {.framebuffer = h.framebuffer, .near = 1.5, .far = 2};
    host_paint(d, &h, NULL, 0, target.near, target.far);
    host_draw_on(d, field, &view, &target);
    host_pixels *got = host_read(d, &h);
    host_outcome seen = host_expect_nearer_wins(got, plain, &view, &target, NULL, 0, 1e-6);
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
    mns_view view = host_view();
    mns_field *field = host_cloud();
    host h = host_make(d, false);
    mns_target target = {.framebuffer = h.framebuffer, .near = 0.1, .far = 10};
    host_paint(d, &h, NULL, 0, target.near, target.far);
    host_draw_on(d, field, &view, &target);
    uint64_t nodes = d->stats.list_nodes;
    for (int i = 0; i < 2; i++) {
        host_paint(d, &h, all, depths[i], target.near, target.far);
        host_draw_on(d, field, &view, &target);
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
    mns_view view = host_view();
    view.eye[1] = 0.5, view.eye[2] = 0.5 + distance;
    view.fov = 2 * atan(0.8 / distance) * 180 / 3.14159265358979323846;
    mns_field *field = host_cloud();
    mns_image *plain = draw_image(d, field, &view, NULL, NULL);
    host h = host_make(d, false);
    mns_target target = {
        .framebuffer = h.framebuffer, .x = 23, .y = 17, .near = distance - 3, .far = distance + 3};
    double z = distance - 0.35;
    host_paint(d, &h, host_rectangle, z, target.near, target.far);
    host_draw_on(d, field, &view, &target);
    host_pixels *got = host_read(d, &h);
    host_outcome seen = host_expect_nearer_wins(got, plain, &view, &target, host_rectangle, z, 1e-5);
    assert_true(seen.ours > 2000 && seen.behind > 300);
    free(got);
    host_free(d, &h);
    mns_image_destroy(plain);
    mns_field_destroy(field);
}

static void plain_draws_go_on_as_before(void **state)
{
    draw_fixture *d = *state;
    mns_view view = host_view();
    mns_field *field = host_cloud();
    mns_image *before = draw_image(d, field, &view, NULL, NULL);
    host h = host_make(d, false);
    mns_target target = {.framebuffer = h.framebuffer, .near = 0.1, .far = 10};
    host_paint(d, &h, host_rectangle, 1.2, target.near, target.far);
    host_draw_on(d, field, &view, &target);
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
    mns_field *field = host_cloud();
    mns_view view = host_view();
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

static void two_renderers_on_two_contexts_do_not_meet(void **state)
{
    draw_fixture *d = *state;
    mns_error error;
    void *second;
    mns_view view = host_view(), smaller = host_view();
    smaller.width = 64, smaller.height = 48;
    mns_field *field = host_cloud(),
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
        cmocka_unit_test(two_renderers_on_two_contexts_do_not_meet),
    };
    return cmocka_run_group_tests_name("host", tests, draw_fixture_setup, draw_fixture_teardown);
}
