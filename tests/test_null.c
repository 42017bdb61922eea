/* A pointer that is missing is a mistake in the host's program: told as one wherever there is a status. */
#include "meniscus.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define REFUSED(call) assert_int_equal((call), MNS_ERROR_USAGE)

static const double at[3] = {0};

static void fields_and_inputs_say_so(void **state)
{
    (void)state;
    static const char *const names[] = {"scattered:3"};
    const mns_field_desc desc = {.count = 1, .position = {.data = at}};
    mns_error error;
    mns_field *field = NULL;
    mns_input *input = NULL;
    REFUSED(mns_field_create(NULL, &field, &error));
    REFUSED(mns_field_create(&desc, NULL, &error));
    REFUSED(mns_input_open(NULL, 1, NULL, &input, &error));
    REFUSED(mns_input_open(names, 1, NULL, NULL, &error));
    REFUSED(mns_input_read(NULL, 0, &field, &error));
    assert_int_equal(mns_input_open(names, 1, NULL, &input, &error), MNS_OK);
    REFUSED(mns_input_read(input, 0, NULL, &error));
    mns_input_close(input);
    assert_null(field);
}

static void files_and_words_say_so(void **state)
{
    (void)state;
    mns_error error;
    mns_image *image = NULL;
    mns_scene *scene = NULL;
    double color[4];
    REFUSED(mns_image_write(NULL, "a.png", &error));
    REFUSED(mns_image_read(NULL, &image, &error));
    REFUSED(mns_image_read("a.exr", NULL, &error));
    REFUSED(mns_scene_load(NULL, &scene, &error));
    REFUSED(mns_scene_load("a.json", NULL, &error));
    REFUSED(mns_color_parse(NULL, color, &error));
    REFUSED(mns_color_parse("1,1,1", NULL, &error));
    REFUSED(mns_view_resolve(NULL, NULL, NULL, &error));
}

static void contexts_and_what_draws_say_so(void **state)
{
    (void)state;
    mns_error error;
    mns_frame *frame = NULL;
    mns_image *image = NULL;
    mns_reference *reference = NULL;
    mns_plan *plan = NULL;
    REFUSED(mns_context_create(MNS_BACKEND_AUTO, NULL, &error));
    REFUSED(mns_context_make_current(NULL, &error));
    REFUSED(mns_renderer_create(NULL, NULL, &error));
    REFUSED(mns_frame_create(NULL, &frame, &error));
    REFUSED(mns_frame_read(NULL, &image, &error));
    REFUSED(mns_reference_create(NULL, &reference, &error));
    REFUSED(mns_plan_create(NULL, NULL, NULL, NULL, NULL, &plan, &error));
    REFUSED(mns_renderer_draw(NULL, NULL, NULL, NULL, NULL, NULL, &error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_and_inputs_say_so),
        cmocka_unit_test(files_and_words_say_so),
        cmocka_unit_test(contexts_and_what_draws_say_so),
    };
    return cmocka_run_group_tests_name("null", tests, NULL, NULL);
}
