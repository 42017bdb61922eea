/* What a plan makes of zeros, limits and mistakes. */
#include "support/scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void nothing_of_the_callers_is_kept(void **state)
{
    (void)state;
    char column[] = "heat";
    scene s = {"borrowed", .desc = {SCENE_UNIT}, .look = {.color_by = column}};
    mns_field *field = scene_field(&s);
    mns_plan *plan = scene_plan(&s, field);
    memset(column, 'x', 4);
    assert_null(plan->look.color_by);
    assert_string_equal(plan->color_by, "heat");
    assert_true(plan->color_range[0] == 3 && plan->color_range[1] == 5);
    mns_field_destroy(field); /* and the plan outlives the field */
    assert_non_null(strstr(mns_plan_text(plan), "balls 3,"));
    mns_plan_destroy(plan);
    mns_plan_destroy(NULL);
}

static void zeros_mean_the_defaults(void **state)
{
    (void)state;
    scene s = {"zeros", .desc = {SCENE_UNIT}};
    const mns_options listed = {.method = MNS_METHOD_LIST};
    mns_field *field = scene_field(&s);
    mns_plan *plan = scene_plan(&s, field), *bare = NULL;
    mns_limits none = {0};
    assert_int_equal(mns_plan_create(field, NULL, NULL, &listed, &none, &bare, NULL), MNS_OK);
    assert_string_equal(mns_plan_text(plan), mns_plan_text(bare));
    assert_true(bare->limits.max_storage_block == 1u << 24 && bare->limits.max_texture_size == 16384);
    assert_true(bare->limits.max_viewport[0] == 16384 && bare->limits.max_point_size == 1);
    assert_true(plan->limits.max_storage_block == 1u << 24 && plan->limits.max_texture_buffer == 65536);
    assert_true(plan->options.samples == 1 && plan->options.slots > 0 && plan->options.root_steps > 0);
    assert_int_equal(plan->options.method, MNS_METHOD_LIST);
    assert_true(plan->look.shininess > 0 && plan->look.cel_bands == 3 && plan->look.diffuse == 0.85);
    assert_true(plan->pool_most == (1u << 24) / LIST_NODE && plan->pool_nodes <= plan->pool_most);
    assert_true(plan->view.width == 1024 && plan->view.height == 768);
    mns_plan_destroy(plan);
    mns_plan_destroy(bare);
    mns_field_destroy(field);
}

/* Sizes: what a ball takes, and node pools that keep to the driver's blocks and to the caller's wish. */
static void sizes_keep_to_the_limits(void **state)
{
    (void)state;
    static const struct {
        scene s;
        size_t floats, pool_most;
    } cases[] = {
        {{"plain", .desc = {SCENE_UNIT}}, 3, 1u << 20},
        {{"radii", .desc = {SCENE_ROW, .radius = {.data = scene_sizes}}}, 4, 1u << 20},
        {{"both", .desc = {SCENE_ROW, .radius = {.data = scene_sizes}, .strength = {.data = scene_gains}}},
         5,
         1u << 20},
        {{"wish", .desc = {SCENE_UNIT}, .options = {.max_pool_nodes = 1000}}, 3, 1000},
        {{"a wish too large", .desc = {SCENE_UNIT}, .options = {.max_pool_nodes = 1u << 30}}, 3, 1u << 20},
        {{"large blocks", .desc = {SCENE_UNIT}, .limits = &scene_llvmpipe}, 3, 1u << 23},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_field *field = scene_field(&cases[i].s);
        mns_plan *plan = scene_plan(&cases[i].s, field);
        assert_int_equal(plan->ball_floats, cases[i].floats);
        assert_int_equal(plan->pool_most, cases[i].pool_most);
        assert_true(plan->pool_nodes >= 1 && plan->pool_nodes <= plan->pool_most);
        mns_plan_destroy(plan);
        mns_field_destroy(field);
    }
}

/* GPU coordinates start at the eye, or for a far eye at the nearest point of the box; rays then begin on a
 * plane at the box. */
