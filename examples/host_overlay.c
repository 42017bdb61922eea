/* The surface in a host's own window: drawn over what is there, each pixel to the nearer of the two. The
 * host's context is current; the renderer was made once from it, mns_renderer_create(glfwGetProcAddress,
 * ...), and the frame from the renderer. */
#include <meniscus.h>

mns_status draw_surface(mns_renderer *renderer, mns_frame *frame, const mns_field *field, const double eye[3],
                        const double look_at[3], int width, int height, mns_error *error)
{
    const mns_view view = {.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT,
                           .eye = {eye[0], eye[1], eye[2]},
                           .look_at = {look_at[0], look_at[1], look_at[2]},
                           .fov = 60, /* as the host's projection has it, and so the two clip planes */
                           .width = width,
                           .height = height};
    const mns_target target = {.framebuffer = 0, .near = 0.1, .far = 100};
    return mns_renderer_draw_on(renderer, field, &view, NULL, NULL, &target, frame, error);
}
