/* Planes on their way from memory to their textures. */
#include "base/memory.h"
#include "base/status.h"
#include "render/render.h"

#include <math.h>

static void send(mns_frame *frame, GLuint texture, GLenum format, GLenum type, const void *data)
{
    enum { UNPACK = 5 };
    static const GLenum name[UNPACK] = {GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS,
                                        GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SWAP_BYTES};
    static const GLint plain[UNPACK] = {4, 0, 0, 0, 0};
    const GladGLContext *gl = &frame->renderer->device.gl;
    GLint before[UNPACK];
    for (int i = 0; i < UNPACK; i++) {
        gl->GetIntegerv(name[i], &before[i]);
        gl->PixelStorei(name[i], plain[i]);
    }
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, frame->width, frame->height, format, type, data);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    for (int i = 0; i < UNPACK; i++) gl->PixelStorei(name[i], before[i]);
}

void frame_send(mns_frame *frame, GLuint texture, GLenum format, const float *data)
{
    send(frame, texture, format, GL_FLOAT, data);
}

void frame_send_whole(mns_frame *frame, GLuint texture, const uint32_t *data)
{
    send(frame, texture, GL_RED_INTEGER, GL_UNSIGNED_INT, data);
}

/* The last two of a texture's `channels` times `scale`. On the CPU: few frames need it, and a driver may take
 * the least floats for zero. */
static mns_status rescale(mns_frame *frame, GLuint texture, size_t channels, double scale, mns_error *error)
{
    const GladGLContext *gl = &frame->renderer->device.gl;
    const GLenum format = channels == 2 ? GL_RG : GL_RGBA;
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    float *plane = memory_array(pixels, channels * sizeof *plane);
    if (!plane) return status_no_memory(error, "while giving a frame its units");
    gl->MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->GetTexImage(GL_TEXTURE_2D, 0, format, GL_FLOAT, plane);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = channels - 2; c < channels; c++)
            plane[i * channels + c] = (float)((double)plane[i * channels + c] * scale);
    frame_send(frame, texture, format, plane);
    free(plane);
    return MNS_OK;
}

mns_status frame_leave_unit(mns_frame *frame, const mns_plan *plan, mns_error *error)
{
    const double scale = plan->unit / plan->t_unit;
    if (scale == 1) return MNS_OK;
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    mns_status status = rescale(frame, frame->t, 2, scale, error);
    if (!status && frame->has_lit) status = rescale(frame, frame->terms, 4, scale, error);
    /* The bound grows by what the low word may lose as one of the least floats. */
    for (size_t i = 0; frame->t_error && i < pixels; i++)
        if (frame->t_error[i] > 0)
            frame->t_error[i] = nextafterf((float)((double)frame->t_error[i] * scale), INFINITY);
    return status;
}
