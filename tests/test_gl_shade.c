/* Planes to colour: what each part of a look does to known pixels. */
#include "shade/palette.h"
#include "support/draw_fixture.h"
#include "support/image_fixture.h"

#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDE = 61, HIGH = 41, CENTRE = HIGH / 2 * WIDE + WIDE / 2 }; /* odd: a ray goes straight ahead */

static double linear(double srgb)
{
    return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4);
}

static double srgb_of(double c)
{
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

static mns_view ahead(void)
{
    return draw_view((const double[3]){0, 0, 4}, (const double[3]){0, 0, 0}, 45, WIDE, HIGH);
}

/* One ball in the middle; its picture with a look. */
static mns_image *draw_ball(draw_fixture *d, const mns_look *look)
{
    mns_view view = ahead();
    mns_field *field = draw_field(1, (const double[3]){0, 0, 0}, NULL, 1.5, NULL, MNS_KERNEL_POLY3);
    mns_image *image = draw_image(d, field, &view, look, NULL);
    mns_field_destroy(field);
    draw_fixture_check(d);
    return image;
}

static void expect_color(const mns_image *image, size_t pixel, double r, double g, double b, double a,
                         double slack)
{
    const double wanted[4] = {r, g, b, a};
    const float *got = &image->rgba[4 * pixel];
    for (int c = 0; c < 4; c++)
        if (fabs((double)got[c] - wanted[c]) > slack)
            fail_msg("pixel %zu is %g,%g,%g,%g, expected %g,%g,%g,%g", pixel, (double)got[0], (double)got[1],
                     (double)got[2], (double)got[3], r, g, b, a);
}

/* ---- Light ---- */

static void a_surface_that_faces_the_headlight_has_its_whole_colour(void **state)
{
    mns_look look = {.set = MNS_LOOK_COLOR | MNS_LOOK_AMBIENT | MNS_LOOK_DIFFUSE | MNS_LOOK_SPECULAR,
                     .color = {0.5, 0.25, 1},
                     .ambient = 0.125,
                     .diffuse = 0.5,
                     .specular = 0.25};
    mns_image *image = draw_ball(*state, &look);
    expect_color(image, CENTRE, linear(0.5) * 0.625 + 0.25, linear(0.25) * 0.625 + 0.25, 0.875, 1, 1e-5);
    mns_image_destroy(image);
    image = draw_ball(*state, NULL); /* ambient 0.15, diffuse 0.85, specular 0.25 */
    expect_color(image, CENTRE, linear(0.35) + 0.25, linear(0.62) + 0.25, linear(0.86) + 0.25, 1, 1e-5);
    expect_color(image, 0, 1, 1, 1, 1, 0);
    mns_image_destroy(image);
}

/* The cosines of a pixel's normal with the light, the eye and, for shine, the way between. */
typedef struct cosines {
    double facing, eye, half;
} cosines;

static cosines cosines_at(const mns_image *image, size_t i, const double to_light[3])
{
    size_t row = i / WIDE, column = i % WIDE;
    double x = (double)column + 0.5 - 0.5 * WIDE, y = 0.5 * HIGH - (double)row - 0.5;
    double unit = 2 * tan(22.5 * 3.14159265358979323846 / 180) / HIGH;
    double to_eye[3] = {-x * unit, -y * unit, 1}, half[3], length = 0, half_length = 0;
    cosines of = {0, 0, 0};
    for (int a = 0; a < 3; a++) length += to_eye[a] * to_eye[a];
    for (int a = 0; a < 3; a++) half[a] = to_light[a] + to_eye[a] / sqrt(length);
    for (int a = 0; a < 3; a++) half_length += half[a] * half[a];
    for (size_t a = 0; a < 3; a++) {
        double n = (double)image->normal[3 * i + a];
        of.facing += n * to_light[a];
        of.eye += n * to_eye[a] / sqrt(length);
        of.half += n * half[a] / sqrt(half_length);
    }
    return of;
}

/* Lambert and Blinn-Phong by their formulas, at every pixel of the ball. */
static void every_pixel_follows_the_formulas(void **state)
{
    const double to_light[3] = {0.6, 0.48, 0.64};
    mns_look look = {
        .set = MNS_LOOK_COLOR, .color = {0.5, 0.5, 0.5}, .light = MNS_LIGHT_DIRECTIONAL, .shininess = 10};
    for (int a = 0; a < 3; a++) look.light_direction[a] = 3 * to_light[a];
    mns_image *image = draw_ball(*state, &look);
    size_t hits = 0, dark = 0;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        if (!isfinite(image->t[i])) continue;
        cosines of = cosines_at(image, i, to_light);
        double shine = of.facing > 0 ? 0.25 * pow(fmax(of.half, 0), 10) : 0;
        double value = linear(0.5) * (0.15 + 0.85 * fmax(of.facing, 0)) + shine;
        expect_color(image, i, value, value, value, 1, 1e-4);
        hits++;
        dark += of.facing <= 0;
    }
    assert_true(hits > 300 && dark > 20);
    mns_image_destroy(image);
}

