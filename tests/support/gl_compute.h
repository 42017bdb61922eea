/* A compute shader made of embedded texts, run over a buffer: what a driver makes of a formula. */
#ifndef MNS_TESTS_GL_COMPUTE_H
#define MNS_TESTS_GL_COMPUTE_H

#include <glad/gl.h>
#include <stddef.h>

/* An embedded file's text; fails the test where there is none of that name. */
const char *gl_compute_embedded(const char *name);
/* The program of `count` texts in a row; fails the test, with the driver's log, where they do not link. */
GLuint gl_compute_program(const GladGLContext *gl, const char *const *text, GLsizei count);
/* Runs `groups` groups of it and deletes it: storage block 0 holds `input`, `result` gets block 1. */
void gl_compute_run(const GladGLContext *gl, GLuint program, GLuint groups, const void *input,
                    size_t input_size, void *result, size_t result_size);

#endif
