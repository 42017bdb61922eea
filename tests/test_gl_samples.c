/* A picture sample by sample, as a window draws it at rest; fields that may go; shaders that are read again.
 */
#include "support/draw_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const mns_view VIEW = {.width = 48, .height = 40};

static mns_status draw(draw_fixture *d, const mns_field *field, mns_options options, mns_error *error)
{
    return mns_renderer_draw(d->renderer, field, &VIEW, NULL, &options, d->frame, error);
}

static void drawn(draw_fixture *d, const mns_field *field, mns_options options)
{
    mns_error error;
    if (draw(d, field, options, &error)) fail_msg("%s", error.text);
}

static mns_image *read_back(draw_fixture *d)
{
    mns_image *image;
    assert_int_equal(mns_frame_read(d->frame, &image, NULL), MNS_OK);
    return image;
}

static void samples_one_by_one_are_those_at_once(void **state)
{
    draw_fixture *d = *state;
    static const mns_method methods[] = {MNS_METHOD_TILE, MNS_METHOD_FBVH};
    mns_field *field = draw_generated("scattered:60", MNS_KERNEL_DEFAULT);
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        drawn(d, field, (mns_options){.method = methods[m], .samples = 5});
        mns_image *at_once = read_back(d);
        drawn(d, field, (mns_options){.method = methods[m], .samples = 5, .sample_count = 2});
        mns_image *part = read_back(d);
        assert_true(memcmp(part->rgba, at_once->rgba, 48 * 40 * 4 * sizeof *part->rgba) != 0);
        drawn(d, field,
              (mns_options){.method = methods[m], .samples = 5, .sample_first = 2, .sample_count = 1});
        drawn(d, field, (mns_options){.method = methods[m], .samples = 5, .sample_first = 3});
        mns_image *whole = read_back(d);
        draw_expect_same(at_once, whole, "sample by sample");
        assert_memory_equal(at_once->rgba, whole->rgba, 48 * 40 * 4 * sizeof *whole->rgba);
        mns_image_destroy(at_once);
        mns_image_destroy(part);
        mns_image_destroy(whole);
    }
    mns_field_destroy(field);
}

static void samples_are_added_to_those_before_alone(void **state)
{
    draw_fixture *d = *state;
    mns_error error;
    mns_field *field = draw_generated("scattered:60", MNS_KERNEL_DEFAULT);
    static const mns_options none[] = {{.samples = 4, .sample_first = 4},
                                       {.samples = 4, .sample_first = -1},
                                       {.samples = 4, .sample_first = 2, .sample_count = 3},
                                       {.samples = 0, .sample_count = 2}};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_int_equal(draw(d, field, none[i], &error), MNS_ERROR_USAGE);
    drawn(d, field, (mns_options){.samples = 4, .sample_count = 1});
    assert_int_equal(draw(d, field, (mns_options){.samples = 4, .sample_first = 2}, &error), MNS_ERROR_USAGE);
    assert_non_null(strstr(error.text, "sample 2"));
    assert_int_equal(draw(d, field, (mns_options){.samples = 5, .sample_first = 1}, &error), MNS_ERROR_USAGE);
    drawn(d, field,
          (mns_options){.samples = 4, .sample_first = 1}); /* what was refused has left the frame alone */
    mns_field_destroy(field);
}

/* Under the sanitizers this is a use of freed memory where the end is not waited for. */
static void a_field_may_go_once_its_tree_was_ended(void **state)
{
    draw_fixture *d = *state;
    const mns_options options = {.method = MNS_METHOD_FBVH};
    for (int i = 0; i < 4; i++) {
        mns_field *field = draw_generated("scattered:20000", MNS_KERNEL_DEFAULT);
        assert_int_equal(mns_renderer_prepare(d->renderer, field, &options, NULL), MNS_OK);
        assert_int_equal(mns_renderer_prepare(d->renderer, NULL, NULL, NULL), MNS_OK);
        mns_field_destroy(field);
    }
    mns_field *field = draw_generated("scattered:60", MNS_KERNEL_DEFAULT);
    drawn(d, field, options);
    mns_field_destroy(field);
}

/* ---- Shaders read again ---- */

static void copy_shaders(const char *folder)
{
    char command[600];
    snprintf(command, sizeof command, "mkdir -p %s && cp %s/glsl/*.glsl %s", folder, MNS_SOURCE_DIR, folder);
    assert_int_equal(system(command), 0);
}

static void change(const char *folder, const char *script, const char *file)
{
    char command[600];
    snprintf(command, sizeof command, "sed -i '%s' %s/%s", script, folder, file);
    assert_int_equal(system(command), 0);
}

static void shaders_are_read_again_or_stay(void **state)
{
    draw_fixture *d = *state;
    char folder[] = "/tmp/meniscus-glsl-XXXXXX", command[200];
    const mns_options options = {.method = MNS_METHOD_TILE};
    mns_error error;
    assert_non_null(mkdtemp(folder));
    copy_shaders(folder);
    mns_field *field = draw_generated("scattered:60", MNS_KERNEL_DEFAULT);
    drawn(d, field, options);
    mns_image *before = read_back(d);
    if (mns_renderer_read_shaders(d->renderer, folder, &error)) fail_msg("%s", error.text);
    drawn(d, field, options);
    mns_image *same = read_back(d);
    assert_memory_equal(before->rgba, same->rgba, 48 * 40 * 4 * sizeof *same->rgba);
    /* One that does not compile: told, and the old one goes on. */
    change(folder, "s/out_color = color/out_color = colour/", "shade.frag.glsl");
    assert_int_equal(mns_renderer_read_shaders(d->renderer, folder, &error), MNS_ERROR_GL);
    assert_non_null(strstr(error.text, "shade.frag.glsl"));
    d->gl.messages = 0; /* the driver's own words on it */
    drawn(d, field, options);
    mns_image *kept = read_back(d);
    assert_memory_equal(before->rgba, kept->rgba, 48 * 40 * 4 * sizeof *kept->rgba);
    change(folder, "s/out_color = colour/out_color = 0.5 * color/", "shade.frag.glsl");
    if (mns_renderer_read_shaders(d->renderer, folder, &error)) fail_msg("%s", error.text);
    drawn(d, field, options);
    mns_image *darker = read_back(d);
    for (size_t i = 0; i < 48 * 40 * 4; i++)
        assert_true(fabsf(darker->rgba[i] - 0.5f * before->rgba[i]) < 1e-6f);
    assert_int_equal(mns_renderer_read_shaders(d->renderer, "/nonexistent", &error), MNS_ERROR_IO);
    mns_image *images[] = {before, same, kept, darker};
    for (size_t i = 0; i < 4; i++) mns_image_destroy(images[i]);
    mns_field_destroy(field);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_one_by_one_are_those_at_once),
        cmocka_unit_test(samples_are_added_to_those_before_alone),
        cmocka_unit_test(a_field_may_go_once_its_tree_was_ended),
        cmocka_unit_test(shaders_are_read_again_or_stay),
    };
    return cmocka_run_group_tests(tests, draw_fixture_setup, draw_fixture_teardown);
}