/* Of cel shading too: bands of the cosine, shine where it is at least half its most, a contour below 0.22. */
static void cel_bands_follow_the_formulas(void **state)
{
    const double to_light[3] = {0.6, 0.48, 0.64};
    mns_look look = {.set = MNS_LOOK_COLOR,
                     .color = {0.5, 0.5, 0.5},
                     .light = MNS_LIGHT_DIRECTIONAL,
                     .shading = MNS_SHADING_CEL,
                     .shininess = 3,
                     .cel_bands = 4};
    for (int a = 0; a < 3; a++) look.light_direction[a] = to_light[a];
    mns_image *image = draw_ball(*state, &look);
    size_t black = 0, shining = 0, near = 0;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        if (!isfinite(image->t[i])) continue;
        cosines of = cosines_at(image, i, to_light);
        double shine = of.facing > 0 ? pow(fmax(of.half, 0), 3) : 0, band = 4 * fmax(of.facing, 0);
        bool contour = of.eye < 0.22;
        black += contour, shining += shine > 0.5 && !contour;
        if (fabs(of.eye - 0.22) < 1e-5 || fabs(shine - 0.5) < 1e-5 || fabs(band - rint(band)) < 1e-5) {
            near += of.facing > 1e-5; /* where rounding may decide either way */
            continue;
        }
        double value = linear(0.5) * (0.15 + 0.85 * fmin(floor(band), 3) / 3) + (shine > 0.5 ? 0.25 : 0);
        if (contour) value = 0;
        expect_color(image, i, value, value, value, 1, 1e-5);
    }
    assert_true(black > 20 && shining > 100 && near < 4);
    mns_image_destroy(image);
}

static void a_surface_seen_from_inside_is_lit_too(void **state)
{
    mns_view view = draw_view((const double[3]){0, 0, 0.1}, (const double[3]){0, 0, 0}, 45, WIDE, HIGH);
    mns_look look = {.set = MNS_LOOK_COLOR | MNS_LOOK_SPECULAR, .color = {1, 1, 1}};
    mns_field *field = draw_field(1, (const double[3]){0, 0, 0}, NULL, 1.5, NULL, MNS_KERNEL_POLY3);
    mns_image *image = draw_image(*state, field, &view, &look, NULL);
    expect_color(image, CENTRE, 1, 1, 1, 1, 1e-5);
    assert_true(image->normal[3 * CENTRE + 2] < -0.999f); /* outward, away from the eye */
    mns_image_destroy(image);
    mns_field_destroy(field);
}

/* ---- Background ---- */

static void the_background_is_premultiplied_by_its_alpha(void **state)
{
    mns_look look = {.set = MNS_LOOK_BACKGROUND, .background = {0.5, 1, 0.25, 0.5}};
    mns_image *image = draw_ball(*state, &look);
    expect_color(image, 0, 0.5 * linear(0.5), 0.5, 0.5 * linear(0.25), 0.5, 1e-6);
    assert_true(image->rgba[4 * CENTRE + 3] == 1);
    mns_image_destroy(image);
    look.background[3] = 0;
    image = draw_ball(*state, &look);
    expect_color(image, 0, 0, 0, 0, 0, 0);
    mns_image_destroy(image);
}

/* ---- Colours of balls ---- */

