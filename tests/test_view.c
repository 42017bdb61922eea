/* The camera: what is fitted, what is refused, and where a pixel's ray goes. */
#include "scene/view.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static mns_field *field_of(const double *position, size_t count, double radius)
{
    mns_field *field = NULL;
    mns_error error;
    mns_field_desc desc = {.count = count, .position = {.data = position}, .uniform_radius = radius};
    if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
    return field;
}

/* The largest of |x| and |y| of the box's corners on the image, 1 being the frame's edges; all must lie
 * before the eye. */
static double reach(const mns_view *view, const double lo[3], const double hi[3])
{
    view_frame frame;
    view_basis(view, &frame);
    double largest = 0, aspect = (double)view->width / view->height;
    for (int i = 0; i < 8; i++) {
        vec3 corner = {i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]};
        vec3 c = vec3_sub(corner, frame.eye);
        double depth = vec3_dot(c, frame.forward);
        assert_true(depth > 0);
        double x = vec3_dot(c, frame.right) / (depth * frame.tan_half * aspect);
        double y = vec3_dot(c, frame.up) / (depth * frame.tan_half);
        largest = fmax(largest, fmax(fabs(x), fabs(y)));
    }
    return largest;
}

static mns_view resolve(const mns_view *view, const mns_field *field)
{
    mns_view resolved;
    mns_error error;
    if (mns_view_resolve(view, field, &resolved, &error)) fail_msg("%s", error.text);
    assert_int_equal(resolved.set, MNS_VIEW_EYE | MNS_VIEW_LOOK_AT);
    return resolved;
}

static const double PAIR[] = {-3, 1, 7, 5, 2, -4};

static void zeroed_view_means_the_defaults(void **state)
{
    (void)state;
    mns_field *field = field_of(PAIR, 2, 0.5);
    mns_view view = resolve(NULL, field), zeroed = resolve(&(mns_view){0}, field);
    assert_memory_equal(&view, &zeroed, sizeof view);
    assert_int_equal(view.width, 1024);
    assert_int_equal(view.height, 768);
    assert_true(view.fov == 45 && view.up[0] == 0 && view.up[1] == 1 && view.up[2] == 0);
    assert_true(view.look_at[0] == 1 && view.look_at[1] == 1.5 && view.look_at[2] == 1.5);
    assert_true(view.eye[0] == 1 && view.eye[1] == 1.5 && view.eye[2] > 1.5);
    mns_field_destroy(field);
}

static void fit_touches_the_margin_whatever_the_frame(void **state)
{
    (void)state;
    static const int size[][2] = {{1024, 768}, {100, 1000}, {1000, 100}, {1, 1}, {65536, 1}};
    static const double fov[] = {1, 45, 120, 179};
    static const double up[][3] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {1, 2, 0.5}};
    mns_field *field = field_of(PAIR, 2, 0.5);
    mns_field_info info;
    mns_field_get_info(field, &info);
    for (size_t s = 0; s < 5; s++)
        for (size_t f = 0; f < 4; f++)
            for (size_t u = 0; u < 4; u++) {
                mns_view asked = {.fov = fov[f], .width = size[s][0], .height = size[s][1]};
                memcpy(asked.up, up[u], sizeof asked.up);
                mns_view view = resolve(&asked, field);
                double edge = reach(&view, info.effective_lo, info.effective_hi);
                assert_true(fabs(edge - (1 - VIEW_MARGIN)) < 1e-9);
            }
    mns_field_destroy(field);
}

static void look_at_alone_is_kept_and_the_whole_field_is_seen(void **state)
{
    (void)state;
    mns_field *field = field_of(PAIR, 2, 0.5);
    mns_field_info info;
    mns_field_get_info(field, &info);
    mns_view view = resolve(&(mns_view){.set = MNS_VIEW_LOOK_AT, .look_at = {9, -2, 3}}, field);
    assert_true(view.look_at[0] == 9 && view.look_at[1] == -2 && view.look_at[2] == 3);
    assert_true(view.eye[0] == 9 && view.eye[1] == -2 && view.eye[2] > 3);
    assert_true(fabs(reach(&view, info.effective_lo, info.effective_hi) - (1 - VIEW_MARGIN)) < 1e-9);
    mns_field_destroy(field);
}

