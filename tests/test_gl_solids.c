/* Solid meshes drawn on the GPU, against the truth's: which mesh is seen where, distances, terms and colours,
 * at every scale, inside the medium too; and nothing of them where there are none. */
#include "render/render.h"
#include "support/light_fixture.h"
#include "support/mesh_file.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const mns_light sun = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 2, 1.5}};

typedef struct files {
    mesh_path floor, box;
    mns_mesh mesh[2];
} files;

/* A floor under the field, and a tetrahedron at `at`, all times `size`. */
static void write_files(files *f, double size, const double at[3])
{
    char text[600];
    double x = at[0] * size, y = at[1] * size, z = at[2] * size, s = 0.25 * size;
    snprintf(text, sizeof text,
             "v %.9g %.9g %.9g\nv %.9g %.9g %.9g\nv %.9g %.9g %.9g\nv %.9g %.9g %.9g\nf 1 2 3 4\n", -2 * size,
             -0.3 * size, -2 * size, -2 * size, -0.3 * size, 2 * size, 2 * size, -0.3 * size, 2 * size,
             2 * size, -0.3 * size, -2 * size);
    mesh_write(".obj", text, f->floor);
    snprintf(text, sizeof text,
             "v %.9g %.9g %.9g\nv %.9g %.9g %.9g\nv %.9g %.9g %.9g\nv %.9g %.9g %.9g\nf 1 2 3\nf 2 4 3\nf 4 "
             "1 3\nf 1 4 "
             "2\n",
             x - s, y - s, z - s, x + s, y - s, z - s, x, y + s, z, x, y - s, z + s);
    mesh_write(".obj", text, f->box);
    f->mesh[0] = (mns_mesh){.file = f->floor};
    f->mesh[1] = (mns_mesh){.file = f->box, .has_color = true, .color = {0.9, 0.3, 0.2}};
}

/* The sun, on both. */
#define TWO_MESHES(f) .lights = &sun, .light_count = 1, .meshes = (f).mesh, .mesh_count = 2

static void drop_files(const files *f)
{
    unlink(f->floor);
    unlink(f->box);
}

/* ---- Against the truth ---- */

/* Pixels that are open, wrong, and of another colour. */
typedef struct tally {
    int seen[3], open, wrong, off; /* seen: nothing or the surface, the floor, the other mesh */
} tally;

/* Of a length: a card's quotients and roots are off by two units in the last place, and a mirror doubles
 * that. */
static double allowed(const draw_fixture *d)
{
    return mns_renderer_limits(d->renderer)->is_software ? 1e-5 : 2e-5;
}

static double term(const float *plane, int i)
{
    return plane ? (double)plane[i] : NAN;
}

static tally compare(const mns_image *got, const mns_image *want, double length)
{
    tally sum = {.open = 0};
    for (int i = 0; i < LIGHT_PIXELS; i++) {
        sum.seen[(int)want->mesh[i]]++;
        if (light_is_open(got, want, i)) {
            sum.open++;
            continue;
        }
        bool wrong = got->mesh[i] != want->mesh[i] || light_differs(got->t, want->t, i, length) ||
                     light_terms_differ(got, want, i, length);
        for (int c = 0; c < 3; c++)
            wrong = wrong || light_differs(got->normal, want->normal, 3 * i + c, 1e-4);
        if (wrong)
            print_message("pixel %d: mesh %g, %g; t %.9g, %.9g; shadow %g, %g; mirrored %.9g, %.9g\n", i,
                          (double)got->mesh[i], (double)want->mesh[i], (double)got->t[i], (double)want->t[i],
                          term(got->shadow, i), term(want->shadow, i), term(got->mirror_t, i),
                          term(want->mirror_t, i));
        sum.wrong += wrong;
        sum.off += light_colors_differ(got, want, i, 3e-3);
    }
    return sum;
}

static tally against_truth(draw_fixture *d, const mns_field *field, const mns_view *view,
                           const mns_look *look, const mns_options *options, double length)
{
    mns_image *want = draw_image(d, field, view, look, &light_truth);
    mns_image *got = draw_image(d, field, view, look, options);
    tally sum = compare(got, want, length);
    mns_image_destroy(want);
    mns_image_destroy(got);
    return sum;
}

