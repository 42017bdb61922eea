/* The eye on the surface, f(eye) = L to the last bit: the side just after counts, ray by ray. Held against
 * one ball, where every ray's answer is known in closed form, and against the reference. */
#include "render/render.h"
#include "support/light_fixture.h"
#include "support/mesh_file.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDE = 96, HIGH = 72 };

/* A ball of radius 1 at 0 and L = 1/4: with poly2, f = L exactly at distance sqrt(1/2), where this eye is. */
static const double eye[3] = {0.5, 0.5, 0};

static mns_field *ball(void)
{
    static const double centre[3] = {0, 0, 0};
    mns_field *field;
    mns_field_desc desc = {.count = 1,
                           .position = {.data = centre},
                           .uniform_radius = 1,
                           .kernel = MNS_KERNEL_POLY2,
                           .iso = 0.25};
    mns_error error;
    if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
    return field;
}

/* Every ray but those along the tangent plane: inwards, the way out of the sphere; outwards, nothing. */
static void expect_ball(const mns_image *image, const mns_view *view, size_t *inwards, size_t *outwards)
{
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++) {
            double d[3];
            size_t i = (size_t)y * WIDE + (size_t)x;
            mns_view_ray(view, x + 0.5, y + 0.5, d);
            double chord = -2 * (d[0] * eye[0] + d[1] * eye[1]); /* on to the sphere's other side */
            if (fabs(chord) < 1e-3) continue;
            assert_true(image->certain[i] == 1);
            if (chord > 0) {
                assert_true(fabs(image->t[i] + (double)image->t_lo[i] - chord) <= 8e-6 * fmax(chord, 1));
                ++*inwards;
            } else {
                assert_true(isinf(image->t[i]));
                ++*outwards;
            }
        }
}

static void a_ray_takes_the_side_just_after_its_start(void **state)
{
    draw_fixture *d = *state;
    static const double targets[][3] = {{0.5, -0.5, 0.2}, {1, 1, 1}, {0, 0, 0.1}, {-1, 1, 0}};
    size_t inwards = 0, outwards = 0;
    mns_field *field = ball();
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
        mns_view view = draw_view(eye, targets[i], 140, WIDE, HIGH), resolved;
        mns_error error;
        assert_int_equal(mns_view_resolve(&view, field, &resolved, &error), MNS_OK);
        mns_image *image = draw_image(d, field, &view, NULL, NULL);
        assert_true(d->frame->plan->features & FEATURE_EYE_ON);
        expect_ball(image, &resolved, &inwards, &outwards);
        mns_image_destroy(image);
    }
    assert_true(inwards > 5000 && outwards > 5000);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

static void no_certain_answer_differs_from_the_reference(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = ball();
    mns_view view = draw_view(eye, (const double[3]){0.2, -0.4, 0.3}, 120, WIDE, HIGH);
    mns_image *drawn = draw_image(d, field, &view, NULL, NULL);
    mns_image *truth = draw_image(d, field, &view, NULL, &light_truth);
    size_t open = 0;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        if (drawn->certain[i] == 0 || truth->certain[i] == 0)
            open++;
        else
            assert_int_equal(isinf(drawn->t[i]) != 0, isinf(truth->t[i]) != 0);
    }
    assert_true(open <= 8); /* tangent rays */
    mns_image_destroy(drawn);
    mns_image_destroy(truth);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* A mesh does not tell on which side it is seen: of a floor through the ball what is seen inwards is dimmed
 * on its way, and what is seen outwards is not. */
static void a_mesh_is_seen_through_the_side_of_its_ray(void **state)
{
    draw_fixture *d = *state;
    static const mns_light sun = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 2, 1.5}};
    mesh_path floor;
    if (!mesh_is_built_in() || light_is_second(d)) skip();
    mesh_write(".obj", "v -3 0 -3\nv -3 0 3\nv 3 0 3\nv 3 0 -3\nf 1 2 3 4\n", floor);
    const mns_mesh mesh = {.file = floor};
    const mns_look look = {.lights = &sun,
                           .light_count = 1,
                           .meshes = &mesh,
                           .mesh_count = 1,
                           .effects = {.refractions = 2, .index = 1.3, .absorption = {1, 2, 3}}};
    mns_field *field = ball();
    const mns_view view = draw_view(eye, (const double[3]){0.8, -0.5, 0.3}, 120, WIDE, HIGH);
    mns_image *drawn = draw_image(d, field, &view, &look, &(mns_options){.method = MNS_METHOD_FBVH});
    mns_image *truth = draw_image(d, field, &view, &look, &light_truth);
    int open = 0, off = 0, dimmed = 0, plain = 0;
    for (int i = 0; i < WIDE * HIGH; i++) {
        if (light_is_open(drawn, truth, i)) {
            open++;
            continue;
        }
        off += drawn->mesh[i] != truth->mesh[i] || light_colors_differ(drawn, truth, i, 3e-3);
        if (truth->mesh[i] == 1)
            *(truth->rgba[4 * i] > 1.1f * truth->rgba[4 * i + 2] ? &dimmed : &plain) += 1;
    }
    if (off || open > 40 || dimmed < 500 || plain < 500)
        fail_msg("%d off, %d open; of the mesh %d dimmed, %d not", off, open, dimmed, plain);
    mns_image_destroy(drawn);
    mns_image_destroy(truth);
    mns_field_destroy(field);
    unlink(floor);
    draw_fixture_check(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_takes_the_side_just_after_its_start),
        cmocka_unit_test(no_certain_answer_differs_from_the_reference),
        cmocka_unit_test(a_mesh_is_seen_through_the_side_of_its_ray),
    };
    return cmocka_run_group_tests_name("eye_on", tests, draw_fixture_setup, draw_fixture_teardown);
}
