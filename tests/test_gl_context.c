/* Contexts without a window: made, lost and made again, two at once, back ends side by side. */
#include "base/status.h"
#include "gl/context.h"
#include "support/gl_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

typedef struct probe { /* a context and its functions */
    mns_context *context;
    GladGLContext gl;
} probe;

static probe open_probe(mns_backend backend)
{
    probe p = {0};
    mns_error error = {0};
    mns_status status = mns_context_create(backend, &p.context, &error);
    if (status != MNS_OK) fail_msg("%s", error.text);
    assert_int_not_equal(gladLoadGLContext(&p.gl, mns_context_get_proc(p.context)), 0);
    return p;
}

static void make_current(probe *p)
{
    mns_error error = {0};
    if (mns_context_make_current(p->context, &error) != MNS_OK) fail_msg("%s", error.text);
}

static void close_probe(probe *p)
{
    mns_context_destroy(p->context);
    *p = (probe){0};
}

/* Each context has its own clear colour: it tells which one is really current. */
static void mark(probe *p, float red)
{
    make_current(p);
    p->gl.ClearColor(red, 0, 0, 0);
}

static float read_mark(probe *p)
{
    float color[4] = {-1, -1, -1, -1};
    make_current(p);
    p->gl.GetFloatv(GL_COLOR_CLEAR_VALUE, color);
    return color[0];
}

static void context_is_core_4_3_or_later(void **state)
{
    gl_fixture *f = *state;
    GLint major = 0, minor = 0, profile = 0;
    f->gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    f->gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    f->gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    assert_true(major > 4 || (major == 4 && minor >= 3));
    assert_int_equal(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    assert_true(strlen(mns_context_name(f->context)) > 0);
    gl_fixture_check(f);
}

static void context_name_tells_the_back_end(void **state)
{
    gl_fixture *f = *state;
    const char *name = mns_context_name(f->context);
    if (f->backend == MNS_BACKEND_EGL) assert_int_equal(strncmp(name, "egl ", 4), 0);
    if (f->backend == MNS_BACKEND_OSMESA) assert_string_equal(name, "osmesa");
    if (f->backend == MNS_BACKEND_GLFW) assert_string_equal(name, "glfw");
}

static void context_draws_into_a_framebuffer(void **state)
{
    gl_fixture *f = *state;
    GLuint texture = 0, framebuffer = 0;
    float pixel[4] = {0};
    f->gl.GenTextures(1, &texture);
    f->gl.BindTexture(GL_TEXTURE_2D, texture);
    f->gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, 64, 64);
    f->gl.GenFramebuffers(1, &framebuffer);
    f->gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    f->gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    assert_int_equal(f->gl.CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    f->gl.ClearColor(0.25f, 0.5f, 0.75f, 1);
    f->gl.Clear(GL_COLOR_BUFFER_BIT);
    f->gl.ReadPixels(63, 63, 1, 1, GL_RGBA, GL_FLOAT, pixel);
    assert_true(pixel[0] == 0.25f && pixel[1] == 0.5f && pixel[2] == 0.75f && pixel[3] == 1);
    f->gl.DeleteFramebuffers(1, &framebuffer);
    f->gl.DeleteTextures(1, &texture);
    gl_fixture_check(f);
}

static void two_contexts_live_at_once(void **state)
{
    gl_fixture *f = *state;
    probe a = open_probe(f->backend), b = open_probe(f->backend);
    mark(&a, 0.25f);
    mark(&b, 0.5f);
    assert_true(read_mark(&a) == 0.25f);
    assert_true(read_mark(&b) == 0.5f);
    close_probe(&a); /* not the current one */
    assert_true(read_mark(&b) == 0.5f);
    close_probe(&b);
    mns_error error;
    assert_int_equal(mns_context_make_current(f->context, &error), MNS_OK);
}

/* Mesa's EGL and OSMesa share one slot for the current context, each with its own idea of what is in it. */
static void back_ends_work_side_by_side(void **state)
{
    static const mns_backend all[] = {MNS_BACKEND_EGL, MNS_BACKEND_OSMESA, MNS_BACKEND_GLFW};
    gl_fixture *f = *state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        mns_context *other = NULL;
        if (mns_context_create(all[i], &other, NULL) != MNS_OK) {
            assert_null(other);
            continue;
        }
        mns_context_destroy(other);
        probe mine = open_probe(f->backend), theirs = open_probe(all[i]);
        mark(&mine, 0.125f);
        mark(&theirs, 0.875f);
        for (int turn = 0; turn < 3; turn++) {
            assert_true(read_mark(&mine) == 0.125f);
            assert_true(read_mark(&theirs) == 0.875f);
        }
        close_probe(&theirs); /* while current */
        assert_true(read_mark(&mine) == 0.125f);
        close_probe(&mine);
    }
    mns_error error;
    assert_int_equal(mns_context_make_current(f->context, &error), MNS_OK);
}

static long resident_kib(void)
{
    long kib = -1;
    char line[256];
    FILE *file = fopen("/proc/self/status", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file))
        if (sscanf(line, "VmRSS: %ld", &kib) == 1) break;
    fclose(file);
    assert_true(kib > 0);
    return kib;
}