static void expect_truth(draw_fixture *d, const mns_field *field, const mns_view *view, const mns_look *look,
                         const mns_options *options, double length, int off, const char *what)
{
    tally sum = against_truth(d, field, view, look, options, length);
    if (sum.wrong || sum.off > off || sum.open > 4)
        fail_msg("%s: %d open, %d wrong, %d of another colour", what, sum.open, sum.wrong, sum.off);
    if (sum.seen[0] < 100 || sum.seen[1] < 100 || sum.seen[2] < 20)
        fail_msg("%s: %d pixels of surface or nothing, %d of the floor, %d of the mesh", what, sum.seen[0],
                 sum.seen[1], sum.seen[2]);
}

static mns_field *three_balls(double size)
{
    const double at[9] = {0, 0, 0, 0.4 * size, 0.1 * size, 0, -0.3 * size, 0, 0.2 * size};
    return draw_field(3, at, NULL, 0.6 * size, NULL, MNS_KERNEL_POLY3);
}

static mns_view view_of(double size)
{
    const double eye[3] = {0.5 * size, 0.8 * size, 2.2 * size}, at[3] = {0.1 * size, 0, 0};
    return draw_view(eye, at, 45, LIGHT_WIDTH, LIGHT_HEIGHT);
}

static void meshes_are_lit_and_mirrored_at_every_scale(void **state)
{
    draw_fixture *d = *state;
    static const double beside[3] = {0.7, 0, 0.1};
    if (!mesh_is_built_in()) skip();
    for (double size = 1e-6; size < 1e7; size *= 1e6) {
        files f;
        char what[64];
        write_files(&f, size, beside);
        mns_field *field = three_balls(size);
        const mns_view view = view_of(size);
        const mns_look look = {
            TWO_MESHES(f),
            .effects = {.shadows = true, .reflections = 2, .mirror = 0.5, .occlusion_rays = 4}};
        for (int method = 0; method < 2; method++) {
            const mns_options options = {.method = method ? MNS_METHOD_TILE : MNS_METHOD_FBVH};
            snprintf(what, sizeof what, "size %g, method %d", size, method);
            expect_truth(d, field, &view, &look, &options, allowed(d) * size, 2, what);
            if (light_is_second(d)) break;
        }
        mns_field_destroy(field);
        drop_files(&f);
        if (light_is_second(d)) break;
    }
}

/* The mesh is in the medium, which bends what is seen of it and absorbs. */
static void a_mesh_in_glass_is_seen_through_it(void **state)
{
    draw_fixture *d = *state;
    static const double within[3] = {0.05, 0, 0};
    files f;
    if (!mesh_is_built_in() || light_is_second(d)) skip();
    write_files(&f, 1, within);
    mns_field *field = three_balls(1);
    const mns_options options = {.method = MNS_METHOD_FBVH};
    const mns_look look = {
        TWO_MESHES(f),
        .effects = {
            .reflections = 1, .refractions = 4, .index = 1.4, .absorption = {1, 2, 3}, .occlusion_rays = 2}};
    mns_view view = view_of(1);
    tally sum = against_truth(d, field, &view, &look, &options, 1e-4);
    if (sum.wrong || sum.off > 6 || sum.open > 4)
        fail_msg("%d open, %d wrong, %d off", sum.open, sum.wrong, sum.off);
    /* And from within: the eye beside the mesh. */
    const double eye[3] = {0.35, 0.1, 0.12}, at[3] = {0, 0, 0};
    view = draw_view(eye, at, 60, LIGHT_WIDTH, LIGHT_HEIGHT);
    sum = against_truth(d, field, &view, &look, &options, 1e-4);
    if (sum.wrong || sum.off > 8 || sum.open > 8)
        fail_msg("inside: %d open, %d wrong, %d off", sum.open, sum.wrong, sum.off);
    assert_true(sum.seen[2] > 100);
    mns_field_destroy(field);
    drop_files(&f);
}

/* A bumpy sheet of about a hundred thousand triangles under the field, in place of the floor. */
static void write_sheet(mesh_path path)
{
    enum { SIDE = 224 };
    mesh_write(".obj", "", path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int column = i % SIDE, row = i / SIDE;
        double x = 4.0 * column / SIDE - 2, z = 4.0 * row / SIDE - 2;
        fprintf(file, "v %.6f %.6f %.6f\n", x, -0.4 + 0.1 * sin(31 * x) * sin(37 * z), z);
    }
    for (int i = 1; i < SIDE * (SIDE - 1); i++)
        if (i % SIDE)
            fprintf(file, "f %d %d %d\nf %d %d %d\n", i, i + SIDE, i + 1, i + 1, i + SIDE, i + SIDE + 1);
    assert_int_equal(fclose(file), 0);
}

