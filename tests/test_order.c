/* Which balls are drawn and in what order: nothing that a ray can meet is dropped, nearest effective spheres
 * come first, and the number of threads changes nothing. */
#include "list/order.h"
#include "support/scenes.h"

#include <omp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint64_t random_next(uint64_t *state) /* splitmix64 */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

typedef struct entry {
    uint64_t key;
    size_t place;
} entry;

static int by_upper_half(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    uint64_t p = x->key >> 32, q = y->key >> 32;
    if (p != q) return p < q ? -1 : 1;
    return (x->place > y->place) - (x->place < y->place);
}

/* mask: which bits of the upper half vary; few make many ties. The lower half is noise that must not count.
 */
static void expect_sorted(size_t count, uint32_t mask)
{
    uint64_t seed = count + mask;
    uint64_t *given = calloc(count + 1, sizeof *given), *key = calloc(count + 1, sizeof *key);
    uint64_t *scratch = calloc(count + 1, sizeof *scratch);
    uint32_t *digits = calloc(RADIX_THREADS * RADIX_DIGITS, sizeof *digits);
    entry *want = calloc(count + 1, sizeof *want);
    assert_true(given && key && scratch && digits && want);
    for (size_t i = 0; i < count; i++) {
        given[i] = random_next(&seed) & ((uint64_t)mask << 32 | 0xffffffffu);
        want[i] = (entry){given[i], i};
    }
    qsort(want, count, sizeof *want, by_upper_half);
    for (int threads = 1; threads <= 4; threads++) {
        omp_set_num_threads(threads);
        memcpy(key, given, count * sizeof *key);
        key[count] = 77;
        list_radix_sort(key, scratch, digits, count);
        for (size_t i = 0; i < count; i++) assert_true(key[i] == want[i].key);
        assert_true(key[count] == 77);
    }
    free(given);
    free(key);
    free(scratch);
    free(digits);
    free(want);
}

static void radix_sorts_as_a_stable_comparison_sort(void **state)
{
    (void)state;
    static const size_t sizes[] = {0, 1, 2, 3, 255, 2048, 8191, ORDER_ALONE, ORDER_ALONE + 1, 50011};
    static const uint32_t masks[] = {0xffffffffu, 0, 0x80000000u, 0x00400801u, 0xffc00000u, 0x7ffu};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
        for (size_t m = 0; m < sizeof masks / sizeof *masks; m++) expect_sorted(sizes[s], masks[m]);
}

enum { WIDE = 48, HIGH = 36 };

#define AT(x, y, z, u, v, w)                                                                                 \
    .set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT, .eye = {x, y, z}, .look_at = {u, v, w}, .width = WIDE,           \
    .height = HIGH

/* From before the field, beside it, within it, from far away, and through wide and narrow lenses. */
static const mns_view views[] = {
    {.width = WIDE, .height = HIGH},
    {.width = WIDE, .height = HIGH, .fov = 150},
    {AT(2, 1, 3, 0.5, 0.5, 0.5), .fov = 20},
    {AT(0.5, 0.5, 0.5, 1, 0.7, 0.2), .fov = 60},
    {AT(0.1, 0.4, 0.5, 0.9, 0.5, 0.4), .fov = 150},
    {AT(400, 300, 200, 0.5, 0.5, 0.5), .fov = 0.1},
    {AT(0.5, 0.5, 1.2, 0.5, 0.5, 2), .fov = 100},
    {AT(0.5, 0.5, 2, 0.2, 0.5, 0.5), .fov = 5, .up = {1, 1, 0}},
};
enum { VIEWS = sizeof views / sizeof *views };
static const char *const fields[] = {"mixed:1500", "scattered:6000"};

static scene scene_of(const char *generator, const mns_view *view)
{
    return (scene){.name = generator, .generator = generator, .view = *view, .limits = &scene_llvmpipe};
}

static list_order order_of(const mns_field *field, const mns_plan *plan)
{
    list_order order = {0};
    mns_error error;
    if (list_order_make(&order, field, plan, SIZE_MAX, &error)) fail_msg("%s", error.text);
    return order;
}

static vec3 centre_of(const mns_field *field, size_t i)
{
    return vec3_make(field->p.axis[0][i], field->p.axis[1][i], field->p.axis[2][i]);
}

static size_t index_at(const list_order *order, size_t place)
{
    return order->ball[(uint32_t)order->key[place]].index;
}

/* Whether a ray through the frame meets the ball at t > 0: tried at each pixel's centre and at the corners
 * that samples reach. */
static bool is_seen(const view_frame *frame, vec3 centre, double radius)
{
    vec3 d = vec3_sub(centre, frame->eye);
    double square = vec3_dot(d, d) - radius * radius;
    if (square <= 0) return true; /* the eye is in it */
    for (int y = 0; y <= 2 * HIGH; y++)
        for (int x = 0; x <= 2 * WIDE; x++) {
            double along = vec3_dot(d, view_direction(frame, 0.5 * x, 0.5 * y));
            if (along > 0 && along * along >= square) return true;
        }
    return false;
}

