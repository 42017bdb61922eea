/* What a window stands on, without one: the camera, its pace, the time of a sequence, frames read on a
 * thread, the words of a command line that change. */
#include "app/view.h"
#include "window/camera.h"
#include "window/pace.h"
#include "window/player.h"
#include "window/script.h"
#include "window/timeline.h"

#include <semaphore.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* ---- The camera ---- */

static camera at(double x, double y, double z)
{
    return (camera){{x, y, z}, {0, 0, 0}, {0, 1, 0}, 45};
}

static void near_to(vec3 a, vec3 b, double by)
{
    if (!(vec3_length(vec3_sub(a, b)) <= by))
        fail_msg("%g,%g,%g is not %g,%g,%g", a.x, a.y, a.z, b.x, b.y, b.z);
}

static const double QUARTER = 1.57079632679489661923;

static void orbit_goes_around_the_target(void **state)
{
    (void)state;
    camera c = at(0, 0, 5);
    camera_orbit(&c, QUARTER, 0);
    near_to(c.eye, vec3_make(5, 0, 0), 1e-12);
    camera_orbit(&c, QUARTER, 0.5);
    assert_float_equal(vec3_length(c.eye), 5, 1e-12);
    assert_float_equal(c.eye.y, 5 * sin(0.5), 1e-12);
    near_to(c.target, vec3_make(0, 0, 0), 0);
    /* What is done in parts is what is done at once. */
    camera parts = at(1, 2, 3), once = parts;
    for (int i = 0; i < 10; i++) camera_orbit(&parts, 0.03, 0);
    camera_orbit(&once, 0.3, 0);
    near_to(parts.eye, once.eye, 1e-12);
}

static void orbit_stops_short_of_the_poles(void **state)
{
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        camera c = at(0, 0, 5);
        for (int i = 0; i < 50; i++) camera_orbit(&c, 0.1, sign * 0.3);
        assert_true(sign * c.eye.y > 4.99 && sign * c.eye.y < 5);
        mns_view view = {0}, resolved;
        camera_put(&c, &view);
        mns_field_desc desc = {0};
        mns_field *field;
        assert_int_equal(mns_field_create(&desc, &field, NULL), MNS_OK);
        assert_int_equal(mns_view_resolve(&view, field, &resolved, NULL), MNS_OK);
        mns_field_destroy(field);
    }
}

static void zoom_keeps_what_is_under_the_cursor(void **state)
{
    (void)state;
    camera c = at(1, 2, 5);
    mns_view view = {.width = 640, .height = 480};
    camera_put(&c, &view);
    double before[3], after[3];
    mns_view_ray(&view, 500, 100, before);
    vec3 point = vec3_along(c.eye, 3, vec3_load(before));
    for (int i = 0; i < 5; i++) camera_zoom(&c, 0.8, point);
    assert_float_equal(vec3_length(vec3_sub(point, c.eye)), 3 * pow(0.8, 5), 1e-12);
    camera_put(&c, &view);
    mns_view_ray(&view, 500, 100, after);
    near_to(vec3_load(before), vec3_load(after), 1e-12);
    /* A wheel that never stops comes to rest before rounding turns the view. */
    for (int i = 0; i < 1000; i++) camera_zoom(&c, 0.5, point);
    assert_true(vec3_length(vec3_sub(c.target, c.eye)) > 0);
    assert_true(vec3_is_finite(c.eye));
}

static void pan_moves_by_the_picture(void **state)
{
    (void)state;
    camera c = at(0, 0, 5);
    double height = 2 * tan(QUARTER / 4) * 5;
    camera_pan(&c, 0.5, -0.25);
    near_to(c.target, vec3_make(0.5 * height, -0.25 * height, 0), 1e-12);
    near_to(c.eye, vec3_make(0.5 * height, -0.25 * height, 5), 1e-12);
    camera_turn(&c, QUARTER, 0);
    near_to(c.eye, vec3_make(0.5 * height, -0.25 * height, 5), 1e-12);
    near_to(vec3_sub(c.target, c.eye), vec3_make(5, 0, 0), 1e-12);
    camera_fly(&c, 0, 0, 2);
    near_to(c.eye, vec3_make(0.5 * height + 2, -0.25 * height, 5), 1e-12);
}