/* A field from a file of the given text. */
static mns_field *field_of(const char *text, const char *name)
{
    void *folder;
    char path[IMAGE_FIXTURE_PATH_MAX];
    mns_error error;
    mns_input *input;
    mns_field *field;
    assert_int_equal(image_fixture_setup(&folder), 0);
    image_fixture_path(path, folder, name);
    image_fixture_save(path, text, strlen(text));
    const char *names[] = {path};
    if (mns_input_open(names, 1, &(mns_input_options){.radius = 1}, &input, &error) != MNS_OK)
        fail_msg("%s", error.text);
    if (mns_input_read(input, 0, &field, &error) != MNS_OK) fail_msg("%s", error.text);
    mns_input_close(input);
    image_fixture_teardown(&folder);
    return field;
}

/* The pixel that looks straight at x,0,0 from ahead(). */
static size_t pixel_at(double x)
{
    double unit = 2 * 4 * tan(22.5 * 3.14159265358979323846 / 180) / HIGH;
    size_t column = (size_t)(0.5 * WIDE + floor(x / unit + 0.5));
    return (size_t)(HIGH / 2) * WIDE + column;
}

/* The colour where a ball is seen, without what light does to it. */
static mns_look bare_look(const char *color_by)
{
    return (mns_look){
        .set = MNS_LOOK_AMBIENT | MNS_LOOK_DIFFUSE | MNS_LOOK_SPECULAR, .ambient = 1, .color_by = color_by};
}

/* Between the passes colours are halves, which a card may round either way. */
static void expect_hex(const draw_fixture *d, const mns_image *image, size_t pixel, uint32_t rgb)
{
    const double slack = mns_renderer_limits(d->renderer)->is_software ? 2e-3 : 4e-3;
    assert_true(isfinite(image->t[pixel]));
    expect_color(image, pixel, linear((rgb >> 16) / 255.0), linear((rgb >> 8 & 255) / 255.0),
                 linear((rgb & 255) / 255.0), 1, slack);
}

