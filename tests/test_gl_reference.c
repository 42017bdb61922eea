/* A frame by the reference: its planes are the tracer's, the list agrees with them, and nothing of the list
 * is made. */
#include "render/render.h"
#include "support/draw_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 64, HEIGHT = 48 };
static const mns_options traced = {.method = MNS_METHOD_REFERENCE};

static mns_field *generated(const char *spec, mns_kernel kernel)
{
    return draw_generated(spec, kernel);
}

static mns_view small_view(void)
{
    return (mns_view){.width = WIDTH, .height = HEIGHT};
}

static void expect_pixel(const mns_image *image, int i, const mns_hit *hit)
{
    float high = (float)hit->t;
    assert_true(image->t[i] == high || (isinf(image->t[i]) && !hit->hit));
    assert_true(image->certain[i] == (hit->certain ? 1.0f : 0.0f));
    for (int a = 0; a < 3; a++) assert_true(image->normal[3 * i + a] == (float)hit->normal[a]);
    if (!hit->hit) {
        assert_true(image->t_lo[i] == 0 && image->t_error[i] == 0);
        return;
    }
    double whole = (double)image->t[i] + (double)image->t_lo[i];
    assert_true(fabs(whole - hit->t) <= 0x1p-46 * hit->t);
    assert_true((double)image->t_error[i] >= hit->t_error + fabs(whole - hit->t));
    assert_true((double)image->t_error[i] <= 1.001 * (hit->t_error + fabs(whole - hit->t)));
}

static void planesAreTheTracersPixelByPixel(void **state)
{
    draw_fixture *d = *state;
    for (mns_kernel k = MNS_KERNEL_POLY2; k < MNS_KERNEL_COUNT; k++) {
        mns_error error;
        mns_view view = small_view(), resolved;
        mns_reference *reference;
        mns_field *field = generated("mixed:300", k);
        mns_image *image = draw_image(d, field, &view, NULL, &traced);
        assert_non_null(image->t_error);
        assert_int_equal(mns_view_resolve(&view, field, &resolved, &error), MNS_OK);
        assert_int_equal(mns_reference_create(field, &reference, &error), MNS_OK);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                double way[3];
                mns_hit hit;
                mns_view_ray(&resolved, x + 0.5, y + 0.5, way);
                assert_int_equal(mns_reference_trace(reference, resolved.eye, way, &hit, &error), MNS_OK);
                expect_pixel(image, y * WIDTH + x, &hit);
            }
        assert_int_equal(d->stats.pixels_hit, draw_count_hits(image));
        assert_true(d->stats.pixels_hit > 100);
        assert_int_equal(d->stats.pixels_undecided, 0);
        mns_image_destroy(image);
        mns_reference_destroy(reference);
        mns_field_destroy(field);
    }
}

/* The list's t is good to some float roundings of it, or of `least` where it is smaller; its colours to those
 * of halves, and of a normal. */
static void expect_alike(const mns_image *list, const mns_image *truth, double least, const char *what)
{
    assert_null(list->t_error);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (isinf(list->t[i]) != isinf(truth->t[i])) fail_msg("%s: pixel %d: hit or miss", what, i);
        for (int c = 0; c < 4; c++)
            if (!(fabsf(list->rgba[4 * i + c] - truth->rgba[4 * i + c]) <= 5e-3f))
                fail_msg("%s: pixel %d: colour %d is %g, by the reference %g", what, i, c,
                         (double)list->rgba[4 * i + c], (double)truth->rgba[4 * i + c]);
        if (isinf(list->t[i])) continue;
        double a = (double)list->t[i] + (double)list->t_lo[i],
               b = (double)truth->t[i] + (double)truth->t_lo[i];
        if (!(fabs(a - b) <= 2e-6 * fmax(b, least)))
            fail_msg("%s: pixel %d: t = %.9g, truly %.9g", what, i, a, b);
    }
}

static void theListAgrees(void **state)
{
    draw_fixture *d = *state;
    static const struct {
        const char *what, *field, *color_by;
        int samples;
        mns_shading shading;
    } cases[] = {
        {"plain", "scattered:500", NULL, 1, MNS_SHADING_SMOOTH},
        {"numbers", "tornado:500", "speed", 1, MNS_SHADING_SMOOTH},
        {"labels", "molecule:200", "element", 1, MNS_SHADING_SMOOTH},
        {"samples", "scattered:500", NULL, 3, MNS_SHADING_SMOOTH},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_view view = small_view();
        mns_field *field = generated(cases[i].field, MNS_KERNEL_DEFAULT);
        mns_look look = {.color_by = cases[i].color_by, .shading = cases[i].shading};
        mns_options on_list = {.samples = cases[i].samples}, on_cpu = traced;
        on_cpu.samples = cases[i].samples;
        mns_image *truth = draw_image(d, field, &view, &look, &on_cpu);
        assert_string_equal(d->stats.method, "reference");
        assert_string_equal(d->stats.solver, "exact");
        mns_image *list = draw_image(d, field, &view, &look, &on_list);
        assert_string_equal(d->stats.method, "list");
        expect_alike(list, truth, 0, cases[i].what);
        mns_image_destroy(list);
        mns_image_destroy(truth);
        mns_field_destroy(field);
    }
}

