/* What a long run holds: nothing grows from frame to frame, nor from renderer to renderer. */
#include "support/draw_fixture.h"

#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What the process holds, in KiB: by malloc, which is exact but knows nothing of what is mapped beside it
 * (compiled code); and resident, which knows all but wavers by a megabyte or so with what the allocator
 * and the driver's compiler keep or give back. A leak a frame or a renderer grows in the first, or
 * in both. */
typedef struct memory {
    long allocated, resident;
} memory;

/* A line of /proc/self/status in KiB. */
static long status_kib(const char *name)
{
    char line[256];
    long kib = -1;
    FILE *file = fopen("/proc/self/status", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file))
        if (strncmp(line, name, strlen(name)) == 0 && line[strlen(name)] == ':')
            kib = atol(line + strlen(name) + 1);
    fclose(file);
    assert_true(kib > 0);
    return kib;
}

static memory memory_now(void)
{
    struct mallinfo2 heap = mallinfo2();
    return (memory){(long)((heap.uordblks + heap.hblkhd) / 1024), status_kib("VmRSS")};
}

/* Fails where more than `allocated` KiB have come since `before`, or more than 3 MiB are resident beyond
 * them. */
static void expect_grown_by(memory before, long allocated, const char *what)
{
    memory now = memory_now();
    printf("%s: %ld KiB allocated, %ld KiB resident\n", what, now.allocated - before.allocated,
           now.resident - before.resident);
    if (now.allocated - before.allocated > allocated)
        fail_msg("%s left %ld KiB of malloc behind, at most %ld", what, now.allocated - before.allocated,
                 allocated);
    if (now.resident - before.resident > allocated + 3 * 1024)
        fail_msg("%s left %ld KiB resident", what, now.resident - before.resident);
}

static uint64_t draw_frame(draw_fixture *d, mns_input *input, size_t index, mns_view *view)
{
    mns_error error;
    mns_field *field;
    mns_view fitted;
    if (mns_input_read(input, index, &field, &error) != MNS_OK) fail_msg("%s", error.text);
    assert_int_equal(mns_view_resolve(view, field, &fitted, &error), MNS_OK);
    *view = fitted; /* by the first frame */
    mns_image *image = draw_image(d, field, view, NULL, &(mns_options){.moved = true});
    assert_true(draw_count_hits(image) > 50);
    mns_image_destroy(image);
    mns_field_destroy(field);
    return d->stats.fallbacks.undecided_float;
}

/* A sequence as the program draws one: each frame read, drawn as moved, read back. The slow paths' programs,
 * 10 MB of the driver's, are compiled when a pixel first needs them, which in frames as small as these may be
 * late: what is measured begins when they are there. */
static void three_hundred_frames_need_no_more_than_twenty(void **state)
{
    draw_fixture *d = *state;
    static const char *const name = "tornado:1500:1:300";
    mns_error error;
    mns_input *input;
    memory at_twenty = {0, 0};
    long most_at_twenty = 0;
    mns_view view = {.width = 64, .height = 48};
    if (mns_input_open(&name, 1, NULL, &input, &error) != MNS_OK) fail_msg("%s", error.text);
    assert_int_equal(mns_input_frames(input), 300);
    for (size_t i = 0; i < 300 && !draw_frame(d, input, i, &view); i++) {}
    for (size_t i = 0; i < 300; i++) {
        draw_frame(d, input, i, &view);
        if (i == 20) at_twenty = memory_now(), most_at_twenty = status_kib("VmHWM");
    }
    expect_grown_by(at_twenty, 1024, "280 frames");
    long grown = status_kib("VmHWM") - most_at_twenty;
    if (grown > 3 * 1024)
        fail_msg("frame 300 needs %ld KiB more than frame 20 did (%ld)", grown, most_at_twenty);
    mns_input_close(input);
    draw_fixture_check(d);
}

/* GL names in use, counted by asking for each of the first ones: what a renderer leaves behind would stay
 * here. */
static size_t count_names(const GladGLContext *gl)
{
    size_t count = 0;
    for (GLuint name = 1; name < 400; name++)
        count += gl->IsBuffer(name) + gl->IsTexture(name) + gl->IsFramebuffer(name) + gl->IsProgram(name) +
                 gl->IsShader(name) + gl->IsVertexArray(name) + gl->IsQuery(name) + gl->IsSampler(name);
    return count;
}

