/* The tiles' lists by brute force: whatever ball a pixel's ray meets before it enters some ball's core stands
 * in its tile's list, in order and once. Rays, chords and cores are taken from their definitions, in doubles,
 * over all balls. */
#include "field/kernel.h"
#include "list/uniforms.h"
#include "support/draw_fixture.h"
#include "tile/tile.h"

#include <math.h>
#include <omp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ---- Scenes ---- */

typedef struct tile_case {
    const char *name;
    const char *generator; /* or NULL: a cloud in the unit cube */
    size_t count;
    double radius_low, radius_high;     /* log-uniform; equal: one for all */
    double strength_low, strength_high; /* uniform; both 0: 1 */
    double eye[3], look_at[3];
    double fov;
    int width, height, samples;
    list_region region; /* empty: the whole frame */
    double most;        /* entries over those needed, at most; 0: not asked */
} tile_case;

#define FRONT .eye = {0.5, 0.8, 2.4}, .look_at = {0.5, 0.5, 0.5}, .fov = 40

static const tile_case cases[] = {
    {"near", NULL, 400, 0.11, 0.11, 0, 0, FRONT, 96, 72, 1, .most = 1.5},
    {"not a multiple of a tile", NULL, 400, 0.11, 0.11, 0, 0, FRONT, 83, 61, 1, .most = 1.5},
    {"small balls", NULL, 3000, 0.02, 0.02, 0, 0, FRONT, 101, 67, 1, .most = 1.8},
    {"large tiles", NULL, 12, 0.5, 0.5, 0, 0, FRONT, 320, 240, 1, .most = 1.5},
    {"larger tiles", NULL, 3, 0.9, 0.9, 0, 0, .eye = {0.5, 0.5, 3}, .look_at = {0.5, 0.5, 0.5}, .fov = 30,
     450, 300, 1, .most = 1.5},
    {"one pixel", NULL, 400, 0.11, 0.11, 0, 0, FRONT, 1, 1, 1},
    {"one row", NULL, 400, 0.11, 0.11, 0, 0, FRONT, 300, 1, 1},
    {"one column", NULL, 400, 0.11, 0.11, 0, 0, FRONT, 1, 300, 1},
    {"samples", NULL, 400, 0.11, 0.11, 0, 0, FRONT, 96, 72, 7, .most = 2},
    {"samples of small balls", NULL, 2000, 0.015, 0.015, 0, 0, FRONT, 96, 72, 5},
    {"a part of the frame", NULL, 400, 0.11, 0.11, 0, 0, FRONT, 96, 72, 1, .region = {13, 22, 50, 37}},
    {"a part, samples", NULL, 400, 0.11, 0.11, 0, 0, FRONT, 96, 72, 3, .region = {0, 36, 96, 36}},
    {"a single pixel of the frame", NULL, 400, 0.11, 0.11, 0, 0, FRONT, 96, 72, 1, .region = {50, 33, 1, 1}},
    {"wide", NULL, 400, 0.11, 0.11, 0, 0, .eye = {0.5, 0.5, 1.3}, .look_at = {0.5, 0.5, 0.5}, .fov = 150, 96,
     72, 1},
    {"wide, from within", NULL, 400, 0.07, 0.07, 0, 0, .eye = {0.5, 0.5, 0.4}, .look_at = {0.1, 0.2, 0.3},
     .fov = 150, 96, 72, 2},
    {"from within", NULL, 600, 0.05, 0.05, 0, 0, .eye = {0.45, 0.5, 0.55}, .look_at = {0.9, 0.3, 0.2},
     .fov = 60, 96, 72, 1},
    {"the eye just outside a ball", NULL, 1, 0.3, 0.3, 0, 0, .eye = {0.5, 0.5, 1.5}, .look_at = {0.3, 0.4, 0},
     .fov = 100, 96, 72, 1},
    {"far", NULL, 400, 0.11, 0.11, 0, 0, .eye = {4800, 6000, 6400}, .look_at = {0.5, 0.5, 0.5}, .fov = 0.012,
     96, 72, 1, .most = 1.7},
    {"far, aside, samples", NULL, 400, 0.05, 0.05, 0, 0, .eye = {48, 60, 64}, .look_at = {0.9, 0.2, 0.5},
     .fov = 0.8, 83, 61, 4},
    {"mixed radii", NULL, 500, 0.004, 0.4, 0, 0, FRONT, 96, 72, 1, .most = 2},
    {"mixed radii, from within", NULL, 500, 0.004, 0.2, 0, 0, .eye = {0.5, 0.5, 0.5}, .look_at = {0, 0.4, 0},
     .fov = 90, 96, 72, 1},
    {"core radii by strengths", NULL, 400, 0.11, 0.11, 0.05, 3, FRONT, 96, 72, 1, .most = 1.6},
    {"both", NULL, 500, 0.02, 0.3, 0.05, 3, FRONT, 96, 72, 1, .most = 2},
    {"negative strengths", NULL, 400, 0.05, 0.15, -1.5, 2.5, FRONT, 96, 72, 1, .most = 1.5},
    {"dense", "dense:3000", .eye = {1, 0.85, 2.7}, .look_at = {1, 0.25, 0.5}, .fov = 45, 96, 72, 1,
     .most = 1.6},
    {"scattered, many threads", "scattered:20000", FRONT, 64, 48, 1},
    {"molecule", "molecule:300", .eye = {0, 0, 60}, .look_at = {0, 0, 0}, .fov = 30, 96, 72, 1},
    {"one ball", NULL, 1, 0.4, 0.4, 0, 0, FRONT, 96, 72, 1, .most = 1.3},
    {"none", NULL, 0, 1, 1, 0, 0, FRONT, 96, 72, 1},
    {"all behind", NULL, 400, 0.11, 0.11, 0, 0, .eye = {0.5, 0.5, 3}, .look_at = {0.5, 0.5, 9}, .fov = 60, 96,
     72, 1},
};

