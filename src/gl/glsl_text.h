/* The files of glsl/, embedded at build time with their comments stripped. */
#ifndef MNS_GL_GLSL_TEXT_H
#define MNS_GL_GLSL_TEXT_H

typedef struct glsl_text {
    const char *name; /* "density.glsl" */
    const char *text;
} glsl_text;

extern const glsl_text glsl_texts[]; /* ends with a NULL name */

#endif