static void draw_with_own_renderer(draw_fixture *d, const mns_field *field, const mns_view *view,
                                   const mns_options *options)
{
    draw_fixture own = {.gl = d->gl};
    mns_error error;
    if (mns_renderer_create(mns_context_get_proc(d->gl.context), &own.renderer, &error) != MNS_OK)
        fail_msg("%s", error.text);
    assert_int_equal(mns_frame_create(own.renderer, &own.frame, &error), MNS_OK);
    mns_image *image = draw_image(&own, field, view, NULL, options);
    assert_true(draw_count_hits(image) > 50);
    mns_image_destroy(image);
    mns_frame_destroy(own.frame);
    mns_renderer_destroy(own.renderer);
}

static int by_size(const void *a, const void *b)
{
    return (*(const long *)a > *(const long *)b) - (*(const long *)a < *(const long *)b);
}

/* What a renderer leaves behind every one does, whereas the driver's own tables grow now and then: so the
 * middle one of five growths tells the two apart, but for the dozen KiB that come and go. */
static void expect_no_growth(draw_fixture *d, const mns_field *field, const mns_view *view)
{
    enum { ROUNDS = 5 };
    long growth[ROUNDS];
    draw_with_own_renderer(d, field, view, NULL); /* the driver lets go of what other options needed */
    memory first = memory_now(), before = first;
    for (int i = 0; i < ROUNDS; i++) {
        draw_with_own_renderer(d, field, view, NULL);
        memory now = memory_now();
        growth[i] = now.allocated - before.allocated;
        before = now;
    }
    qsort(growth, ROUNDS, sizeof *growth, by_size);
    /* A card's driver was seen to keep some of each program, whoever deletes it. */
    const long most = mns_renderer_limits(d->renderer)->is_software ? 16 : 256;
    if (growth[ROUNDS / 2] > most) fail_msg("each renderer leaves some %ld KiB behind", growth[ROUNDS / 2]);
    expect_grown_by(first, 1024, "5 renderers");
}

static void renderers_leave_nothing_behind(void **state)
{
    draw_fixture *d = *state;
    mns_view view = {.width = 64, .height = 48};
    size_t fixed = count_names(&d->gl.gl);
    mns_field *field = draw_generated("dense:300", MNS_KERNEL_POLY3);
    const mns_options options[] = {
        {0}, {.slots = 2, .shuffle = 3, .samples = 2}}; /* the slow paths' objects too */
    for (size_t i = 0; i < 2; i++) {
        size_t names[2]; /* the driver may hold on to the program that was used last, but to no more */
        for (size_t k = 0; k < 2; k++) {
            draw_with_own_renderer(d, field, &view, &options[i]);
            names[k] = count_names(&d->gl.gl);
        }
        assert_true(names[0] <= fixed + 3);
        assert_int_equal(names[1], names[0]);
    }
    expect_no_growth(d, field, &view);
    mns_field_destroy(field);
    gl_fixture_check(&d->gl);
}

static void frames_of_changing_size_leave_nothing_behind(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = draw_generated("dense:300", MNS_KERNEL_POLY3);
    mns_error error;
    size_t names = 0;
    memory before = {0, 0};
    for (int i = 0; i < 60; i++) {
        mns_frame *frame;
        mns_view view = {.width = 200 + i % 7, .height = 150 - i % 5};
        assert_int_equal(mns_frame_create(d->renderer, &frame, &error), MNS_OK);
        for (int k = 0; k < 2; k++) { /* resized once */
            view.width -= 50 * k;
            if (mns_renderer_draw(d->renderer, field, &view, NULL, NULL, frame, &error) != MNS_OK)
                fail_msg("%s", error.text);
        }
        mns_frame_destroy(frame);
        if (i == 20) names = count_names(&d->gl.gl), before = memory_now();
    }
    assert_true(count_names(&d->gl.gl) <= names);
    expect_grown_by(before, 1024, "39 frames of other sizes");
    mns_field_destroy(field);
    draw_fixture_check(d);
}

int main(void)
{
#ifdef __SANITIZE_ADDRESS__
    puts("the sanitizer keeps what was freed: memory cannot be measured under it");
    return 77;
#endif
    if (setenv("MESA_SHADER_CACHE_DISABLE", "true", 1) != 0)
        return 1; /* holds programs, and writes on a thread */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_hundred_frames_need_no_more_than_twenty),
        cmocka_unit_test(renderers_leave_nothing_behind),
        cmocka_unit_test(frames_of_changing_size_leave_nothing_behind),
    };
    return cmocka_run_group_tests_name("memory", tests, draw_fixture_setup, draw_fixture_teardown);
}
