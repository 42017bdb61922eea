/* Rays that leave the surface: at any scale of the scene, at any slant, from thin films and crowded folds,
 * none meets its own start, and none passes through what is there. */
#include "support/effects_fixture.h"
#include "support/reference_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static const double scales[] = {1e-6, 1, 1e6};
enum { SCALES = sizeof scales / sizeof *scales };

/* A random heap about the origin, of overlapping balls, in units of `scale`, moved by `offset` of them. */
static mns_field *heap(double scale, double offset, mns_kernel kernel)
{
    fixture_numbers numbers = {1234567};
    fixture_balls b = {.count = 0};
    for (int i = 0; i < 40; i++) {
        double v[3];
        for (int a = 0; a < 3; a++) v[a] = scale * (offset + 2 * fixture_random(&numbers) - 1);
        fixture_add(&b, v[0], v[1], v[2], scale * (0.3 + 0.5 * fixture_random(&numbers)),
                    i % 9 == 8 ? -0.3 : 1);
    }
    return fixture_field(&b, kernel, 0.2);
}

static reference_answer ask(const mns_reference *r, reference_scratch *scratch, vec3 from, vec3 way,
                            double side, double reach)
{
    reference_query query = {.side = side, .reach = reach};
    reference_answer answer;
    vec3_store(query.origin, from);
    vec3_store(query.direction, vec3_unit(way));
    assert_true(reference_ask(r, scratch, &query, &answer));
    return answer;
}

static vec3 random_way(fixture_numbers *numbers)
{
    return vec3_unit(
        (vec3){fixture_random(numbers) - 0.5, fixture_random(numbers) - 0.5, fixture_random(numbers) - 0.5});
}

static double value_at(const mns_reference *r, vec3 from, double s, vec3 way)
{
    double point[3];
    vec3_store(point, vec3_along(from, s, way));
    return mns_reference_value(r, point, NULL, NULL);
}

/* From `from` on up to t - or, on a miss, up to 4 units - f stays on the ray's side of L: looked at so
 * densely that what is passed over is shorter than a thousandth of a radius. */
static void expect_side(const mns_reference *r, vec3 from, vec3 way, double side, double t, double scale)
{
    enum { STEPS = 4000 };
    double end = fmin(t, 4 * scale);
    for (int i = 1; i < STEPS; i++) {
        double s = end * i / STEPS, f = value_at(r, from, s, way);
        if (!(side * (f - 0.2) > -1e-9)) fail_msg("f = %.17g at %g of %g, side %g", f, s, t, side);
    }
}

/* Reflections, shadow rays and refractions of a heap, held against f itself. */
static void rays_from_a_heap_see_what_is_there(void **state)
{
    (void)state;
    const mns_kernel kernels[] = {MNS_KERNEL_POLY3, MNS_KERNEL_WENDLAND};
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < SCALES; i++) {
            double scale = scales[i];
            mns_field *field = heap(scale, 0, kernels[k]);
            mns_reference *r = fixture_reference(field);
            reference_scratch scratch = {0};
            fixture_numbers numbers = {99};
            int blocked = 0, undecided = 0, count = 0;
            for (int ray = 0; ray < 150; ray++) {
                vec3 eye = vec3_scale(random_way(&numbers), 5 * scale),
                     aim = vec3_scale(random_way(&numbers), scale);
                reference_answer first = ask(r, &scratch, eye, vec3_sub(aim, eye), 0, INFINITY);
                if (!first.hit.hit) continue;
                vec3 at = vec3_load(first.point), n = vec3_load(first.hit.normal), way = random_way(&numbers);
                if (ray % 3 == 0) /* grazing */
                    way = vec3_unit(vec3_along(vec3_sub(way, vec3_scale(n, vec3_dot(way, n))), 1e-6, n));
                double side = vec3_dot(way, n) > 0 ? -1 : 1;
                reference_answer on = ask(r, &scratch, at, way, side, INFINITY);
                count++;
                undecided += !on.hit.certain;
                if (!on.hit.certain) continue;
                expect_side(r, at, way, side, on.hit.t, scale);
                assert_true(side < 0 || on.hit.hit); /* no way in without a way out */
                blocked += side < 0 && on.hit.hit;
                if (!on.hit.hit) continue;
                double after = value_at(r, at, on.hit.t * (1 + 1e-7) + 1e-9 * scale, way) - 0.2;
                assert_true(side * after < 0);
            }
            assert_true(count > 60 && blocked > 5 && undecided <= 1);
            reference_scratch_free(&scratch);
            mns_reference_destroy(r);
            mns_field_destroy(field);
        }
}

