/* Light beyond the first hit, traced on the GPU, against the truth's: terms and colours, pixel by pixel, of
 * every method and effect, at every scale, from inside too. */
#include "render/render.h"
#include "support/draw_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDTH = 48, HEIGHT = 36, PIXELS = WIDTH * HEIGHT };

static const mns_options truth = {.method = MNS_METHOD_REFERENCE};
static const mns_view small = {.width = WIDTH, .height = HEIGHT};
static const mns_view tilted = {.up = {0.6, 0.2, -0.4}, .width = WIDTH, .height = HEIGHT};

/* ---- Looks ---- */

static const mns_light sun = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 2, 1.5}};
static const mns_light lamps[] = {
    {.kind = MNS_LIGHT_POINT, .position = {1, 2, 2}, .color = {1, 0.5, 0.25}},
    {.kind = MNS_LIGHT_AREA, .position = {-1, 2, 1}, .radius = 0.5, .strength = 0.5},
    {.kind = MNS_LIGHT_HEAD, .strength = 0.25},
    {.kind = MNS_LIGHT_AREA, .position = {0, 0.5, 3}, .radius = 9, .strength = 0.25}}; /* around all */
enum { LAMPS = sizeof lamps / sizeof *lamps };

/* So far away that floats do not hold the square of it, by the same program. */
static const mns_light far_lamps[LAMPS] = {
    {.kind = MNS_LIGHT_POINT, .position = {1e25, 2e25, 2e25}, .color = {1, 0.5, 0.25}},
    {.kind = MNS_LIGHT_AREA, .position = {-1e22, 2e22, 1e22}, .radius = 5e21, .strength = 0.5},
    {.kind = MNS_LIGHT_HEAD, .strength = 0.25},
    {.kind = MNS_LIGHT_AREA, .position = {0, 1, 0.5}, .radius = 1e23, .strength = 0.25}};

/* Between balls, or around one: what stands behind a light, or in it, shades nothing. */
static const mns_light near_lamps[LAMPS] = {
    {.kind = MNS_LIGHT_POINT, .position = {1.1, 0.1, 0.3}},
    {.kind = MNS_LIGHT_AREA, .position = {1.1, -0.6, 0.2}, .radius = 0.9},
    {.kind = MNS_LIGHT_HEAD, .strength = 0.25},
    {.kind = MNS_LIGHT_AREA, .position = {1.1, 0.3, -0.2}, .radius = 0.1}};

#define SUN .lights = &sun, .light_count = 1

typedef struct look_case {
    const char *name;
    mns_look look;
} look_case;

static const look_case
    hard = {"hard shadows", {SUN, .effects = {.shadows = true}}},
    soft = {"lamps and occlusion",
            {.lights = lamps,
             .light_count = LAMPS,
             .set = MNS_LOOK_BACKGROUND,
             .background = {0.2, 0.4, 0.6, 0.5},
             .effects = {.shadows = true, .shadow_samples = 4, .occlusion_rays = 6, .occlusion_reach = 0.3}}},
    mirror = {"mirrors",
              {SUN, .effects = {.shadows = true, .reflections = 2, .mirror = 0.5, .environment = "sky"}}},
    glass = {"glass",
             {SUN, .effects = {.shadows = true,
                               .occlusion_rays = 1,
                               .reflections = 1,
                               .refractions = 4,
                               .index = 1.4,
                               .transmission = 0.75,
                               .absorption = {1, 2, 3}}}};

/* ---- What is compared ---- */

static bool differ(const float *got, const float *want, int i, double allowed)
{
    if (!want) return got != NULL;
    return !(got[i] == want[i] || fabs((double)got[i] - (double)want[i]) <= allowed);
}

typedef struct tally {
    int hits, open, wrong, off; /* pixels: hit, undecided by either, of another term, of another colour */
} tally;

/* `length`: how exact distances have to be. */
static tally compare(const mns_image *got, const mns_image *want, double length, double color)
{
    tally sum = {0};
    for (int i = 0; i < PIXELS; i++) {
        sum.hits += !isinf(want->t[i]);
        if (got->certain[i] * got->effects_certain[i] * want->certain[i] * want->effects_certain[i] != 1) {
            sum.open++;
            continue;
        }
        sum.wrong += differ(got->shadow, want->shadow, i, 1e-5) ||
                     differ(got->occlusion, want->occlusion, i, 1e-5) ||
                     differ(got->mirror_t, want->mirror_t, i, length) ||
                     differ(got->refract_t, want->refract_t, i, length);
        bool off = false;
        for (int c = 0; c < 4; c++) off = off || differ(got->rgba, want->rgba, 4 * i + c, color);
        sum.off += off;
    }
    return sum;
}

