/* What a frame by a tree makes and moves, and what it does not: nothing where nobody asks, nothing again
 * where nothing changed; the next frame's tree ahead of its frame; counts of a ray's work only where they are
 * wanted. */
#include "base/clock.h"
#include "render/render.h"
#include "support/host_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

static const mns_view small_view = {.width = 64, .height = 48};

static mns_stats draw_by(draw_fixture *d, const mns_field *field, const mns_options *options)
{
    mns_error error;
    if (mns_renderer_draw(d->renderer, field, &small_view, NULL, options, d->frame, &error))
        fail_msg("%s", error.text);
    return *mns_frame_stats(d->frame);
}

/* A renderer and a frame that have drawn nothing. */
static void renew(draw_fixture *d)
{
    mns_error error;
    draw_fixture_check(d);
    mns_frame_destroy(d->frame);
    mns_renderer_destroy(d->renderer);
    if (mns_renderer_create(mns_context_get_proc(d->gl.context), &d->renderer, &error) ||
        mns_frame_create(d->renderer, &d->frame, &error))
        fail_msg("%s", error.text);
}

static void other_methods_build_nothing_of_a_tree(void **state)
{
    draw_fixture *d = *state;
    static const trace_passes nothing;
    static const trace_worker nobody;
    static const mns_method methods[] = {MNS_METHOD_LIST, MNS_METHOD_TILE, MNS_METHOD_REFERENCE};
    renew(d);
    mns_field *field = draw_generated("scattered:50", MNS_KERNEL_POLY3);
    for (size_t i = 0; i < 3; i++) {
        mns_options options = {.method = methods[i], .measure = true};
        mns_error error;
        assert_int_equal(mns_renderer_prepare(d->renderer, field, &options, &error), MNS_OK);
        mns_stats stats = draw_by(d, field, &options);
        assert_memory_equal(&d->renderer->trace, &nothing, sizeof nothing);
        assert_memory_equal(&d->renderer->worker, &nobody, sizeof nobody);
        assert_true(stats.tree.balls == 0 && !stats.counted && d->frame->work == 0);
        for (size_t p = 0; p < d->renderer->programs.count; p++)
            assert_null(strstr(d->renderer->programs.item[p].key, "fbvh"));
    }
    mns_field_destroy(field);
}

static void a_tree_makes_nothing_of_the_lists(void **state)
{
    draw_fixture *d = *state;
    renew(d);
    mns_field *field = draw_generated("scattered:50", MNS_KERNEL_POLY3);
    mns_stats stats = draw_by(d, field, &(mns_options){.method = MNS_METHOD_FBVH});
    const list_passes *p = &d->renderer->passes;
    assert_true(!p->balls.id && !p->nodes.id && !p->counter.id && !p->tile_heads.id && !p->heads &&
                !p->core_depth);
    assert_int_equal(stats.passes, 5);
    assert_int_equal(stats.list_nodes, 0);
    assert_true(stats.tree.balls == 50 && stats.tree.leaves > 0 && stats.tree.references >= 50);
    /* balls, pairs, leaves, references, blocks, pixels to resolve, view, shading; and where a pixel needed
     * doubles, their words */
    unsigned late = stats.fallbacks.undecided_float ? 2 : 0;
    assert_int_equal(stats.buffers, 8 + late);
    mns_field_destroy(field);
}

static void the_same_again_builds_and_sends_nothing(void **state)
{
    draw_fixture *d = *state;
    renew(d);
    mns_field *field = draw_generated("tornado:500", MNS_KERNEL_POLY3);
    mns_field *other = draw_generated("tornado:500:1:2", MNS_KERNEL_POLY3);
    mns_options options = {.method = MNS_METHOD_FBVH, .measure = true};
    mns_stats first = draw_by(d, field, &options);
    assert_true(first.ms[MNS_PHASE_BUILD] > 0 && first.ms[MNS_PHASE_UPLOAD] > 0 &&
                first.ms[MNS_PHASE_TRACE] > 0);
    fbvh_builder *builder = d->renderer->worker.builder;
    for (int i = 0; i < 2; i++) {
        mns_stats again = draw_by(d, field, &options);
        assert_true(again.ms[MNS_PHASE_BUILD] == 0 && again.ms[MNS_PHASE_UPLOAD] == 0);
        assert_true(again.ms[MNS_PHASE_TRACE] > 0 && again.pixels_hit == first.pixels_hit);
        assert_true(again.programs == first.programs && again.buffers == first.buffers);
    }
    options.moved = true;
    assert_true(draw_by(d, field, &options).ms[MNS_PHASE_BUILD] > 0);
    options.moved = false;
    options.tree = "no-fit";
    assert_true(draw_by(d, field, &options).ms[MNS_PHASE_BUILD] > 0);
    assert_true(draw_by(d, field, &options).ms[MNS_PHASE_BUILD] == 0);
    options.solver = MNS_SOLVER_SECANT; /* another program over the same tree */
    assert_true(draw_by(d, field, &options).ms[MNS_PHASE_BUILD] == 0);
    assert_true(draw_by(d, other, &options).ms[MNS_PHASE_BUILD] > 0);
    options.method = MNS_METHOD_BVH;
    assert_true(draw_by(d, other, &options).ms[MNS_PHASE_BUILD] > 0);
    assert_ptr_equal(d->renderer->worker.builder, builder);
    mns_field_destroy(field);
    mns_field_destroy(other);
}