static void elements_have_their_customary_colours(void **state)
{
    draw_fixture *d = *state;
    mns_view view = ahead();
    mns_look look = bare_look("element");
    mns_field *field = field_of("3\nthree\nO -1.5 0 0\nC 0 0 0\nN 1.5 0 0\n", "three.xyz");
    mns_image *image = draw_image(d, field, &view, &look, NULL);
    expect_hex(d, image, pixel_at(-1.6), 0xff0d0d);
    expect_hex(d, image, CENTRE, 0x909090);
    expect_hex(d, image, pixel_at(1.6), 0x3050f8);
    assert_string_equal(d->stats.color_by, "element");
    assert_string_equal(d->stats.color_map, "");
    mns_image_destroy(image);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

static void each_map_runs_from_its_first_anchor_to_its_last(void **state)
{
    draw_fixture *d = *state;
    static const uint32_t ends[MNS_COLOR_MAP_COUNT][2] = {{0x440154, 0xfde725},
                                                          {0x000004, 0xfcfdbf},
                                                          {0x000004, 0xfcffa4},
                                                          {0x0d0887, 0xf0f921},
                                                          {0x00224e, 0xfee838}};
    mns_view view = ahead();
    mns_look look = bare_look("heat");
    mns_field *field = field_of("x,y,z,heat\n-1.5,0,0,3\n0,0,0,5\n1.5,0,0,7\n", "heat.csv");
    for (int map = 0; map < MNS_COLOR_MAP_COUNT; map++) {
        look.color_map = (mns_color_map)map;
        mns_image *image = draw_image(d, field, &view, &look, NULL);
        expect_hex(d, image, pixel_at(-1.6), ends[map][0]);
        expect_hex(d, image, pixel_at(1.6), ends[map][1]);
        /* half-way between the anchors in the middle */
        const uint32_t *anchor = palette_map((mns_color_map)map);
        double middle[3];
        for (int c = 0; c < 3; c++)
            middle[c] = ((anchor[4] >> (16 - 8 * c) & 255) + (anchor[5] >> (16 - 8 * c) & 255)) / 510.0;
        expect_color(image, CENTRE, linear(middle[0]), linear(middle[1]), linear(middle[2]), 1, 2e-3);
        assert_string_equal(d->stats.color_map, mns_color_map_name((mns_color_map)map));
        assert_true(d->stats.color_range[0] == 3 && d->stats.color_range[1] == 7);
        mns_image_destroy(image);
    }
    mns_field_destroy(field);
    draw_fixture_check(d);
}

static void a_given_range_moves_the_maps_ends(void **state)
{
    draw_fixture *d = *state;
    mns_view view = ahead();
    mns_look look = bare_look("heat");
    look.set |= MNS_LOOK_RANGE;
    look.range[0] = 5, look.range[1] = 6;
    mns_field *field = field_of("x,y,z,heat\n-1.5,0,0,3\n0,0,0,5\n1.5,0,0,7\n", "heat.csv");
    mns_image *image = draw_image(d, field, &view, &look, NULL);
    expect_hex(d, image, pixel_at(-1.6), 0x440154); /* clamped */
    expect_hex(d, image, CENTRE, 0x440154);
    expect_hex(d, image, pixel_at(1.6), 0xfde725);
    assert_true(d->stats.color_range[0] == 5 && d->stats.color_range[1] == 6);
    mns_image_destroy(image);
    look.color_by = "cold";
    mns_error error;
    assert_int_equal(mns_renderer_draw(d->renderer, field, &view, &look, NULL, d->frame, &error),
                     MNS_ERROR_USAGE);
    assert_non_null(strstr(error.text, "heat")); /* it says which there are */
    mns_field_destroy(field);
}

/* Where two balls meet, their colours are mixed in linear light, by their shares of the field. */
static void colours_are_mixed_where_balls_meet(void **state)
{
    draw_fixture *d = *state;
    mns_view view = ahead();
    mns_look look = bare_look("element");
    mns_field *field = field_of("2\ntwo\nO -0.5 0 0\nN 0.5 0 0\n", "two.xyz");
    mns_image *image = draw_image(d, field, &view, &look, NULL);
    assert_true(isfinite(image->t[CENTRE]));
    expect_color(image, CENTRE, (1 + linear(0x30 / 255.0)) / 2,
                 (linear(0x0d / 255.0) + linear(0x50 / 255.0)) / 2,
                 (linear(0x0d / 255.0) + linear(0xf8 / 255.0)) / 2, 1, 2e-3);
    mns_image_destroy(image);
    mns_field_destroy(field);
}

/* ---- Cel bands ---- */

static size_t count_colors(const mns_image *image, bool *black)
{
    float seen[64][3];
    size_t count = 0;
    *black = false;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        const float *c = &image->rgba[4 * i];
        size_t k = 0;
        if (!isfinite(image->t[i])) continue;
        if (c[0] == 0 && c[1] == 0 && c[2] == 0) *black = true;
        while (k < count && memcmp(seen[k], c, sizeof seen[k]) != 0) k++;
        if (k == count && count < 64) memcpy(seen[count++], c, sizeof seen[0]);
    }
    return count;
}

static void cel_shading_has_a_few_colours_and_a_contour(void **state)
{
    bool black;
    mns_look look = {.set = MNS_LOOK_SPECULAR, .shading = MNS_SHADING_CEL};
    mns_image *image = draw_ball(*state, NULL);
    assert_int_equal(count_colors(image, &black), 64); /* smooth: as many as are counted */
    assert_false(black);
    mns_image_destroy(image);
    for (int bands = 1; bands <= 5; bands += 2) {
        look.cel_bands = bands;
        image = draw_ball(*state, &look);
        size_t colors = count_colors(image, &black);
        assert_true(black);
        /* the darkest band may lie in the contour */
        if (colors < (size_t)bands || colors > (size_t)bands + 1)
            fail_msg("%zu colours with %d bands", colors, bands);
        mns_image_destroy(image);
    }
}

/* ---- Samples ---- */

