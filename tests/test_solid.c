/* Solid meshes: the first hit by the tree against every triangle in turn, edges and corners that no ray slips
 * through, rays that leave a triangle at any scale, and meshes in one plane. */
#include "field/field.h"
#include "solid/solid_files.h"
#include "support/effects_fixture.h"
#include "support/mesh_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static double next_random(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static vec3 random_point(uint64_t *seed, double size)
{
    double x = next_random(seed), y = next_random(seed), z = next_random(seed);
    return vec3_make(size * (2 * x - 1), size * (2 * y - 1), size * (2 * z - 1));
}

static void add_to(solid_soup *soup, uint32_t mesh, vec3 a, vec3 b, vec3 c)
{
    vec3 corner[3] = {a, b, c};
    mns_error error;
    if (solid_soup_add(soup, corner, mesh, "test", &error)) fail_msg("%s", error.text);
}

static void add(solid_soup *soup, vec3 a, vec3 b, vec3 c)
{
    add_to(soup, 0, a, b, c);
}

static solid_set set_of(solid_soup *soup)
{
    solid_set set;
    mns_error error;
    if (solid_set_make(soup, 1, &set, &error)) fail_msg("%s", error.text);
    solid_soup_free(soup);
    return set;
}

/* The box from lo to hi, twelve triangles. */
static void add_box(solid_soup *soup, vec3 lo, vec3 hi)
{
    static const int face[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                                   {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
    vec3 v[8];
    for (int i = 0; i < 8; i++)
        v[i] = vec3_make(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
    for (int f = 0; f < 6; f++) {
        add(soup, v[face[f][0]], v[face[f][1]], v[face[f][2]]);
        add(soup, v[face[f][0]], v[face[f][2]], v[face[f][3]]);
    }
}

/* By barycentric coordinates, without any tree or bound. */
static double met_by_one(const solid_set *set, const solid_triangle *t, const solid_ray *ray)
{
    vec3 a = vec3_load(set->corner[t->corner[0]]);
    vec3 u = vec3_sub(vec3_load(set->corner[t->corner[1]]), a);
    vec3 v = vec3_sub(vec3_load(set->corner[t->corner[2]]), a);
    vec3 p = vec3_cross(ray->way, v), from = vec3_sub(ray->origin, a), q = vec3_cross(from, u);
    double scale = vec3_dot(u, p);
    double s = vec3_dot(from, p) / scale, w = vec3_dot(ray->way, q) / scale, far = vec3_dot(v, q) / scale;
    return s >= 0 && w >= 0 && s + w <= 1 && far > 0 && far <= ray->reach ? far : INFINITY;
}

static void the_tree_finds_what_every_triangle_gives(void **state)
{
    (void)state;
    uint64_t seed = 7;
    solid_soup soup = {0};
    for (int i = 0; i < 3000; i++) {
        vec3 at = random_point(&seed, 1);
        add(&soup, at, vec3_add(at, random_point(&seed, 0.2)), vec3_add(at, random_point(&seed, 0.2)));
    }
    solid_set set = set_of(&soup);
    int hits = 0, doubts = 0;
    for (int i = 0; i < 3000; i++) {
        const solid_ray ray = {.origin = random_point(&seed, 2),
                               .way = vec3_unit(random_point(&seed, 1)),
                               .reach = i % 3 ? INFINITY : 2 * next_random(&seed)};
        double nearest = INFINITY;
        for (size_t t = 0; t < set.triangle_count; t++)
            nearest = fmin(nearest, met_by_one(&set, &set.triangle[t], &ray));
        solid_hit hit = solid_trace(&set, &ray);
        doubts += !hit.certain;
        if (!hit.certain) continue;
        hits += hit.hit;
        assert_int_equal(hit.hit, isfinite(nearest));
        if (!hit.hit) continue;
        assert_true(fabs(hit.t - nearest) <= hit.t_error + 1e-12);
        assert_true(hit.t_error < 1e-7);
        assert_true(vec3_dot(hit.normal, ray.way) <= 0 && fabs(vec3_length(hit.normal) - 1) < 1e-12);
    }
    assert_true(hits > 500 && doubts < 3);
    solid_set_free(&set);
}

/* Rays aimed at every corner, edge and face's diagonal of a closed box from outside: all meet it, and only at
 * its outline is there any doubt. */
static void no_ray_slips_between_two_triangles(void **state)
{
    (void)state;
    solid_soup soup = {0};
    add_box(&soup, vec3_make(-0.3, -0.7, -0.1), vec3_make(0.9, 0.2, 0.8));
    solid_set set = set_of(&soup);
    uint64_t seed = 3;
    int certain = 0, tried = 0;
    for (int i = 0; i < 20000; i++) {
        const solid_triangle *t = &set.triangle[(size_t)i % set.triangle_count];
        vec3 a = vec3_load(set.corner[t->corner[i % 3]]), b = vec3_load(set.corner[t->corner[(i + 1) % 3]]);
        double part = i % 5 ? next_random(&seed) : 0;
        vec3 aim = vec3_along(vec3_scale(a, 1 - part), part, b);
        /* From the far side of the box through its middle: the ray has met it before it comes to the edge. */
        vec3 middle = vec3_make(0.3, -0.25, 0.35), out = vec3_sub(middle, aim);
        solid_ray ray = {.origin = vec3_along(middle, 3 + next_random(&seed), out), .reach = INFINITY};
        ray.way = vec3_unit(vec3_sub(aim, ray.origin));
        assert_true(solid_trace(&set, &ray).hit);
        /* From within: it must come out. */
        ray.origin = middle;
        ray.way = vec3_unit(vec3_sub(aim, middle));
        solid_hit hit = solid_trace(&set, &ray);
        assert_true(hit.hit);
        assert_true(fabs(hit.t - vec3_length(vec3_sub(aim, middle))) < 1e-12);
        certain += hit.certain;
        tried++;
    }
    assert_int_equal(certain, tried);
    /* Past its outline, by less than rounding. */
    const solid_ray ray = {.origin = {0.9 + 1e-15, 0, 5}, .way = {0, 0, -1}, .reach = INFINITY};
    assert_false(solid_trace(&set, &ray).certain);
    solid_set_free(&set);
}

/* From each of a box's faces, out to all sides: nothing is met, and nothing is in doubt, at any size and far
 * from 0. From inside: always the far wall, never the near one. */
static void a_ray_that_leaves_a_triangle_does_not_meet_it(void **state)
{
    (void)state;
    static const double scales[] = {1e-6, 1, 1e6};
    for (size_t k = 0; k < 6; k++) {
        double size = scales[k % 3];
        vec3 at = k < 3 ? vec3_make(0, 0, 0) : vec3_make(1000 * size, -700 * size, 333 * size);
        solid_soup soup = {0};
        add_box(&soup, vec3_add(at, vec3_make(-0.3 * size, -0.7 * size, -0.1 * size)),
                vec3_add(at, vec3_make(0.9 * size, 0.2 * size, 0.8 * size)));
        solid_set set = set_of(&soup);
        uint64_t seed = 11 + k;
        int doubts = 0;
        for (int i = 0; i < 20000; i++) {
            solid_ray ray = {.reach = INFINITY,
                             .origin = vec3_along(at, 4 * size, vec3_unit(random_point(&seed, 1)))};
            vec3 aim = vec3_add(at, vec3_make(0.3 * size, -0.25 * size, 0.35 * size));
            ray.way = vec3_unit(vec3_sub(vec3_add(aim, random_point(&seed, 0.6 * size)), ray.origin));
            solid_hit hit = solid_trace(&set, &ray);
            if (!hit.hit || !hit.certain) continue;
            ray.origin = vec3_along(ray.origin, hit.t, ray.way);
            ray.leaves = hit.normal;
            ray.way = vec3_unit(random_point(&seed, 1));
            if (i % 3 == 0) /* slanting */
                ray.way = vec3_unit(vec3_add(vec3_cross(hit.normal, ray.way), vec3_scale(hit.normal, 1e-6)));
            bool outwards = vec3_dot(ray.way, hit.normal) > 0;
            solid_hit next = solid_trace(&set, &ray);
            doubts += !next.certain;
            if (next.certain && next.hit == outwards)
                fail_msg("size %g, ray %d %s: t %g", size, i, outwards ? "out" : "in", next.t);
            if (next.certain && next.hit) assert_true(next.t > 1e-9 * size);
        }
        /* Slants of a millionth, past an edge by what rounding is a thousand sizes from 0. */
        if (doubts > 20) fail_msg("%d rays in doubt at %g", doubts, size);
        solid_set_free(&set);
    }
}

/* Two meshes in a slanting plane, cut into other triangles, the second `above` the first as the eye sees
 * them.
 */
static solid_set two_layers(bool swapped, double above)
{
    static const int cut[2][2][3] = {{{0, 1, 2}, {1, 3, 2}}, {{0, 1, 3}, {0, 3, 2}}};
    solid_soup soup = {0};
    for (uint32_t mesh = 0; mesh < 2; mesh++) {
        vec3 v[4];
        for (int i = 0; i < 4; i++) {
            double x = i & 1 ? 2 : -2, y = i & 2 ? 2 : -2;
            v[i] = vec3_make(x, y, 0.5 * x - 0.25 * y + 1024 + (mesh ? above : 0));
        }
        for (int i = 0; i < 2; i++) {
            const int *at = cut[mesh][i];
            add_to(&soup, swapped ? 1 - mesh : mesh, v[at[0]], v[at[1]], v[at[2]]);
        }
    }
    return set_of(&soup);
}

/* Of meshes in one plane the first is seen, in whatever order their triangles come, and that is certain;
 * where one lies before the other by more than rounding that one is, and in between it is told to be in
 * doubt. */
static void of_meshes_in_one_plane_the_first_is_seen(void **state)
{
    (void)state;
    const double above[] = {0, 0, 1e-6, 1e-6, 4e-9};
    for (int k = 0; k < 5; k++) {
        solid_set set = two_layers(k & 1, above[k]);
        uint64_t seed = 5;
        int certain = 0;
        for (int i = 0; i < 2000; i++) {
            vec3 aim = vec3_make(1.9 * (2 * next_random(&seed) - 1), 1.9 * (2 * next_random(&seed) - 1), 0);
            aim.z = 0.5 * aim.x - 0.25 * aim.y + 1024;
            solid_ray ray = {.origin = vec3_add(aim, random_point(&seed, 1)), .reach = INFINITY};
            ray.origin.z += 3;
            ray.way = vec3_unit(vec3_sub(aim, ray.origin));
            solid_hit hit = solid_trace(&set, &ray);
            assert_true(hit.hit);
            certain += hit.certain;
            if (k == 4) continue;
            assert_int_equal(hit.mesh, k < 2 ? 0 : k == 2);
        }
        assert_int_equal(certain, k < 4 ? 2000 : 0);
        solid_set_free(&set);
    }
}

/* Whether a hit lies clearly behind another, as the decision on meshes in one place has it; and in one place.
 */
static bool is_behind(const solid_hit *a, const solid_hit *b)
{
    return a->t - b->t > 4 * (a->t_error + b->t_error);
}

static bool in_one_place(const solid_hit *a, const solid_hit *b)
{
    return fabs(a->t - b->t) <= 0.25 * (a->t_error + b->t_error);
}

/* Layers a part of rounding apart, each of a triangle of its own size and slant, in any order. */
static size_t make_layers(uint64_t *seed, solid_soup *soup, solid_soup alone[5])
{
    size_t count = 2 + (size_t)(4 * next_random(seed)), first = (size_t)(count * next_random(seed));
    size_t stride = count == 4 ? 1 : 1 + (size_t)((count > 3 ? count - 1 : 1) * next_random(seed));
    double depth = 0, apart = 4e-12 * pow(200, next_random(seed));
    for (size_t i = 0; i < count; i++) {
        uint32_t mesh = (uint32_t)((first + stride * i) % count);
        double half = pow(10, next_random(seed)), slant = 2 * next_random(seed) - 1;
        const vec3 at[3] = {vec3_make(-half, -half, -1 - depth - slant * half),
                            vec3_make(half, -half, -1 - depth - slant * half),
                            vec3_make(0, half, -1 - depth + slant * half)};
        add_to(soup, mesh, at[0], at[1], at[2]);
        add_to(&alone[mesh], 0, at[0], at[1], at[2]);
        depth += apart * next_random(seed);
    }
    return count;
}

/* Of any number of meshes near to one place the one named first is seen, of those that lie clearly behind
 * none; where all of those are in one place that is certain, if it is told so, whatever came first. */
static void how_many_lie_in_one_place_does_not_matter(void **state)
{
    (void)state;
    uint64_t seed = 11;
    size_t certain = 0, doubtful = 0, chosen = 0;
    for (int round = 0; round < 20000; round++) {
        solid_soup soup = {0}, alone[5] = {{0}};
        solid_hit one[5];
        const solid_ray ray = {.way = vec3_make(0, 0, -1), .reach = INFINITY};
        size_t count = make_layers(&seed, &soup, alone);
        for (size_t i = 0; i < count; i++) {
            solid_set set = set_of(&alone[i]);
            one[i] = solid_trace(&set, &ray);
            assert_true(one[i].hit);
            solid_set_free(&set);
        }
        solid_set set = set_of(&soup);
        solid_hit hit = solid_trace(&set, &ray);
        solid_set_free(&set);
        assert_true(hit.hit);
        size_t first = count, seen = 0, at[5];
        bool is_told = true;
        for (size_t i = 0; i < count; i++) {
            bool hidden = false;
            for (size_t k = 0; k < count; k++) hidden = hidden || is_behind(&one[i], &one[k]);
            if (hidden) continue;
            if (first == count) first = i;
            for (size_t k = 0; k < seen; k++) is_told = is_told && in_one_place(&one[i], &one[at[k]]);
            at[seen++] = i;
        }
        certain += hit.certain, doubtful += !hit.certain, chosen += hit.certain && seen > 1;
        if (hit.certain && (!is_told || hit.mesh != first))
            fail_msg("round %d: of %zu meshes %zu are seen, and that of %u is certain, where it is %zu%s",
                     round, count, seen, hit.mesh, first, is_told ? "" : " or another");
    }
    print_message("%zu certain, %zu of them of several, %zu in doubt\n", certain, chosen, doubtful);
    assert_true(certain > 4000 && chosen > 1000 && doubtful > 1000);
}

/* ---- Beside the surface ---- */

static const double origin[3] = {0, 0, 0};

static mns_field *one_ball(double scale)
{
    const mns_field_desc desc = {.count = 1, .position = {.data = origin}, .uniform_radius = scale};
    mns_field *field;
    mns_error error;
    if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
    return field;
}

/* A ball over a floor, under a light from straight above: what the eye meets, what the shadow hides, what the
 * mirror shows; the same at any scale. Where the ball ends: (1 - u)^3 = 0.2. */
static void a_floor_is_seen_shadowed_and_mirrored(void **state)
{
    (void)state;
    static const double scales[] = {1e-6, 1, 1e6};
    if (!mesh_is_built_in()) skip();
    for (size_t k = 0; k < 3; k++) {
        const double s = scales[k], edge = s * sqrt(1 - cbrt(0.2));
        char text[300];
        mesh_path path;
        snprintf(text, sizeof text, "v %g %g %g\nv %g %g %g\nv %g %g %g\nv %g %g %g\nf 1 2 3 4\n", -9 * s,
                 -2 * s, -9 * s, -9 * s, -2 * s, 9 * s, 9 * s, -2 * s, 9 * s, 9 * s, -2 * s, -9 * s);
        mesh_write(".obj", text, path);
        const mns_mesh mesh = {.file = path, .has_color = true, .color = {1, 1, 1}};
        const mns_light above = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {0, 1, 0}};
        const mns_look look = {.meshes = &mesh,
                               .mesh_count = 1,
                               .lights = &above,
                               .light_count = 1,
                               .set = MNS_LOOK_AMBIENT | MNS_LOOK_DIFFUSE,
                               .ambient = 0.25,
                               .diffuse = 0.5,
                               .effects = {.shadows = true, .mirror = 1, .reflections = 1}};
        mns_field *field = one_ball(s);
        solid_files files = {0};
        mns_error error;
        effects_fixture f;
        if (solid_files_take(&files, &mesh, 1, field_unit(field), &error)) fail_msg("%s", error.text);
        effects_fixture_open(&f, field, vec3_make(0, s, 4 * s), vec3_make(0, 0, 0), &look);
        f.scene.solids = &files.set;
        const struct {
            double x, z;
            bool lit;
        } spots[] = {{0, 0, false}, {0.99 * edge, 0, false}, {1.01 * edge, 0, true}, {0, 1.01 * edge, true}};
        for (size_t i = 0; i < sizeof spots / sizeof *spots; i++) {
            reference_answer first;
            vec3 way = vec3_make(spots[i].x, -3 * s, spots[i].z - 4 * s);
            effects_pixel pixel = effects_fixture_shade(&f, way, &first);
            double t = vec3_length(way) / field_unit(field);
            assert_true(fabs(first.hit.t - t) <= 1e-6 * t && first.hit.certain && pixel.certain);
            assert_float_equal(first.hit.normal[1], 1, 1e-6);
            assert_float_equal(pixel.shadow, spots[i].lit ? 1 : 0, 0);
            assert_float_equal(pixel.color[0], spots[i].lit ? 0.75 : 0.25, 1e-9);
        }
        /* The ball's underside is a mirror: straight down it shows the lit or the dark floor. */
        effects_fixture_close(&f);
        effects_fixture_open(&f, field, vec3_make(0, -1.5 * s, 0.2 * s), vec3_make(0, 0, 0.2 * s), &look);
        f.scene.solids = &files.set;
        effects_pixel pixel = effects_fixture_shade(&f, vec3_make(0, 1, 0), NULL);
        assert_true(pixel.certain && isfinite(pixel.mirror));
        double height = sqrt(edge * edge - 0.04 * s * s);
        assert_true(pixel.mirror * field_unit(field) > 2 * s - height);
        effects_fixture_close(&f);
        solid_files_free(&files);
        mns_field_destroy(field);
        unlink(path);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tree_finds_what_every_triangle_gives),
        cmocka_unit_test(no_ray_slips_between_two_triangles),
        cmocka_unit_test(a_ray_that_leaves_a_triangle_does_not_meet_it),
        cmocka_unit_test(of_meshes_in_one_plane_the_first_is_seen),
        cmocka_unit_test(how_many_lie_in_one_place_does_not_matter),
        cmocka_unit_test(a_floor_is_seen_shadowed_and_mirrored),
    };
    return cmocka_run_group_tests_name("solids", tests, NULL, NULL);
}