static void fit_shows_every_corner(void **state)
{
    (void)state;
    static const double lo[3] = {-1, 2, -3}, hi[3] = {4, 2.5, 7};
    static const char *const sides[] = {"front", "back", "left", "right", "top", "bottom"};
    for (size_t s = 0; s < 6; s++) {
        camera c = at(1, 2, 3);
        vec3 right, up, forward;
        assert_true(camera_stand(&c, sides[s]));
        camera_fit(&c, lo, hi, 1.5);
        camera_axes(&c, &right, &up, &forward);
        double most = 0;
        for (int i = 0; i < 8; i++) {
            vec3 corner = {i & 1 ? lo[0] : hi[0], i & 2 ? lo[1] : hi[1], i & 4 ? lo[2] : hi[2]};
            vec3 from = vec3_sub(corner, c.eye);
            double depth = vec3_dot(from, forward) * tan(QUARTER / 4);
            assert_true(depth > 0);
            most = fmax(most,
                        fmax(fabs(vec3_dot(from, right)) / (1.5 * depth), fabs(vec3_dot(from, up)) / depth));
        }
        assert_true(most <= 1 + 1e-9 && most > 0.8);
    }
    camera c = at(0, 0, 5);
    assert_false(camera_stand(&c, "inside"));
}

static void field_of_view_keeps_the_size_at_the_target(void **state)
{
    (void)state;
    camera c = at(0, 0, 5);
    double size = 5 * tan(QUARTER / 4);
    camera_widen(&c, 90);
    assert_float_equal(c.eye.z * tan(QUARTER / 2), size, 1e-12);
    camera_widen(&c, 1000);
    assert_float_equal(c.fov, 170, 0);
}

/* ---- Pace and time ---- */

/* Frames that take `full` ms at the whole size, by their pixels. */
static double settle(pace *p, double full, int frames)
{
    for (int i = 0; i < frames; i++) pace_drawn(p, full * pace_scale(p) * pace_scale(p));
    return full * pace_scale(p) * pace_scale(p);
}

static void pace_drops_and_comes_back(void **state)
{
    (void)state;
    pace p;
    pace_begin(&p, 1);
    assert_float_equal(pace_scale(&p), 1, 0);
    double ms = settle(&p, 300, 4);
    assert_true(ms <= 1.15 * p.target_ms && ms > 0.5 * p.target_ms);
    int step = p.step;
    settle(&p, 300, 50);
    assert_in_range(p.step, step, step + 1); /* it does not swing */
    settle(&p, 10, 20);
    assert_float_equal(pace_scale(&p), 1, 0);
    settle(&p, 1e6, 20);
    assert_int_equal(p.step, PACE_LEAST);
    assert_int_equal(pace_size(&p, 1), 1);
    pace_begin(&p, 0);
    assert_float_equal(p.target_ms, 1000.0 / 60, 1e-12);
}

/* Where most of the time hangs on no pixel, few pixels would gain nothing. */
static void pace_leaves_pixels_that_cost_little(void **state)
{
    (void)state;
    pace p;
    pace_begin(&p, 1);
    for (int i = 0; i < 40; i++) pace_drawn(&p, 200 + 400 * pace_scale(&p) * pace_scale(&p));
    double pixels = 400 * pace_scale(&p) * pace_scale(&p);
    assert_true(pixels > 25 && pixels < 60);
    assert_float_equal(p.fixed_ms, 200, 1e-6);
}

/* What a small picture says of the whole one lowers the size, and never raises it. */
static void pace_follows_what_is_expected(void **state)
{
    (void)state;
    pace p;
    pace_begin(&p, 1);
    pace_expect(&p, 10, 0);
    assert_int_equal(p.step, PACE_STEPS);
    pace_expect(&p, 4 * p.target_ms, 0);
    assert_int_equal(p.step, PACE_STEPS / 2);
    pace_expect(&p, 10, 0);
    assert_int_equal(p.step, PACE_STEPS / 2);
    pace_expect(&p, 1e6, 1000); /* the pixels get a quarter of what hangs on none */
    assert_int_equal(p.step, PACE_LEAST);
}