static void eye_alone_is_kept_and_looks_at_the_centre(void **state)
{
    (void)state;
    mns_field *field = field_of(PAIR, 2, 0.5);
    mns_view view = resolve(&(mns_view){.set = MNS_VIEW_EYE, .eye = {9, -2, 3}}, field);
    assert_true(view.eye[0] == 9 && view.eye[1] == -2 && view.eye[2] == 3);
    assert_true(view.look_at[0] == 1 && view.look_at[1] == 1.5 && view.look_at[2] == 1.5);
    view = resolve(&(mns_view){.set = MNS_VIEW_EYE, .eye = {1, 1.5, 1.5}}, field);
    assert_true(view.look_at[0] == 1 && view.look_at[1] == 1.5 && view.look_at[2] < 1.5);
    mns_field_destroy(field);
}

static void members_that_are_not_set_are_not_read(void **state)
{
    (void)state;
    mns_field *field = field_of(PAIR, 2, 0.5);
    mns_view fitted = resolve(NULL, field);
    mns_view view = resolve(&(mns_view){.eye = {NAN, 1, 2}, .look_at = {1, INFINITY, 2}}, field);
    assert_memory_equal(&view, &fitted, sizeof view);
    mns_field_destroy(field);
}

static void empty_field_gets_a_view_of_the_unit_cube(void **state)
{
    (void)state;
    mns_field *field = field_of(NULL, 0, 1);
    static const double lo[3] = {-1, -1, -1}, hi[3] = {1, 1, 1};
    mns_view view = resolve(NULL, field);
    assert_true(fabs(reach(&view, lo, hi) - (1 - VIEW_MARGIN)) < 1e-9);
    mns_field_destroy(field);
}

static void lone_ball_far_from_the_origin_is_fitted(void **state)
{
    (void)state;
    static const double position[3] = {1e5, -2e5, 3e5};
    mns_field *field = field_of(position, 1, 0.25);
    mns_field_info info;
    mns_field_get_info(field, &info);
    mns_view view = resolve(NULL, field);
    assert_true(fabs(reach(&view, info.effective_lo, info.effective_hi) - (1 - VIEW_MARGIN)) < 1e-7);
    mns_field_destroy(field);
}

static void what_makes_no_sense_is_a_usage_error(void **state)
{
    (void)state;
    const unsigned both = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT;
    static const mns_view like = {
        .set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT, .eye = {1, 2, 3}, .look_at = {0, 0, 0}};
    mns_view bad[] = {
        {.set = both, .eye = {1, 2, 3}, .look_at = {1, 2, 3}},
        {.set = both, .eye = {0, 5, 0}},
        {.set = both, .eye = {0, 5, 0}, .up = {0, -3, 0}},
        {.set = both, .eye = {1, 0, 0}, .up = {1e-200, 0, 0}},
        {.up = {0, 0, 1}},
        {.fov = 180},
        {.fov = -1},
        {.fov = NAN},
        {.fov = INFINITY},
        {.width = -1},
        {.height = 65537},
        {.set = MNS_VIEW_EYE, .eye = {NAN, 0, 0}},
        {.set = MNS_VIEW_LOOK_AT, .look_at = {0, INFINITY, 0}},
        {.set = both, .eye = {1, 2, 3}, .up = {0, 1, NAN}},
        {.set = both, .eye = {1e308, 1e308, 0}, .look_at = {-1e308, -1e308, 0}},
    };
    static const char *const word[] = {"eye and look-at",
                                       "up",
                                       "up",
                                       "up",
                                       "up",
                                       "field of view",
                                       "field of view",
                                       "field of view",
                                       "field of view",
                                       "size",
                                       "size",
                                       "eye",
                                       "look-at",
                                       "up",
                                       "too far apart"};
    mns_field *field = field_of(PAIR, 2, 0.5);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        mns_error error = {0};
        mns_view resolved = like;
        assert_int_equal(mns_view_resolve(&bad[i], field, &resolved, &error), MNS_ERROR_USAGE);
        if (!strstr(error.text, word[i]))
            fail_msg("case %zu: \"%s\" does not name \"%s\"", i, error.text, word[i]);
        assert_memory_equal(&resolved, &like, sizeof like);
    }
    mns_field_destroy(field);
}