static void nothing_that_a_ray_meets_is_culled(void **state)
{
    (void)state;
    size_t dropped = 0;
    for (int v = 0; v < VIEWS; v++) {
        scene s = scene_of("mixed:1500", &views[v]);
        mns_field *field = scene_field(&s);
        mns_plan *plan = scene_plan(&s, field);
        list_order order = order_of(field, plan);
        bool *kept = calloc(field->p.count, sizeof *kept);
        assert_non_null(kept);
        for (size_t i = 0; i < order.count; i++) kept[index_at(&order, i)] = true;
        for (size_t i = 0; i < field->p.count; i++) {
            if (kept[i]) continue;
            dropped++;
            if (is_seen(&plan->frame, centre_of(field, i), field_radius(field, i)))
                fail_msg("view %d: ball %zu is seen, and was culled", v, i);
        }
        free(kept);
        list_order_free(&order);
        mns_plan_destroy(plan);
        mns_field_destroy(field);
    }
    assert_true(dropped > 1000); /* and much was culled */
}

/* Keys are floats: two effective distances within a float's step may stand as the index has them. */
static void the_nearest_come_first(void **state)
{
    (void)state;
    for (int f = 0; f < 2; f++)
        for (int v = 0; v < VIEWS; v++) {
            scene s = scene_of(fields[f], &views[v]);
            mns_field *field = scene_field(&s);
            mns_plan *plan = scene_plan(&s, field);
            list_order order = order_of(field, plan);
            double last = -INFINITY;
            size_t last_index = 0;
            for (size_t i = 0; i < order.count; i++) {
                size_t index = index_at(&order, i);
                double away =
                    vec3_length(vec3_sub(centre_of(field, index), plan->frame.eye)) - plan->plane_depth;
                double distance = away - field_radius(field, index),
                       step = fmax(fabs(distance), fabs(last)) * 0x1p-23;
                assert_true(i == 0 || distance >= last - step);
                if (i > 0 && order.key[i] >> 32 == order.key[i - 1] >> 32) assert_true(index > last_index);
                last = distance;
                last_index = index;
            }
            assert_true(order.count <= field->p.count);
            list_order_free(&order);
            mns_plan_destroy(plan);
            mns_field_destroy(field);
        }
}

static void equal_distances_keep_the_fields_order(void **state)
{
    (void)state;
    enum { COUNT = 3 * 15000 };
    double *position = calloc(3 * COUNT, sizeof *position);
    assert_non_null(position);
    for (size_t i = 0; i < COUNT; i++) position[3 * i] = (double)(i % 3); /* three heaps */
    scene s = {"heaps", .desc = {.count = COUNT, .position = {.data = position}, .uniform_radius = 1},
               SCENE_EYE(-5, 0, 40)};
    mns_field *field = scene_field(&s);
    mns_plan *plan = scene_plan(&s, field);
    list_order order = order_of(field, plan);
    assert_int_equal(order.count, COUNT);
    for (size_t i = 0; i < COUNT; i++)
        assert_int_equal(index_at(&order, i), 3 * (i % (COUNT / 3)) + i / (COUNT / 3));
    list_order_free(&order);
    mns_plan_destroy(plan);
    mns_field_destroy(field);
    free(position);
}