static mns_field *cloud(const tile_case *c)
{
    double *position = calloc(3 * c->count + 1, sizeof *position),
           *radius = calloc(c->count + 1, sizeof *radius), *strength = calloc(c->count + 1, sizeof *strength);
    uint64_t random = 17 + c->count;
    assert_true(position && radius && strength);
    for (size_t i = 0; i < c->count; i++) {
        for (size_t a = 0; a < 3; a++) position[3 * i + a] = draw_random(&random);
        radius[i] = c->radius_low * pow(c->radius_high / c->radius_low, draw_random(&random));
        strength[i] = c->strength_low + (c->strength_high - c->strength_low) * draw_random(&random);
    }
    mns_field *field =
        draw_field(c->count, position, c->radius_low == c->radius_high ? NULL : radius, c->radius_low,
                   c->strength_low == c->strength_high ? NULL : strength, MNS_KERNEL_POLY3);
    free(position), free(radius), free(strength);
    return field;
}

/* A scene with all that its lists are made from, and the lists. */
typedef struct setting {
    const char *name;
    mns_field *field;
    mns_plan *plan;
    list_region region;
    size_t near; /* balls to sort before what they hide is dropped */
    list_order order;
    tile_bins bins;
    size_t tiles;
} setting;

static void make_lists(setting *s)
{
    mns_error error;
    if (list_order_make(&s->order, s->field, s->plan, s->near, &error) ||
        tile_outlines_make(&s->bins, &s->order, s->field, s->plan, &error) ||
        tile_bins_make(&s->bins, &s->order, s->field, s->plan, s->region, &error))
        fail_msg("%s: %s", s->name, error.text);
    assert_true(s->bins.fits);
    s->tiles = (size_t)s->bins.across * (size_t)s->bins.down;
}

static void begin(setting *s, const char *name, mns_field *field, const mns_view *view,
                  const mns_options *options)
{
    static const mns_limits limits = {
        .max_storage_block = 1u << 27, .max_texture_size = 16384, .max_viewport = {16384, 16384}};
    mns_options tile = *options;
    mns_error error;
    tile.method = MNS_METHOD_TILE;
    *s = (setting){
        .name = name, .field = field, .near = SIZE_MAX, .region = {0, 0, view->width, view->height}};
    if (mns_plan_create(field, view, NULL, &tile, &limits, &s->plan, &error))
        fail_msg("%s: %s", name, error.text);
}

