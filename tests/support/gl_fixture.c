#include "support/gl_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { STATUS_SKIP = 77 };

mns_backend gl_fixture_backend(void)
{
    static const struct {
        const char *name;
        mns_backend backend;
    } known[] = {
        {"auto", MNS_BACKEND_AUTO},
        {"egl", MNS_BACKEND_EGL},
        {"osmesa", MNS_BACKEND_OSMESA},
        {"glfw", MNS_BACKEND_GLFW},
    };
    const char *name = getenv("MNS_TEST_BACKEND");
    if (!name || !*name) return MNS_BACKEND_AUTO;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strcmp(name, known[i].name)) return known[i].backend;
    fprintf(stderr, "MNS_TEST_BACKEND=%s: expected auto, egl, osmesa or glfw\n", name);
    exit(1);
}

static void GLAPIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                  const GLchar *message, const void *user)
{
    /* the callback's type makes the pointer const; it is the fixture that gl_fixture_begin handed over */
    gl_fixture *fixture = (gl_fixture *)(uintptr_t)user;
    (void)source, (void)id, (void)length;
    if (type == GL_DEBUG_TYPE_PERFORMANCE) return; /* an opinion, which differs from driver to driver */
    if (severity != GL_DEBUG_SEVERITY_MEDIUM && severity != GL_DEBUG_SEVERITY_HIGH) return;
    fixture->messages++;
    snprintf(fixture->last_message, sizeof fixture->last_message, "%s", message);
}

void gl_fixture_begin(gl_fixture *fixture)
{
    mns_error error;
    *fixture = (gl_fixture){.backend = gl_fixture_backend()};
    if (mns_context_create(fixture->backend, &fixture->context, &error) != MNS_OK) {
        printf("skipped: %s\n", error.text);
        exit(STATUS_SKIP);
    }
    if (!gladLoadGLContext(&fixture->gl, mns_context_get_proc(fixture->context))) {
        fprintf(stderr, "glad loads no GL from %s\n", mns_context_name(fixture->context));
        exit(1);
    }
    fixture->gl.Enable(GL_DEBUG_OUTPUT);
    fixture->gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    fixture->gl.DebugMessageCallback(on_message, fixture);
}

void gl_fixture_check(gl_fixture *fixture)
{
    GLenum pending = fixture->gl.GetError();
    unsigned messages = fixture->messages;
    fixture->messages = 0;
    if (pending != GL_NO_ERROR) fail_msg("GL error 0x%04x: %s", pending, fixture->last_message);
    if (messages) fail_msg("%u debug messages, the last: %s", messages, fixture->last_message);
}

void gl_fixture_end(gl_fixture *fixture)
{
    gl_fixture_check(fixture);
    mns_context_destroy(fixture->context);
    *fixture = (gl_fixture){0};
}

int gl_fixture_setup(void **state)
{
    gl_fixture *fixture = malloc(sizeof *fixture);
    if (!fixture) return -1;
    gl_fixture_begin(fixture);
    *state = fixture;
    return 0;
}

int gl_fixture_teardown(void **state)
{
    gl_fixture_end(*state);
    free(*state);
    *state = NULL;
    return 0;
}
