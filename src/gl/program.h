/* Shader variants: assembled from glsl/ by a block of #defines, compiled once, kept by what they were made
 * of. */
#ifndef MNS_GL_PROGRAM_H
#define MNS_GL_PROGRAM_H

#include "gl/binary.h"
#include "gl/glsl_text.h"

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
    glsl_text *texts;     /* what they are made of; NULL: what is built in */
} gl_programs;

/* The whole text of one stage: version, defines, the file with its #include lines replaced. Caller frees.
 * NULL: out of memory or no such file. */
char *glsl_assemble(const char *file, const char *defines);

/* Compiles a program of these texts (NULL: those built in), or takes it from what is kept. Errors: GL (the
 * compiler's first complaint), MEMORY. */
mns_status gl_program_build(gl_device *device, gl_binaries *binaries, const glsl_text *texts,
                            const gl_shader *shader, GLuint *id, mns_error *error);

/* The program of that shader, compiled, or taken from what is kept, when it is first asked for. Errors: GL
 * (the compiler's first complaint), MEMORY. */
mns_status gl_program_get(gl_device *device, gl_programs *programs, const gl_shader *shader, GLuint *id,
                          mns_error *error);
void gl_programs_free(gl_device *device, gl_programs *programs);

#endif
