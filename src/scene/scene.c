#include "scene/scene.h"

#include "base/memory.h"
#include "base/status.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* A scene is written by hand; what is larger is some other file. */
#define SCENE_MAX_BYTES ((size_t)16 << 20)

static void free_file(scene_file *file)
{
    if (!file) return;
    for (size_t i = 0; i < file->input_count; i++) free(file->inputs[i]);
    free(file->inputs);
    free(file->color_by);
    free(file->blend_by);
    free(file->environment);
    free(file->lights);
    for (size_t i = 0; i < file->scene.look.mesh_count; i++) free(file->mesh_files[i]);
    free(file->mesh_files);
    free(file->meshes);
    free(file);
}

void mns_scene_destroy(mns_scene *scene)
{
    free_file((scene_file *)scene);
}

/* "word:digit...": a generator, not a file. */
static bool is_generator(const char *name)
{
    const char *c = name;
    while (islower((unsigned char)*c)) c++;
    return c > name && *c == ':' && isdigit((unsigned char)c[1]);
}

/* Puts the scene's folder before a relative file name. */
static mns_status resolve(char **name, const char *path, mns_error *error)
{
    const char *slash = strrchr(path, '/');
    size_t folder = slash ? (size_t)(slash - path) + 1 : 0, length = strlen(*name) + 1;
    if (folder == 0 || (*name)[0] == '/') return MNS_OK;
    char *full = memory_array(folder + length, 1);
    if (!full) return status_no_memory(error, "reading a scene");
    memcpy(full, path, folder);
    memcpy(full + folder, *name, length);
    free(*name);
    *name = full;
    return MNS_OK;
}

static mns_status resolve_files(scene_file *file, const char *path, mns_error *error)
{
    mns_status status = MNS_OK;
    for (size_t i = 0; i < file->input_count && !status; i++)
        if (!is_generator(file->inputs[i])) status = resolve(&file->inputs[i], path, error);
    for (size_t i = 0; i < file->scene.look.mesh_count && !status; i++) {
        status = resolve(&file->mesh_files[i], path, error);
        file->meshes[i].file = file->mesh_files[i];
    }
    if (!status && file->environment && strcmp(file->environment, "sky") != 0)
        status = resolve(&file->environment, path, error);
    return status;
}

mns_status scene_parse(const char *text, size_t size, const char *path, mns_scene **scene, mns_error *error)
{
    json_error_t where;
    json_t *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &where);
    if (!root)
        return status_fail(error, MNS_ERROR_INPUT, "%s:%d:%d: expected JSON: %s", path, where.line,
                           where.column, where.text);
    mns_status status = MNS_ERROR_MEMORY;
    scene_file *file = calloc(1, sizeof *file);
    if (!file) {
        status_no_memory(error, "reading a scene");
        goto fail;
    }
    status = scene_read_keys(root, path, file, error);
    if (!status) status = resolve_files(file, path, error);
    if (status) goto fail;
    json_decref(root);
    file->scene.inputs = (const char *const *)file->inputs;
    file->scene.input_count = file->input_count;
    file->scene.look.color_by = file->color_by;
    file->scene.look.blend.by = file->blend_by;
    file->scene.look.effects.environment = file->environment;
    file->scene.look.lights = file->lights;
    file->scene.look.meshes = file->meshes;
    *scene = &file->scene;
    return MNS_OK;

fail:
    json_decref(root);
    free_file(file);
    return status;
}

/* The whole file as bytes; the caller frees *text. */
static mns_status read_text(const char *path, char **text, size_t *size, mns_error *error)
{
    char *bytes = NULL;
    mns_status status = MNS_ERROR_IO;
    FILE *stream = fopen(path, "rb");
    struct stat about;
    if (!stream || fstat(fileno(stream), &about)) {
        status_fail(error, status, "%s: cannot open the scene: %s", path, strerror(errno));
        goto fail;
    }
    if (S_ISDIR(about.st_mode)) {
        status_fail(error, status, "%s: is a folder; expected a JSON scene file", path);
        goto fail;
    }
    /* The size is read off the bytes, for a pipe has none to tell. */
    size_t used = 0, room = 1 << 14;
    bytes = memory_array(room, 1);
    while (bytes && (used += fread(bytes + used, 1, room - used, stream)) == room && room < SCENE_MAX_BYTES) {
        char *larger = memory_resize(bytes, room * 2, 1);
        if (!larger) free(bytes);
        bytes = larger;
        room *= 2;
    }
    if (!bytes) {
        status = status_no_memory(error, "reading a scene");
        goto fail;
    }
    if (ferror(stream)) {
        status_fail(error, status, "%s: byte %zu: cannot read the scene: %s", path, used, strerror(errno));
        goto fail;
    }
    if (used >= SCENE_MAX_BYTES) {
        status =
            status_fail(error, MNS_ERROR_INPUT,
                        "%s: more than %zu MiB; expected a JSON scene, with particles in files of their own",
                        path, SCENE_MAX_BYTES >> 20);
        goto fail;
    }
    fclose(stream);
    *text = bytes;
    *size = used;
    return MNS_OK;

fail:
    free(bytes);
    if (stream) fclose(stream);
    return status;
}

mns_status mns_scene_load(const char *path, mns_scene **scene, mns_error *error)
{
    if (!path || !scene) return status_fail(error, MNS_ERROR_USAGE, "scene: no name, or nowhere to put it");
    char *text = NULL;
    size_t size = 0;
    mns_status status = read_text(path, &text, &size, error);
    if (status) return status;
    status = scene_parse(text, size, path, scene, error);
    free(text);
    return status;
}
