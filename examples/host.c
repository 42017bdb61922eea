/* A host's own particles to a picture, without a window.
 * Build: cc host.c $(pkg-config --cflags --libs meniscus) -o host */
#include <meniscus.h>
#include <stdio.h>

int main(void)
{
    const double at[] = {-0.6, 0, 0, 0.6, 0, 0, 0, 1, 0};
    const mns_field_desc desc = {.count = 3, .position = {.data = at}, .uniform_radius = 1.2};
    mns_field *field = NULL;
    mns_context *context = NULL;
    mns_renderer *renderer = NULL;
    mns_frame *frame = NULL;
    mns_image *image = NULL;
    mns_error error;
    mns_status status = mns_field_create(&desc, &field, &error);
    if (!status) status = mns_context_create(MNS_BACKEND_AUTO, &context, &error);
    if (!status) status = mns_renderer_create(mns_context_get_proc(context), &renderer, &error);
    if (!status) status = mns_frame_create(renderer, &frame, &error);
    if (!status) status = mns_renderer_draw(renderer, field, NULL, NULL, NULL, frame, &error);
    if (!status) status = mns_frame_read(frame, &image, &error);
    if (!status) status = mns_image_write(image, "host.png", &error);
    if (status) fprintf(stderr, "%s\n", error.text);
    mns_image_destroy(image);
    mns_frame_destroy(frame);
    mns_renderer_destroy(renderer);
    mns_context_destroy(context);
    mns_field_destroy(field);
    return status != MNS_OK;
}
