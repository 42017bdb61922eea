/* The truth: what the tracer gives a pixel, and the cache that keeps it. */
#include "compare/truth.h"
#include "support/cli.h"
#include "support/draw_fixture.h"

#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

/* A folder of its own as the user's cache, and a scene. */
typedef struct cache_test {
    cli folder;
    mns_field *field;
    mns_view view;
} cache_test;

static const double CENTRES[] = {0, 0, 0, 0.7, 0.1, 0, -0.2, 0.5, 0.3};

static int setup(void **state)
{
    cache_test *c = calloc(1, sizeof *c);
    mns_error error;
    assert_non_null(c);
    cli_setup(&c->folder, "");
    setenv("XDG_CACHE_HOME", c->folder.folder, 1);
    c->field = draw_field(3, CENTRES, NULL, 1, NULL, MNS_KERNEL_POLY3);
    mns_view view = {.width = 24, .height = 16};
    assert_int_equal(mns_view_resolve(&view, c->field, &c->view, &error), MNS_OK);
    *state = c;
    return 0;
}

static int teardown(void **state)
{
    cache_test *c = *state;
    mns_field_destroy(c->field);
    cli_teardown(&c->folder);
    free(c);
    return 0;
}

static truth_planes *make(const cache_test *c, const mns_field *field, const mns_view *view)
{
    truth_desc desc = {.field = field ? field : c->field, .view = view ? view : &c->view, .use_cache = true};
    truth_planes *truth;
    mns_error error;
    if (truth_create(&desc, &truth, &error)) fail_msg("%s", error.text);
    return truth;
}

static void cached_path(const cache_test *c, const truth_planes *truth, char path[256])
{
    snprintf(path, 256, "%s/meniscus/truth/%s.truth", c->folder.folder, truth->hash);
}

static size_t count_cached(const cache_test *c)
{
    cli folder = {.program = ""};
    snprintf(folder.folder, sizeof folder.folder, "%.40s/meniscus/truth", c->folder.folder);
    return cli_count_files(&folder);
}

/* Every plane, bit for bit. */
static void expect_same(const truth_planes *a, const truth_planes *b)
{
    size_t pixels = (size_t)a->width * (size_t)a->height;
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_memory_equal(a->t, b->t, pixels * sizeof *a->t);
    assert_memory_equal(a->t_error, b->t_error, pixels * sizeof *a->t_error);
    assert_memory_equal(a->normal, b->normal, 3 * pixels * sizeof *a->normal);
    assert_memory_equal(a->radius, b->radius, pixels * sizeof *a->radius);
    assert_memory_equal(a->certain, b->certain, pixels);
    assert_int_equal(a->hits, b->hits);
    assert_int_equal(a->undecided, b->undecided);
}

static void each_pixel_is_the_ray_through_its_centre(void **state)
{
    const cache_test *c = *state;
    truth_planes *truth = make(c, NULL, NULL);
    mns_reference *reference;
    mns_error error;
    assert_int_equal(mns_reference_create(c->field, &reference, &error), MNS_OK);
    size_t hits = 0;
    for (int y = 0; y < 16; y++)
        for (int x = 0; x < 24; x++) {
            size_t i = (size_t)y * 24 + (size_t)x;
            double direction[3];
            mns_hit hit;
            mns_view_ray(&c->view, x + 0.5, y + 0.5, direction);
            assert_int_equal(mns_reference_trace(reference, c->view.eye, direction, &hit, &error), MNS_OK);
            assert_true(hit.hit ? truth->t[i] == hit.t : isinf(truth->t[i]) != 0);
            assert_true(truth->radius[i] == (hit.hit ? 1 : 0));
            assert_int_equal(truth->certain[i], hit.certain);
            hits += hit.hit;
        }
    assert_true(hits > 50 && hits < 24 * 16);
    assert_int_equal(truth->hits, hits);
    assert_true(truth->has_view && !truth->rgba && !truth->cached && truth->ms > 0);
    mns_reference_destroy(reference);
    truth_destroy(truth);
}

static void a_second_truth_comes_from_the_cache(void **state)
{
    const cache_test *c = *state;
    truth_planes *first = make(c, NULL, NULL), *second = make(c, NULL, NULL);
    assert_false(first->cached);
    assert_true(second->cached);
    assert_string_equal(first->note, "");
    assert_true(first->ms == second->ms); /* what it took when it was traced */
    expect_same(first, second);
    assert_int_equal(count_cached(c), 1);
    truth_destroy(first);
    truth_destroy(second);
}

static void without_the_cache_nothing_is_left(void **state)
{
    const cache_test *c = *state;
    truth_desc desc = {.field = c->field, .view = &c->view};
    truth_planes *truth;
    mns_error error;
    assert_int_equal(truth_create(&desc, &truth, &error), MNS_OK);
    assert_false(truth->cached);
    assert_false(cli_exists(&c->folder, "meniscus"));
    truth_destroy(truth);
}

