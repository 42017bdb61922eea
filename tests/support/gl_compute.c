#include "support/gl_compute.h"

#include "gl/glsl_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

const char *gl_compute_embedded(const char *name)
{
    for (const glsl_text *file = glsl_texts; file->name; file++)
        if (!strcmp(file->name, name)) return file->text;
    fail_msg("%s is not embedded", name);
    return NULL;
}

GLuint gl_compute_program(const GladGLContext *gl, const char *const *text, GLsizei count)
{
    char log[512] = "";
    GLuint shader = gl->CreateShader(GL_COMPUTE_SHADER), program = gl->CreateProgram();
    gl->ShaderSource(shader, count, text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    gl->AttachShader(program, shader);
    gl->LinkProgram(program);
    gl->DeleteShader(shader);
    GLint linked = GL_FALSE;
    gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) fail_msg("%s", log);
    return program;
}

void gl_compute_run(const GladGLContext *gl, GLuint program, GLuint groups, const void *input,
                    size_t input_size, void *result, size_t result_size)
{
    GLuint buffer[2];
    gl->GenBuffers(2, buffer);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer[0]);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)input_size, input, GL_STATIC_DRAW);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffer[1]);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)result_size, NULL, GL_STATIC_READ);
    gl->UseProgram(program);
    gl->DispatchCompute(groups, 1, 1);
    gl->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl->GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, (GLsizeiptr)result_size, result);
    gl->UseProgram(0);
    gl->DeleteBuffers(2, buffer);
    gl->DeleteProgram(program);
}
