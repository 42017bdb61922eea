/* A tree whose leaves overlap, where a ray crosses the surface in the last digits of what a leaf knows:
 * another leaf, which takes over there, finds the ray inside already. Found at four pixels of this field,
 * each of which missed its hit. */
#include "support/draw_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

/* Of the frame that fits the field. */
static const int pixels[][2] = {{173, 282}, {235, 308}, {400, 366}, {196, 396}};

static void no_crossing_falls_between_two_leaves(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_BVH};
    const mns_view whole = {.width = 640, .height = 480};
    mns_field *field = draw_generated("mixed:10000", MNS_KERNEL_POLY3);
    mns_image *image = draw_image(d, field, &whole, NULL, &options);
    mns_view view;
    mns_reference *reference;
    mns_error error;
    if (mns_view_resolve(&whole, field, &view, &error) || mns_reference_create(field, &reference, &error))
        fail_msg("%s", error.text);
    for (size_t i = 0; i < sizeof pixels / sizeof *pixels; i++) {
        size_t at = (size_t)pixels[i][1] * 640 + (size_t)pixels[i][0];
        double way[3];
        mns_hit hit;
        mns_view_ray(&view, pixels[i][0] + 0.5, pixels[i][1] + 0.5, way);
        if (mns_reference_trace(reference, view.eye, way, &hit, &error)) fail_msg("%s", error.text);
        assert_true(hit.hit && hit.certain && image->certain[at] == 1);
        assert_true(fabs(image->t[at] + (double)image->t_lo[at] - hit.t) <= 4e-6 * hit.t);
    }
    mns_reference_destroy(reference);
    mns_image_destroy(image);
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_crossing_falls_between_two_leaves)};
    return cmocka_run_group_tests(tests, draw_fixture_setup, draw_fixture_teardown);
}
