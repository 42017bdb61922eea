#include "gl/reload.h"

#include "base/memory.h"
#include "base/status.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { FILE_MOST = 1 << 20 };

void glsl_texts_free(glsl_text *texts)
{
    for (glsl_text *file = texts; file && file->name; file++) free((char *)(uintptr_t)file->text);
    free(texts);
}

static mns_status read_file(const char *folder, const char *name, const char **text, mns_error *error)
{
    char path[STORE_PATH];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    if (!file)
        return status_fail(error, MNS_ERROR_IO, "%.300s: cannot read the shader: %s", path, strerror(errno));
    char *bytes = malloc(FILE_MOST + 1);
    size_t size = bytes ? fread(bytes, 1, FILE_MOST, file) : 0;
    bool failed = ferror(file) || !feof(file);
    fclose(file);
    if (!bytes) return status_no_memory(error, "while reading shaders");
    if (failed) {
        free(bytes);
        return status_fail(error, MNS_ERROR_IO,
                           "%.300s: cannot read the shader: expected a file below %d bytes", path, FILE_MOST);
    }
    bytes[size] = '\0';
    *text = bytes;
    return MNS_OK;
}

mns_status glsl_texts_read(const char *folder, glsl_text **texts, mns_error *error)
{
    size_t count = 0;
    while (glsl_texts[count].name) count++;
    glsl_text *made = calloc(count + 1, sizeof *made);
    if (!made) return status_no_memory(error, "while reading shaders");
    for (size_t i = 0; i < count; i++) {
        mns_status status = read_file(folder, glsl_texts[i].name, &made[i].text, error);
        if (status) {
            glsl_texts_free(made);
            return status;
        }
        made[i].name = glsl_texts[i].name;
    }
    *texts = made;
    return MNS_OK;
}

/* The shader that a key names, in its parts: "vertex|fragment|compute|defines|", cut up in place. */
static gl_shader shader_of(char *key)
{
    char *part[4];
    for (int i = 0; i < 4; i++) {
        part[i] = key;
        key += i < 3 ? strcspn(key, "|") : strlen(key) - 1;
        *key++ = '\0';
    }
    return (gl_shader){.vertex = *part[0] ? part[0] : NULL,
                       .fragment = *part[1] ? part[1] : NULL,
                       .compute = *part[2] ? part[2] : NULL,
                       .defines = part[3]};
}

mns_status gl_programs_reload(gl_device *device, gl_programs *programs, glsl_text *texts, mns_error *error)
{
    mns_status status = MNS_OK;
    size_t made = 0;
    GLuint *id = memory_array(programs->count + 1, sizeof *id);
    if (!id) return status_no_memory(error, "while compiling shaders anew");
    for (; made < programs->count && !status; made++) {
        char *key = strdup(programs->item[made].key);
        if (!key) {
            status = status_no_memory(error, "while compiling shaders anew");
            break;
        }
        gl_shader shader = shader_of(key);
        status = gl_program_build(device, &programs->binaries, texts, &shader, &id[made], error);
        free(key);
        if (status) break;
    }
    for (size_t i = 0; i < made; i++) {
        device->gl.DeleteProgram(status ? id[i] : programs->item[i].id);
        if (!status) programs->item[i].id = id[i];
    }
    free(id);
    if (status) return status;
    glsl_texts_free(programs->texts);
    programs->texts = texts;
    return MNS_OK;
}
