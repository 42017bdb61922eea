/* Fields that would make a builder recurse or copy without end: all end in a tree that is right and within
 * its bounds. */
#include "fbvh/fbvh.h"
#include "support/fbvh_check.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static double noise(size_t i, unsigned k) /* in [0, 1) */
{
    uint64_t z = (i * 8 + k + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

typedef struct balls {
    size_t count;
    double *at, *radius, *strength;
} balls;

static balls balls_make(size_t count)
{
    balls b = {count, calloc(3 * count, sizeof(double)), calloc(count, sizeof(double)),
               calloc(count, sizeof(double))};
    assert_true(b.at && b.radius && b.strength);
    for (size_t i = 0; i < count; i++) {
        for (unsigned a = 0; a < 3; a++) b.at[3 * i + a] = noise(i, a);
        b.radius[i] = b.strength[i] = 1;
    }
    return b;
}

static mns_field *field_of(balls *b, double iso)
{
    mns_field *field;
    mns_field_desc desc = {.count = b->count,
                           .position = {.data = b->at},
                           .radius = {.data = b->radius},
                           .strength = {.data = b->strength},
                           .iso = iso};
    assert_int_equal(mns_field_create(&desc, &field, NULL), MNS_OK);
    free(b->at);
    free(b->radius);
    free(b->strength);
    return field;
}

/* Both kinds, with the defaults and with every wish to split on. */
static void build_all(const mns_field *field, size_t points, bool surface)
{
    static const char *const texts[] = {
        "fbvh",
        "bvh",
        "fbvh,leaf-least=1,traversal-cost=0.001,references=40,middle-levels=48",
        "bvh,leaf-least=1,traversal-cost=0.001,references=40,middle-levels=48",
        "fbvh,no-fit,no-tight,no-discard,leaf-least=1,traversal-cost=0.001,references=9",
        "fbvh,references=1",
        "bvh,references=1"};
    fbvh_builder *builder;
    assert_int_equal(fbvh_builder_create(&builder, NULL), MNS_OK);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        fbvh_options options = {0};
        const fbvh_tree *tree;
        assert_int_equal(fbvh_options_parse(texts[i], &options, NULL), MNS_OK);
        assert_int_equal(fbvh_build(builder, field, &options, &tree, NULL), MNS_OK);
        if (!options.no_tight) assert_true((tree->node_count > 0) == surface);
        fbvh_check_shape(tree, &options);
        if (points) fbvh_check_field(tree, field, points, 3);
    }
    fbvh_builder_destroy(builder);
    mns_field_destroy((mns_field *)field);
}

static void no_balls_no_tree(void **state)
{
    (void)state;
    balls none = balls_make(0);
    build_all(field_of(&none, 0.2), 0, false);
}

static void a_lone_ball(void **state)
{
    (void)state;
    balls b = balls_make(1);
    build_all(field_of(&b, 0.2), 200, true);
}

static void balls_too_weak_have_no_tree(void **state)
{
    (void)state;
    balls b = balls_make(50);
    for (size_t i = 0; i < 50; i++) b.strength[i] = 1e-3;
    build_all(field_of(&b, 0.2), 0, false);
    b = balls_make(50);
    for (size_t i = 0; i < 50; i++) b.strength[i] = i % 2 ? -1 : 0;
    build_all(field_of(&b, 0.2), 0, false);
}

static void pairs_on_one_point(void **state)
{
    (void)state;
    balls b = balls_make(240);
    for (size_t i = 1; i < 240; i += 2) memcpy(b.at + 3 * i, b.at + 3 * i - 3, 3 * sizeof *b.at);
    for (size_t i = 0; i < 240; i++) b.radius[i] = 0.2;
    build_all(field_of(&b, 0.2), 150, true);
}

static void slab_without_thickness(void **state)
{
    (void)state;
    balls b = balls_make(300);
    for (size_t i = 0; i < 300; i++) b.at[3 * i + 2] = 0.25, b.radius[i] = 0.1;
    build_all(field_of(&b, 0.2), 100, true);
}

static void balls_in_a_row(void **state)
{
    (void)state;
    balls b = balls_make(300);
    for (size_t i = 0; i < 300; i++) b.at[3 * i] = b.at[3 * i + 2] = 7, b.radius[i] = 0.02;
    build_all(field_of(&b, 0.2), 100, true);
}

static void ten_thousand_on_one_point(void **state)
{
    (void)state;
    balls b = balls_make(10000);
    for (size_t i = 0; i < 10000; i++) b.at[3 * i] = b.at[3 * i + 1] = b.at[3 * i + 2] = -3;
    build_all(field_of(&b, 0.2), 5, true);
}

/* Sizes and distances that halve a hundred times: no even cut tells the small ones apart. */
static void balls_that_shrink_towards_a_point(void **state)
{
    (void)state;
    balls b = balls_make(110);
    for (size_t i = 0; i < 110; i++) {
        double size = pow(0.6, (double)i);
        for (unsigned a = 0; a < 3; a++) b.at[3 * i + a] = size * (1 + 0.1 * noise(i, a));
        b.radius[i] = fmax(0.5 * size, 1e-12);
    }
    build_all(field_of(&b, 0.2), 50, true);
}

/* Floats place these to a tenth of their radius at best: boxes and reach must allow for it. */
static void small_balls_far_apart(void **state)
{
    (void)state;
    balls b = balls_make(160);
    for (size_t i = 0; i < 160; i++) {
        for (unsigned a = 0; a < 3; a++)
            b.at[3 * i + a] = (i / 40 >> a & 1 ? 1e4 : -1e4) + 0.012 * noise(i, a) + 1e-5 * (double)(i % 7);
        b.radius[i] = 0.006;
    }
    build_all(field_of(&b, 0.2), 300, true);
}

/* The bound on the tight radius is met exactly where balls coincide. */
static void equal_balls_on_one_point_for_every_kernel(void **state)
{
    (void)state;
    for (int kernel = 1; kernel < MNS_KERNEL_COUNT; kernel++) {
        balls b = balls_make(3);
        for (size_t i = 0; i < 9; i++) b.at[i] = 0;
        mns_field *field = field_of(&b, 0.2);
        field->kernel = (mns_kernel)kernel;
        build_all(field, 600, true);
    }
}

static void giant_among_dwarfs(void **state)
{
    (void)state;
    balls b = balls_make(400);
    for (size_t i = 1; i < 400; i++) b.radius[i] = 0.03;
    b.radius[0] = 5;
    build_all(field_of(&b, 0.2), 100, true);
}

static void giant_among_a_million_dwarfs(void **state)
{
    (void)state;
    enum { MANY = 1000000 };
    balls b = balls_make(MANY);
    for (size_t i = 1; i < MANY; i++) b.radius[i] = 0.007;
    b.radius[0] = 2;
    mns_field *field = field_of(&b, 0.2);
    fbvh_builder *builder;
    assert_int_equal(fbvh_builder_create(&builder, NULL), MNS_OK);
    for (int kind = 0; kind < 2; kind++) {
        fbvh_options options = {.kind = (fbvh_kind)kind};
        const fbvh_tree *tree;
        assert_int_equal(fbvh_build(builder, field, &options, &tree, NULL), MNS_OK);
        fbvh_check_shape(tree, &options);
        assert_true(tree->figures.leaves > 1000);
        /* By Algorithm 1 the leaf that owns the giant holds all that it overlaps. */
        assert_true(kind == FBVH_OVERLAPPING || tree->figures.leaf_largest < 5000);
    }
    fbvh_builder_destroy(builder);
    mns_field_destroy(field);
}

/* A block that the wish for references or for nodes does not fit makes the tree smaller; one that the balls
 * do not fit is refused. */
static void small_blocks_make_small_trees(void **state)
{
    (void)state;
    mns_error error;
    const fbvh_tree *tree;
    fbvh_builder *builder;
    balls b = balls_make(2000);
    for (size_t i = 0; i < 2000; i++) b.radius[i] = 0.1;
    mns_field *field = field_of(&b, 0.2);
    assert_int_equal(fbvh_builder_create(&builder, NULL), MNS_OK);
    for (int kind = 0; kind < 2; kind++)
        for (size_t block = 32000; block < 2000000; block *= 2) {
            fbvh_options options = {.kind = (fbvh_kind)kind, .leaf_least = 1, .traversal_cost = 0.01};
            options.max_block_bytes = block;
            options.references_a_ball = 100;
            assert_int_equal(fbvh_build(builder, field, &options, &tree, &error), MNS_OK);
            fbvh_check_shape(tree, &options);
            assert_true(tree->figures.made_smaller == (block < 2000 * 100 * 16));
            fbvh_check_field(tree, field, 3, 5);
        }
    fbvh_options options = {.max_block_bytes = 31999};
    assert_int_equal(fbvh_build(builder, field, &options, &tree, &error), MNS_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.text, "2000 balls"));
    fbvh_builder_destroy(builder);
    mns_field_destroy(field);
}

