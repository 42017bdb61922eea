/* Mesh files: read, refused with a reason, by several threads at once, and again where they changed. */
#include "solid/solid_files.h"
#include "support/mesh_file.h"

#include <fcntl.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const char cube[] =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

static mns_status read_text(const char *ending, const char *text, mns_mesh_info *info, mns_error *error)
{
    mesh_path path;
    mesh_write(ending, text, path);
    mns_status status = mns_mesh_get_info(path, info, error);
    unlink(path);
    return status;
}

static void files_are_read(void **state)
{
    (void)state;
    static const struct {
        const char *ending, *text;
        size_t triangles, corners, dropped;
        double hi[3];
    } cases[] = {
        {".obj", cube, 12, 8, 0, {1, 1, 1}},
        {".obj", "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 1 0 0\nf 1 2 3\nf 1 4 2\nf 1 1 2\n", 1, 3, 2, {2, 3, 0}},
        {".ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 4\n3 0 1 2\n",
         1,
         3,
         0,
         {1, 1, 4}},
        {".stl",
         "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
         "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
         "endfacet\nendsolid one\n",
         2,
         4,
         0,
         {1, 1, 0}},
        /* A node that turns x to y, doubles it, and moves it by 10 along x. */
        {".gltf",
         "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
         "\"nodes\":[{\"mesh\":0,\"matrix\":[0,2,0,0,-2,0,0,0,0,0,2,0,10,0,0,1]}],"
         "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":4}]}],"
         "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
         "\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
         "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
         1,
         3,
         0,
         {10, 2, 0}},
    };
    if (!mesh_is_built_in()) skip();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_mesh_info info;
        mns_error error;
        if (read_text(cases[i].ending, cases[i].text, &info, &error)) fail_msg("%zu: %s", i, error.text);
        assert_int_equal(info.triangles, cases[i].triangles);
        assert_int_equal(info.corners, cases[i].corners);
        assert_int_equal(info.dropped, cases[i].dropped);
        for (int a = 0; a < 3; a++) assert_float_equal(info.hi[a], cases[i].hi[a], 1e-6);
    }
}

static void bad_files_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *ending, *text, *says;
    } cases[] = {
        {".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "expected a mesh"},
        {".obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", "no triangles"},
        {".obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangles"},
        {".obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n", "not finite"},
        {".stl", "solid\nfacet\n", "expected a mesh"},
        {".xyzzy", "anything", "expected a mesh"},
        {".gltf", "{\"asset\":", "expected a mesh"},
    };
    if (!mesh_is_built_in()) skip();
    mns_mesh_info info;
    mns_error error;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (read_text(cases[i].ending, cases[i].text, &info, &error) != MNS_ERROR_INPUT)
            fail_msg("case %zu was taken", i);
        if (!strstr(error.text, cases[i].says)) fail_msg("case %zu: %s", i, error.text);
    }
    assert_int_equal(mns_mesh_get_info("/nowhere/a.obj", &info, &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "/nowhere/a.obj"));
    assert_int_equal(mns_mesh_get_info(NULL, &info, &error), MNS_ERROR_USAGE);
}

/* Reads a bad file over and over; NULL, or what was said of another. */
static void *read_bad_file(void *context)
{
    static const char not_own[] = "another file's failure";
    const char *path = context, *name = strrchr(path, '/') + 1;
    for (int i = 0; i < 300; i++) {
        mns_mesh_info info;
        mns_error error;
        if (mns_mesh_get_info(path, &info, &error) != MNS_ERROR_INPUT) return (void *)(uintptr_t)not_own;
        const char *reason = strstr(error.text, "glTF): ");
        if (!reason || !strstr(reason, name)) return (void *)(uintptr_t)not_own;
    }
    return NULL;
}

