#include "support/draw_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

int draw_fixture_setup(void **state)
{
    draw_fixture *d = calloc(1, sizeof *d);
    mns_error error;
    if (!d) return -1;
    gl_fixture_begin(&d->gl);
    if (mns_renderer_create(mns_context_get_proc(d->gl.context), &d->renderer, &error) != MNS_OK)
        fail_msg("%s", error.text);
    mns_renderer_keep_programs(d->renderer, NULL); /* what is tested is compiled here and now */
    if (mns_frame_create(d->renderer, &d->frame, &error) != MNS_OK) fail_msg("%s", error.text);
    *state = d;
    return 0;
}

void draw_fixture_check(draw_fixture *d)
{
    const char *last;
    size_t messages = mns_renderer_messages(d->renderer, &last);
    if (messages) fail_msg("%zu messages of the driver, the last: %s", messages, last);
    gl_fixture_check(&d->gl);
}

int draw_fixture_teardown(void **state)
{
    draw_fixture *d = *state;
    draw_fixture_check(d);
    mns_frame_destroy(d->frame);
    mns_renderer_destroy(d->renderer);
    gl_fixture_end(&d->gl);
    free(d);
    return 0;
}

mns_options draw_by_lists(const mns_options *options)
{
    mns_options listed = options ? *options : (mns_options){0};
    if (listed.method == MNS_METHOD_AUTO) listed.method = MNS_METHOD_LIST;
    return listed;
}

mns_image *draw_image(draw_fixture *d, const mns_field *field, const mns_view *view, const mns_look *look,
                      const mns_options *options)
{
    mns_error error;
    mns_image *image;
    const mns_options listed = draw_by_lists(options);
    if (mns_renderer_draw(d->renderer, field, view, look, &listed, d->frame, &error) != MNS_OK)
        fail_msg("%s", error.text);
    if (mns_frame_read(d->frame, &image, &error) != MNS_OK) fail_msg("%s", error.text);
    d->stats = *mns_frame_stats(d->frame);
    return image;
}

mns_field *draw_generated(const char *spec, mns_kernel kernel)
{
    mns_error error;
    mns_input *input;
    mns_field *field;
    mns_input_options options = {.kernel = kernel};
    if (mns_input_open(&spec, 1, &options, &input, &error) != MNS_OK) fail_msg("%s", error.text);
    if (mns_input_read(input, 0, &field, &error) != MNS_OK) fail_msg("%s", error.text);
    mns_input_close(input);
    return field;
}

mns_field *draw_field(size_t count, const double *position, const double *radius, double uniform_radius,
                      const double *strength, mns_kernel kernel)
{
    mns_error error;
    mns_field *field;
    mns_field_desc desc = {.count = count,
                           .position = {.data = position},
                           .radius = {.data = radius},
                           .strength = {.data = strength},
                           .uniform_radius = uniform_radius,
                           .kernel = kernel};
    if (mns_field_create(&desc, &field, &error) != MNS_OK) fail_msg("%s", error.text);
    return field;
}

mns_view draw_view(const double eye[3], const double look_at[3], double fov, int width, int height)
{
    mns_view view = {.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT,
                     .up = {0, 1, 0},
                     .fov = fov,
                     .width = width,
                     .height = height};
    memcpy(view.eye, eye, sizeof view.eye);
    memcpy(view.look_at, look_at, sizeof view.look_at);
    return view;
}

static void expect_plane(const float *a, const float *b, size_t pixels, size_t channels, const char *plane,
                         const char *what)
{
    size_t different = 0, first = 0;
    for (size_t i = pixels; i-- > 0;)
        if (memcmp(a + i * channels, b + i * channels, channels * sizeof *a) != 0) different++, first = i;
    if (different)
        fail_msg("%s: %s differs at %zu pixels, the first %zu: %.9g and %.9g", what, plane, different, first,
                 (double)a[first * channels], (double)b[first * channels]);
}

void draw_expect_same(const mns_image *a, const mns_image *b, const char *what)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    size_t pixels = (size_t)a->width * (size_t)a->height;
    expect_plane(a->t, b->t, pixels, 1, "t", what);
    expect_plane(a->t_lo, b->t_lo, pixels, 1, "t.lo", what);
    expect_plane(a->normal, b->normal, pixels, 3, "normal", what);
    expect_plane(a->certain, b->certain, pixels, 1, "certain", what);
    expect_plane(a->rgba, b->rgba, pixels, 4, "colour", what);
    const struct {
        const char *name;
        const float *a, *b;
    } terms[] = {
        {"shadow", a->shadow, b->shadow},     {"occlusion", a->occlusion, b->occlusion},
        {"mirror", a->mirror_t, b->mirror_t}, {"refraction", a->refract_t, b->refract_t},
        {"mesh", a->mesh, b->mesh},           {"certain effects", a->effects_certain, b->effects_certain}};
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++)
        if (terms[i].a && terms[i].b) expect_plane(terms[i].a, terms[i].b, pixels, 1, terms[i].name, what);
}

size_t draw_count_hits(const mns_image *image)
{
    size_t hits = 0, pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++) hits += isfinite(image->t[i]) != 0;
    return hits;
}

double draw_random(uint64_t *state) /* splitmix64: Steele, Lea, Flood 2014 */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}