static void a_sequence_keeps_its_beat(void **state)
{
    (void)state;
    timeline t;
    timeline_begin(&t, 10, 0);
    assert_int_equal(timeline_next(&t, t.shown, 0, 0), -1);
    timeline_play(&t, 1000);
    double step = 1000 / 24.0;
    assert_int_equal(timeline_next(&t, t.shown, 1000, 0), 1);
    assert_float_equal(timeline_due_ms(&t, 1), 1000 + step, 1e-9);
    timeline_show(&t, 1, 1000 + step + 3);
    assert_float_equal(timeline_due_ms(&t, 2), 1000 + 2 * step, 1e-9);
    assert_int_equal(t.dropped, 0);
}

static void what_comes_too_late_is_dropped_and_told(void **state)
{
    (void)state;
    timeline t;
    timeline_begin(&t, 10, 7);
    timeline_play(&t, 0);
    double step = 1000 / 24.0;
    assert_int_equal(timeline_next(&t, t.shown, 0, 4.5 * step), 1); /* 8, 9 and 0 would be over */
    timeline_show(&t, 1, 4 * step);
    assert_int_equal(t.dropped, 3);
    assert_int_equal(timeline_next(&t, t.shown, 4 * step, 1e9), 0); /* never more than once around */
    t.loops = false;
    assert_int_equal(timeline_next(&t, t.shown, 4 * step, 1e9), 9); /* nor past the end */
    timeline_show(&t, 9, 5 * step);
    assert_false(t.playing);
    timeline_play(&t, 0); /* from the beginning again, which comes first */
    assert_int_equal(timeline_next(&t, t.shown, 0, 0), 0);
    timeline_show(&t, 0, step);
    assert_true(t.playing);
    assert_int_equal(timeline_next(&t, t.shown, step, 0), 1);
    timeline_speed(&t, 1000, 0);
    assert_float_equal(t.speed, 64, 0);
    assert_int_equal(timeline_clamp(&t, 12), 9);
}

/* While one is shown and the next one waits, the one after that is read. */
static void two_frames_are_on_their_way(void **state)
{
    (void)state;
    timeline t;
    const double step = 1000 / 24.0;
    timeline_begin(&t, 4, 0);
    timeline_play(&t, 0);
    assert_int_equal(timeline_next(&t, 1, 0, 0), 2);
    assert_int_equal(timeline_next(&t, 1, 0, 3.5 * step), 3);
    assert_int_equal(timeline_next(&t, 3, 0, 0), 0); /* around */
    assert_int_equal(timeline_next(&t, 3, 0, 1e9), 2);
    timeline_loop(&t, false);
    assert_int_equal(timeline_next(&t, 2, 0, 0), 3);
    assert_int_equal(timeline_next(&t, 3, 0, 0), -1); /* the last one waits already */
    timeline_show(&t, 3, step);
    timeline_loop(&t, true);
    timeline_play(&t, 0);
    timeline_loop(&t, false); /* at its end: that is one */
    assert_false(t.playing);
    timeline_begin(&t, 2, 1);
    timeline_play(&t, 0);
    assert_int_equal(timeline_next(&t, 0, 0, 0), 1); /* the one that is shown comes again */
}

/* ---- Frames on a thread ---- */

static sem_t woken;

static void wake(void)
{
    sem_post(&woken);
}

