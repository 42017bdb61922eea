/* Effects against closed forms: a ball alone, and a ball over a ground so wide that it is all but a plane. */
#include "effects/shared.h"
#include "field/kernel.h"
#include "support/effects_fixture.h"
#include "support/reference_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* So low a level puts the surface near the edge of the effective spheres, so that balls which do not touch do
 * not know of one another: each is a sphere of radius EDGE R. */
static const double iso = 1e-8;
static double edge(void)
{
    return density_core(DENSITY_POLY2, iso);
}

static const double ground = 1000; /* radius of the ground's ball, whose top is at the origin */

static mns_field *lone_ball(double radius)
{
    fixture_balls b = {.count = 0};
    fixture_add(&b, 0, 0, 0, radius / edge(), 1);
    return fixture_field(&b, MNS_KERNEL_POLY2, iso);
}

/* A ball of radius 1 whose middle is at (0, height, 0). */
static mns_field *ball_over_ground(double height)
{
    fixture_balls b = {.count = 0};
    fixture_add(&b, 0, -ground, 0, ground / edge(), 1);
    fixture_add(&b, 0, height, 0, 1 / edge(), 1);
    return fixture_field(&b, MNS_KERNEL_POLY2, iso);
}

static mns_look dark(void) /* everything of the lights by hand */
{
    return (mns_look){.set = MNS_LOOK_AMBIENT | MNS_LOOK_DIFFUSE | MNS_LOOK_SPECULAR | MNS_LOOK_COLOR |
                             MNS_LOOK_BACKGROUND,
                      .background = {1, 1, 1, 1},
                      .color = {1, 1, 1}};
}

/* Distance to the sphere, along a unit direction from outside it. */
static double sphere_distance(vec3 from, vec3 way, vec3 middle, double radius)
{
    vec3 to = vec3_sub(middle, from);
    double along = vec3_dot(to, way), aside = vec3_length(vec3_sub(to, vec3_scale(way, along)));
    return along - sqrt(radius * radius - aside * aside);
}

static vec3 point_of(const reference_answer *a)
{
    return vec3_load(a->point);
}

/* ---- Shading ---- */

static void lights_add_up_as_written(void **state)
{
    (void)state;
    mns_field *field = lone_ball(1);
    const mns_light lights[] = {
        {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 1, 2}, .strength = 0.5, .color = {1, 0, 0}},
        {.kind = MNS_LIGHT_POINT, .position = {0, 3, 4}, .strength = 2},
        {.kind = MNS_LIGHT_HEAD, .color = {0, 0, 1}},
        {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {0, 0, -1}}, /* from behind */
    };
    mns_look look = dark();
    look.ambient = 0.25, look.diffuse = 0.5, look.specular = 0.75, look.shininess = 10;
    look.lights = lights, look.light_count = 4;
    effects_fixture f;
    effects_fixture_open(&f, field, (vec3){0, 0, 5}, (vec3){0, 0, 0}, &look);
    f.albedo[1] = 0.5;
    for (int i = 0; i < 20; i++) {
        reference_answer first;
        vec3 way = vec3_unit((vec3){0.009 * i, 0.005 * i, -1});
        effects_pixel pixel = effects_fixture_shade(&f, way, &first);
        vec3 n = vec3_unit(point_of(&first)), v = vec3_scale(way, -1);
        double want[3];
        for (int c = 0; c < 3; c++) want[c] = f.albedo[c] * 0.25;
        for (int l = 0; l < 3; l++) {
            vec3 w = l == 0   ? vec3_unit((vec3){1, 1, 2})
                     : l == 1 ? vec3_unit(vec3_sub((vec3){0, 3, 4}, point_of(&first)))
                              : v;
            const double radiance[3][3] = {{0.5, 0, 0}, {2, 2, 2}, {0, 0, 1}};
            double facing = fmax(vec3_dot(n, w), 0);
            double shine = facing > 0 ? 0.75 * pow(vec3_dot(n, vec3_unit(vec3_add(w, v))), 10) : 0;
            for (int c = 0; c < 3; c++) want[c] += radiance[l][c] * (f.albedo[c] * 0.5 * facing + shine);
        }
        for (int c = 0; c < 3; c++) fixture_expect_close(pixel.color[c], want[c], 1e-9);
        assert_true(pixel.color[3] == 1 && pixel.rays == 0 && pixel.certain);
    }
    effects_fixture_close(&f);
    mns_field_destroy(field);
}

