/* Draws a scene of the table by the reference. usage: draw_truth FOLDER NAME OUTPUT.exr|OUTPUT.png... */
#include "support/image_table.h"

#include <stdio.h>

static mns_status draw(const image_scene *s, mns_image **image, mns_error *error)
{
    mns_context *context = NULL;
    mns_renderer *renderer = NULL;
    mns_frame *frame = NULL;
    mns_options options = s->options;
    options.method = MNS_METHOD_REFERENCE;
    mns_status status = mns_context_create(MNS_BACKEND_AUTO, &context, error);
    if (!status) status = mns_renderer_create(mns_context_get_proc(context), &renderer, error);
    if (!status) status = mns_frame_create(renderer, &frame, error);
    if (!status)
        status = mns_renderer_draw(renderer, s->field, &s->view, &s->scene->look, &options, frame, error);
    if (!status) status = mns_frame_read(frame, image, error);
    mns_frame_destroy(frame);
    mns_renderer_destroy(renderer);
    mns_context_destroy(context);
    return status;
}

int main(int count, char **arguments)
{
    if (count < 4) return fprintf(stderr, "usage: draw_truth FOLDER NAME OUTPUT...\n"), 2;
    mns_error error = {0};
    mns_image *image = NULL;
    image_table table = image_table_load(arguments[1]);
    const image_row *row = image_table_find(&table, arguments[2]);
    if (!row) return fprintf(stderr, "%s: no such name in %s/table.json\n", arguments[2], arguments[1]), 2;
    image_scene scene = image_scene_load(arguments[1], row);
    mns_status status = draw(&scene, &image, &error);
    for (int i = 3; i < count && !status; i++) status = mns_image_write(image, arguments[i], &error);
    if (status) fprintf(stderr, "%s: %s\n", row->name, error.text);
    mns_image_destroy(image);
    image_scene_free(&scene);
    image_table_free(&table);
    return status != MNS_OK;
}
