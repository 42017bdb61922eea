/* A scene file's text to a scene. */
#ifndef MNS_SCENE_SCENE_H
#define MNS_SCENE_SCENE_H

#include "meniscus.h"

#include <jansson.h>

/* A scene and what its pointers point to. */
typedef struct scene_file {
    mns_scene scene; /* first, so that the public pointer is this one */
    char **inputs;
    size_t input_count;
    char *color_by, *blend_by, *environment;
    mns_light *lights; /* scene.look.light_count of them */
    mns_mesh *meshes;  /* scene.look.mesh_count of them, */
    char **mesh_files; /* and their names */
} scene_file;

/* Parses `size` bytes of JSON. `path` names the file in errors, and relative inputs are resolved beside it.
 */
mns_status scene_parse(const char *text, size_t size, const char *path, mns_scene **scene, mns_error *error);

/* Fills *file from the document's keys; inputs stay as they are written. On failure the caller frees what is
 * there. */
mns_status scene_read_keys(const json_t *root, const char *path, scene_file *file, mns_error *error);

#endif
