/* A context for tests: the back end that MNS_TEST_BACKEND names (auto, egl, osmesa, glfw; default auto), its
 * GL functions, and an eye on what the driver says. */
#ifndef MNS_TESTS_GL_FIXTURE_H
#define MNS_TESTS_GL_FIXTURE_H

#include "meniscus.h"

#include <glad/gl.h>

typedef struct gl_fixture {
    mns_backend backend;
    mns_context *context;
    GladGLContext gl;
    unsigned messages; /* debug messages of medium or high severity so far */
    char last_message[256];
} gl_fixture;

/* The back end that MNS_TEST_BACKEND names. Ends the program, status 1, on a name it does not know. */
mns_backend gl_fixture_backend(void);

/* Makes the context, current on this thread. Where there is none: prints the reason and ends the program,
 * status 77. */
void gl_fixture_begin(gl_fixture *fixture);

/* Fails the running test if GL has an error pending or the driver gave a message of medium or high severity
 * since the beginning or the last check. A renderer takes the debug output over: ask mns_renderer_messages
 * for what came since. */
void gl_fixture_check(gl_fixture *fixture);

/* Checks as above, then destroys the context. */
void gl_fixture_end(gl_fixture *fixture);

/* setup and teardown for cmocka: *state is the gl_fixture. */
int gl_fixture_setup(void **state);
int gl_fixture_teardown(void **state);

#endif