/* ---- Shadows, occlusion ---- */

static void a_balls_shadow_is_its_outline(void **state)
{
    (void)state;
    mns_field *field = ball_over_ground(3);
    mns_look look = dark();
    look.diffuse = 1;
    look.light = MNS_LIGHT_DIRECTIONAL;
    look.light_direction[1] = 1;
    look.effects.shadows = true;
    effects_fixture f;
    effects_fixture_open(&f, field, (vec3){10, 8, 0}, (vec3){0, 0, 0}, &look);
    const double off[] = {-0.9, -0.1, -1e-3, -1e-6, -1e-8, 1e-8, 1e-6, 1e-3, 0.1, 3};
    for (size_t i = 0; i < sizeof off / sizeof *off; i++)
        for (int k = 0; k < 8; k++) {
            double angle = 0.3 + 0.7 * k, r = 1 + off[i];
            vec3 to = {r * cos(angle), 0, r * sin(angle)};
            to.y = sqrt(ground * ground - r * r) - ground;
            reference_answer first;
            effects_pixel pixel = effects_fixture_shade(&f, vec3_sub(to, f.plan->frame.eye), &first);
            vec3 at = point_of(&first);
            if (at.y > 0.5) continue; /* the ball itself is before it */
            fixture_expect_close(hypot(at.x, at.z), r, 1e-9);
            assert_true(pixel.shadow == (r > 1 ? 1 : 0));
            assert_true(pixel.certain && pixel.rays == 1);
            double lit = pixel.shadow * (at.y + ground) / ground;
            fixture_expect_close(pixel.color[0], lit, 1e-9);
        }
    effects_fixture_close(&f);
    mns_field_destroy(field);
}

/* The middle of the ground seen from aside, under the ball. */
static effects_pixel under_the_ball(const mns_field *field, const mns_look *look)
{
    effects_fixture f;
    effects_fixture_open(&f, field, (vec3){10, 2, 0}, (vec3){0, 0, 0}, look);
    effects_pixel pixel = effects_fixture_shade(&f, vec3_sub((vec3){0, 0, 0}, f.plan->frame.eye), NULL);
    effects_fixture_close(&f);
    return pixel;
}

static void a_spheres_share_is_that_of_its_solid_angle(void **state)
{
    (void)state;
    mns_field *field = ball_over_ground(10);
    mns_light light = {.kind = MNS_LIGHT_AREA, .position = {0, 30, 0}, .radius = 6};
    mns_look look = dark();
    look.diffuse = 1;
    look.lights = &light, look.light_count = 1;
    look.effects = (mns_effects){.shadows = true, .shadow_samples = 4096};
    double hidden = 1 - sqrt(1 - 0.1 * 0.1), whole = 1 - sqrt(1 - 0.2 * 0.2);
    effects_pixel pixel = under_the_ball(field, &look);
    fixture_expect_close(pixel.shadow, 1 - hidden / whole, 2e-3);
    assert_true(pixel.certain && pixel.rays == 4096);
    light.radius = 2; /* behind the ball, whole */
    assert_true(under_the_ball(field, &look).shadow == 0);
    light.position[1] = 5, light.radius = 1; /* before it */
    assert_true(under_the_ball(field, &look).shadow == 1);
    light.position[1] = 0.5; /* around the place itself */
    assert_true(under_the_ball(field, &look).shadow == 1);
    look.effects.shadow_samples = 0;
    light.position[1] = 5;
    assert_int_equal(under_the_ball(field, &look).rays, 16);
    mns_field_destroy(field);
}

/* The form factor of a ball of radius 1 at the distance h above a plane: h^-2. */
static void occlusion_is_the_form_factor(void **state)
{
    (void)state;
    const double heights[] = {1.2, 2, 4};
    for (size_t i = 0; i < 3; i++) {
        double h = heights[i];
        mns_field *field = ball_over_ground(h);
        mns_look look = dark();
        look.ambient = 0.5;
        look.effects = (mns_effects){.occlusion_rays = 4096, .occlusion_reach = 2 * h};
        effects_pixel pixel = under_the_ball(field, &look);
        fixture_expect_close(pixel.occlusion, 1 - 1 / (h * h), 3e-3);
        fixture_expect_close(pixel.color[0], 0.5 * pixel.occlusion, 1e-12);
        assert_true(pixel.certain);
        look.effects.occlusion_reach = 0.99 * (h - 1);
        assert_true(under_the_ball(field, &look).occlusion == 1);
        mns_field_destroy(field);
    }
}