/* assimp has one text for all failures; each thread is told of its own file all the same. */
static void threads_are_told_of_their_own_files(void **state)
{
    (void)state;
    enum { THREADS = 4 };
    pthread_t thread[THREADS];
    mesh_path path[THREADS];
    void *wrong[THREADS];
    if (!mesh_is_built_in()) skip();
    for (int i = 0; i < THREADS; i++) mesh_write(".xyzzy", "anything", path[i]);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&thread[i], NULL, read_bad_file, path[i]), 0);
    for (int i = 0; i < THREADS; i++) pthread_join(thread[i], &wrong[i]);
    for (int i = 0; i < THREADS; i++) {
        unlink(path[i]);
        assert_null(wrong[i]);
    }
}

/* The triangle's places in a file of their own, which changes. */
static void a_file_that_a_mesh_names_is_watched_too(void **state)
{
    (void)state;
    const float before[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, after[9] = {0, 0, 0, 1, 0, 0, 0, 0.5f, 0};
    const mns_mesh_info none = {0};
    mns_mesh_info info[2] = {none, none};
    mesh_path path, places;
    char text[600];
    mns_error error;
    solid_files files = {0};
    if (!mesh_is_built_in()) skip();
    mesh_write(".bin", "", places);
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":4}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}]}",
        strrchr(places, '/') + 1);
    mesh_write(".gltf", text, path);
    const mns_mesh mesh = {.file = path};
    uint64_t version = 0;
    for (int i = 0; i < 2; i++) {
        FILE *file = fopen(places, "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(i ? after : before, sizeof before, 1, file), 1);
        fclose(file);
        const struct timespec written[2] = {{.tv_sec = 1000 + i}, {.tv_sec = 1000 + i}};
        assert_int_equal(utimensat(AT_FDCWD, places, written, 0), 0); /* whatever a clock's tick is */
        if (solid_files_take(&files, &mesh, 1, 1, &error)) fail_msg("%s", error.text);
        assert_true(files.version != version);
        version = files.version;
        assert_float_equal(files.set.hi[1], i ? 0.5 : 1, 0);
        if (solid_files_take(&files, &mesh, 1, 1, &error)) fail_msg("%s", error.text);
        assert_int_equal(files.version, version);
        if (mns_mesh_get_info(path, &info[i], &error)) fail_msg("%s", error.text);
    }
    assert_true(info[0].fingerprint != info[1].fingerprint);
    unlink(places);
    assert_int_equal(solid_files_take(&files, &mesh, 1, 1, &error), MNS_ERROR_INPUT);
    unlink(path);
    solid_files_free(&files);
}

static void files_are_read_again_where_they_changed(void **state)
{
    (void)state;
    mesh_path path;
    mns_error error;
    solid_files files = {0};
    if (!mesh_is_built_in()) skip();
    mesh_write(".obj", cube, path);
    const mns_mesh mesh[2] = {{.file = path}, {.file = path}};
    assert_int_equal(solid_files_take(&files, mesh, 2, 1, &error), MNS_OK);
    uint64_t first = files.version;
    assert_int_equal(files.set.triangle_count, 24);
    assert_int_equal(solid_files_take(&files, mesh, 2, 1, &error), MNS_OK);
    assert_int_equal(files.version, first);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("v 0 0 0\nv 2 0 0\nv 0 3 0\nf 1 2 3\n", file);
    fclose(file);
    assert_int_equal(solid_files_take(&files, mesh, 2, 1, &error), MNS_OK);
    assert_true(files.version != first);
    assert_int_equal(files.set.triangle_count, 2);
    unlink(path);
    assert_int_equal(solid_files_take(&files, mesh, 2, 1, &error), MNS_ERROR_IO);
    assert_int_equal(files.set.triangle_count, 0);
    solid_files_free(&files);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_read),
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(threads_are_told_of_their_own_files),
        cmocka_unit_test(a_file_that_a_mesh_names_is_watched_too),
        cmocka_unit_test(files_are_read_again_where_they_changed),
    };
    return cmocka_run_group_tests_name("mesh files", tests, NULL, NULL);
}