/* No term is wrong, but few pixels are open, and of the others all but `off` have the truth's colour. A
 * float's ray may pass on the other side of an edge that it meets deep in a path; there a pixel of glass may
 * be off. */
static void expect_truth(draw_fixture *d, const mns_field *field, const mns_view *view, const look_case *look,
                         const mns_options *options, double length, int off, const char *what)
{
    mns_image *want = draw_image(d, field, view, &look->look, &truth);
    uint64_t rays = d->stats.effects_rays;
    mns_image *got = draw_image(d, field, view, &look->look, options);
    tally sum = compare(got, want, length, 3e-3);
    if (sum.wrong || sum.off > off || sum.open > 2 + sum.hits / 200)
        fail_msg("%s, %s: of %d hits %d open, %d wrong, %d of another colour", what, look->name, sum.hits,
                 sum.open, sum.wrong, sum.off);
    assert_true(sum.hits > 100 && d->stats.effects_undecided <= (uint64_t)sum.open);
    if (!sum.open && !off) assert_true(d->stats.effects_rays == rays);
    mns_image_destroy(want);
    mns_image_destroy(got);
}

/* A variant takes seconds to compile: through the second back end go few. */
static bool is_second(const draw_fixture *d)
{
    return d->gl.backend == MNS_BACKEND_OSMESA;
}

static void every_method_draws_the_truth(void **state)
{
    static const struct {
        const char *field;
        const look_case *look;
        mns_method method;
        int off;
    } cases[] = {{"dense:500", &soft, MNS_METHOD_FBVH, 0},    {"dense:500", &soft, MNS_METHOD_TILE, 0},
                 {"tornado:1000", &soft, MNS_METHOD_LIST, 0}, {"tornado:1000", &glass, MNS_METHOD_FBVH, 6},
                 {"dense:500", &glass, MNS_METHOD_FBVH, 6},   {"tornado:1000", &glass, MNS_METHOD_BVH, 6}};
    draw_fixture *d = *state;
    for (size_t i = 0; i < (is_second(d) ? 1 : sizeof cases / sizeof *cases); i++) {
        mns_field *field = draw_generated(cases[i].field, MNS_KERNEL_DEFAULT);
        const mns_options options = {.method = cases[i].method};
        expect_truth(d, field, &small, cases[i].look, &options, 1e-4, cases[i].off, cases[i].field);
        mns_field_destroy(field);
    }
}

/* A polynomial along a ray, and one that is none. */
static void every_kind_of_kernel_leaves_the_surface(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_FBVH};
    static const mns_kernel kernels[] = {MNS_KERNEL_WENDLAND, MNS_KERNEL_POLY4};
    for (int i = 0; i < (is_second(d) ? 1 : 2); i++) {
        mns_field *field = draw_generated("mixed:200", kernels[i]);
        expect_truth(d, field, &small, &mirror, &options, 1e-4, 2, mns_kernel_name(kernels[i]));
        mns_field_destroy(field);
    }
}

/* ---- Scales ---- */

enum { BALLS = 150 };

/* Every fifth ball carves. */
static mns_field *balls_of_size(double size)
{
    double position[3 * BALLS], strength[BALLS];
    uint64_t state = 5;
    for (int i = 0; i < 3 * BALLS; i++) position[i] = size * draw_random(&state);
    for (int i = 0; i < BALLS; i++) strength[i] = i % 5 ? 1 : -0.75;
    return draw_field(BALLS, position, NULL, 0.16 * size, strength, MNS_KERNEL_POLY3);
}

static look_case mirror_and_occlusion(void)
{
    look_case look = mirror;
    look.look.effects.occlusion_rays = 4;
    return look;
}

static void no_scale_has_acne_or_leaks(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_FBVH};
    const look_case look = mirror_and_occlusion();
    for (double size = 1e-6; size < 1e7; size *= 1e12) {
        const double eye[3] = {0.5 * size, 0.7 * size, 2.6 * size},
                     at[3] = {0.5 * size, 0.5 * size, 0.5 * size};
        char what[32];
        snprintf(what, sizeof what, "size %g", size);
        mns_field *field = balls_of_size(size);
        mns_view view = draw_view(eye, at, 40, WIDTH, HEIGHT);
        expect_truth(d, field, &view, &look, &options, 1e-4 * size, 2, what);
        mns_field_destroy(field);
    }
}