static void lengths_beyond_floats_are_refused(void **state)
{
    (void)state;
    mns_error error;
    const fbvh_tree *tree;
    fbvh_builder *builder;
    assert_int_equal(fbvh_builder_create(&builder, NULL), MNS_OK);
    for (int i = 0; i < 2; i++) {
        balls b = balls_make(3);
        if (i)
            b.at[0] = 1e50;
        else
            b.radius[1] = 1e-50;
        mns_field *field = field_of(&b, 0.2);
        assert_int_equal(fbvh_build(builder, field, NULL, &tree, &error), MNS_ERROR_UNSUPPORTED);
        mns_field_destroy(field);
    }
    fbvh_builder_destroy(builder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_balls_no_tree),
        cmocka_unit_test(a_lone_ball),
        cmocka_unit_test(balls_too_weak_have_no_tree),
        cmocka_unit_test(pairs_on_one_point),
        cmocka_unit_test(slab_without_thickness),
        cmocka_unit_test(balls_in_a_row),
        cmocka_unit_test(ten_thousand_on_one_point),
        cmocka_unit_test(balls_that_shrink_towards_a_point),
        cmocka_unit_test(small_balls_far_apart),
        cmocka_unit_test(equal_balls_on_one_point_for_every_kernel),
        cmocka_unit_test(giant_among_dwarfs),
        cmocka_unit_test(giant_among_a_million_dwarfs),
        cmocka_unit_test(small_blocks_make_small_trees),
        cmocka_unit_test(lengths_beyond_floats_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