static void contexts_made_again_and_again_do_not_grow(void **state)
{
    enum { WARM = 5, ROUNDS = 20, GROWTH_KIB = 4096 };
    gl_fixture *f = *state;
    long before = 0;
    for (int round = 0; round < WARM + ROUNDS; round++) {
        if (round == WARM) before = resident_kib();
        probe p = open_probe(f->backend);
        assert_non_null(p.gl.GetString(GL_VERSION));
        close_probe(&p);
    }
    long grown = resident_kib() - before;
    print_message("%d contexts: %ld KiB more\n", ROUNDS, grown);
#ifndef __SANITIZE_ADDRESS__ /* which keeps what is freed */
    assert_true(grown < GROWTH_KIB);
#endif
    mns_error error;
    assert_int_equal(mns_context_make_current(f->context, &error), MNS_OK);
}

static void description_tells_version_and_limits(void **state)
{
    gl_fixture *f = *state;
    char *text = mns_backend_describe(f->backend), block[64];
    mns_error error;
    GLint64 bytes = 0;
    assert_non_null(text);
    assert_int_equal(mns_context_make_current(f->context, &error), MNS_OK);
    f->gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    snprintf(block, sizeof block, "storage block       %lld bytes", (long long)bytes);
    assert_non_null(strstr(text, (const char *)f->gl.GetString(GL_VERSION)));
    assert_non_null(strstr(text, (const char *)f->gl.GetString(GL_RENDERER)));
    assert_non_null(strstr(text, block));
    assert_non_null(strstr(text, mns_context_name(f->context)));
    assert_int_not_equal(text[strlen(text) - 1], '\n');
    free(text);
}

/* What a program of its own prints that asks for a context of `backend`: Mesa reads its environment only
 * once. */
static void run_attempt(const char *environment, const char *backend, char *line, int size)
{
    char self[512] = "", command[1024];
    assert_true(readlink("/proc/self/exe", self, sizeof self - 1) > 0);
    snprintf(command, sizeof command, "%s MNS_TEST_BACKEND=%s '%s' attempt", environment, backend, self);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    assert_non_null(fgets(line, size, pipe));
    pclose(pipe);
}

static int attempt(void)
{
    mns_context *context = NULL;
    mns_error error = {0};
    mns_status status = mns_context_create(gl_fixture_backend(), &context, &error);
    printf("%d %s\n", (int)status, status == MNS_OK ? mns_context_name(context) : error.text);
    mns_context_destroy(context);
    return 0;
}

static void old_driver_is_told_from_an_absent_one(void **state)
{
    gl_fixture *f = *state;
    char line[600], expected[8];
    if (!strstr((const char *)f->gl.GetString(GL_VERSION), "Mesa"))
        skip(); /* only Mesa can play an old driver */
    snprintf(expected, sizeof expected, "%d ", MNS_ERROR_GL);
    run_attempt("MESA_GL_VERSION_OVERRIDE=4.2",
                getenv("MNS_TEST_BACKEND") ? getenv("MNS_TEST_BACKEND") : "auto", line, sizeof line);
    assert_int_equal(strncmp(line, expected, strlen(expected)), 0);
    assert_non_null(strstr(line, "version too old"));
}

static void auto_tells_every_back_end_tried(void **state)
{
    gl_fixture *f = *state;
    char line[600];
    if (!strstr((const char *)f->gl.GetString(GL_VERSION), "Mesa")) skip();
    run_attempt("DISPLAY= WAYLAND_DISPLAY= MESA_GL_VERSION_OVERRIDE=4.2", "auto", line, sizeof line);
    assert_non_null(strstr(line, "no OpenGL 4.3 context"));
    assert_non_null(strstr(line, "EGL: "));
    assert_non_null(strstr(line, "; OSMesa: "));
    assert_non_null(strstr(line, "; GLFW: "));
}

static void unknown_back_end_is_a_usage_error(void **state)
{
    mns_context *context = NULL;
    mns_error error = {0};
    (void)state;
    assert_int_equal(mns_context_create((mns_backend)99, &context, &error), MNS_ERROR_USAGE);
    assert_null(context);
    assert_non_null(strstr(error.text, "99"));
}

static void destroy_takes_null(void **state)
{
    (void)state;
    mns_context_destroy(NULL);
}

int main(int count, char **argument)
{
    if (count > 1 && !strcmp(argument[1], "attempt")) return attempt();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(context_is_core_4_3_or_later),
        cmocka_unit_test(context_name_tells_the_back_end),
        cmocka_unit_test(context_draws_into_a_framebuffer),
        cmocka_unit_test(two_contexts_live_at_once),
        cmocka_unit_test(back_ends_work_side_by_side),
        cmocka_unit_test(contexts_made_again_and_again_do_not_grow),
        cmocka_unit_test(description_tells_version_and_limits),
        cmocka_unit_test(old_driver_is_told_from_an_absent_one),
        cmocka_unit_test(auto_tells_every_back_end_tried),
        cmocka_unit_test(unknown_back_end_is_a_usage_error),
        cmocka_unit_test(destroy_takes_null),
    };
    return cmocka_run_group_tests(tests, gl_fixture_setup, gl_fixture_teardown);
}