/* An eye 100,000 sizes away: its first hits come from a plane at the box. */
static void a_far_eye_sees_the_same_light(void **state)
{
    draw_fixture *d = *state;
    const double eye[3] = {0.5, 3e4, 1e5}, at[3] = {0.5, 0.5, 0.5};
    const mns_options options = {.method = MNS_METHOD_LIST};
    const look_case look = mirror_and_occlusion();
    if (is_second(d)) skip();
    mns_field *field = balls_of_size(1);
    mns_view view = draw_view(eye, at, 1e-3, WIDTH, HEIGHT);
    expect_truth(d, field, &view, &look, &options, 1e-3, 2, "far");
    mns_field_destroy(field);
}

static void an_eye_inside_sees_light_too(void **state)
{
    draw_fixture *d = *state;
    const double eye[3] = {1, 0.25, 0.5}, at[3] = {0, 0.1, 0.2};
    const mns_options options = {.method = MNS_METHOD_FBVH};
    if (is_second(d)) skip();
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    mns_view view = draw_view(eye, at, 60, WIDTH, HEIGHT);
    expect_truth(d, field, &view, &soft, &options, 1e-4, 0, "inside");
    expect_truth(d, field, &view, &glass, &options, 1e-4, 8, "inside");
    mns_field_destroy(field);
}

/* ---- Pictures ---- */

static void colours_cel_and_samples_are_the_truths(void **state)
{
    draw_fixture *d = *state;
    mns_options few = {.method = MNS_METHOD_FBVH, .samples = 2};
    mns_options same = truth;
    same.samples = 2;
    static const struct {
        const char *field, *color_by;
        mns_shading shading;
    } cases[] = {{"tornado:500", "speed", MNS_SHADING_SMOOTH}, {"molecule:100", "element", MNS_SHADING_CEL}};
    if (is_second(d)) skip();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_field *field = draw_generated(cases[i].field, MNS_KERNEL_DEFAULT);
        look_case look = mirror;
        look.look.color_by = cases[i].color_by;
        look.look.shading = cases[i].shading;
        mns_image *want = draw_image(d, field, &small, &look.look, &same);
        mns_image *got = draw_image(d, field, &small, &look.look, &few);
        tally sum = compare(got, want, 1e-4, 4e-3);
        if (sum.wrong || sum.off > 16 || sum.open > 4)
            fail_msg("%s: %d open, %d wrong, %d off", cases[i].field, sum.open, sum.wrong, sum.off);
        mns_image_destroy(want);
        mns_image_destroy(got);
        mns_field_destroy(field);
    }
}

/* Each sample of a pixel has rays of its own, of the seed's sequence. */
static void samples_and_seeds_have_the_truths_rays(void **state)
{
    draw_fixture *d = *state;
    mns_options few = {.method = MNS_METHOD_FBVH, .samples = 3}, same = truth;
    same.samples = 3;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    mns_look look = soft.look;
    for (uint32_t seed = 0; seed < 8; seed += 7) {
        look.effects.seed = seed;
        mns_image *want = draw_image(d, field, &small, &look, &same);
        mns_image *got = draw_image(d, field, &small, &look, &few);
        tally sum = compare(got, want, 1e-4, 3e-3);
        if (sum.wrong || sum.off > 4 || sum.open > 4)
            fail_msg("seed %u: %d open, %d wrong, %d off", seed, sum.open, sum.wrong, sum.off);
        mns_image_destroy(want);
        mns_image_destroy(got);
    }
    mns_field_destroy(field);
}

static void lights_may_be_endlessly_far_and_between_balls(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_FBVH};
    look_case look = soft;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    look.look.lights = far_lamps;
    expect_truth(d, field, &small, &look, &options, 1e-4, 0, "far lamps");
    mns_field_destroy(field);
    static const double three[9] = {0, 0, 0, 2.2, 0, 0, 1.1, -0.75, 0};
    field = draw_field(3, three, NULL, 1, NULL, MNS_KERNEL_DEFAULT);
    look.look.lights = near_lamps;
    expect_truth(d, field, &small, &look, &options, 1e-4, 0, "near lamps");
    mns_field_destroy(field);
}