/* One byte of the file is turned over, wherever it lies. */
static void a_damaged_file_is_thrown_away(void **state)
{
    const cache_test *c = *state;
    truth_planes *truth = make(c, NULL, NULL);
    char path[256];
    cached_path(c, truth, path);
    struct stat about;
    assert_int_equal(stat(path, &about), 0);
    const long places[] = {0, 8, 20, 30, 60, 70, 100, 3000, (long)about.st_size - 1};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        FILE *file = fopen(path, "r+b");
        assert_non_null(file);
        fseek(file, places[i], SEEK_SET);
        int byte = fgetc(file);
        fseek(file, places[i], SEEK_SET);
        fputc(byte ^ 0x10, file);
        fclose(file);
        truth_planes *again = make(c, NULL, NULL);
        if (again->cached) fail_msg("byte %ld turned over, and believed", places[i]);
        expect_same(truth, again);
        truth_destroy(again);
        again = make(c, NULL, NULL); /* written anew */
        assert_true(again->cached);
        truth_destroy(again);
    }
    assert_int_equal(count_cached(c), 1);
    truth_destroy(truth);
}

static void a_cut_or_a_longer_file_is_thrown_away(void **state)
{
    const cache_test *c = *state;
    char path[256];
    truth_planes *truth = make(c, NULL, NULL);
    cached_path(c, truth, path);
    for (int longer = 0; longer < 2; longer++) {
        struct stat about;
        assert_int_equal(stat(path, &about), 0);
        FILE *file = fopen(path, "r+b");
        assert_non_null(file);
        assert_int_equal(ftruncate(fileno(file), about.st_size + (longer ? 8 : -8)), 0);
        fclose(file);
        truth_planes *again = make(c, NULL, NULL);
        assert_false(again->cached);
        expect_same(truth, again);
        truth_destroy(again);
    }
    truth_destroy(truth);
}

static void another_scene_has_another_truth(void **state)
{
    const cache_test *c = *state;
    truth_planes *truth = make(c, NULL, NULL);
    double moved[9], strength[3] = {1, 1, -0.5};
    memcpy(moved, CENTRES, sizeof moved);
    moved[8] = nextafter(moved[8], 1);
    mns_view wider = c->view;
    wider.fov = nextafter(wider.fov, 90);
    mns_field *fields[] = {draw_field(3, moved, NULL, 1, NULL, MNS_KERNEL_POLY3),
                           draw_field(3, CENTRES, NULL, nextafter(1, 2), NULL, MNS_KERNEL_POLY3),
                           draw_field(3, CENTRES, NULL, 1, strength, MNS_KERNEL_POLY3),
                           draw_field(3, CENTRES, NULL, 1, NULL, MNS_KERNEL_PERLIN)};
    for (size_t i = 0; i < 4; i++) {
        truth_planes *other = make(c, fields[i], NULL);
        if (other->cached || !strcmp(other->hash, truth->hash)) fail_msg("field %zu is taken for another", i);
        truth_destroy(other);
        mns_field_destroy(fields[i]);
    }
    truth_planes *other = make(c, NULL, &wider);
    assert_false(other->cached);
    truth_destroy(other);
    assert_int_equal(count_cached(c), 6);
    truth_destroy(truth);
}

static void hash_look(const cache_test *c, const mns_look *look, const char *driver,
                      char hash[TRUTH_HASH_SIZE])
{
    truth_hash(c->field, &c->view, look, driver, hash);
    assert_int_equal(strlen(hash), TRUTH_HASH_SIZE - 1);
}

static void the_look_counts_where_colours_are_kept(void **state)
{
    const cache_test *c = *state;
    char plain[TRUTH_HASH_SIZE], none[TRUTH_HASH_SIZE], other[TRUTH_HASH_SIZE];
    hash_look(c, &(mns_look){0}, "a driver", plain);
    hash_look(c, NULL, NULL, none);
    assert_string_not_equal(plain, none);
    hash_look(c, &(mns_look){0}, "another driver", other);
    assert_string_not_equal(plain, other);
    hash_look(c, NULL, "a driver", other); /* which draws nothing */
    assert_string_equal(none, other);
}

