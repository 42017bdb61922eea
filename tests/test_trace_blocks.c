/* The blocks of pixels that a tree is walked for, by brute force: whatever leaf's box the ray of a pixel, or
 * of a sample at its corner, meets, the pixel's block is listed. */
#include "support/draw_fixture.h"
#include "trace/blocks.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct blocks_case {
    const char *generator;
    double eye[3], look_at[3], fov;
    int width, height;
    list_region region;  /* empty: the frame */
    bool all, few, none; /* every block is listed, at most half of them are, no ray meets a box */
} blocks_case;

#define MIDDLE .look_at = {0.5, 0.5, 0.5}

static const blocks_case cases[] = {
    {"scattered:300", .eye = {0.5, 0.8, 3.4}, MIDDLE, .fov = 60, 150, 101, .few = true},
    {"scattered:20000", .eye = {0.5, 0.8, 3.4}, MIDDLE, .fov = 60, 96, 70, .few = true},
    {"scattered:300", .eye = {0.5, 0.8, 2.4}, MIDDLE, .fov = 40, 90, 61, .region = {13, 21, 50, 37}},
    {"scattered:300", .eye = {0.5, 0.5, 0.5}, .look_at = {0, 0.4, 0}, .fov = 90, 96, 72, .all = true},
    {"scattered:300", .eye = {4800, 6000, 6400}, MIDDLE, .fov = 0.02, 96, 72},
    {"scattered:1", .eye = {0.5, 0.8, 9}, MIDDLE, .fov = 40, 90, 61},
    {"scattered:300", .eye = {0.5, 0.5, 3}, .look_at = {0.5, 0.5, 9}, .fov = 60, 96, 72, .few = true,
     .none = true},
    {"scattered:300", .eye = {0.5, 0.8, 2.4}, MIDDLE, .fov = 40, 1, 1},
    {"tornado:2000", .eye = {3, 1, 9}, .look_at = {0, 2, 0}, .fov = 50, 96, 72},
};

/* Where the ray through a point of the frame is between two planes of an axis. */
static bool meets(const fbvh_node *node, vec3 eye, vec3 way)
{
    const double from[3] = {eye.x, eye.y, eye.z}, along[3] = {way.x, way.y, way.z};
    double enter = 0, leave = INFINITY;
    for (int a = 0; a < 3; a++) {
        double lo = (double)node->lo[a] - from[a], hi = (double)node->hi[a] - from[a];
        if (along[a] == 0) {
            if (lo > 0 || hi < 0) return false;
            continue;
        }
        double near = (along[a] > 0 ? lo : hi) / along[a], far = (along[a] > 0 ? hi : lo) / along[a];
        enter = fmax(enter, near);
        leave = fmin(leave, far);
    }
    return enter <= leave;
}

static bool meets_any(const fbvh_tree *tree, vec3 eye, vec3 way)
{
    for (size_t i = 0; i < tree->node_count; i++)
        if (i != 1 && tree->node[i].count && meets(&tree->node[i], eye, way)) return true;
    return false;
}

/* Every third pixel of the region, at its centre and at corners. */
static size_t expect_listed(const blocks_case *c, const fbvh_tree *tree, const mns_plan *plan,
                            list_region region, const trace_blocks *blocks)
{
    static const double places[][2] = {{0.5, 0.5}, {0, 0}, {1, 0}, {0, 1}, {1, 1}};
    vec3 eye = vec3_sub(plan->frame.eye, vec3_load(tree->origin));
    int across = (region.width + 7) / 8;
    size_t met = 0;
    for (int y = 0; y < region.height; y += 3)
        for (int x = 0; x < region.width; x += 3)
            for (size_t k = 0; k < sizeof places / sizeof *places; k++) {
                double px = region.x + x + places[k][0], py = c->height - (region.y + y + places[k][1]);
                if (!meets_any(tree, eye, view_direction(&plan->frame, px, py))) continue;
                met++;
                if (!blocks->touched[(size_t)(y / 8) * (size_t)across + (size_t)(x / 8)])
                    fail_msg("%s: pixel %d,%d", c->generator, x, y);
            }
    return met;
}