/* Blocks that hold the walks of but a few rows: the frame is lit in parts. */
static void a_frame_is_lit_in_parts(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_FBVH};
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    size_t *block = &d->renderer->device.limits.max_storage_block, whole = *block;
    mns_image *at_once = draw_image(d, field, &small, &soft.look, &options);
    uint64_t rays = d->stats.effects_rays;
    *block = 1 << 17;
    mns_image *in_parts = draw_image(d, field, &small, &soft.look, &options);
    *block = whole;
    draw_expect_same(at_once, in_parts, "in parts");
    assert_memory_equal(at_once->shadow, in_parts->shadow, PIXELS * sizeof(float));
    assert_memory_equal(at_once->occlusion, in_parts->occlusion, PIXELS * sizeof(float));
    assert_true(d->stats.effects_rays == rays);
    mns_image_destroy(at_once);
    mns_image_destroy(in_parts);
    mns_field_destroy(field);
}

/* Of a ball's middle column a light stands so low that its rays leave along the surface: doubles cannot tell
 * either. */
static void what_nobody_can_decide_is_told(void **state)
{
    draw_fixture *d = *state;
    enum { SIDE = 9 };
    static const double middle[3] = {0, 0, 0}, eye[3] = {0, 0, 4};
    const mns_light low = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 0, 1e-15}};
    const mns_look look = {.lights = &low, .light_count = 1, .effects = {.shadows = true}};
    const mns_view view = draw_view(eye, middle, 30, SIDE, SIDE);
    mns_field *field = draw_field(1, middle, NULL, 1, NULL, MNS_KERNEL_POLY3);
    for (int k = 0; k < 2; k++) {
        const mns_options options = {.method = k ? MNS_METHOD_FBVH : MNS_METHOD_REFERENCE};
        mns_image *image = draw_image(d, field, &view, &look, &options);
        uint64_t open = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            const bool grazed = i % SIDE == SIDE / 2 && !isinf(image->t[i]);
            assert_true(image->effects_certain[i] == (grazed ? 0 : 1));
            open += grazed;
        }
        assert_true(open >= 3 && d->stats.effects_undecided == open);
        mns_image_destroy(image);
    }
    mns_field_destroy(field);
}

static void a_map_stands_around_the_scene(void **state)
{
    draw_fixture *d = *state;
    char path[] = "/tmp/paths-XXXXXX.exr";
    mns_error error;
    if (is_second(d)) skip();
    mns_field *field = draw_generated("scattered:200", MNS_KERNEL_DEFAULT);
    mns_image *picture = draw_image(d, field, &small, NULL, NULL);
    int file = mkstemps(path, 4);
    assert_true(file >= 0);
    close(file);
    if (mns_image_write(picture, path, &error)) fail_msg("%s", error.text);
    look_case look = mirror;
    look.look.effects.environment = path;
    const mns_options options = {.method = MNS_METHOD_LIST};
    /* Between two texels of an edge in the map a ray's last digits are seen. */
    expect_truth(d, field, &small, &look, &options, 1e-4, 12, "map");
    /* Another in the same file: its top is where the view's is, and behind its two ends meet. */
    static const double eye[3] = {0.5, 0.6, -2}, at[3] = {0.5, 0.5, 0.5};
    mns_view behind = draw_view(eye, at, 60, WIDTH, HEIGHT);
    memcpy(behind.up, tilted.up, sizeof behind.up);
    mns_image *other = draw_image(d, field, &(mns_view){.width = 13, .height = 7}, NULL, NULL);
    uint64_t seed = 1;
    for (int i = 0; i < 4 * 13 * 7; i++) other->rgba[i] = i % 4 < 3 ? (float)draw_random(&seed) : 1;
    if (mns_image_write(other, path, &error)) fail_msg("%s", error.text);
    expect_truth(d, field, &behind, &look, &options, 1e-4, 0, "another map");
    unlink(path);
    mns_image_destroy(other);
    mns_image_destroy(picture);
    mns_field_destroy(field);
}