/* Whose walks are long: each dispatch takes its part of them, and no driver's cut is come near. */
static void a_mesh_of_many_triangles_is_walked_in_parts(void **state)
{
    draw_fixture *d = *state;
    static const double beside[3] = {0.7, 0, 0.1};
    files f;
    if (!mesh_is_built_in() || light_is_second(d)) skip();
    write_files(&f, 1, beside);
    unlink(f.floor);
    write_sheet(f.floor);
    mns_field *field = three_balls(1);
    const mns_options options = {.method = MNS_METHOD_FBVH};
    const mns_view view = view_of(1);
    const mns_look look = {
        TWO_MESHES(f),
        .effects = {
            .shadows = true, .reflections = 1, .mirror = 0.5, .occlusion_rays = 64, .occlusion_reach = 4}};
    expect_truth(d, field, &view, &look, &options, 1e-5, 2, "a sheet");
    mns_field_destroy(field);
    drop_files(&f);
}

/* From a hundred thousand radii away a mesh in the surface is as certain as from nearby. */
static void a_far_eye_is_certain_of_a_mesh(void **state)
{
    draw_fixture *d = *state;
    static const double within[3] = {0.55, 0.05, 0.2}, at[3] = {0.1, 0, 0};
    files f;
    if (!mesh_is_built_in()) skip();
    write_files(&f, 1, within);
    mns_field *field = three_balls(1);
    const mns_look look = {.lights = &sun, .light_count = 1, .meshes = f.mesh, .mesh_count = 2};
    for (int k = 0; k < 4; k++) {
        double away = k < 2 ? 1e5 : 3e3;
        const double eye[3] = {0.5 * away, 0.8 * away, 2.2 * away};
        const mns_options options = {.method = k & 1 ? MNS_METHOD_TILE : MNS_METHOD_FBVH};
        const mns_view view = draw_view(eye, at, 45 / away, LIGHT_WIDTH, LIGHT_HEIGHT);
        tally sum = against_truth(d, field, &view, &look, &options, 1e-4);
        if (sum.wrong || sum.off > 2 || sum.open > 2)
            fail_msg("%g away, %d: %d open, %d wrong, %d off", away, k & 1, sum.open, sum.wrong, sum.off);
        if (sum.seen[0] < 100 || sum.seen[1] < 100 || sum.seen[2] < 10)
            fail_msg("seen %d %d %d", sum.seen[0], sum.seen[1], sum.seen[2]);
        if (light_is_second(d)) break;
    }
    mns_field_destroy(field);
    drop_files(&f);
}

/* A floor so large that floats do not hold its normal's square still stops the rays from beside it. */
static void a_floor_as_wide_as_floats_allow_is_met(void **state)
{
    draw_fixture *d = *state;
    static const double beside[3] = {0.7, 0.3, 0.1};
    files f;
    if (!mesh_is_built_in() || light_is_second(d)) skip();
    write_files(&f, 1, beside);
    unlink(f.floor);
    mesh_write(".obj", "v -3e9 -0.3 -3e9\nv -3e9 -0.3 3e9\nv 3e9 -0.3 3e9\nv 3e9 -0.3 -3e9\nf 1 2 3 4\n",
               f.floor);
    mns_field *field = three_balls(1);
    const mns_view view = view_of(1);
    const mns_options options = {.method = MNS_METHOD_FBVH};
    const mns_look look = {TWO_MESHES(f), .effects = {.occlusion_rays = 8, .occlusion_reach = 4}};
    tally sum = against_truth(d, field, &view, &look, &options, 1e-2);
    if (sum.wrong || sum.off || sum.open > 30)
        fail_msg("%d open, %d wrong, %d off", sum.open, sum.wrong, sum.off);
    assert_true(sum.seen[1] > 500 && sum.seen[2] > 20);
    mns_field_destroy(field);
    drop_files(&f);
}

/* A plate seen through a hole in a ceiling so wide that floats would take the one for a part of the other:
 * the ceiling's shadow lies on it. */