static void begin_case(setting *s, const tile_case *c)
{
    mns_view view = draw_view(c->eye, c->look_at, c->fov, c->width, c->height);
    begin(s, c->name, c->generator ? draw_generated(c->generator, MNS_KERNEL_POLY3) : cloud(c), &view,
          &(mns_options){.samples = c->samples});
    if (c->region.width) s->region = c->region;
}

static void end(setting *s)
{
    list_order_free(&s->order);
    tile_bins_free(&s->bins);
    mns_plan_destroy(s->plan);
    mns_field_destroy(s->field);
}

/* ---- The lists' form ---- */

/* Every list ascends, so that none holds a ball twice; the lists stand one behind the other, from entry 1 on.
 */
static void expect_form(const setting *s)
{
    size_t next = 1;
    for (size_t tile = 0; tile < s->tiles; tile++) {
        tile_head head = s->bins.head[tile];
        assert_int_equal(head.past - head.first, s->bins.length[tile]);
        if (head.first == head.past) {
            assert_int_equal(head.first, 0);
            continue;
        }
        assert_int_equal(head.first, next);
        for (size_t at = head.first; at < head.past; at++) {
            uint32_t place = s->bins.place[at];
            assert_true(place < s->order.count);
            if (at > head.first && place <= s->bins.place[at - 1])
                fail_msg("%s: tile %zu: place %u after %u", s->name, tile, place, s->bins.place[at - 1]);
        }
        next = head.past;
    }
    assert_int_equal(next, s->bins.count + 1);
}

/* ---- What the lists must hold ---- */

/* Of one pixel: the unit direction from the eye through (x, y) in GL's pixels, off by the sample. */
static vec3 ray_through(const view_frame *f, double x, double y)
{
    double unit = 2 * f->tan_half / f->height;
    vec3 way = vec3_along(f->forward, (x - 0.5 * f->width) * unit, f->right);
    way = vec3_along(way, (y - 0.5 * f->height) * unit, f->up);
    return vec3_scale(way, 1 / vec3_length(way));
}

/* Where the ray enters and leaves a sphere. */
static bool chord(vec3 centre, double radius, vec3 way, double *enter, double *leave)
{
    double middle = vec3_dot(centre, way), away = vec3_length(vec3_along(centre, -middle, way));
    if (!(away < radius)) return false;
    double half = sqrt((radius - away) * (radius + away));
    *enter = middle - half;
    *leave = middle + half;
    return true;
}

/* The balls of a field as rays see them. */
typedef struct seen_ball {
    vec3 centre; /* from the eye */
    double radius, core, distance;
} seen_ball;

static seen_ball *see(const setting *s)
{
    const mns_field *field = s->field;
    seen_ball *ball = calloc(field->p.count + 1, sizeof *ball);
    assert_non_null(ball);
    for (size_t i = 0; i < field->p.count; i++) {
        vec3 at = {field->p.axis[0][i], field->p.axis[1][i], field->p.axis[2][i]};
        double strength = field_strength(field, i);
        ball[i].centre = vec3_sub(at, s->plan->frame.eye);
        ball[i].radius = field_radius(field, i);
        ball[i].distance = vec3_length(ball[i].centre) - ball[i].radius;
        if (s->plan->features & FEATURE_CORE && strength > field->iso)
            ball[i].core = ball[i].radius * kernel_core_radius(field->kernel, field->iso / strength);
    }
    return ball;
}

/* Notes in `needed` (a byte a tile and ball) what one ray's pixel must have in its list. */
static void need(const setting *s, const seen_ball *ball, vec3 way, uint8_t *needed)
{
    double enter, leave, hidden = INFINITY;
    size_t count = s->field->p.count;
    for (size_t i = 0; i < count; i++)
        if (ball[i].core > 0 && chord(ball[i].centre, ball[i].core, way, &enter, &leave) && leave > 0)
            hidden = fmin(hidden, enter);
    for (size_t i = 0; i < count; i++)
        if (ball[i].distance < hidden && chord(ball[i].centre, ball[i].radius, way, &enter, &leave) &&
            leave > 0)
            needed[i] = 1;
}

