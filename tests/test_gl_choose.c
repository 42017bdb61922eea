/* What the plan chooses draws the picture that the method draws when it is asked for. */
#include "support/draw_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static mns_image *draw_chosen(draw_fixture *d, const mns_field *field, const mns_view *view,
                              mns_options options, mns_method *method)
{
    mns_error error;
    mns_image *image = NULL;
    if (mns_renderer_draw(d->renderer, field, view, NULL, &options, d->frame, &error) ||
        mns_frame_read(d->frame, &image, &error))
        fail_msg("%s", error.text);
    *method = mns_plan_method(mns_frame_plan(d->frame), NULL);
    return image;
}

static void pictures_are_those_of_the_method(void **state)
{
    draw_fixture *d = *state;
    static const struct {
        mns_options options;
        mns_method on_software;
    } cases[] = {
        {{.samples = 0}, MNS_METHOD_TILE},
        {{.moved = true}, MNS_METHOD_TILE},
        {{.gather = MNS_GATHER_PAPER}, MNS_METHOD_LIST},
        {{.counters = true}, MNS_METHOD_FBVH},
        {{.solver = MNS_SOLVER_SECANT}, MNS_METHOD_FBVH},
    };
    const mns_view view = {.width = 90, .height = 60};
    mns_field *field = draw_generated("dense:300", MNS_KERNEL_POLY2);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_options options = cases[i].options;
        mns_image *chosen = draw_chosen(d, field, &view, options, &options.method);
        if (mns_renderer_limits(d->renderer)->is_software)
            assert_int_equal(options.method, cases[i].on_software);
        mns_image *asked = draw_image(d, field, &view, NULL, &options);
        assert_true(draw_count_hits(chosen) > 500);
        draw_expect_same(chosen, asked, "chosen and asked for");
        mns_image_destroy(chosen);
        mns_image_destroy(asked);
    }
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(pictures_are_those_of_the_method, draw_fixture_setup,
                                        draw_fixture_teardown),
    };
    return cmocka_run_group_tests_name("choose", tests, NULL, NULL);
}