/* Outside of a ball nothing stands in the way, inside the way is a chord: down to slants of 1e-9. */
static void a_ball_does_not_shade_itself(void **state)
{
    (void)state;
    for (mns_kernel kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++)
        for (size_t i = 0; i < SCALES; i++)
            for (int offset = 0; offset < 2; offset++) {
                double scale = scales[i], middle = offset ? 1000 * scale : 0;
                fixture_balls b = {.count = 0};
                fixture_add(&b, middle, 0, 0, scale, 1);
                mns_field *field = fixture_field(&b, kernel, 0.2);
                mns_reference *r = fixture_reference(field);
                reference_scratch scratch = {0};
                fixture_numbers numbers = {5};
                for (int ray = 0; ray < 100; ray++) {
                    vec3 eye = {middle, 0, 3 * scale};
                    vec3 aim = {middle + scale * (fixture_random(&numbers) - 0.5),
                                scale * fixture_random(&numbers) / 2, 0};
                    reference_answer first = ask(r, &scratch, eye, vec3_sub(aim, eye), 0, INFINITY);
                    if (!first.hit.hit) continue;
                    vec3 at = vec3_load(first.point), n = vec3_load(first.hit.normal),
                         way = random_way(&numbers);
                    double slant = pow(10, -9 * fixture_random(&numbers)),
                           edge = vec3_length(vec3_sub(at, (vec3){middle, 0, 0}));
                    vec3 flat = vec3_unit(vec3_sub(way, vec3_scale(n, vec3_dot(way, n))));
                    vec3 out = vec3_unit(vec3_along(flat, slant, n)),
                         in = vec3_unit(vec3_along(flat, -slant, n));
                    reference_answer free_way = ask(r, &scratch, at, out, -1, INFINITY);
                    assert_true(!free_way.hit.hit && (free_way.hit.certain || slant < 1e-6));
                    reference_answer chord = ask(r, &scratch, at, in, 1, INFINITY);
                    double length = -2 * edge * vec3_dot(in, n);
                    /* So flat a chord is shallower than the start's own rounding. */
                    assert_true(chord.hit.certain || slant < (offset ? 1e-5 : 1e-6));
                    if (!chord.hit.certain) continue;
                    assert_true(chord.hit.hit);
                    fixture_expect_close(chord.hit.t / length, 1,
                                         1e-6 + (offset ? 1e-11 : 1e-13) / (slant * slant));
                }
                reference_scratch_free(&scratch);
                mns_reference_destroy(r);
                mns_field_destroy(field);
            }
}

/* A film a millionth of its balls' radius thick, where two balls barely join: in at one face, out at the
 * other. */
static void a_film_has_two_faces(void **state)
{
    (void)state;
    for (size_t i = 0; i < SCALES; i++) {
        double scale = scales[i];
        fixture_balls b = {.count = 0};
        fixture_add(&b, 0, 0, 0, scale, 1); /* a peak so little above L that the ball is as thin as that */
        mns_field *field = fixture_field(&b, MNS_KERNEL_POLY3, 1 - 7.5e-13);
        mns_reference *r = fixture_reference(field);
        reference_scratch scratch = {0};
        reference_answer first = ask(r, &scratch, (vec3){0, 0, 3 * scale}, (vec3){0, 0, -1}, 0, INFINITY);
        assert_true(first.hit.hit && first.hit.certain);
        reference_answer out = ask(r, &scratch, vec3_load(first.point), (vec3){0, 0, -1}, 1, INFINITY);
        fixture_expect_close(out.hit.t, 1e-6 * scale, 1e-8 * scale); /* rounding of f over its slope there */
        reference_answer back = ask(r, &scratch, vec3_load(first.point), (vec3){0, 0, 1}, -1, INFINITY);
        assert_true(out.hit.hit && out.hit.certain && !back.hit.hit && back.hit.certain);
        reference_scratch_free(&scratch);
        mns_reference_destroy(r);
        mns_field_destroy(field);
    }
}