/* Holds the lists against what is needed. Returns the entries needed, over all tiles. */
static size_t expect_lists(const setting *s)
{
    size_t balls = s->field->p.count, sum = 0;
    seen_ball *ball = see(s);
    uint8_t *needed = calloc(s->tiles * (balls + 1), 1);
    assert_non_null(needed);
    int samples = s->plan->options.samples;
    for (int y = 0; y < s->region.height; y++)
        for (int x = 0; x < s->region.width; x++)
            for (int i = samples > 1 ? 0 : -1; i < (samples > 1 ? samples : 0); i++) {
                double jitter[2];
                list_jitter(i < 0 ? 0 : i, i < 0 ? 1 : samples, jitter);
                vec3 way = ray_through(&s->plan->frame, s->region.x + x + 0.5 + jitter[0],
                                       s->region.y + y + 0.5 + jitter[1]);
                size_t tile =
                    (size_t)(y >> s->bins.shift) * (size_t)s->bins.across + (size_t)(x >> s->bins.shift);
                need(s, ball, way, needed + tile * balls);
            }
    for (size_t tile = 0; tile < s->tiles; tile++) {
        uint8_t *mine = needed + tile * balls;
        for (size_t i = 0; i < balls; i++) sum += mine[i];
        for (size_t at = s->bins.head[tile].first; at < s->bins.head[tile].past; at++)
            mine[list_ball_at(&s->order, s->bins.place[at])->index] = 0;
        for (size_t i = 0; i < balls; i++)
            if (mine[i])
                fail_msg("%s: tile %zu of %d across, %d pixels wide: ball %zu is missing", s->name, tile,
                         s->bins.across, 1 << s->bins.shift, i);
    }
    free(needed);
    free(ball);
    return sum;
}

static void every_ball_that_a_ray_meets_is_listed(void **state)
{
    (void)state;
    bool shifts[6] = {false};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        setting s;
        begin_case(&s, &cases[i]);
        make_lists(&s);
        expect_form(&s);
        size_t sum = expect_lists(&s);
        if (cases[i].most > 0 && (sum < 10 || (double)s.bins.count > cases[i].most * (double)sum))
            fail_msg("%s: %zu entries, of which %zu are needed", s.name, s.bins.count, sum);
        shifts[s.bins.shift] = true;
        end(&s);
    }
    assert_true(shifts[2] && shifts[3] && shifts[4] && shifts[5]);
}

static void empty_scenes_have_empty_lists(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (strcmp(cases[i].name, "none") != 0 && strcmp(cases[i].name, "all behind") != 0) continue;
        setting s;
        begin_case(&s, &cases[i]);
        make_lists(&s);
        assert_int_equal(s.bins.count, 0);
        for (size_t tile = 0; tile < s.tiles; tile++) assert_int_equal(s.bins.head[tile].past, 0);
        end(&s);
    }
}

/* ---- Threads ---- */

static void expect_the_same_balls(const setting *a, const setting *b)
{
    assert_int_equal(a->bins.shift, b->bins.shift);
    assert_int_equal(a->bins.count, b->bins.count);
    assert_memory_equal(a->bins.head, b->bins.head, a->tiles * sizeof(tile_head));
    for (size_t i = 1; i <= a->bins.count; i++)
        assert_int_equal(list_ball_at(&a->order, a->bins.place[i])->index,
                         list_ball_at(&b->order, b->bins.place[i])->index);
}

static void any_number_of_threads_makes_the_same_lists(void **state)
{
    (void)state;
    assert_true(BIN_ALONE < 7 * 20000 / 8); /* the largest is sieved and binned by all */
    static const char *const names[] = {"scattered, many threads", "samples", "mixed radii", "one row"};
    int before = omp_get_max_threads();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bool wanted = false;
        for (size_t k = 0; k < sizeof names / sizeof *names; k++) wanted |= !strcmp(cases[i].name, names[k]);
        if (!wanted) continue;
        setting one, many;
        omp_set_num_threads(1);
        begin_case(&one, &cases[i]);
        make_lists(&one);
        begin_case(&many, &cases[i]);
        static const int threads[] = {2, 3, 7, 1};
        for (size_t k = 0; k < 4; k++) {
            omp_set_num_threads(threads[k]);
            many.near = one.order.count / 8;
            make_lists(&many);
            expect_the_same_balls(&one, &many);
            many.near = SIZE_MAX;
            make_lists(&many);
            assert_int_equal(one.bins.count, many.bins.count);
            assert_memory_equal(one.bins.place, many.bins.place, (one.bins.count + 1) * sizeof(uint32_t));
            assert_memory_equal(one.bins.head, many.bins.head, one.tiles * sizeof(tile_head));
        }
        end(&one);
        end(&many);
    }
    omp_set_num_threads(before);
}