/* ---- Mirrors, glass ---- */

static void mirrored_rays_go_where_they_must(void **state)
{
    (void)state;
    mns_field *field = ball_over_ground(3);
    mns_look look = dark();
    look.ambient = 1;
    look.set |= MNS_LOOK_MIRROR;
    look.effects = (mns_effects){.reflections = 1, .mirror = 0.25};
    look.background[0] = 0;
    effects_fixture f;
    effects_fixture_open(&f, field, (vec3){8, 3, 0}, (vec3){3, 0, 0}, &look);
    f.albedo[0] = 0.5;
    int met = 0;
    for (int i = 0; i < 40; i++) {
        reference_answer first;
        vec3 way = vec3_unit((vec3){-4.3 + 0.02 * i, -3, 0.03 * i});
        effects_pixel pixel = effects_fixture_shade(&f, way, &first);
        vec3 at = point_of(&first), n = vec3_unit(vec3_sub(at, (vec3){0, -ground, 0}));
        assert_true(at.y < 0.1);
        vec3 on = vec3_along(way, -2 * vec3_dot(way, n), n);
        double t = sphere_distance(at, on, (vec3){0, 3, 0}, 1);
        if (!isnan(t)) {
            /* There the next mirrored ray is one too many, and sees the background. */
            fixture_expect_close(pixel.mirror, t, 1e-8 * t);
            fixture_expect_close(pixel.color[0], 0.75 * 0.5 + 0.25 * 0.75 * 0.5, 1e-12);
            fixture_expect_close(pixel.color[1], 0.75 + 0.25, 1e-12);
        } else {
            assert_true(isinf(pixel.mirror));
            fixture_expect_close(pixel.color[0], 0.75 * 0.5, 1e-12);
        }
        met += !isnan(t);
        assert_true(isinf(pixel.refracted) && pixel.certain && pixel.rays == 1);
    }
    assert_true(met > 10 && met < 40);
    effects_fixture_close(&f);
    mns_field_destroy(field);
}

/* By Fresnel's sines and tangents. */
static double reflectance(double in, double out)
{
    if (in == 0) return 0;
    double across = sin(in - out) / sin(in + out), along = tan(in - out) / tan(in + out);
    return 0.5 * (across * across + along * along);
}

static void glass_obeys_snell_fresnel_and_beer(void **state)
{
    (void)state;
    mns_field *field = lone_ball(2);
    mns_look look = dark();
    look.effects = (mns_effects){.refractions = 2, .index = 1.5, .absorption = {0, 0.25, 1}};
    effects_fixture f;
    effects_fixture_open(&f, field, (vec3){0, 0, 10}, (vec3){0, 0, 0}, &look);
    for (int i = 0; i < 60; i++) {
        double aside = 0.033 * i; /* of the ray, from the middle */
        vec3 way = {sin(asin(aside / 10)), 0, -cos(asin(aside / 10))};
        effects_pixel pixel = effects_fixture_shade(&f, way, NULL);
        double in = asin(aside / 2), out = asin(aside / 3), length = 4 * cos(out);
        double mirrored = i ? reflectance(in, out) : 0.04;
        fixture_expect_close(pixel.refracted, length, 1e-7);
        assert_true(isinf(pixel.mirror) && pixel.certain && pixel.rays == 2);
        /* Around is white, so the way out loses nothing. */
        for (int c = 0; c < 3; c++) {
            double dimmed = exp(-look.effects.absorption[c] * length);
            fixture_expect_close(pixel.color[c], mirrored + (1 - mirrored) * dimmed, 1e-6);
        }
    }
    effects_fixture_close(&f);
    mns_field_destroy(field);
}

/* From the inside of a ball of radius 1, from half way out: the ray meets it at the angle whose sine is half
 * the sine of its own. */
