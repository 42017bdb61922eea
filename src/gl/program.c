#include "gl/program.h"

#include "base/memory.h"
#include "base/status.h"
#include "gl/reload.h"

#include <stdio.h>
#include <string.h>

typedef struct text {
    char *data;
    size_t size;
    bool failed;
} text;

static void text_append(text *t, const char *data, size_t size)
{
    if (t->failed) return;
    char *larger = memory_resize(t->data, t->size + size + 1, 1);
    if (!larger) {
        t->failed = true;
        return;
    }
    t->data = larger;
    memcpy(t->data + t->size, data, size);
    t->size += size;
    t->data[t->size] = '\0';
}

static const char *find_file(const glsl_text *texts, const char *name, size_t length)
{
    for (const glsl_text *file = texts; file->name; file++)
        if (strlen(file->name) == length && memcmp(file->name, name, length) == 0) return file->text;
    return NULL;
}

/* Appends a file, its lines `#include "other.glsl"` replaced by that file's text. */
static void append_file(text *t, const glsl_text *texts, const char *name, size_t length, int depth)
{
    static const char directive[] = "#include \"";
    const char *line = depth < 8 ? find_file(texts, name, length) : NULL;
    if (!line) {
        t->failed = true;
        return;
    }
    while (*line) {
        const char *end = strchr(line, '\n');
        end = end ? end + 1 : line + strlen(line);
        if (strncmp(line, directive, sizeof directive - 1) == 0) {
            const char *from = line + sizeof directive - 1;
            append_file(t, texts, from, strcspn(from, "\"\n"), depth + 1);
        } else if (*line != '\n') {
            text_append(t, line, (size_t)(end - line));
        }
        line = end;
    }
}

static char *assemble(const glsl_text *texts, const char *file, const char *defines)
{
    text t = {0};
    static const char version[] = "#version 430 core\n";
    text_append(&t, version, sizeof version - 1);
    text_append(&t, defines, strlen(defines));
    append_file(&t, texts, file, strlen(file), 0);
    if (t.failed) {
        free(t.data);
        return NULL;
    }
    return t.data;
}

char *glsl_assemble(const char *file, const char *defines)
{
    return assemble(glsl_texts, file, defines);
}

/* One stage of a program. */
typedef struct program_stage {
    GLenum kind;
    const char *file;
    char *source;
} program_stage;

enum { STAGES = 3 };

static mns_status compile(gl_device *device, GLuint program, const program_stage *stage, mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    GLuint shader = gl->CreateShader(stage->kind);
    gl->ShaderSource(shader, 1, (const GLchar *const *)&stage->source, NULL);
    gl->CompileShader(shader);
    GLint good = GL_FALSE;
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    char log[256] = "";
    if (!good) gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    gl->AttachShader(program, shader);
    gl->DeleteShader(shader); /* lives on with the program */
    if (good) return MNS_OK;
    return status_fail(error, MNS_ERROR_GL, "%s does not compile on %s: %s", stage->file, device->name, log);
}

static mns_status compile_and_link(gl_device *device, GLuint program, const program_stage stage[STAGES],
                                   mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    for (int i = 0; i < STAGES; i++) {
        mns_status status = stage[i].file ? compile(device, program, &stage[i], error) : MNS_OK;
        if (status) return status;
    }
    gl->LinkProgram(program);
    GLint good = GL_FALSE;
    gl->GetProgramiv(program, GL_LINK_STATUS, &good);
    if (good) return MNS_OK;
    char log[256] = "";
    gl->GetProgramInfoLog(program, sizeof log, NULL, log);
    const char *file = stage[1].file ? stage[1].file : stage[2].file;
    return status_fail(error, MNS_ERROR_GL, "%s does not link on %s: %s", file, device->name, log);
}

/* A program made of its stages' text, unless it was made so before. */
static mns_status make(gl_device *device, gl_binaries *binaries, const program_stage stage[STAGES],
                       GLuint *id, mns_error *error)
{
    gl_binary_key key = gl_binary_key_begin(device);
    for (int i = 0; i < STAGES; i++) gl_binary_key_add(&key, stage[i].source ? stage[i].source : "");
    GLuint program = device->gl.CreateProgram();
    mns_status status = MNS_OK;
    if (!gl_binary_take(device, binaries, &key, program)) {
        gl_binary_ask(device, binaries, program);
        status = compile_and_link(device, program, stage, error);
        if (!status) gl_binary_leave(device, binaries, &key, program);
    }
    if (status)
        device->gl.DeleteProgram(program);
    else
        *id = program;
    return status;
}

mns_status gl_program_build(gl_device *device, gl_binaries *binaries, const glsl_text *texts,
                            const gl_shader *shader, GLuint *id, mns_error *error)
{
    program_stage stage[STAGES] = {{GL_VERTEX_SHADER, shader->vertex, NULL},
                                   {GL_FRAGMENT_SHADER, shader->fragment, NULL},
                                   {GL_COMPUTE_SHADER, shader->compute, NULL}};
    mns_status status = MNS_OK;
    for (int i = 0; i < STAGES && !status; i++) {
        if (!stage[i].file) continue;
        stage[i].source = assemble(texts ? texts : glsl_texts, stage[i].file, shader->defines);
        if (!stage[i].source) status = status_no_memory(error, "while assembling a shader");
    }
    if (!status) status = make(device, binaries, stage, id, error);
    for (int i = 0; i < STAGES; i++) free(stage[i].source);
    return status;
}

static char *make_key(const gl_shader *shader)
{
    text key = {0};
    const char *const parts[] = {shader->vertex, shader->fragment, shader->compute, shader->defines};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (parts[i]) text_append(&key, parts[i], strlen(parts[i]));
        text_append(&key, "|", 1);
    }
    if (!key.failed) return key.data;
    free(key.data);
    return NULL;
}

mns_status gl_program_get(gl_device *device, gl_programs *programs, const gl_shader *shader, GLuint *id,
                          mns_error *error)
{
    char *key = make_key(shader);
    gl_program *item = NULL;
    mns_status status = MNS_OK;
    if (!key) return status_no_memory(error, "while looking up a shader");
    for (size_t i = 0; i < programs->count; i++)
        if (strcmp(programs->item[i].key, key) == 0) {
            *id = programs->item[i].id;
            goto done;
        }
    item = memory_resize(programs->item, programs->count + 1, sizeof *item);
    if (!item) {
        status = status_no_memory(error, "while keeping a shader");
        goto done;
    }
    programs->item = item;
    status = gl_program_build(device, &programs->binaries, programs->texts, shader, id, error);
    if (status) goto done;
    programs->item[programs->count++] = (gl_program){key, *id};
    return MNS_OK;
done:
    free(key);
    return status;
}

void gl_programs_free(gl_device *device, gl_programs *programs)
{
    for (size_t i = 0; i < programs->count; i++) {
        device->gl.DeleteProgram(programs->item[i].id);
        free(programs->item[i].key);
    }
    free(programs->item);
    glsl_texts_free(programs->texts);
    *programs = (gl_programs){0};
}
