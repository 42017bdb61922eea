/* The keys of a scene file: a table an object, a row a key. README.md lists them for users. */
#include "scene/scene_object.h"

#include "base/memory.h"
#include "base/status.h"

#include <stdio.h>
#include <string.h>

/* ---- Inputs ---- */

static mns_status read_inputs(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    bool is_list = json_is_array(value);
    size_t count = is_list ? json_array_size(value) : 1;
    if (r->file->inputs)
        return status_fail(r->error, MNS_ERROR_INPUT, "%s: %s: expected either input or inputs, not both",
                           r->path, key);
    if (count == 0) return scene_wrong(r, key, value, "at least one name");
    r->file->inputs = memory_array(count, sizeof *r->file->inputs);
    if (!r->file->inputs) return status_no_memory(r->error, "reading a scene's inputs");
    for (size_t i = 0; i < count; i++) {
        char path[SCENE_PATH_SIZE + 16];
        snprintf(path, sizeof path, is_list ? "%s[%zu]" : "%s", key, i);
        mns_status status =
            scene_read_text(r, path, is_list ? json_array_get(value, i) : value, &r->file->inputs[i]);
        if (status) return status;
        r->file->input_count++;
    }
    return MNS_OK;
}

static mns_status read_input(scene_reader *r, const char *key, const json_t *value, void *target)
{
    if (!json_is_string(value))
        return scene_wrong(r, key, value, "a file name or a generator; for several: inputs");
    return read_inputs(r, key, value, target);
}

static mns_status read_input_list(scene_reader *r, const char *key, const json_t *value, void *target)
{
    if (!json_is_array(value)) return scene_wrong(r, key, value, "a list of file names; for one: input");
    return read_inputs(r, key, value, target);
}

/* ---- The tables ---- */

/* The value tells whether it is given, or a bit of `set` does. */
#define KEY(name, read, member) name, read, offsetof(mns_scene, member), 0, 0
#define KEY_SET(name, read, member, set, bit)                                                                \
    name, read, offsetof(mns_scene, member), offsetof(mns_scene, set), bit
/* A part that knows its place in the scene itself. */
#define PART(name, read) name, read, 0, 0, 0

static const scene_key FIELD_KEYS[] = {
    {KEY("kernel", scene_read_kernel, field.kernel)},
    {KEY("iso", scene_read_positive, field.iso)},
    {KEY("radius", scene_read_positive, field.radius)},
    {KEY("radius_scale", scene_read_positive, field.radius_scale)},
};

static const scene_key CAMERA_KEYS[] = {
    {KEY_SET("eye", scene_read_point, view.eye, view.set, MNS_VIEW_EYE)},
    {KEY_SET("look_at", scene_read_point, view.look_at, view.set, MNS_VIEW_LOOK_AT)},
    {KEY("up", scene_read_direction, view.up)},
    {KEY("fov", scene_read_angle, view.fov)},
};

static const scene_key LIGHT_KEYS[] = {
    {KEY("kind", scene_read_light_kind, look.light)},
    {KEY("direction", scene_read_direction, look.light_direction)},
};

static const scene_key MATERIAL_KEYS[] = {
    {KEY_SET("color", scene_read_color, look.color, look.set, MNS_LOOK_COLOR)},
    {KEY("color_by", scene_read_color_by, look.color_by)},
    {KEY("color_map", scene_read_color_map, look.color_map)},
    {KEY_SET("range", scene_read_range, look.range, look.set, MNS_LOOK_RANGE)},
    {KEY_SET("ambient", scene_read_weight, look.ambient, look.set, MNS_LOOK_AMBIENT)},
    {KEY_SET("diffuse", scene_read_weight, look.diffuse, look.set, MNS_LOOK_DIFFUSE)},
    {KEY_SET("specular", scene_read_weight, look.specular, look.set, MNS_LOOK_SPECULAR)},
    {KEY("shininess", scene_read_positive, look.shininess)},
    {KEY("shading", scene_read_shading, look.shading)},
    {KEY("cel_bands", scene_read_bands, look.cel_bands)},
};

static mns_status read_field(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    return scene_read_object(r, key, value, FIELD_KEYS, SCENE_COUNT(FIELD_KEYS), &r->file->scene);
}

static mns_status read_camera(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    return scene_read_object(r, key, value, CAMERA_KEYS, SCENE_COUNT(CAMERA_KEYS), &r->file->scene);
}

static mns_status read_look(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    char expected[160] = "one of";
    size_t used = strlen(expected);
    const char *text = json_string_value(value), *name;
    for (size_t i = 0; (name = mns_look_preset_name(i)); i++) {
        if (text && strcmp(name, text) == 0) {
            r->file->scene.look.preset = name;
            return MNS_OK;
        }
        used += (size_t)snprintf(expected + used, sizeof expected - used, " %s", name);
    }
    return scene_wrong(r, key, value, expected);
}

/* A direction alone means a directional light. */
static mns_status read_light(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    mns_status status =
        scene_read_object(r, key, value, LIGHT_KEYS, SCENE_COUNT(LIGHT_KEYS), &r->file->scene);
    if (!status && json_object_get(value, "direction") && !json_object_get(value, "kind"))
        r->file->scene.look.light = MNS_LIGHT_DIRECTIONAL;
    r->file->scene.look.set |= MNS_LOOK_LIGHT;
    return status;
}

static mns_status read_material(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    return scene_read_object(r, key, value, MATERIAL_KEYS, SCENE_COUNT(MATERIAL_KEYS), &r->file->scene);
}

static const scene_key SCENE_KEYS[] = {
    {PART("field", read_field)},
    {PART("input", read_input)},
    {PART("inputs", read_input_list)},
    {PART("camera", read_camera)},
    {PART("light", read_light)},
    {KEY_SET("lights", scene_read_lights, look, look.set, MNS_LOOK_LIGHT)},
    {PART("meshes", scene_read_meshes)},
    {PART("look", read_look)},
    {PART("effects", scene_read_effects)},
    {PART("material", read_material)},
    {PART("blend", scene_read_blend)},
    {KEY_SET("background", scene_read_background, look.background, look.set, MNS_LOOK_BACKGROUND)},
    {PART("size", scene_read_size)},
    {KEY("frame", scene_read_frame, frame)},
    {KEY("method", scene_read_method, draw.method)},
    {KEY("solver", scene_read_solver, draw.solver)},
    {KEY("samples", scene_read_samples, draw.samples)},
};

mns_status scene_read_keys(const json_t *root, const char *path, scene_file *file, mns_error *error)
{
    scene_reader reader = {path, file, error};
    return scene_read_object(&reader, "", root, SCENE_KEYS, SCENE_COUNT(SCENE_KEYS), &file->scene);
}
