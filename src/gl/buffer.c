#include "gl/buffer.h"

#include "base/status.h"

#include <string.h>

mns_status gl_buffer_reserve(gl_device *device, gl_buffer *buffer, const char *what, size_t size, size_t most,
                             mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    if (most && size > most)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "%s: %zu bytes are needed, this driver's blocks hold %zu", what, size, most);
    if (buffer->id && buffer->size >= size) return MNS_OK;
    size_t wanted = size + size / 4;
    if (most && wanted > most) wanted = most;
    if (wanted < 256) wanted = 256;
    if (!buffer->id) gl->GenBuffers(1, &buffer->id);
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer->id);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)wanted, NULL, GL_DYNAMIC_DRAW);
    gl->BindBuffer(GL_ARRAY_BUFFER, 0);
    buffer->size = wanted;
    mns_status status = gl_check(device, what, error);
    if (status) gl_buffer_free(device, buffer);
    return status;
}

void gl_buffer_free(gl_device *device, gl_buffer *buffer)
{
    if (buffer->id) device->gl.DeleteBuffers(1, &buffer->id);
    *buffer = (gl_buffer){0};
}

mns_status gl_buffer_map(gl_device *device, gl_buffer *buffer, size_t size, void **data, mns_error *error)
{
    const GladGLContext *gl = &device->gl;
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer->id);
    *data = gl->MapBufferRange(GL_ARRAY_BUFFER, 0, (GLsizeiptr)size,
                               GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    gl->BindBuffer(GL_ARRAY_BUFFER, 0);
    return *data ? MNS_OK : status_no_memory(error, "while mapping a buffer");
}

bool gl_buffer_unmap(gl_device *device, gl_buffer *buffer)
{
    const GladGLContext *gl = &device->gl;
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer->id);
    bool kept = gl->UnmapBuffer(GL_ARRAY_BUFFER);
    gl->BindBuffer(GL_ARRAY_BUFFER, 0);
    return kept;
}

mns_status gl_buffer_send(gl_device *device, gl_buffer *buffer, const char *what, const void *data,
                          size_t size, size_t most, mns_error *error)
{
    void *mapped;
    do {
        mns_status status = gl_buffer_reserve(device, buffer, what, size, most, error);
        if (!status) status = gl_buffer_map(device, buffer, size, &mapped, error);
        if (status) return status;
        memcpy(mapped, data, size);
    } while (!gl_buffer_unmap(device, buffer));
    return MNS_OK;
}

void gl_buffer_fetch(gl_device *device, GLuint id, size_t size, void *data)
{
    const GladGLContext *gl = &device->gl;
    bool made = device->reading;
    memset(data, 0, size); /* where the driver fails */
    if (!made) gl->GenBuffers(1, &device->reading);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, id);
    gl->BindBuffer(GL_ARRAY_BUFFER, device->reading);
    if (!made) gl->BufferData(GL_ARRAY_BUFFER, GL_BUFFER_FETCH_MOST, NULL, GL_STREAM_READ);
    gl->CopyBufferSubData(GL_SHADER_STORAGE_BUFFER, GL_ARRAY_BUFFER, 0, 0, (GLsizeiptr)size);
    gl->GetBufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)size, data);
    gl->BindBuffer(GL_ARRAY_BUFFER, 0);
}