/* Walks that wait for another dispatch, for doubles and in parts of the frame come to the same. */
static void however_a_walk_is_led_it_ends_the_same(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    look_case look = soft;
    look.look.effects.occlusion_rays = 96; /* past a dispatch's budget */
    mns_options options = {.method = MNS_METHOD_FBVH};
    expect_truth(d, field, &small, &look, &options, 1e-4, 0, "many rays");
    options.root_steps = is_second(d) ? 0 : 1; /* what has to be cut is left to doubles */
    mns_image *one = draw_image(d, field, &small, &look.look, &options);
    mns_image *two = draw_image(d, field, &small, &look.look, &options);
    draw_expect_same(one, two, "again");
    assert_memory_equal(one->occlusion, two->occlusion, PIXELS * sizeof(float));
    if (!is_second(d)) expect_truth(d, field, &small, &look, &options, 1e-4, 0, "one step");
    mns_image_destroy(one);
    mns_image_destroy(two);
    mns_field_destroy(field);
}

/* Noise goes by the root of the rays, in however many samples of the pixel they come. */
static void noise_is_told_of_what_is_sampled(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    double shadow = 0, occlusion = 0;
    for (int k = 0; k < 3; k++) {
        look_case look = soft;
        mns_options options = {.method = MNS_METHOD_FBVH, .samples = k == 2 ? 4 : 1};
        look.look.effects.shadow_samples *= k == 1 ? 4 : 1;
        look.look.effects.occlusion_rays *= k == 1 ? 4 : 1;
        mns_image_destroy(draw_image(d, field, &small, &look.look, &options));
        const mns_stats *s = mns_frame_stats(d->frame);
        if (k == 0) {
            shadow = s->noise_shadow, occlusion = s->noise_occlusion;
            assert_true(shadow > 0.01 && shadow < 0.5 && occlusion > 0.01 && occlusion < 0.5);
            continue;
        }
        assert_true(fabs(s->noise_shadow / shadow - 0.5) < 0.1);
        assert_true(fabs(s->noise_occlusion / occlusion - 0.5) < 0.1);
    }
    /* Two lights in one place are sampled twice. */
    const mns_light twice[2] = {lamps[1], lamps[1]};
    for (size_t count = 1; count <= 2; count++) {
        const mns_look look = {
            .lights = twice, .light_count = count, .effects = {.shadows = true, .shadow_samples = 4}};
        mns_image_destroy(draw_image(d, field, &small, &look, &(mns_options){.method = MNS_METHOD_FBVH}));
        const double noise = mns_frame_stats(d->frame)->noise_shadow;
        if (count > 1) assert_true(fabs(noise / shadow - sqrt(0.5)) < 0.1);
        shadow = noise;
    }
    mns_image_destroy(draw_image(d, field, &small, &hard.look, NULL));
    assert_true(mns_frame_stats(d->frame)->noise_shadow == 0 &&
                mns_frame_stats(d->frame)->noise_occlusion == 0);
    mns_field_destroy(field);
}

static void what_has_no_rays_builds_no_tree(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = draw_generated("dense:500", MNS_KERNEL_DEFAULT);
    look_case look = {"sky",
                      {.set = MNS_LOOK_MIRROR | MNS_LOOK_BACKGROUND,
                       .background = {0, 0, 0, 0.5},
                       .effects = {.mirror = 0.5, .environment = "sky"}}};
    const mns_options options = {.method = MNS_METHOD_TILE};
    expect_truth(d, field, &tilted, &look, &options, 1e-4, 0, "sky");
    assert_true(d->stats.tree.balls == 0 && d->stats.effects_rays == 0);
    expect_truth(d, field, &small, &hard, &options, 1e-4, 0, "shadows");
    assert_true(d->stats.tree.balls == 500);
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_draws_the_truth),
        cmocka_unit_test(every_kind_of_kernel_leaves_the_surface),
        cmocka_unit_test(no_scale_has_acne_or_leaks),
        cmocka_unit_test(a_far_eye_sees_the_same_light),
        cmocka_unit_test(an_eye_inside_sees_light_too),
        cmocka_unit_test(colours_cel_and_samples_are_the_truths),
        cmocka_unit_test(samples_and_seeds_have_the_truths_rays),
        cmocka_unit_test(lights_may_be_endlessly_far_and_between_balls),
        cmocka_unit_test(a_frame_is_lit_in_parts),
        cmocka_unit_test(what_nobody_can_decide_is_told),
        cmocka_unit_test(a_map_stands_around_the_scene),
        cmocka_unit_test(however_a_walk_is_led_it_ends_the_same),
        cmocka_unit_test(noise_is_told_of_what_is_sampled),
        cmocka_unit_test(what_has_no_rays_builds_no_tree),
    };
    return cmocka_run_group_tests_name("light's ways", tests, draw_fixture_setup, draw_fixture_teardown);
}
