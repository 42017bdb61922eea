/* Both trees of every generator and of fields with carving balls, for all switches, against all balls one by
 * one. */
#include "fbvh/fbvh.h"
#include "support/fbvh_check.h"

#include <omp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *const generators[] = {"scattered:150", "dense:200",   "mixed:150", "sheet:150",
                                         "molecule:120",  "tornado:200", "pool:200",  "drop:200"};
enum { GENERATORS = sizeof generators / sizeof *generators };

static mns_field *generated(const char *name, mns_kernel kernel)
{
    mns_input *input;
    mns_field *field;
    mns_input_options options = {.kernel = kernel};
    assert_int_equal(mns_input_open(&name, 1, &options, &input, NULL), MNS_OK);
    assert_int_equal(mns_input_read(input, 0, &field, NULL), MNS_OK);
    mns_input_close(input);
    return field;
}

/* The balls of a generator, a third of which carve, some of which are nothing; from a far corner of space. */
static mns_field *carved(const char *name)
{
    mns_field *whole = generated(name, MNS_KERNEL_DEFAULT), *field;
    size_t n = whole->p.count;
    double *at = calloc(3 * n, sizeof *at), *radius = calloc(n, sizeof *radius), *q = calloc(n, sizeof *q);
    assert_true(at && radius && q);
    for (size_t i = 0; i < n; i++) {
        for (int a = 0; a < 3; a++) at[3 * i + (size_t)a] = whole->p.axis[a][i] + 3e3;
        radius[i] = field_radius(whole, i) * (0.6 + 0.1 * (double)(i % 7));
        q[i] = i % 11 == 5 ? 0 : i % 3 ? 0.15 * (double)(1 + i % 9) : -0.4;
    }
    mns_field_desc desc = {.count = n,
                           .position = {.data = at},
                           .radius = {.data = radius},
                           .strength = {.data = q},
                           .iso = 0.3};
    assert_int_equal(mns_field_create(&desc, &field, NULL), MNS_OK);
    free(at);
    free(radius);
    free(q);
    mns_field_destroy(whole);
    return field;
}

static void check_tree(fbvh_builder *builder, const mns_field *field, const char *text, size_t points)
{
    fbvh_options options = {0};
    const fbvh_tree *tree;
    assert_int_equal(fbvh_options_parse(text, &options, NULL), MNS_OK);
    assert_int_equal(fbvh_build(builder, field, &options, &tree, NULL), MNS_OK);
    assert_true(tree->node_count > 0);
    fbvh_check_shape(tree, &options);
    if (options.no_discard) fbvh_check_references(tree, field);
    fbvh_check_field(tree, field, points, 7);
}

static void check_all_switches(const mns_field *field, size_t points)
{
    static const char *const sizes[] = {"", ",leaf-least=1,traversal-cost=0.01,references=100",
                                        ",references=2", ",middle-levels=3,discard-most=40"};
    fbvh_builder *builder;
    assert_int_equal(fbvh_builder_create(&builder, NULL), MNS_OK);
    for (unsigned mask = 0; mask < 32; mask++) {
        if (mask & 1 && mask & 4) continue; /* the overlapping tree knows no fitting */
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            char text[200];
            snprintf(text, sizeof text, "%s%s%s%s%s%s", mask & 1 ? "bvh" : "fbvh", mask & 2 ? ",cost-n" : "",
                     mask & 4 ? ",no-fit" : "", mask & 8 ? ",no-tight" : "", mask & 16 ? ",no-discard" : "",
                     sizes[i]);
            check_tree(builder, field, text, points);
        }
    }
    fbvh_builder_destroy(builder);
}

static void every_generator_every_switch(void **state)
{
    (void)state;
    for (int i = 0; i < GENERATORS; i++) {
        mns_field *field = generated(generators[i], MNS_KERNEL_DEFAULT);
        check_all_switches(field, 40);
        mns_field_destroy(field);
    }
}

static void carving_balls_every_switch(void **state)
{
    (void)state;
    for (int i = 0; i < GENERATORS; i += 2) {
        mns_field *field = carved(generators[i]);
        check_all_switches(field, 40);
        mns_field_destroy(field);
    }
}

static void every_kernel(void **state)
{
    (void)state;
    fbvh_builder *builder;
    assert_int_equal(fbvh_builder_create(&builder, NULL), MNS_OK);
    for (int kernel = 1; kernel < MNS_KERNEL_COUNT; kernel++) {
        mns_field *field = generated("mixed:300", (mns_kernel)kernel);
        check_tree(builder, field, "fbvh,leaf-least=1,references=50", 300);
        check_tree(builder, field, "bvh,leaf-least=1,references=50", 300);
        mns_field_destroy(field);
    }
    fbvh_builder_destroy(builder);
}