/* ---- What the nearest hide ---- */

/* Lists are the same, however many balls are sorted before the rest is looked at. */
static void what_is_dropped_unsorted_was_in_no_list(void **state)
{
    (void)state;
    size_t dropped = 0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        setting all, few;
        begin_case(&all, &cases[i]);
        make_lists(&all);
        assert_int_equal(all.order.count, all.order.in_view);
        begin_case(&few, &cases[i]);
        const size_t near[] = {0, 1, all.order.count / 8, all.order.count / 2, all.order.count};
        for (size_t k = 0; k < sizeof near / sizeof *near; k++) {
            few.near = near[k];
            make_lists(&few);
            if (all.bins.shift != few.bins.shift) continue; /* it is taken from a sample of the order */
            expect_the_same_balls(&all, &few);
            dropped += few.order.in_view - few.order.count;
        }
        end(&few);
        end(&all);
    }
    assert_true(dropped > 3000);
}

static void a_part_of_the_frame_drops_nothing(void **state)
{
    (void)state;
    setting s;
    const tile_case *dense = cases;
    while (strcmp(dense->name, "dense") != 0) dense++;
    begin_case(&s, dense);
    s.near = 400;
    s.region = (list_region){0, 0, 96, 36};
    make_lists(&s);
    assert_int_equal(s.order.count, s.order.in_view);
    assert_int_equal(s.order.sorted, s.order.count);
    end(&s);
}

/* ---- Crowds and limits ---- */

static mns_field *coincident(size_t count, double strength)
{
    double *position = calloc(3 * count, sizeof *position), *strengths = calloc(count, sizeof *strengths);
    assert_true(position && strengths);
    for (size_t i = 0; i < count; i++) {
        for (size_t a = 0; a < 3; a++) position[3 * i + a] = 0.5;
        strengths[i] = strength;
    }
    mns_field *field = draw_field(count, position, NULL, 0.3, strengths, MNS_KERNEL_POLY3);
    free(position), free(strengths);
    return field;
}

enum { CROWD = 10000 };

/* So weak that there is no core: all of them are in each list that one of them is in. */
static void ten_thousand_coincident_balls_are_all_listed(void **state)
{
    (void)state;
    setting s;
    mns_view view = draw_view((const double[3]){0.5, 0.8, 2.4}, (const double[3]){0.5, 0.5, 0.5}, 40, 48, 36);
    begin(&s, "coincident", coincident(CROWD, 1e-4), &view, &(mns_options){0});
    make_lists(&s);
    expect_form(&s);
    size_t full = 0;
    for (size_t tile = 0; tile < s.tiles; tile++) {
        assert_true(s.bins.length[tile] == 0 || s.bins.length[tile] == CROWD);
        full += s.bins.length[tile] > 0;
    }
    assert_true(full > 4 && full < s.tiles);
    end(&s);
}

/* With cores the crowd is as long where nothing is in front of it: every ball begins before every core. */
static void coincident_cores_hide_only_what_begins_behind_them(void **state)
{
    (void)state;
    setting s;
    mns_view view = draw_view((const double[3]){0.5, 0.8, 2.4}, (const double[3]){0.5, 0.5, 0.5}, 40, 48, 36);
    begin(&s, "coincident cores", coincident(50, 1), &view, &(mns_options){0});
    assert_true(s.plan->features & FEATURE_CORE);
    make_lists(&s);
    expect_form(&s);
    expect_lists(&s);
    end(&s);
}