static void frames_are_read_on_a_thread(void **state)
{
    (void)state;
    const char *name = "drop:500:1:6";
    mns_input *input;
    player p;
    assert_int_equal(mns_input_open(&name, 1, NULL, &input, NULL), MNS_OK);
    sem_init(&woken, 0, 0);
    assert_int_equal(player_open(&p, input, wake, 1, NULL), MNS_OK);
    for (long frame = 0; frame < 7; frame++) {
        mns_field *field = NULL;
        mns_field_info info;
        mns_status status;
        mns_error error;
        double ms;
        long got;
        player_ask(&p, frame);
        assert_int_equal(player_busy(&p), frame);
        sem_wait(&woken);
        assert_true(player_take(&p, &got, &field, &ms, &status, &error));
        assert_int_equal(got, frame);
        assert_int_equal(player_busy(&p), -1);
        assert_int_equal(status, frame < 6 ? MNS_OK : MNS_ERROR_USAGE);
        if (frame == 6) break;
        mns_field_get_info(field, &info);
        assert_int_equal(info.count, 500);
        mns_field_destroy(field);
    }
    player_ask(&p, 3); /* one that nobody takes */
    player_close(&p);
    sem_destroy(&woken);
}

/* ---- Scripts and words ---- */

static void a_script_gives_its_lines(void **state)
{
    (void)state;
    char path[] = "/tmp/meniscus-script-XXXXXX";
    int file = mkstemp(path);
    static const char text[] = "# a word before\n\n  orbit 1 2 \r\nrest";
    assert_int_equal(write(file, text, sizeof text - 1), (ssize_t)sizeof text - 1);
    close(file);
    script s;
    assert_int_equal(script_read(&s, path, NULL), MNS_OK);
    assert_string_equal(script_next(&s), "orbit 1 2");
    assert_int_equal(s.line, 3);
    assert_string_equal(script_next(&s), "rest");
    assert_null(script_next(&s));
    script_free(&s);
    unlink(path);
    mns_error error;
    assert_int_equal(script_read(&s, path, &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, path));
}

static void expect_words(const view_words *words, const option_table *table, const char *expected)
{
    static const char *const without[] = {"size", NULL};
    char *text = view_words_shell(words, table, without);
    assert_non_null(text);
    assert_string_equal(text, expected);
    free(text);
}

static void options_change_as_words(void **state)
{
    (void)state;
    static const option_row rows[] = {{NULL, 0, NULL, "A heading:", NULL}, {"iso", 0, "L", "", NULL},
                                      {"light", 0, "SPEC", "", NULL},      {"size", 's', "WxH", "", NULL},
                                      {"method", 0, "NAME", "", NULL},     {"shadows", 0, "?N", "", NULL}};
    static const option_table table = {.command = "view", .rows = rows, .count = 6};
    char *argv[] = {"view", "a b.csv", "--iso", "0.3", "--light=1,2,3", "-s", "9x9", "--meth=list"};
    view_words words;
    assert_true(view_words_copy(&words, argv, 8));
    expect_words(&words, &table, " 'a b.csv' --iso 0.3 --light=1,2,3 --meth=list");
    assert_true(view_words_set(&words, &table, "iso", "0.4"));
    assert_true(view_words_set(&words, &table, "method", NULL));
    assert_true(view_words_set(&words, &table, "shadows", ""));
    expect_words(&words, &table, " 'a b.csv' --light=1,2,3 --iso=0.4 --shadows");
    static const char *const names[] = {"it's.csv", "b"};
    assert_true(view_words_inputs(&words, &table, names, 2));
    expect_words(&words, &table, " --light=1,2,3 --iso=0.4 --shadows 'it'\\''s.csv' b");
    view_words_free(&words);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orbit_goes_around_the_target),
        cmocka_unit_test(orbit_stops_short_of_the_poles),
        cmocka_unit_test(zoom_keeps_what_is_under_the_cursor),
        cmocka_unit_test(pan_moves_by_the_picture),
        cmocka_unit_test(fit_shows_every_corner),
        cmocka_unit_test(field_of_view_keeps_the_size_at_the_target),
        cmocka_unit_test(pace_drops_and_comes_back),
        cmocka_unit_test(pace_leaves_pixels_that_cost_little),
        cmocka_unit_test(pace_follows_what_is_expected),
        cmocka_unit_test(a_sequence_keeps_its_beat),
        cmocka_unit_test(what_comes_too_late_is_dropped_and_told),
        cmocka_unit_test(two_frames_are_on_their_way),
        cmocka_unit_test(frames_are_read_on_a_thread),
        cmocka_unit_test(a_script_gives_its_lines),
        cmocka_unit_test(options_change_as_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
