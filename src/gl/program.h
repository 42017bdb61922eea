/* Shader variants: assembled from glsl/ by a block of #defines, compiled once, kept by what they were made
 * of. */
#ifndef MNS_GL_PROGRAM_H
#define MNS_GL_PROGRAM_H

#include "gl/binary.h"

typedef struct gl_shader {
    const char *vertex;   /* file of glsl/, or NULL */
    const char *fragment; /* file, or NULL */
    const char *compute;  /* file, or NULL */
    const char *defines;  /* lines "#define NAME value\n" */
} gl_shader;

typedef struct gl_program {
    char *key;
    GLuint id;
} gl_program;

typedef struct gl_programs {
    gl_program *item;
    size_t count;
    gl_binaries binaries; /* where programs are kept between runs */
} gl_programs;

/* The whole text of one stage: version, defines, the file with its #include lines replaced. Caller frees.
 * NULL: out of memory or no such file. */
char *glsl_assemble(const char *file, const char *defines);

/* The program of that shader, compiled, or taken from what is kept, when it is first asked for. Errors: GL
 * (the compiler's first complaint), MEMORY. */
mns_status gl_program_get(gl_device *device, gl_programs *programs, const gl_shader *shader, GLuint *id,
                          mns_error *error);
void gl_programs_free(gl_device *device, gl_programs *programs);

#endif
