#include "gl/device.h"

#include "base/status.h"

#include <stdio.h>
#include <string.h>

static void on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                       const GLchar *message, const void *user)
{
    (void)source, (void)id, (void)length;
    /* Performance hints are the driver's opinion, not a fault of ours. */
    if (severity != GL_DEBUG_SEVERITY_HIGH && severity != GL_DEBUG_SEVERITY_MEDIUM) return;
    if (type == GL_DEBUG_TYPE_PERFORMANCE) return;
    gl_device *device = (gl_device *)(uintptr_t)user;
    device->messages++;
    snprintf(device->last_message, sizeof device->last_message, "%s", message);
}

static void read_limits(gl_device *device)
{
    const GladGLContext *gl = &device->gl;
    mns_limits *limits = &device->limits;
    GLint64 block = 0;
    gl->GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
    limits->max_storage_block = block > 0 ? (size_t)block : 0;
    GLint size = 0, texels = 0, viewport[2] = {0, 0};
    gl->GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    limits->max_texture_buffer = texels;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &size);
    gl->GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    GLfloat point[2] = {1, 1};
    gl->GetFloatv(GL_POINT_SIZE_RANGE, point);
    limits->max_texture_size = size;
    limits->max_viewport[0] = viewport[0];
    limits->max_viewport[1] = viewport[1];
    limits->max_point_size = point[1];
    limits->has_clip_control = gl->ClipControl != NULL;
    const char *renderer = (const char *)gl->GetString(GL_RENDERER);
    limits->is_software = renderer && (strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe") ||
                                       strstr(renderer, "swr") || strstr(renderer, "SWR"));
}

/* GL_KHR_debug is core from 4.3. A callback of the host's is left alone: then messages are the host's to see.
 */
static void listen(gl_device *device)
{
    const GladGLContext *gl = &device->gl;
    void *theirs = NULL;
    gl->GetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &theirs);
    if (theirs) return;
    gl->Enable(GL_DEBUG_OUTPUT);
    gl->DebugMessageCallback(on_message, device);
}

mns_status gl_device_open(gl_device *device, mns_get_proc get_proc, mns_error *error)
{
    memset(device, 0, sizeof *device);
    if (!get_proc)
        return status_fail(error, MNS_ERROR_USAGE, "renderer: get_proc is NULL; pass the context's own");
    int version = gladLoadGLContext(&device->gl, (GLADloadfunc)get_proc);
    if (!version)
        return status_fail(error, MNS_ERROR_GL,
                           "renderer: no OpenGL functions found; is a context current on this thread?");
    int major = GLAD_VERSION_MAJOR(version), minor = GLAD_VERSION_MINOR(version);
    if (major < 4 || (major == 4 && minor < 3))
        return status_fail(error, MNS_ERROR_GL,
                           "renderer: the context offers OpenGL %d.%d; make one of at least 4.3 core", major,
                           minor);
    const char *renderer = (const char *)device->gl.GetString(GL_RENDERER);
    const char *text = (const char *)device->gl.GetString(GL_VERSION);
    const char *vendor = (const char *)device->gl.GetString(GL_VENDOR);
    snprintf(device->name, sizeof device->name, "%s, %s", renderer ? renderer : "?", text ? text : "?");
    snprintf(device->vendor, sizeof device->vendor, "%s", vendor ? vendor : "?");
    read_limits(device);
    listen(device);
    return MNS_OK;
}

void gl_device_close(gl_device *device)
{
    const GladGLContext *gl = &device->gl;
    void *user = NULL;
    if (!gl->GetPointerv) return;
    if (device->reading) gl->DeleteBuffers(1, &device->reading);
    device->reading = 0;
    gl->GetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &user);
    if (user == device) gl->DebugMessageCallback(NULL, NULL);
}

mns_status gl_check(gl_device *device, const char *where, mns_error *error)
{
    GLenum code = device->gl.GetError();
    if (code == GL_NO_ERROR) return MNS_OK;
    while (device->gl.GetError() != GL_NO_ERROR) {}
    if (code == GL_OUT_OF_MEMORY)
        return status_fail(error, MNS_ERROR_MEMORY, "%s: the driver is out of memory; try a smaller frame",
                           where);
    return status_fail(error, MNS_ERROR_GL, "%s: GL error 0x%04x (%s) from %s", where, code,
                       device->last_message[0] ? device->last_message : "no debug message", device->name);
}
