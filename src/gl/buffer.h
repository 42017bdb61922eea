/* Buffers that grow and never shrink, so that a steady scene allocates nothing. */
#ifndef MNS_GL_BUFFER_H
#define MNS_GL_BUFFER_H

#include "gl/device.h"

typedef struct gl_buffer {
    GLuint id; /* 0: not made */
    size_t size;
} gl_buffer;

/* At least `size` bytes, contents lost when it grows. Grows by a quarter more than asked, up to `most` bytes
 * (0: no bound). Errors: MEMORY, UNSUPPORTED (size > most). */
mns_status gl_buffer_reserve(gl_device *device, gl_buffer *buffer, const char *what, size_t size, size_t most,
                             mns_error *error);
void gl_buffer_free(gl_device *device, gl_buffer *buffer);
/* Maps the first `size` bytes for writing, what was there lost. Errors: MEMORY. */
mns_status gl_buffer_map(gl_device *device, gl_buffer *buffer, size_t size, void **data, mns_error *error);
/* False where the driver lost the contents meanwhile: map and write again. */
bool gl_buffer_unmap(gl_device *device, gl_buffer *buffer);
/* Makes room for `size` bytes, as gl_buffer_reserve, and copies them to the buffer. Errors: MEMORY,
 * UNSUPPORTED. */
mns_status gl_buffer_send(gl_device *device, gl_buffer *buffer, const char *what, const void *data,
                          size_t size, size_t most, mns_error *error);
/* The first `size` bytes of buffer `id`, GL_BUFFER_FETCH_MOST or fewer, once the commands before have written
 * them. They come through a buffer of their own: a driver may move one that is read to the host's memory, and
 * what the card writes there every frame would go the long way. */
enum { GL_BUFFER_FETCH_MOST = 64 };
void gl_buffer_fetch(gl_device *device, GLuint id, size_t size, void *data);

#endif