/* Large enough for the crown and its jobs; too large for brute force, but not for the shape. */
static void many_balls_keep_shape_for_any_threads(void **state)
{
    (void)state;
    fbvh_builder *builder;
    omp_set_num_threads(4);
    assert_int_equal(fbvh_builder_create(&builder, NULL), MNS_OK);
    mns_field *field = generated("tornado:20000", MNS_KERNEL_DEFAULT);
    for (int kind = 0; kind < 2; kind++) {
        fbvh_options options = {.kind = (fbvh_kind)kind};
        const fbvh_tree *one, *four;
        omp_set_num_threads(1);
        assert_int_equal(fbvh_build(builder, field, &options, &one, NULL), MNS_OK);
        omp_set_num_threads(4);
        assert_int_equal(fbvh_build(builder, field, &options, &four, NULL), MNS_OK);
        fbvh_check_shape(one, &options);
        assert_int_equal(one->node_count, four->node_count);
        assert_int_equal(one->reference_count, four->reference_count);
        assert_memory_equal(one->node, four->node, one->node_count * sizeof *one->node);
        assert_memory_equal(one->reference, four->reference, one->reference_count * sizeof *one->reference);
    }
    mns_field_destroy(field);
    fbvh_builder_destroy(builder);
}

/* Two trees live at once, and frames of the same size need no new memory (of several threads each may in time
 * come to need what one alone does). */
static void the_tree_before_stays_and_memory_does_not_grow(void **state)
{
    (void)state;
    fbvh_builder *builder;
    omp_set_num_threads(1);
    assert_int_equal(fbvh_builder_create(&builder, NULL), MNS_OK);
    mns_field *field = generated("pool:3000", MNS_KERNEL_DEFAULT),
              *other = generated("dense:3000", MNS_KERNEL_DEFAULT);
    const fbvh_tree *first, *second, *third;
    assert_int_equal(fbvh_build(builder, field, NULL, &first, NULL), MNS_OK);
    size_t bytes = first->node_count * sizeof *first->node;
    fbvh_node *copy = malloc(bytes);
    assert_non_null(copy);
    memcpy(copy, first->node, bytes);
    assert_int_equal(fbvh_build(builder, other, NULL, &second, NULL), MNS_OK);
    assert_memory_equal(copy, first->node, bytes);
    fbvh_options wrong = {.references_a_ball = 0.5};
    assert_int_equal(fbvh_build(builder, other, &wrong, &third, NULL), MNS_ERROR_USAGE);
    fbvh_check_shape(second, &(fbvh_options){0});
    assert_int_equal(fbvh_build(builder, field, NULL, &third, NULL), MNS_OK);
    assert_memory_equal(copy, third->node, bytes);
    size_t scratch = third->figures.scratch_bytes;
    for (int frame = 0; frame < 4; frame++)
        assert_int_equal(fbvh_build(builder, field, NULL, &third, NULL), MNS_OK);
    assert_int_equal(third->figures.scratch_bytes, scratch);
    free(copy);
    mns_field_destroy(field);
    mns_field_destroy(other);
    fbvh_builder_destroy(builder);
}

static void options_by_name(void **state)
{
    (void)state;
    fbvh_options o = {0};
    mns_error error;
    assert_int_equal(fbvh_options_parse(NULL, &o, &error), MNS_OK);
    assert_int_equal(fbvh_options_parse("", &o, &error), MNS_OK);
    assert_int_equal(
        fbvh_options_parse("bvh,cost-n,no-fit,no-tight,no-discard,discard-most=5,leaf-least=9,"
                           "traversal-cost=2.5,middle-levels=-1,references=3.25,block-bytes=4096",
                           &o, &error),
        MNS_OK);
    assert_true(o.kind == FBVH_OVERLAPPING && o.cost == FBVH_COST_LINEAR && o.no_fit && o.no_tight &&
                o.no_discard);
    assert_true(o.discard_most == 5 && o.leaf_least == 9 && o.middle_levels == -1 &&
                o.max_block_bytes == 4096);
    assert_true(o.traversal_cost == 2.5 && o.references_a_ball == 3.25);
    assert_int_equal(fbvh_options_parse("fbvh,cost-n2", &o, &error), MNS_OK);
    assert_true(o.kind == FBVH_FITTED && o.cost == FBVH_COST_SQUARE);
    static const char *const wrong[] = {"kd",
                                        "leaf-least",
                                        "leaf-least=",
                                        "leaf-least=1.5",
                                        "no-fit=1",
                                        "references=-1",
                                        "references=1e3",
                                        "leaf-least=99999999999",
                                        "bvh,,no-fit",
                                        "middle-levels=-2",
                                        "=3",
                                        "traversal-cost=."};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        fbvh_options before = o;
        assert_int_equal(fbvh_options_parse(wrong[i], &o, &error), MNS_ERROR_USAGE);
        assert_memory_equal(&before, &o, sizeof o);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_generator_every_switch),
        cmocka_unit_test(carving_balls_every_switch),
        cmocka_unit_test(every_kernel),
        cmocka_unit_test(many_balls_keep_shape_for_any_threads),
        cmocka_unit_test(the_tree_before_stays_and_memory_does_not_grow),
        cmocka_unit_test(options_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