/* ---- Frames that move ---- */

/* Until what is announced is built, as a device of its own would draw meanwhile. */
static void wait_for_tree(draw_fixture *d)
{
    double until = clock_ms() + 60000; /* no measure of speed: this much is a thread that hangs */
    while (!atomic_load(&d->renderer->worker.done)) {
        if (clock_ms() > until) fail_msg("what is announced is never built");
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    }
}

/* Announced fields give the pictures that they give unannounced, in any order of announcing. */
static void trees_built_ahead_give_the_same_pictures(void **state)
{
    enum { FRAMES = 4 };
    draw_fixture *d = *state;
    mns_error error;
    mns_options options = {.method = MNS_METHOD_FBVH};
    mns_field *field[FRAMES];
    mns_image *plain[FRAMES];
    for (size_t i = 0; i < FRAMES; i++) {
        char spec[40];
        snprintf(spec, sizeof spec, "scattered:300:%zu", i + 1);
        field[i] = draw_generated(spec, MNS_KERNEL_POLY3);
        plain[i] = draw_image(d, field[i], &small_view, NULL, &options);
    }
    renew(d);
    static const size_t none = FRAMES;
    static const size_t announced[] = {0, 1, 2, 3, 0, 2, 1, 1, none, none, none, 2, none, none, none};
    static const size_t drawn[] = {0, 0, 1, 3, 3, 0, 2, 1, 3, 2, 0, 1, 0, 3, 2};
    for (size_t i = 0; i < sizeof drawn / sizeof *drawn; i++) {
        if (announced[i] != none && mns_renderer_prepare(d->renderer, field[announced[i]], &options, &error))
            fail_msg("%s", error.text);
        mns_image *image = draw_image(d, field[drawn[i]], &small_view, NULL, &options);
        draw_expect_same(plain[drawn[i]], image, "built ahead");
        mns_image_destroy(image);
    }
    renew(d); /* each announced while the one before is drawn, but for the first, which nobody announced */
    for (size_t i = 0; i < FRAMES; i++) {
        if (i + 1 < FRAMES && mns_renderer_prepare(d->renderer, field[i + 1], &options, &error))
            fail_msg("%s", error.text);
        if (i + 1 < FRAMES) wait_for_tree(d);
        mns_image *image = draw_image(d, field[i], &small_view, NULL, &options);
        draw_expect_same(plain[i], image, "announced by the one before");
        mns_image_destroy(image);
    }
    renew(d); /* with one still announced */
    for (size_t i = 0; i < FRAMES; i++) {
        mns_image_destroy(plain[i]);
        mns_field_destroy(field[i]);
    }
    draw_fixture_check(d);
}

/* The paper's figure 7: while a frame is drawn the next one's tree is built by another thread, and the draw
 * takes that one. What a clock says of it is for the bench; here it is seen by who did what. */