/* Nothing beyond its reach stops a ray, and nothing before it is missed. */
static void a_reach_is_a_reach(void **state)
{
    (void)state;
    mns_field *field = heap(1, 0, MNS_KERNEL_POLY3);
    mns_reference *r = fixture_reference(field);
    reference_scratch scratch = {0};
    fixture_numbers numbers = {3};
    int met = 0;
    for (int ray = 0; ray < 200; ray++) {
        vec3 eye = vec3_scale(random_way(&numbers), 4), aim = random_way(&numbers);
        reference_answer whole = ask(r, &scratch, eye, vec3_sub(aim, eye), 0, INFINITY);
        if (!whole.hit.hit) continue;
        met++;
        reference_answer shorter = ask(r, &scratch, eye, vec3_sub(aim, eye), 0, whole.hit.t * (1 - 1e-9));
        reference_answer longer = ask(r, &scratch, eye, vec3_sub(aim, eye), 0, whole.hit.t * (1 + 1e-9));
        assert_true(!shorter.hit.hit && longer.hit.hit && shorter.hit.certain && longer.hit.certain);
        fixture_expect_close(longer.hit.t, whole.hit.t, 1e-12);
    }
    assert_true(met > 50);
    reference_scratch_free(&scratch);
    mns_reference_destroy(r);
    mns_field_destroy(field);
}

/* A scene of a power of two times the size has the same bits, all lengths being as many times as long: of the
 * farther ones the field's own unit is not the scene's. */
static void a_scene_has_no_size_of_its_own(void **state)
{
    (void)state;
    const double sizes[] = {1, 0x1p-20, 0x1p20, 0x1p-60, 0x1p60};
    enum { SIZES = sizeof sizes / sizeof *sizes };
    double units[SIZES]; /* the size in the field's unit, in which pixels have their lengths */
    effects_pixel pixels[SIZES][64];
    for (int i = 0; i < SIZES; i++) {
        mns_field *field = heap(sizes[i], 0, MNS_KERNEL_POLY3);
        const mns_light light = {.kind = MNS_LIGHT_AREA,
                                 .position = {2 * sizes[i], 4 * sizes[i], 3 * sizes[i]},
                                 .radius = sizes[i]};
        const mns_look look = {.lights = &light,
                               .light_count = 1,
                               .set = MNS_LOOK_TRANSMISSION,
                               .effects = {.shadows = true,
                                           .reflections = 1,
                                           .refractions = 3,
                                           .index = 1.4,
                                           .transmission = 0.5,
                                           .occlusion_rays = 4,
                                           .occlusion_reach = 0.5 * sizes[i],
                                           .environment = "sky",
                                           .absorption = {1 / sizes[i], 0, 0}}};
        effects_fixture f;
        effects_fixture_open(&f, field, (vec3){0, 0, 6 * sizes[i]}, (vec3){0, 0, 0}, &look);
        assert_true((f.plan->unit == 1) == (i < 3));
        units[i] = sizes[i] / f.plan->unit;
        for (int k = 0; k < 64; k++)
            pixels[i][k] = effects_fixture_shade(
                &f, (vec3){0.05 * (k % 8) - 0.175, 0.00625 * (k - k % 8) - 0.175, -1}, NULL);
        effects_fixture_close(&f);
        mns_field_destroy(field);
    }
    uint64_t rays = 0;
    for (int i = 0; i < SIZES; i++)
        for (int k = 0; k < 64; k++) {
            const effects_pixel *p = &pixels[i][k], *one = &pixels[0][k];
            assert_memory_equal(p->color, one->color, sizeof p->color);
            assert_true(p->shadow == one->shadow && p->occlusion == one->occlusion && p->certain);
            assert_true(isinf(one->mirror) ? isinf(p->mirror) : p->mirror == one->mirror * units[i]);
            assert_true(isinf(one->refracted) ? isinf(p->refracted)
                                              : p->refracted == one->refracted * units[i]);
            rays += p->rays;
        }
    assert_true(rays > 5000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_from_a_heap_see_what_is_there),
        cmocka_unit_test(a_ball_does_not_shade_itself),
        cmocka_unit_test(a_film_has_two_faces),
        cmocka_unit_test(a_reach_is_a_reach),
        cmocka_unit_test(a_scene_has_no_size_of_its_own),
    };
    return cmocka_run_group_tests_name("effects, scales", tests, NULL, NULL);
}