/* Lists past the plan's limit are given up early, and said to be so; what follows is as if nothing had been.
 */
static void lists_past_the_limit_do_not_fit(void **state)
{
    (void)state;
    static const size_t most[] = {1, 100, 200000};
    mns_view view =
        draw_view((const double[3]){0.5, 0.8, 2.4}, (const double[3]){0.5, 0.5, 0.5}, 40, 480, 360);
    setting s;
    begin(&s, "crowd", coincident(CROWD, 1e-4), &view, &(mns_options){0});
    for (size_t i = 0; i < 3; i++) {
        s.plan->pool_most = most[i];
        assert_int_equal(list_order_make(&s.order, s.field, s.plan, SIZE_MAX, NULL), MNS_OK);
        assert_int_equal(tile_outlines_make(&s.bins, &s.order, s.field, s.plan, NULL), MNS_OK);
        assert_int_equal(tile_bins_make(&s.bins, &s.order, s.field, s.plan, s.region, NULL), MNS_OK);
        assert_false(s.bins.fits);
        assert_true(s.bins.count >= most[i]);
        assert_false(tile_bins_serve(&s.bins, s.plan, s.region));
        size_t pairs = 0;
        for (int k = 0; k < s.bins.band_count; k++) pairs += s.bins.band[k].capacity;
        assert_true(pairs < 8u << 20); /* of 10,000 in each of 2,700 tiles */
    }
    s.plan->pool_most = 1u << 20;
    s.region = (list_region){237, 178, 8, 8};
    make_lists(&s);
    expect_form(&s);
    assert_true(s.bins.count >= CROWD);
    assert_true(tile_bins_serve(&s.bins, s.plan, s.region));
    s.plan->pool_most = s.bins.count; /* what no longer fits serves no longer */
    assert_false(tile_bins_serve(&s.bins, s.plan, s.region));
    end(&s);
}

static void lists_serve_their_region_and_their_samples_only(void **state)
{
    (void)state;
    setting s;
    begin_case(&s, &cases[0]);
    make_lists(&s);
    list_region part = s.region;
    part.width--;
    assert_true(tile_bins_serve(&s.bins, s.plan, s.region));
    assert_false(tile_bins_serve(&s.bins, s.plan, part));
    s.plan->options.samples = 4;
    assert_false(tile_bins_serve(&s.bins, s.plan, s.region));
    make_lists(&s);
    assert_true(tile_bins_serve(&s.bins, s.plan, s.region));
    end(&s);
}

/* The lengths are those of the lists, once a pixel. */
static void lengths_are_told_a_pixel(void **state)
{
    (void)state;
    setting s;
    begin_case(&s, &cases[1]);
    make_lists(&s);
    list_lengths lengths = {0};
    assert_true(tile_bins_lengths(&s.bins, &lengths));
    size_t pixels = 0;
    uint64_t sum = 0, want = 0;
    for (int y = 0; y < s.region.height; y++)
        for (int x = 0; x < s.region.width; x++) {
            uint32_t length = s.bins.length[(y >> s.bins.shift) * s.bins.across + (x >> s.bins.shift)];
            want += length;
            pixels += length > 0;
        }
    assert_int_equal(lengths.count, pixels);
    for (size_t i = 0; i < pixels; i++) sum += lengths.length[i];
    assert_true(sum == want);
    free(lengths.length);
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_ball_that_a_ray_meets_is_listed),
        cmocka_unit_test(empty_scenes_have_empty_lists),
        cmocka_unit_test(any_number_of_threads_makes_the_same_lists),
        cmocka_unit_test(what_is_dropped_unsorted_was_in_no_list),
        cmocka_unit_test(a_part_of_the_frame_drops_nothing),
        cmocka_unit_test(ten_thousand_coincident_balls_are_all_listed),
        cmocka_unit_test(coincident_cores_hide_only_what_begins_behind_them),
        cmocka_unit_test(lists_past_the_limit_do_not_fit),
        cmocka_unit_test(lists_serve_their_region_and_their_samples_only),
        cmocka_unit_test(lengths_are_told_a_pixel),
    };
    return cmocka_run_group_tests_name("tile", tests, NULL, NULL);
}