/* The list is what was touched, row by row. */
static void expect_list(const trace_blocks *blocks, list_region region)
{
    uint32_t at = 1;
    int across = (region.width + 7) / 8, down = (region.height + 7) / 8;
    for (int y = 0; y < down; y++)
        for (int x = 0; x < across; x++)
            if (blocks->touched[(size_t)y * (size_t)across + (size_t)x])
                assert_int_equal(blocks->list[at++], (uint32_t)x | (uint32_t)y << 16);
    assert_int_equal(blocks->list[0], at - 1);
}

static void expect_case(const blocks_case *c, fbvh_kind kind, trace_blocks *blocks)
{
    static const mns_limits limits = {
        .max_storage_block = 1u << 27, .max_texture_size = 16384, .max_viewport = {16384, 16384}};
    mns_view view = draw_view(c->eye, c->look_at, c->fov, c->width, c->height);
    mns_options options = {.method = kind == FBVH_FITTED ? MNS_METHOD_FBVH : MNS_METHOD_BVH};
    mns_field *field = draw_generated(c->generator, MNS_KERNEL_POLY3);
    fbvh_builder *builder;
    const fbvh_tree *tree;
    mns_plan *plan;
    mns_error error;
    if (mns_plan_create(field, &view, NULL, &options, &limits, &plan, &error)) fail_msg("%s", error.text);
    assert_false(fbvh_builder_create(&builder, &error));
    if (fbvh_build(builder, field, &plan->tree, &tree, &error)) fail_msg("%s", error.text);
    list_region region = c->region.width ? c->region : (list_region){0, 0, c->width, c->height};
    assert_false(trace_blocks_take(blocks, tree, &error));
    assert_false(trace_blocks_list(blocks, plan, region, &error));
    size_t met = expect_listed(c, tree, plan, region, blocks);
    size_t count = blocks->list[0],
           most = (size_t)((region.width + 7) / 8) * (size_t)((region.height + 7) / 8);
    expect_list(blocks, region);
    assert_true(c->none ? met == 0 : met > 0 && count > 0);
    if (c->all) assert_int_equal(count, most);
    if (c->few && count > most / 2) fail_msg("%s: %zu of %zu blocks", c->generator, count, most);
    fbvh_builder_destroy(builder);
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

static void rays_that_meet_a_box_are_listed(void **state)
{
    (void)state;
    trace_blocks blocks = {0}; /* from case to case, as from frame to frame */
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int kind = FBVH_FITTED; kind <= FBVH_OVERLAPPING; kind++)
            expect_case(&cases[i], (fbvh_kind)kind, &blocks);
    trace_blocks_free(&blocks);
}

/* A ray's work is a figure of those that miss, too. */
static void a_frame_that_is_counted_is_traced_whole(void **state)
{
    (void)state;
    trace_blocks blocks = {0};
    mns_plan plan = {.features = FEATURE_TREE | FEATURE_COUNTERS,
                     .frame = {.width = 33, .height = 17, .tan_half = 1}};
    fbvh_tree none = {.node_count = 0};
    mns_error error;
    assert_false(trace_blocks_take(&blocks, &none, &error));
    assert_false(trace_blocks_list(&blocks, &plan, (list_region){0, 0, 33, 17}, &error));
    assert_int_equal(blocks.list[0], 5 * 3);
    plan.features = FEATURE_TREE;
    assert_false(trace_blocks_list(&blocks, &plan, (list_region){0, 0, 33, 17}, &error));
    assert_int_equal(blocks.list[0], 0);
    trace_blocks_free(&blocks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_that_meet_a_box_are_listed),
        cmocka_unit_test(a_frame_that_is_counted_is_traced_whole),
    };
    return cmocka_run_group_tests_name("trace blocks", tests, NULL, NULL);
}
