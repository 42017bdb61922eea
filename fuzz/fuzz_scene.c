/* Any bytes as a scene file: parsed or refused, never a crash and never a leak. */
#include "scene/scene.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    mns_scene *scene = NULL;
    mns_error error = {0};
    if (scene_parse((const char *)data, size, "folder/scene.json", &scene, &error)) {
        /* a refusal says why, in one line */
        if (scene || !error.text[0] || strchr(error.text, '\n')) __builtin_trap();
        return 0;
    }
    for (size_t i = 0; i < scene->input_count; i++)
        if (!scene->inputs[i][0]) __builtin_trap();
    mns_scene_destroy(scene);
    return 0;
}