static void a_wide_ceiling_close_above_shadows(void **state)
{
    draw_fixture *d = *state;
    static const double away[3] = {5, -3, 0}, eye[3] = {0, 1, 1e-3}, at[3] = {0};
    const mns_light low = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 0.18, 0.1}};
    files f;
    if (!mesh_is_built_in() || light_is_second(d)) skip();
    mesh_write(".obj",
               "v -1e5 0.02 -1e5\nv 1e5 0.02 -1e5\nv 1e5 0.02 1e5\nv -1e5 0.02 1e5\n"
               "v -0.1 0.02 -0.1\nv 0.1 0.02 -0.1\nv 0.1 0.02 0.1\nv -0.1 0.02 0.1\n"
               "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
               f.floor);
    mesh_write(".obj", "v -0.4 0 -0.4\nv -0.4 0 0.4\nv 0.4 0 0.4\nv 0.4 0 -0.4\nf 1 2 3 4\n", f.box);
    f.mesh[0] = (mns_mesh){.file = f.floor};
    f.mesh[1] = (mns_mesh){.file = f.box};
    mns_field *field = draw_field(1, away, NULL, 0.6, NULL, MNS_KERNEL_POLY3);
    const mns_view view = draw_view(eye, at, 14, LIGHT_WIDTH, LIGHT_HEIGHT);
    const mns_look look = {
        .lights = &low, .light_count = 1, .meshes = f.mesh, .mesh_count = 2, .effects = {.shadows = true}};
    tally sum = against_truth(d, field, &view, &look, &(mns_options){.method = MNS_METHOD_FBVH}, 1e-5);
    if (sum.wrong || sum.off || sum.open > 30)
        fail_msg("%d open, %d wrong, %d off", sum.open, sum.wrong, sum.off);
    assert_true(sum.seen[1] > 300 && sum.seen[2] > 500);
    mns_field_destroy(field);
    drop_files(&f);
}

/* A rug in the floor's plane: the one that is named first is seen, by the eye and in the mirror. */
static void of_meshes_in_one_plane_the_first_is_seen(void **state)
{
    draw_fixture *d = *state;
    static const double beside[3] = {0.7, 0, 0.1};
    files f;
    if (!mesh_is_built_in()) skip();
    write_files(&f, 1, beside);
    unlink(f.box);
    mesh_write(".obj", "v -0.7 -0.3 -0.9\nv -0.8 -0.3 1.1\nv 0.9 -0.3 0.8\nf 1 2 3\n", f.box);
    mns_field *field = three_balls(1);
    const mns_view view = view_of(1);
    const mns_options options = {.method = MNS_METHOD_FBVH};
    mns_mesh mesh[2] = {f.mesh[0], f.mesh[1]};
    const mns_look look = {.lights = &sun,
                           .light_count = 1,
                           .meshes = mesh,
                           .mesh_count = 2,
                           .effects = {.shadows = true, .reflections = 1, .mirror = 0.5}};
    for (int rug = 0; rug < 2; rug++) {
        mesh[rug] = f.mesh[1], mesh[1 - rug] = f.mesh[0];
        tally sum = against_truth(d, field, &view, &look, &options, allowed(d));
        if (sum.wrong || sum.off > 2 || sum.open > 4)
            fail_msg("rug %d: %d open, %d wrong, %d off", rug, sum.open, sum.wrong, sum.off);
        assert_true(rug ? sum.seen[1] > 100 && sum.seen[2] == 0 : sum.seen[1] > 100 && sum.seen[2] > 100);
        if (light_is_second(d)) break;
    }
    mns_field_destroy(field);
    drop_files(&f);
}

/* Meshes that stay while their colours change, and while the field goes elsewhere, are where they were and of
 * the new colours. */