static void eyesInsideAndFarAwayAgreeToo(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = generated("scattered:500", MNS_KERNEL_DEFAULT);
    mns_view views[] = {
        draw_view((double[3]){0.5, 0.5, 0.5}, (double[3]){1, 0.4, 0.3}, 90, WIDTH, HEIGHT),
        draw_view((double[3]){0.5, 0.5, 3e4}, (double[3]){0.5, 0.5, 0}, 0.003, WIDTH, HEIGHT)};
    for (int i = 0; i < 2; i++) {
        mns_image *truth = draw_image(d, field, &views[i], NULL, &traced);
        mns_image *list = draw_image(d, field, &views[i], NULL, NULL);
        assert_true(d->stats.pixels_undecided == 0 && draw_count_hits(truth) > 100);
        /* Inside, floats are those of points a few radii away, met at any slant. */
        expect_alike(list, truth, i ? 0 : 0.5, i ? "far" : "inside");
        mns_image_destroy(list);
        mns_image_destroy(truth);
    }
    mns_field_destroy(field);
}

static void nothingOfTheListIsMade(void **state)
{
    draw_fixture *d = *state;
    mns_view view = small_view();
    mns_field *field = generated("scattered:500", MNS_KERNEL_DEFAULT);
    const list_passes *p = &d->renderer->passes;
    mns_image *image = draw_image(d, field, &view, NULL, &traced);
    size_t count;
    const char *const *pass = mns_plan_passes(mns_frame_plan(d->frame), &count);
    assert_int_equal(count, 2);
    assert_string_equal(pass[0], "trace");
    assert_string_equal(pass[1], "shade");
    assert_int_equal(d->stats.programs, 1);
    assert_int_equal(d->stats.buffers, 1); /* of the shading's numbers */
    assert_int_equal(d->stats.passes, 2);
    assert_true(!p->heads && !p->core_depth && !p->balls.id && !p->nodes.id && !p->view.id);
    mns_image_destroy(image);
    mns_field_destroy(field);
}

static void theBoundGoesThroughAFile(void **state)
{
    draw_fixture *d = *state;
    char path[] = "/tmp/meniscus-reference-XXXXXX.exr";
    mns_error error;
    mns_view view = small_view();
    mns_image *back = NULL;
    mns_field *field = generated("scattered:500", MNS_KERNEL_DEFAULT);
    int made = mkstemps(path, 4);
    assert_true(made >= 0);
    FILE *file = fdopen(made, "wb");
    assert_non_null(file);
    fclose(file);
    for (int i = 0; i < 2; i++) { /* with the channel, and without */
        mns_image *image = draw_image(d, field, &view, NULL, i ? NULL : &traced);
        assert_int_equal(mns_image_write(image, path, &error), MNS_OK);
        assert_int_equal(mns_image_read(path, &back, &error), MNS_OK);
        draw_expect_same(image, back, "read back");
        assert_true(!back->t_error == (i == 1));
        if (!i) assert_memory_equal(image->t_error, back->t_error, WIDTH * HEIGHT * sizeof *image->t_error);
        mns_image_destroy(image);
        mns_image_destroy(back);
    }
    remove(path);
    mns_field_destroy(field);
}

static void whatItCannotDoIsSaid(void **state)
{
    draw_fixture *d = *state;
    mns_error error;
    mns_options cubic = {.method = MNS_METHOD_REFERENCE, .solver = MNS_SOLVER_CUBIC};
    mns_target target = {.near = 0.1, .far = 100};
    mns_view view = small_view();
    mns_field *field = generated("scattered:50", MNS_KERNEL_DEFAULT);
    assert_int_equal(mns_renderer_draw(d->renderer, field, &view, NULL, &cubic, d->frame, &error),
                     MNS_ERROR_USAGE);
    assert_non_null(strstr(error.text, "reference has one solver: exact"));
    assert_int_equal(
        mns_renderer_draw_on(d->renderer, field, &view, NULL, &traced, &target, d->frame, &error),
        MNS_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.text, "take the method list"));
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(planesAreTheTracersPixelByPixel, draw_fixture_setup,
                                        draw_fixture_teardown),
        cmocka_unit_test_setup_teardown(theListAgrees, draw_fixture_setup, draw_fixture_teardown),
        cmocka_unit_test_setup_teardown(eyesInsideAndFarAwayAgreeToo, draw_fixture_setup,
                                        draw_fixture_teardown),
        cmocka_unit_test_setup_teardown(nothingOfTheListIsMade, draw_fixture_setup, draw_fixture_teardown),
        cmocka_unit_test_setup_teardown(theBoundGoesThroughAFile, draw_fixture_setup, draw_fixture_teardown),
        cmocka_unit_test_setup_teardown(whatItCannotDoIsSaid, draw_fixture_setup, draw_fixture_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
