/* Shaders read from a folder while a program runs, in place of those built in. */
#ifndef MNS_GL_RELOAD_H
#define MNS_GL_RELOAD_H

#include "gl/program.h"

/* Every file that is built in, as it is in `folder`; ends with a NULL name. Errors: IO, MEMORY. */
mns_status glsl_texts_read(const char *folder, glsl_text **texts, mns_error *error);
void glsl_texts_free(glsl_text *texts);

/* Compiles all programs anew from `texts`, and takes these over; where one does not compile, all stay as they
 * were, and the texts are left to the caller. Errors: as gl_program_build. */
mns_status gl_programs_reload(gl_device *device, gl_programs *programs, glsl_text *texts, mns_error *error);

#endif