static void samples_smooth_edges_and_leave_the_planes_alone(void **state)
{
    draw_fixture *d = *state;
    mns_view view = ahead();
    mns_look look = bare_look(NULL);
    look.set |= MNS_LOOK_COLOR | MNS_LOOK_BACKGROUND; /* black on transparent: alpha is the coverage */
    mns_field *field = draw_field(1, (const double[3]){0, 0, 0}, NULL, 1.5, NULL, MNS_KERNEL_POLY3);
    mns_image *one = draw_image(d, field, &view, &look, NULL);
    mns_image *many = draw_image(d, field, &view, &look, &(mns_options){.samples = 16});
    size_t between[2] = {0, 0};
    double coverage[2] = {0, 0};
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        double a = (double)one->rgba[4 * i + 3], b = (double)many->rgba[4 * i + 3];
        between[0] += a > 0.01 && a < 0.99;
        between[1] += b > 0.01 && b < 0.99;
        coverage[0] += a, coverage[1] += b;
        assert_true(fabs(b * 16 - floor(b * 16 + 0.5)) < 1e-4); /* sixteenths */
    }
    assert_int_equal(between[0], 0);
    assert_true(between[1] > 40);
    assert_true(fabs(coverage[1] - coverage[0]) < 0.05 * coverage[0]);
    free(one->rgba);
    one->rgba = calloc((size_t)WIDE * HIGH, 4 * sizeof(float));
    memset(many->rgba, 0, (size_t)WIDE * HIGH * 4 * sizeof(float));
    assert_non_null(one->rgba);
    draw_expect_same(one, many, "samples"); /* t, t.lo, normal, certain */
    mns_image_destroy(one);
    mns_image_destroy(many);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* ---- To a file ---- */

static void a_png_holds_the_colours_as_srgb(void **state)
{
    void *folder;
    char path[IMAGE_FIXTURE_PATH_MAX];
    mns_error error;
    mns_look look = {.set = MNS_LOOK_BACKGROUND, .background = {0.5, 1, 0.25, 0.5}};
    mns_image *image = draw_ball(*state, &look);
    assert_int_equal(image_fixture_setup(&folder), 0);
    image_fixture_path(path, folder, "ball.png");
    if (mns_image_write(image, path, &error) != MNS_OK) fail_msg("%s", error.text);
    png_image png = {.version = PNG_IMAGE_VERSION};
    static png_byte pixel[WIDE * HIGH][4];
    assert_true(png_image_begin_read_from_file(&png, path));
    assert_int_equal(png.width, WIDE);
    assert_int_equal(png.height, HIGH);
    png.format = PNG_FORMAT_RGBA;
    assert_true(png_image_finish_read(&png, NULL, pixel, 0, NULL));
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++)
        for (int c = 0; c < 4; c++) {
            double alpha = (double)image->rgba[4 * i + 3], value = (double)image->rgba[4 * i + (size_t)c];
            double wanted = 255 * (c == 3 ? alpha : srgb_of(fmin(value / alpha, 1)));
            if (fabs(pixel[i][c] - wanted) > 0.51)
                fail_msg("pixel %zu, channel %d: %d, expected %g", i, c, pixel[i][c], wanted);
        }
    assert_int_equal(pixel[0][0], 128); /* 0.5 as it was asked for */
    assert_int_equal(pixel[0][3], 128);
    image_fixture_teardown(&folder);
    mns_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_surface_that_faces_the_headlight_has_its_whole_colour),
        cmocka_unit_test(every_pixel_follows_the_formulas),
        cmocka_unit_test(cel_bands_follow_the_formulas),
        cmocka_unit_test(a_surface_seen_from_inside_is_lit_too),
        cmocka_unit_test(the_background_is_premultiplied_by_its_alpha),
        cmocka_unit_test(elements_have_their_customary_colours),
        cmocka_unit_test(each_map_runs_from_its_first_anchor_to_its_last),
        cmocka_unit_test(a_given_range_moves_the_maps_ends),
        cmocka_unit_test(colours_are_mixed_where_balls_meet),
        cmocka_unit_test(cel_shading_has_a_few_colours_and_a_contour),
        cmocka_unit_test(samples_smooth_edges_and_leave_the_planes_alone),
        cmocka_unit_test(a_png_holds_the_colours_as_srgb),
    };
    return cmocka_run_group_tests_name("shade", tests, draw_fixture_setup, draw_fixture_teardown);
}