static void the_next_frames_tree_is_built_while_this_one_is_drawn(void **state)
{
    enum { FRAMES = 3 };
    draw_fixture *d = *state;
    const trace_worker *worker = &d->renderer->worker;
    mns_error error;
    mns_options options = {.method = MNS_METHOD_FBVH, .moved = true};
    mns_field *field = draw_generated("dense:20000", MNS_KERNEL_POLY3);
    mns_stats alone = draw_by(d, field, &options);
    assert_true(!worker->running &&
                !worker->ready.tree); /* nobody announced: the draw builds, and uses it up */
    if (mns_renderer_prepare(d->renderer, field, &options, &error)) fail_msg("%s", error.text);
    for (size_t i = 0; i < FRAMES; i++) {
        assert_true(worker->running); /* to announce is not to wait */
        wait_for_tree(d);             /* the frame before is drawn */
        assert_int_equal(worker->ahead.status, MNS_OK);
        fbvh_figures built = worker->ahead.tree->figures;
        mns_stats ahead = draw_by(d, field, &options);
        assert_true(!worker->running && !worker->ready.tree);                     /* it is used up */
        assert_true(ahead.tree.build_ms == built.build_ms && built.build_ms > 0); /* no other was built */
        assert_true(ahead.pixels_hit == alone.pixels_hit);
        if (mns_renderer_prepare(d->renderer, field, &options, &error)) fail_msg("%s", error.text);
    }
    renew(d);
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* ---- Hosts ---- */

/* Over a host's framebuffer the nearer one wins, and rays end where the host drew nearer. */
static void a_host_is_drawn_on_by_trees_too(void **state)
{
    draw_fixture *d = *state;
    mns_error error;
    renew(d);
    mns_view view = host_view();
    mns_field *field = host_cloud();
    for (int method = MNS_METHOD_FBVH; method <= MNS_METHOD_BVH; method++) {
        mns_options options = {.method = (mns_method)method};
        mns_image *plain = draw_image(d, field, &view, NULL, &options);
        host h = host_make(d, false);
        mns_target target = {.framebuffer = h.framebuffer, .x = 23, .y = 17, .near = 0.1, .far = 10};
        host_paint(d, &h, host_rectangle, 1.5, target.near, target.far);
        if (mns_renderer_draw_on(d->renderer, field, &view, NULL, &options, &target, d->frame, &error))
            fail_msg("%s", error.text);
        host_pixels *got = host_read(d, &h);
        host_outcome seen = host_expect_nearer_wins(got, plain, &view, &target, host_rectangle, 1.5, 1e-6);
        if (seen.ours < 1000 || seen.behind < 300) fail_msg("%zu ours, %zu behind", seen.ours, seen.behind);
        free(got);
        host_free(d, &h);
        mns_image_destroy(plain);
    }
    mns_field_destroy(field);
    draw_fixture_check(d);
}

/* ---- Counts ---- */

/* An EXR file keeps every count, each under its own name: one read back is the same bits. */
static void expect_read_back(const mns_image *counted)
{
    mns_error error;
    char path[] = "/tmp/mns_work_XXXXXX.exr";
    mns_image *back = NULL;
    int file = mkstemps(path, 4);
    assert_true(file >= 0);
    close(file);
    if (mns_image_write(counted, path, &error) || mns_image_read(path, &back, &error))
        fail_msg("%s", error.text);
    remove(path);
    assert_non_null(back->work);
    size_t count = (size_t)counted->width * (size_t)counted->height * MNS_WORK_COUNT;
    assert_memory_equal(back->work, counted->work, count * sizeof *back->work);
    mns_image_destroy(back);
}

static void counts_are_made_where_they_are_asked_for(void **state)
{
    draw_fixture *d = *state;
    mns_error error;
    renew(d);
    mns_field *field = draw_generated("scattered:300", MNS_KERNEL_POLY3);
    for (int method = MNS_METHOD_FBVH; method <= MNS_METHOD_BVH; method++) {
        mns_options options = {.method = (mns_method)method};
        mns_image *plain = draw_image(d, field, &small_view, NULL, &options), *heat;
        assert_null(plain->work);
        assert_false(d->stats.counted);
        assert_int_equal(mns_image_heat(plain, MNS_WORK_BALLS, MNS_COLOR_MAP_MAGMA, &heat, NULL, &error),
                         MNS_ERROR_USAGE);
        options.counters = true;
        mns_image *counted = draw_image(d, field, &small_view, NULL, &options);
        assert_true(counted->work && d->stats.counted);
        draw_expect_same(plain, counted, "counted");
        double sum[MNS_WORK_COUNT] = {0}, most;
        size_t pixels = (size_t)counted->width * (size_t)counted->height;
        for (size_t i = 0; i < pixels; i++) {
            const float *work = counted->work + MNS_WORK_COUNT * i;
            for (int k = 0; k < MNS_WORK_COUNT; k++) sum[k] += (double)work[k];
            if (isfinite(counted->t[i])) /* a hit has passed a leaf, its balls, and been solved */
                assert_true(work[MNS_WORK_LEAVES] >= 1 && work[MNS_WORK_BALLS] >= 1 &&
                            work[MNS_WORK_ROUNDS] >= 1);
            assert_true(work[MNS_WORK_BALLS] == 0 || work[MNS_WORK_LEAVES] >= 1);
        }
        for (int k = 0; k < MNS_WORK_COUNT; k++)
            assert_true(fabs(sum[k] / (double)pixels - d->stats.work[k]) <= 1e-6 * sum[k]);
        if (mns_image_heat(counted, MNS_WORK_BALLS, MNS_COLOR_MAP_MAGMA, &heat, &most, &error))
            fail_msg("%s", error.text);
        assert_true(most >= 1 && heat->width == counted->width);
        size_t different = 0;
        for (size_t i = 1; i < pixels; i++) different += heat->rgba[4 * i] != heat->rgba[0];
        assert_true(different > 100);
        expect_read_back(counted);
        mns_image_destroy(heat);
        mns_image_destroy(plain);
        mns_image_destroy(counted);
    }
    mns_field_destroy(field);
    draw_fixture_check(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_methods_build_nothing_of_a_tree),
        cmocka_unit_test(a_tree_makes_nothing_of_the_lists),
        cmocka_unit_test(the_same_again_builds_and_sends_nothing),
        cmocka_unit_test(trees_built_ahead_give_the_same_pictures),
        cmocka_unit_test(the_next_frames_tree_is_built_while_this_one_is_drawn),
        cmocka_unit_test(a_host_is_drawn_on_by_trees_too),
        cmocka_unit_test(counts_are_made_where_they_are_asked_for),
    };
    return cmocka_run_group_tests_name("trees", tests, draw_fixture_setup, draw_fixture_teardown);
}