/* Every member tells one look from all others. */
static void two_looks_have_two_truths(void **state)
{
    static const mns_light red = {.color = {1, 0, 0}}, strong = {.strength = 2},
                           near = {.kind = MNS_LIGHT_POINT, .position = {0, 0, 1}},
                           far = {.kind = MNS_LIGHT_POINT, .position = {0, 0, 2}},
                           ball = {.kind = MNS_LIGHT_AREA, .position = {0, 0, 1}, .radius = 1},
                           sun = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 0, 0}};
    static const mns_mesh floor_mesh = {.file = "floor.obj"}, other_mesh = {.file = "box.obj"},
                          black_mesh = {.file = "floor.obj", .has_color = true},
                          dark_mesh = {.file = "floor.obj", .has_color = true, .color = {0, 0, 0.1}};
    static const mns_light two[] = {{.strength = 2}, {.strength = 3}};
    static const mns_look looks[] = {
        {.set = 0},
        {.set = MNS_LOOK_SPECULAR},
        {.preset = "water"},
        {.preset = "glass"},
        {.lights = &red, .light_count = 1},
        {.lights = &strong, .light_count = 1},
        {.lights = &near, .light_count = 1},
        {.lights = &far, .light_count = 1},
        {.lights = &ball, .light_count = 1},
        {.lights = &sun, .light_count = 1},
        {.lights = two, .light_count = 2},
        {.meshes = &floor_mesh, .mesh_count = 1},
        {.meshes = &other_mesh, .mesh_count = 1},
        {.meshes = &black_mesh, .mesh_count = 1},
        {.meshes = &dark_mesh, .mesh_count = 1},
        {.effects = {.shadows = true}},
        {.effects = {.shadow_samples = 1}},
        {.effects = {.reflections = 1}},
        {.effects = {.refractions = 1}},
        {.effects = {.mirror = 0.5}},
        {.effects = {.index = 1.5}},
        {.effects = {.transmission = 0.5}},
        {.effects = {.absorption[2] = 1}},
        {.effects = {.occlusion_rays = 1}},
        {.effects = {.occlusion_reach = 1}},
        {.effects = {.environment = "sky"}},
        {.effects = {.seed = 1}},
        {.blend.by = "heat"},
        {.blend.range = {0, 2}},
        {.blend.set = MNS_LOOK_COLOR},
        {.blend.color = {1, 0, 0}},
        {.blend.mirror = 0.5},
        {.blend.transmission = 0.5},
        {.blend.absorption = {0, 1, 0}},
    };
    enum { LOOKS = sizeof looks / sizeof *looks };
    const cache_test *c = *state;
    char hash[LOOKS][TRUTH_HASH_SIZE];
    for (size_t i = 0; i < LOOKS; i++) {
        hash_look(c, &looks[i], "a driver", hash[i]);
        for (size_t k = 0; k < i; k++)
            if (!strcmp(hash[i], hash[k])) fail_msg("look %zu is taken for look %zu", i, k);
    }
}

/* A map is told by its size and time, for it may be another under the same name. */
static void a_changed_environment_has_another_truth(void **state)
{
    const cache_test *c = *state;
    char path[256], before[TRUTH_HASH_SIZE], after[TRUTH_HASH_SIZE];
    const struct timespec once[2] = {{1000, 0}, {1000, 0}}, later[2] = {{1001, 0}, {1001, 0}};
    cli_write(&c->folder, "map.png", "one");
    snprintf(path, sizeof path, "%s/map.png", c->folder.folder);
    const mns_look look = {.effects = {.environment = path}};
    assert_int_equal(utimensat(AT_FDCWD, path, once, 0), 0);
    hash_look(c, &look, "a driver", before);
    hash_look(c, &look, "a driver", after);
    assert_string_equal(before, after);
    assert_int_equal(utimensat(AT_FDCWD, path, later, 0), 0);
    hash_look(c, &look, "a driver", after);
    assert_string_not_equal(before, after);
    cli_write(&c->folder, "map.png", "longer");
    assert_int_equal(utimensat(AT_FDCWD, path, once, 0), 0);
    hash_look(c, &look, "a driver", after);
    assert_string_not_equal(before, after);
    assert_int_equal(unlink(path), 0);
}

static void an_unusable_cache_is_told_and_no_failure(void **state)
{
    const cache_test *c = *state;
    setenv("XDG_CACHE_HOME", "/dev/null/here", 1);
    truth_planes *truth = make(c, NULL, NULL);
    assert_false(truth->cached);
    assert_non_null(strstr(truth->note, "/dev/null/here/meniscus/truth"));
    truth_destroy(truth);
}

static void tell(void *context, int done, int rows)
{
    int *last = context;
    assert_int_equal(rows, 16);
    assert_true(done > *last && done <= rows);
    *last = done;
}

static void progress_rises_to_the_last_row(void **state)
{
    const cache_test *c = *state;
    int last = 0;
    truth_desc desc = {.field = c->field, .view = &c->view, .progress = tell, .context = &last};
    truth_planes *truth;
    mns_error error;
    assert_int_equal(truth_create(&desc, &truth, &error), MNS_OK);
    assert_int_equal(last, 16);
    truth_destroy(truth);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(each_pixel_is_the_ray_through_its_centre), TEST(a_second_truth_comes_from_the_cache),
        TEST(without_the_cache_nothing_is_left),        TEST(a_damaged_file_is_thrown_away),
        TEST(a_cut_or_a_longer_file_is_thrown_away),    TEST(another_scene_has_another_truth),
        TEST(the_look_counts_where_colours_are_kept),   TEST(two_looks_have_two_truths),
        TEST(a_changed_environment_has_another_truth),  TEST(an_unusable_cache_is_told_and_no_failure),
        TEST(progress_rises_to_the_last_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
