/* Linked programs kept between runs, where the driver gives them away (GL_ARB_get_program_binary, core
 * from 4.1): one file a program in the user's cache. A file that does not fit in every byte, or that the
 * driver refuses, is thrown away, and the program compiled. */
#ifndef MNS_GL_BINARY_H
#define MNS_GL_BINARY_H

#include "base/store.h"
#include "gl/device.h"

typedef struct gl_binaries {
    char folder[STORE_PATH]; /* "": nothing is kept */
    uint64_t taken;          /* programs that came from there */
} gl_binaries;

/* What a program is made of: the text of its stages, the driver, this library's version. */
typedef struct gl_binary_key {
    uint64_t lane[2];
} gl_binary_key;

/* Keeps programs in `folder` from now on; NULL or "": nowhere, as where the driver gives none. `binaries` is
 * zeros, or was opened before: what was taken until now still counts. */
void gl_binaries_open(gl_device *device, gl_binaries *binaries, const char *folder);

gl_binary_key gl_binary_key_begin(const gl_device *device);
void gl_binary_key_add(gl_binary_key *key, const char *text);

/* Makes a new program what it was when it was left; false: it is as it was, to be compiled. */
bool gl_binary_take(gl_device *device, gl_binaries *binaries, const gl_binary_key *key, GLuint program);
/* Before a program is linked: that it shall be left. */
void gl_binary_ask(gl_device *device, const gl_binaries *binaries, GLuint program);
/* Leaves a linked program for the next time, where that can be. */
void gl_binary_leave(gl_device *device, const gl_binaries *binaries, const gl_binary_key *key,
                     GLuint program);

#endif