static void the_origin_is_the_eye_or_the_nearest_point(void **state)
{
    (void)state;
    scene near_eye = {"near", .desc = {SCENE_UNIT}, SCENE_EYE(1, 2, 9)},
          far_eye = {"far", .desc = {SCENE_UNIT}, SCENE_EYE(1, 0.5, 101)};
    mns_field *field = scene_field(&near_eye);
    mns_plan *plan = scene_plan(&near_eye, field);
    assert_true(plan->origin[0] == 1 && plan->origin[1] == 2 && plan->origin[2] == 9 &&
                plan->plane_depth == 0);
    mns_plan_destroy(plan);
    plan = scene_plan(&far_eye, field);
    assert_true(plan->origin[0] == 1 && plan->origin[1] == 0.5 && plan->origin[2] == 1);
    assert_true(plan->plane_depth <= 100 && plan->plane_depth > 99.9999);
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

/* A core radius that all balls share, where all are alike. */
static void cores_are_one_ratio_or_one_a_ball(void **state)
{
    (void)state;
    scene alike = {"alike", .desc = {SCENE_UNIT, .iso = 0.125}};
    mns_field *field = scene_field(&alike);
    mns_plan *plan = scene_plan(&alike, field);
    assert_true(fabs(plan->core_ratio - sqrt(0.5)) < 1e-15); /* (1 - v^2)^3 = 1/8 */
    mns_plan_destroy(plan);
    mns_field_destroy(field);
}

static const double nine[27] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0,
                                0, 5, 0, 0, 6, 0, 0, 7, 0, 0, 8, 0, 0};
static const mns_limits tiny_blocks = {.max_storage_block = 8 * 12,
                                       .max_point_size = 255}; /* of 12 bytes a ball */
static const mns_limits small_frames = {.max_texture_size = 640, .max_viewport = {800, 480}};