static void tiny_and_huge_up_vectors_are_directions_all_the_same(void **state)
{
    (void)state;
    static const double length[] = {1e-300, 1, 1e300};
    for (size_t i = 0; i < 3; i++) {
        view_frame frame;
        mns_view view =
            resolve(&(mns_view){.set = MNS_VIEW_EYE, .eye = {0, 0, 5}, .up = {0, length[i], 0}}, NULL);
        view_basis(&view, &frame);
        assert_true(frame.right.x == 1 && frame.up.y == 1 && frame.forward.z == -1);
    }
}

static void rays_meet_the_frame_where_the_pixels_are(void **state)
{
    (void)state;
    mns_view view = resolve(
        &(mns_view){.set = MNS_VIEW_EYE, .eye = {3, 4, 5}, .fov = 60, .width = 200, .height = 100}, NULL);
    view_frame frame;
    view_basis(&view, &frame);
    vec3 middle = view_direction(&frame, 100, 50);
    assert_true(vec3_length(vec3_sub(middle, frame.forward)) < 1e-15);
    assert_true(vec3_dot(vec3_cross(frame.right, frame.up), frame.forward) < -1 + 1e-14);
    /* the top edge's middle stands half the field of view above the view, the bottom edge's below */
    vec3 top = view_direction(&frame, 100, 0), bottom = view_direction(&frame, 100, 100);
    assert_true(fabs(acos(vec3_dot(top, frame.forward)) - PI / 6) < 1e-14);
    assert_true(fabs(vec3_dot(top, frame.up) - 0.5) < 1e-14 &&
                fabs(vec3_dot(bottom, frame.up) + 0.5) < 1e-14);
    /* pixel (0, 0) is the top left, and pixels are square */
    vec3 first = view_direction(&frame, 0.5, 0.5), next = view_direction(&frame, 1.5, 1.5);
    assert_true(vec3_dot(first, frame.right) < 0 && vec3_dot(first, frame.up) > 0);
    vec3 p = vec3_scale(first, 1 / vec3_dot(first, frame.forward)),
         q = vec3_scale(next, 1 / vec3_dot(next, frame.forward));
    vec3 step = vec3_sub(q, p);
    double pixel = 2 * tan(PI / 6) / 100;
    assert_true(fabs(vec3_dot(step, frame.right) - pixel) < 1e-14 &&
                fabs(vec3_dot(step, frame.up) + pixel) < 1e-14);
    for (int i = 0; i < 20; i++)
        assert_true(fabs(vec3_length(view_direction(&frame, 13 * i, 7 * i)) - 1) < 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(zeroed_view_means_the_defaults),
        cmocka_unit_test(fit_touches_the_margin_whatever_the_frame),
        cmocka_unit_test(look_at_alone_is_kept_and_the_whole_field_is_seen),
        cmocka_unit_test(eye_alone_is_kept_and_looks_at_the_centre),
        cmocka_unit_test(members_that_are_not_set_are_not_read),
        cmocka_unit_test(empty_field_gets_a_view_of_the_unit_cube),
        cmocka_unit_test(lone_ball_far_from_the_origin_is_fitted),
        cmocka_unit_test(what_makes_no_sense_is_a_usage_error),
        cmocka_unit_test(tiny_and_huge_up_vectors_are_directions_all_the_same),
        cmocka_unit_test(rays_meet_the_frame_where_the_pixels_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
