/* Meshes of a scene file: names, or objects with a file and a color. */
#include "scene/scene_object.h"

#include "base/status.h"

#include <stdio.h>
#include <stdlib.h>

/* What one object fills. */
typedef struct mesh_entry {
    char *file;
    mns_mesh mesh;
    unsigned set;
} mesh_entry;

enum { MESH_HAS_COLOR = 1, MESHES_MOST = 256 };

static mns_status read_file(scene_reader *r, const char *key, const json_t *value, void *target)
{
    return scene_read_text(r, key, value, target);
}

static const scene_key MESH_KEYS[] = {
    {"file", read_file, offsetof(mesh_entry, file), 0, 0},
    {"color", scene_read_color, offsetof(mesh_entry, mesh.color), offsetof(mesh_entry, set), MESH_HAS_COLOR},
};

static mns_status read_mesh(scene_reader *r, const char *key, const json_t *value, mesh_entry *entry)
{
    if (json_is_string(value)) return scene_read_text(r, key, value, &entry->file);
    if (!json_is_object(value)) return scene_wrong(r, key, value, "a file's name, or an object with a file");
    mns_status status = scene_read_object(r, key, value, MESH_KEYS, SCENE_COUNT(MESH_KEYS), entry);
    if (!status && !entry->file) return scene_wrong(r, key, value, "an object with a file");
    entry->mesh.has_color = entry->set & MESH_HAS_COLOR;
    return status;
}

mns_status scene_read_meshes(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    scene_file *file = r->file;
    size_t count = json_array_size(value);
    if (!json_is_array(value) || count > MESHES_MOST)
        return scene_wrong(r, key, value, "a list of at most 256 meshes");
    file->meshes = calloc(count + 1, sizeof *file->meshes);
    file->mesh_files = calloc(count + 1, sizeof *file->mesh_files);
    if (!file->meshes || !file->mesh_files) return status_no_memory(r->error, "reading a scene");
    for (size_t i = 0; i < count; i++) {
        char path[SCENE_PATH_SIZE];
        mesh_entry entry = {0};
        snprintf(path, sizeof path, "%.30s[%zu]", key, i);
        mns_status status = read_mesh(r, path, json_array_get(value, i), &entry);
        file->mesh_files[i] = entry.file;
        file->meshes[i] = entry.mesh;
        file->scene.look.mesh_count = i + 1;
        if (status) return status;
    }
    return MNS_OK;
}