static void what_changed_of_meshes_is_sent_anew(void **state)
{
    draw_fixture *d = *state;
    static const double beside[3] = {0.7, 0, 0.1}, elsewhere[3] = {-0.3, 0.2, -0.1};
    files f;
    if (!mesh_is_built_in() || light_is_second(d)) skip();
    write_files(&f, 1, beside);
    mns_field *fields[2] = {three_balls(1), draw_field(1, elsewhere, NULL, 0.6, NULL, MNS_KERNEL_POLY3)};
    const mns_view view = view_of(1);
    const mns_options options = {.method = MNS_METHOD_FBVH};
    const mns_look look = {TWO_MESHES(f), .effects = {.shadows = true, .reflections = 1, .mirror = 0.5}};
    for (int k = 0; k < 3; k++) {
        const char *const what[] = {"at first", "other colours", "another field"};
        if (k == 1) f.mesh[1].color[1] = 0.8, f.mesh[0].has_color = true, f.mesh[0].color[2] = 0.7;
        expect_truth(d, fields[k / 2], &view, &look, &options, allowed(d), 2, what[k]);
    }
    for (int k = 0; k < 2; k++) mns_field_destroy(fields[k]);
    drop_files(&f);
}

/* ---- What is there and what is not ---- */

/* A plain picture beside a mesh: of the surface every pixel that no mesh hides is as it is without, and no
 * ray is traced; without a mesh nothing of it is made. */
static void what_no_mesh_hides_stays_as_it_is(void **state)
{
    draw_fixture *d = *state;
    static const double beside[3] = {0.7, 0, 0.1};
    files f;
    if (!mesh_is_built_in()) skip();
    write_files(&f, 1, beside);
    mns_field *field = three_balls(1);
    const mns_view view = view_of(1);
    const mns_options options = {.method = MNS_METHOD_TILE, .samples = 2};
    mns_look look = {.lights = &sun, .light_count = 1};
    mns_image *bare = draw_image(d, field, &view, &look, &options);
    assert_null(bare->mesh);
    assert_true(d->frame->mesh == 0 && d->renderer->effects.solids.buffer.id == 0 &&
                d->renderer->effects.solids.texture == 0 && d->renderer->solids.count == 0);
    look.meshes = f.mesh, look.mesh_count = 2;
    mns_image *image = draw_image(d, field, &view, &look, &options);
    assert_true(d->renderer->effects.solids.buffer.id != 0 && d->stats.effects_rays == 0);
    int surface = 0, meshes = 0;
    for (int i = 0; i < LIGHT_PIXELS; i++) {
        meshes += image->mesh[i] > 0;
        if (image->mesh[i] > 0) {
            assert_true(image->t[i] < bare->t[i]);
            continue;
        }
        assert_true(image->t[i] == bare->t[i] && image->certain[i] == bare->certain[i]);
        surface += !isinf(image->t[i]);
    }
    assert_true(surface > 100 && meshes > 300);
    /* Through a file and back. */
    char path[] = "/tmp/solids-XXXXXX.exr";
    mns_error error;
    mns_image *read = NULL;
    int file = mkstemps(path, 4);
    assert_true(file >= 0);
    close(file);
    if (mns_image_write(image, path, &error) || mns_image_read(path, &read, &error))
        fail_msg("%s", error.text);
    assert_memory_equal(read->mesh, image->mesh, LIGHT_PIXELS * sizeof(float));
    unlink(path);
    mns_image_destroy(read);
    /* The same again has the same bits; a file that went is told. */
    mns_image *again = draw_image(d, field, &view, &look, &options);
    draw_expect_same(image, again, "again");
    drop_files(&f);
    for (int method = 0; method < 2; method++) {
        const mns_options *by = method ? &light_truth : &options;
        assert_int_equal(mns_renderer_draw(d->renderer, field, &view, &look, by, d->frame, &error),
                         MNS_ERROR_IO);
        assert_non_null(strstr(error.text, f.floor));
    }
    mns_image_destroy(again);
    mns_image_destroy(bare);
    mns_image_destroy(image);
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_no_mesh_hides_stays_as_it_is),
        cmocka_unit_test(meshes_are_lit_and_mirrored_at_every_scale),
        cmocka_unit_test(a_mesh_in_glass_is_seen_through_it),
        cmocka_unit_test(a_mesh_of_many_triangles_is_walked_in_parts),
        cmocka_unit_test(a_far_eye_is_certain_of_a_mesh),
        cmocka_unit_test(a_floor_as_wide_as_floats_allow_is_met),
        cmocka_unit_test(a_wide_ceiling_close_above_shadows),
        cmocka_unit_test(of_meshes_in_one_plane_the_first_is_seen),
        cmocka_unit_test(what_changed_of_meshes_is_sent_anew),
    };
    return cmocka_run_group_tests_name("solids, drawn", tests, draw_fixture_setup, draw_fixture_teardown);
}