static void beyond_the_critical_angle_all_is_mirrored(void **state)
{
    (void)state;
    mns_field *field = lone_ball(1);
    mns_look look = dark();
    look.background[0] = 0;
    look.effects = (mns_effects){.refractions = 3, .index = 3, .absorption = {0, 0.5, 0}};
    effects_fixture f;
    effects_fixture_open(&f, field, (vec3){0, 0, 0.5}, (vec3){0, 0, 0}, &look);
    for (int i = 1; i < 20; i++) {
        double from = 0.075 * i, in = asin(0.5 * sin(from)), first = cos(in) + 0.5 * cos(from);
        effects_pixel pixel = effects_fixture_shade(&f, (vec3){sin(from), 0, -cos(from)}, NULL);
        bool total = sin(in) > 1.0 / 3;
        assert_true(pixel.certain);
        if (total) {
            /* Three more chords, and then no surface is left to meet. */
            fixture_expect_close(pixel.mirror, 2 * cos(in), 1e-7);
            assert_true(isinf(pixel.refracted) && pixel.rays == 3);
            fixture_expect_close(pixel.color[1], exp(-0.5 * (first + 6 * cos(in))), 1e-6);
            fixture_expect_close(pixel.color[2], 1, 1e-12);
        } else {
            assert_true(isinf(pixel.mirror) && isinf(pixel.refracted) && pixel.rays == 1);
            fixture_expect_close(pixel.color[1], exp(-0.5 * first), 1e-6);
        }
    }
    effects_fixture_close(&f);
    mns_field_destroy(field);
}

static void fresnels_share_at_the_ends(void **state)
{
    (void)state;
    fixture_expect_close(optics_fresnel(1.5, 1), 0.04, 1e-15);
    fixture_expect_close(optics_fresnel(1 / 1.5, 1), 0.04, 1e-15);
    fixture_expect_close(optics_fresnel(1.333, 1e-9), 1, 1e-7);
    assert_true(optics_fresnel(1 / 1.5, 0.7) == 1); /* sine 0.714, critical 0.667 */
    assert_true(optics_fresnel(1 / 1.5, cos(asin(0.66))) < 1);
    double brewster = atan(1.5); /* there light across the plane alone is reflected */
    double out = asin(sin(brewster) / 1.5);
    fixture_expect_close(optics_fresnel(1.5, cos(brewster)), 0.5 * pow(sin(brewster - out), 2), 1e-15);
}

/* ---- Depth, seeds ---- */

/* Between two mirrors that face one another a ray goes on until its levels end. */
static void levels_end_where_they_are_told(void **state)
{
    (void)state;
    fixture_balls b = {.count = 0};
    fixture_add(&b, 0, -ground, 0, ground / edge(), 1);
    fixture_add(&b, 0, ground + 2, 0, ground / edge(), 1);
    mns_field *field = fixture_field(&b, MNS_KERNEL_POLY2, iso);
    for (int levels = 0; levels <= 8; levels++) {
        mns_look look = dark();
        look.ambient = 1;
        look.background[0] = 0;
        look.effects = (mns_effects){.reflections = levels, .mirror = 0.5};
        effects_fixture f;
        effects_fixture_open(&f, field, (vec3){0, 1, 0}, (vec3){0, 0, 0}, &look);
        effects_pixel pixel = effects_fixture_shade(&f, (vec3){0.05, -1, 0}, NULL);
        assert_int_equal(pixel.rays, levels);
        fixture_expect_close(pixel.color[0], 1 - pow(0.5, levels + 1),
                             1e-12); /* the rest saw the background */
        fixture_expect_close(pixel.color[1], 1, 1e-12);
        effects_fixture_close(&f);
    }
    mns_field_destroy(field);
}

/* A share below 1/1024 is not followed: 0.1^3 is, 0.1^4 is not. */
static void faint_rays_see_the_environment(void **state)
{
    (void)state;
    fixture_balls b = {.count = 0};
    fixture_add(&b, 0, -ground, 0, ground / edge(), 1);
    fixture_add(&b, 0, ground + 2, 0, ground / edge(), 1);
    mns_field *field = fixture_field(&b, MNS_KERNEL_POLY2, iso);
    mns_look look = dark();
    look.effects = (mns_effects){.reflections = 8, .mirror = 0.1};
    effects_fixture f;
    effects_fixture_open(&f, field, (vec3){0, 1, 0}, (vec3){0, 0, 0}, &look);
    assert_int_equal(effects_fixture_shade(&f, (vec3){0.05, -1, 0}, NULL).rays, 3);
    effects_fixture_close(&f);
    mns_field_destroy(field);
}