static void errors_are_one_line(void **state)
{
    (void)state;
    static const struct {
        scene s;
        mns_status status;
        const char *says;
    } cases[] = {
        {{"method", .options = {.method = (mns_method)7}}, MNS_ERROR_USAGE, "method 7"},
        {{"solver", .options = {.solver = (mns_solver)4}}, MNS_ERROR_USAGE, "solver 4"},
        {{"gather", .options = {.gather = (mns_gather)2}}, MNS_ERROR_USAGE, "gather 2"},
        {{"samples", .options = {.samples = 65}}, MNS_ERROR_USAGE, "65 samples"},
        {{"samples", .options = {.samples = -1}}, MNS_ERROR_USAGE, "-1 samples"},
        {{"slots", .options = {.slots = 1025}}, MNS_ERROR_USAGE, "1025 slots"},
        {{"slots", .options = {.slots = -1}}, MNS_ERROR_USAGE, "-1 slots"},
        {{"steps", .options = {.root_steps = 4097}}, MNS_ERROR_USAGE, "4097 root steps"},
        {{"column", .look = {.color_by = "speed"}},
         MNS_ERROR_USAGE,
         "no column \"speed\" to colour by; the input has heat"},
        {{"range", .look = {.set = MNS_LOOK_RANGE, .color_by = "heat", .range = {0, NAN}}},
         MNS_ERROR_USAGE,
         "range"},
        {{"light", .look = {.light = (mns_light_kind)2}}, MNS_ERROR_USAGE, "light"},
        {{"way", .look = {.light_direction = {0, INFINITY, 0}}}, MNS_ERROR_USAGE, "direction"},
        {{"shading", .look = {.shading = (mns_shading)2}}, MNS_ERROR_USAGE, "shading 2"},
        {{"bands", .look = {.cel_bands = 65}}, MNS_ERROR_USAGE, "65 cel bands"},
        {{"map", .look = {.color_map = MNS_COLOR_MAP_COUNT}}, MNS_ERROR_USAGE, "colour map"},
        {{"ambient", .look = {.set = MNS_LOOK_AMBIENT, .ambient = -1}}, MNS_ERROR_USAGE, "ambient"},
        {{"color", .look = {.set = MNS_LOOK_COLOR, .color = {0, 2, 0}}}, MNS_ERROR_USAGE, "colours"},
        {{"eye", .view = {.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT}}, MNS_ERROR_USAGE, "eye"},
        {{"wide", .view = {.width = 641, .height = 10}, .limits = &small_frames},
         MNS_ERROR_UNSUPPORTED,
         "641x10"},
        {{"high", .view = {.width = 10, .height = 481}, .limits = &small_frames},
         MNS_ERROR_UNSUPPORTED,
         "640x480"},
        {{"huge", .view = {.width = 16385, .height = 1}}, MNS_ERROR_UNSUPPORTED, "16384x16384"},
        {{"balls", .desc = {.count = 9, .position = {.data = nine}}, .view = {.width = 64, .height = 48},
          .options = {.method = MNS_METHOD_LIST}, .limits = &tiny_blocks},
         MNS_ERROR_UNSUPPORTED,
         "9 balls: this driver's storage blocks hold 8"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene s = cases[i].s;
        if (!s.desc.count) s.desc = (mns_field_desc){SCENE_UNIT};
        mns_field *field = scene_field(&s);
        mns_plan *plan = (mns_plan *)&s;
        mns_error error = {0};
        mns_status status = mns_plan_create(field, &s.view, &s.look, &s.options, s.limits, &plan, &error);
        if (status != cases[i].status || error.status != status || !strstr(error.text, cases[i].says))
            fail_msg("%s: status %d, %s", s.name, status, error.text);
        assert_null(strchr(error.text, '\n'));
        assert_ptr_equal(plan, &s); /* left as it was */
        assert_int_equal(mns_plan_create(field, &s.view, &s.look, &s.options, s.limits, &plan, NULL), status);
        mns_field_destroy(field);
    }
    mns_plan *plan = NULL;
    mns_error error;
    assert_int_equal(mns_plan_create(NULL, NULL, NULL, NULL, NULL, &plan, &error), MNS_ERROR_USAGE);
}

static void the_largest_allowed_are_allowed(void **state)
{
    (void)state;
    scene frame = {"frame", .desc = {SCENE_UNIT}, .view = {.width = 640, .height = 480},
                   .limits = &small_frames};
    scene balls = {"balls", .desc = {.count = 8, .position = {.data = nine}},
                   .view = {.width = 64, .height = 48}, .limits = &tiny_blocks};
    const scene *all[] = {&frame, &balls};
    for (int i = 0; i < 2; i++) {
        mns_field *field = scene_field(all[i]);
        mns_plan_destroy(scene_plan(all[i], field));
        mns_field_destroy(field);
    }
}

/* A tile's head is a texel, too: 65,536 of them are 256 x 256 tiles, of 4 pixels a side at the least. */
static void texels_hold_the_heads_of_all_tiles(void **state)
{
    (void)state;
    static const int widths[] = {1024, 1025};
    for (int i = 0; i < 2; i++) {
        scene s = {"heads", .desc = {SCENE_UNIT}, .view = {.width = widths[i], .height = 1024},
                   .options = {.method = MNS_METHOD_TILE, .max_pool_nodes = 1000}};
        mns_field *field = scene_field(&s);
        mns_plan *plan = scene_plan(&s, field);
        assert_int_equal((plan->features & FEATURE_TEXELS) != 0, i == 0);
        mns_plan_destroy(plan);
        mns_field_destroy(field);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_of_the_callers_is_kept),
        cmocka_unit_test(zeros_mean_the_defaults),
        cmocka_unit_test(sizes_keep_to_the_limits),
        cmocka_unit_test(the_origin_is_the_eye_or_the_nearest_point),
        cmocka_unit_test(cores_are_one_ratio_or_one_a_ball),
        cmocka_unit_test(errors_are_one_line),
        cmocka_unit_test(the_largest_allowed_are_allowed),
        cmocka_unit_test(texels_hold_the_heads_of_all_tiles),
    };
    return cmocka_run_group_tests_name("plan_limits", tests, NULL, NULL);
}