static void any_number_of_threads_gives_the_same(void **state)
{
    (void)state;
    scene s = scene_of("scattered:60000", &views[0]);
    mns_field *field = scene_field(&s);
    mns_plan *plan = scene_plan(&s, field);
    omp_set_num_threads(1);
    list_order one = order_of(field, plan);
    assert_true(one.count > ORDER_ALONE);
    for (int threads = 2; threads <= 4; threads++) {
        omp_set_num_threads(threads);
        list_order many = order_of(field, plan);
        assert_true(many.count == one.count && many.quads == one.quads);
        assert_memory_equal(one.key, many.key, one.count * sizeof *one.key);
        assert_memory_equal(one.ball, many.ball, one.count * sizeof *one.ball);
        list_order_free(&many);
    }
    list_order_free(&one);
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

/* The nearest in order; behind them the rest, in the order of the field; and once that is sorted, all. */
static void a_part_is_the_nearest(void **state)
{
    (void)state;
    scene s = scene_of("scattered:60000", &views[0]);
    mns_field *field = scene_field(&s);
    mns_plan *plan = scene_plan(&s, field);
    list_order all = order_of(field, plan), part = {0};
    static const size_t near[] = {1, 7000, 59000};
    for (size_t k = 0; k < 3; k++) {
        size_t sorted = 0;
        for (int threads = 1; threads <= 4; threads++) {
            omp_set_num_threads(threads);
            assert_int_equal(list_order_make(&part, field, plan, near[k], NULL), MNS_OK);
            assert_true(part.count == all.count && part.in_view == all.count && part.size == all.size);
            assert_true(part.sorted >= near[k] && part.sorted <= near[k] + 600);
            assert_true(threads == 1 || part.sorted == sorted);
            sorted = part.sorted;
            assert_memory_equal(part.key, all.key, sorted * sizeof *all.key);
            for (size_t i = sorted + 1; i < part.count; i++)
                assert_true((uint32_t)part.key[i - 1] < (uint32_t)part.key[i]);
            list_order_finish(&part);
            assert_int_equal(part.sorted, all.count);
            assert_memory_equal(part.key, all.key, all.count * sizeof *all.key);
        }
    }
    list_order_free(&part);
    list_order_free(&all);
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

/* A point's side in pixels: the widest the ball's image can be, between the tangents from the eye. */
static double image_size(const view_frame *frame, vec3 centre, double radius)
{
    vec3 d = vec3_sub(centre, frame->eye);
    double z = vec3_dot(d, frame->forward), square = (z - radius) * (z + radius), widest = 0;
    if (z <= radius) return INFINITY;
    const vec3 axis[] = {frame->right, frame->up};
    for (int k = 0; k < 2; k++) {
        double x = vec3_dot(d, axis[k]);
        widest = fmax(widest, 2 * radius * sqrt(x * x + square) / square);
    }
    return widest * frame->height / (2 * frame->tan_half);
}

static void points_hold_the_balls_drawn_as_such(void **state)
{
    (void)state;
    size_t points = 0;
    for (int f = 0; f < 2; f++)
        for (int v = 0; v < VIEWS; v++)
            for (int size = 1; size <= 64; size *= 2) {
                scene s = scene_of(fields[f], &views[v]);
                s.view.width *= size;
                s.view.height *= size;
                mns_field *field = scene_field(&s);
                mns_plan *plan = scene_plan(&s, field);
                list_order order = order_of(field, plan);
                for (size_t i = order.quads; i < order.count; i++) {
                    size_t index = index_at(&order, i);
                    double pixels =
                        image_size(&plan->frame, centre_of(field, index), field_radius(field, index));
                    assert_true(pixels <= scene_llvmpipe.max_point_size - 1);
                    points++;
                }
                if (order.quads && !(plan->features & FEATURE_QUADS))
                    fail_msg("%s, view %d, %dx%d: %zu rectangles, which the plan left out", s.name, v,
                             s.view.width, s.view.height, order.quads);
                list_order_free(&order);
                mns_plan_destroy(plan);
                mns_field_destroy(field);
            }
    assert_true(points > 10000);
}

static void without_points_all_are_rectangles(void **state)
{
    (void)state;
    scene s = {"least", .generator = "mixed:1500", .view = views[2]};
    mns_field *field = scene_field(&s);
    mns_plan *plan = scene_plan(&s, field);
    list_order order = order_of(field, plan);
    assert_true(order.count > 0 && order.quads == order.count);
    list_order_free(&order);
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

/* One order is used frame after frame: it grows, and what it holds is always the last field's. */
static void an_order_can_be_made_again(void **state)
{
    (void)state;
    static const char *const names[] = {"scattered:100", "scattered:6000", "scattered:10"};
    list_order order = {0};
    for (int i = 0; i < 3; i++) {
        scene s = scene_of(names[i], &views[0]);
        mns_field *field = scene_field(&s);
        mns_plan *plan = scene_plan(&s, field);
        assert_int_equal(list_order_make(&order, field, plan, SIZE_MAX, NULL), MNS_OK);
        assert_int_equal(order.count, field->p.count); /* the default view shows all */
        for (size_t k = 0; k < order.count; k++) {
            vec3 from = vec3_sub(centre_of(field, k), vec3_load(plan->origin));
            const list_ball want = {{(float)from.x, (float)from.y, (float)from.z}, (uint32_t)k};
            assert_memory_equal(&order.ball[k], &want, sizeof want);
        }
        mns_plan_destroy(plan);
        mns_field_destroy(field);
    }
    list_order_free(&order);
    list_order_free(&order);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(radix_sorts_as_a_stable_comparison_sort),
        cmocka_unit_test(nothing_that_a_ray_meets_is_culled),
        cmocka_unit_test(the_nearest_come_first),
        cmocka_unit_test(equal_distances_keep_the_fields_order),
        cmocka_unit_test(any_number_of_threads_gives_the_same),
        cmocka_unit_test(a_part_is_the_nearest),
        cmocka_unit_test(points_hold_the_balls_drawn_as_such),
        cmocka_unit_test(without_points_all_are_rectangles),
        cmocka_unit_test(an_order_can_be_made_again),
    };
    return cmocka_run_group_tests_name("order", tests, NULL, NULL);
}