static void a_seed_is_a_picture(void **state)
{
    (void)state;
    mns_field *field = ball_over_ground(2);
    mns_look look = dark();
    look.ambient = 1;
    look.effects = (mns_effects){.occlusion_rays = 2, .occlusion_reach = 5, .seed = 11};
    effects_pixel a = under_the_ball(field, &look), b = under_the_ball(field, &look);
    assert_memory_equal(a.color, b.color, sizeof a.color);
    int others = 0;
    for (uint32_t seed = 0; seed < 32; seed++) {
        look.effects.seed = seed;
        others += under_the_ball(field, &look).color[0] != a.color[0];
    }
    assert_true(others > 2);
    mns_field_destroy(field);
}

/* Any stretch of a sequence is spread evenly: of 64 points in a row each of 16 squares has 2 to 6; and two
 * sequences have nothing in common. */
static void samples_are_spread_evenly(void **state)
{
    (void)state;
    for (uint32_t pixel = 0; pixel < 200; pixel++) {
        uint32_t key = samples_key(pixel % 20, pixel / 20, 1, 1, 0);
        int count[16] = {0};
        for (uint32_t i = 0; i < 64; i++) {
            double u = samples_number(key, 64 * pixel + i, 0), v = samples_number(key, 64 * pixel + i, 1);
            assert_true(u >= 0 && u < 1 && v >= 0 && v < 1 && (double)(float)u == u);
            count[4 * (int)(4 * u) + (int)(4 * v)]++;
        }
        for (int i = 0; i < 16; i++) assert_true(count[i] >= 2 && count[i] <= 6);
    }
    double product = 0;
    for (uint32_t i = 0; i < 10000; i++) {
        double u = samples_number(samples_key(i, 0, 0, 1, 0), 0, 0) - 0.5;
        product += u * (samples_number(samples_key(i + 1, 0, 0, 1, 0), 0, 0) - 0.5);
    }
    assert_true(fabs(product / 10000) < 4 * (1.0 / 12) / 100);
}

static void samples_turn_without_a_twist(void **state)
{
    (void)state;
    fixture_numbers numbers = {7};
    for (int i = 0; i < 1000; i++) {
        vec3 n = vec3_unit((vec3){fixture_random(&numbers) - 0.5, fixture_random(&numbers) - 0.5,
                                  i % 2 ? 0 : fixture_random(&numbers) - 0.5});
        if (i < 2) n = (vec3){0, 0, i ? 1 : -1};
        double u = fixture_random(&numbers), v = fixture_random(&numbers), h[3], out[3];
        for (int a = 0; a < 3; a++) h[a] = samples_hemisphere(a, u, v);
        for (int a = 0; a < 3; a++) out[a] = samples_turned(a, n.x, n.y, n.z, h[0], h[1], h[2]);
        fixture_expect_close(vec3_length(vec3_load(out)), 1, 1e-6);
        fixture_expect_close(vec3_dot(vec3_load(out), n), sqrt(1 - u), 1e-12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_add_up_as_written),
        cmocka_unit_test(a_balls_shadow_is_its_outline),
        cmocka_unit_test(a_spheres_share_is_that_of_its_solid_angle),
        cmocka_unit_test(occlusion_is_the_form_factor),
        cmocka_unit_test(mirrored_rays_go_where_they_must),
        cmocka_unit_test(glass_obeys_snell_fresnel_and_beer),
        cmocka_unit_test(beyond_the_critical_angle_all_is_mirrored),
        cmocka_unit_test(fresnels_share_at_the_ends),
        cmocka_unit_test(levels_end_where_they_are_told),
        cmocka_unit_test(faint_rays_see_the_environment),
        cmocka_unit_test(a_seed_is_a_picture),
        cmocka_unit_test(samples_are_spread_evenly),
        cmocka_unit_test(samples_turn_without_a_twist),
    };
    return cmocka_run_group_tests_name("effects", tests, NULL, NULL);
}
