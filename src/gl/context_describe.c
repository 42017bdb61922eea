/* What each back end offers on this machine, or why it cannot start: the text of a bug report. */
#include "gl/context.h"

#include <glad/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *gl_text(const GladGLContext *gl, GLenum name)
{
    const char *text = (const char *)gl->GetString(name);
    return text ? text : "unknown";
}

static bool has_extension(const GladGLContext *gl, const char *name)
{
    GLint count = 0;
    gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++) {
        const char *listed = (const char *)gl->GetStringi(GL_EXTENSIONS, (GLuint)i);
        if (listed && !strcmp(listed, name)) return true;
    }
    return false;
}

static void print_size(FILE *out, const GladGLContext *gl)
{
    GLint64 block = 0;
    GLint texture = 0, viewport[2] = {0};
    GLfloat point[2] = {0};
    gl->GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    gl->GetFloatv(GL_POINT_SIZE_RANGE, point);
    fprintf(out, "  storage block       %lld bytes (%.0f MiB)\n", (long long)block,
            (double)block / (1 << 20));
    fprintf(out, "  texture side        %d\n", texture);
    fprintf(out, "  viewport            %d x %d\n", viewport[0], viewport[1]);
    fprintf(out, "  point size          %g to %g\n", point[0], point[1]);
}

static void print_stages(FILE *out, const GladGLContext *gl)
{
    GLint vertex = 0, fragment = 0, groups[3] = {0};
    gl->GetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &vertex);
    gl->GetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &fragment);
    for (GLuint i = 0; i < 3; i++) gl->GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, i, &groups[i]);
    fprintf(out, "  storage blocks      %d in the vertex stage, %d in the fragment stage\n", vertex,
            fragment);
    fprintf(out, "  compute groups      %d x %d x %d\n", groups[0], groups[1], groups[2]);
}

static void print_abilities(FILE *out, const GladGLContext *gl)
{
    GLint major = 0, minor = 0;
    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->GetIntegerv(GL_MINOR_VERSION, &minor);
    bool clip = major > 4 || (major == 4 && minor >= 5) || has_extension(gl, "GL_ARB_clip_control");
    fprintf(out, "  clip control        %s\n", clip ? "yes" : "no");
    GLint formats = 0;
    gl->GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    fprintf(out, "  program binaries    %s\n", formats > 0 ? "yes" : "no");
    fprintf(out, "  fragment interlock  %s\n",
            has_extension(gl, "GL_ARB_fragment_shader_interlock") ? "yes" : "no");
}

/* A context that was opened, with `status` and `error`; closes it. `name` is its name where it could not be.
 */
static void print_context(FILE *out, mns_context *context, mns_status status, const char *name,
                          const mns_error *error)
{
    GladGLContext gl = {0};
    if (status != MNS_OK) {
        fprintf(out, "%s: cannot start: %s\n", name, error->text);
        return;
    }
    if (gladLoadGLContext(&gl, context->backend.get_proc)) {
        fprintf(out, "%s: OpenGL %s\n", context->name, gl_text(&gl, GL_VERSION));
        fprintf(out, "  renderer            %s\n", gl_text(&gl, GL_RENDERER));
        print_size(out, &gl);
        print_stages(out, &gl);
        print_abilities(out, &gl);
    } else {
        fprintf(out, "%s: cannot start: the driver gives no GL functions\n", context->name);
    }
    context->backend.destroy(context);
}

static void print_egl(FILE *out)
{
    mns_context context = {0};
    mns_error error = {0};
    mns_status status = context_egl_surfaceless_open(&context, &error);
    print_context(out, &context, status, "egl surfaceless", &error);
    for (int device = 0; device < context_egl_device_count(); device++) {
        char name[32];
        snprintf(name, sizeof name, "egl device %d", device);
        context = (mns_context){0};
        status = context_egl_device_open(&context, device, &error);
        print_context(out, &context, status, name, &error);
    }
}

static void print_osmesa(FILE *out)
{
    mns_context context = {0};
    mns_error error = {0};
    mns_status status = context_osmesa_open(&context, &error);
    print_context(out, &context, status, "osmesa", &error);
}

static void print_glfw(FILE *out)
{
    mns_context context = {0};
    mns_error error = {0};
    mns_status status = context_glfw_open(&context, &error);
    print_context(out, &context, status, "glfw", &error);
}

char *mns_backend_describe(mns_backend backend)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    context_release_thread();
    if (backend == MNS_BACKEND_EGL || backend == MNS_BACKEND_AUTO) print_egl(out);
    if (backend == MNS_BACKEND_OSMESA || backend == MNS_BACKEND_AUTO) print_osmesa(out);
    if (backend == MNS_BACKEND_GLFW || backend == MNS_BACKEND_AUTO) print_glfw(out);
    bool failed = ferror(out) != 0;
    failed |= fclose(out) != 0;
    if (failed) {
        free(text);
        return NULL;
    }
    if (size && text[size - 1] == '\n') text[size - 1] = 0;
    return text;
}
