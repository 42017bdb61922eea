#include "window/scene_json.h"

#include "base/status.h"

#include <errno.h>
#include <jansson.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Values ---- */

static void put(json_t *to, const char *key, json_t *value)
{
    json_object_set_new(to, key, value);
}

static void put_positive(json_t *to, const char *key, double value)
{
    if (value > 0) put(to, key, json_real(value));
}

static json_t *numbers(const double *v, size_t count)
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) json_array_append_new(list, json_real(v[i]));
    return list;
}

/* An object with nothing in it is left out. */
static void put_object(json_t *to, const char *key, json_t *object)
{
    if (json_object_size(object))
        put(to, key, object);
    else
        json_decref(object);
}

/* A file by its whole name: the scene may be saved anywhere. A generator stays as it is. */
static json_t *file_name(const char *name)
{
    char *whole = realpath(name, NULL);
    json_t *text = json_string(whole ? whole : name);
    free(whole);
    return text;
}

/* ---- Parts of a scene ---- */

static json_t *inputs_of(const window_settings *s)
{
    if (s->input_count == 1) return file_name(s->inputs[0]);
    json_t *list = json_array();
    for (size_t i = 0; i < s->input_count; i++) json_array_append_new(list, file_name(s->inputs[i]));
    return list;
}

static json_t *field_of(const mns_input_options *field)
{
    json_t *to = json_object();
    if (field->kernel) put(to, "kernel", json_string(mns_kernel_name(field->kernel)));
    put_positive(to, "iso", field->iso);
    put_positive(to, "radius", field->radius);
    put_positive(to, "radius_scale", field->radius_scale);
    return to;
}

static json_t *camera_json(const mns_view *view)
{
    json_t *to = json_object();
    put(to, "eye", numbers(view->eye, 3));
    put(to, "look_at", numbers(view->look_at, 3));
    put(to, "up", numbers(view->up, 3));
    put(to, "fov", json_real(view->fov));
    return to;
}

static bool is_zero(const double v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

static json_t *light_json(const mns_light *light)
{
    static const char *const kinds[] = {"head", "directional", "point", "area"};
    json_t *to = json_object();
    put(to, "kind", json_string(kinds[light->kind]));
    if (!is_zero(light->direction)) put(to, "direction", numbers(light->direction, 3));
    if (light->kind == MNS_LIGHT_POINT || light->kind == MNS_LIGHT_AREA)
        put(to, "position", numbers(light->position, 3));
    put_positive(to, "radius", light->radius);
    if (!is_zero(light->color)) put(to, "color", numbers(light->color, 3));
    put_positive(to, "strength", light->strength);
    return to;
}

static void put_lights(json_t *to, const mns_look *look)
{
    if (look->light_count) {
        json_t *list = json_array();
        for (size_t i = 0; i < look->light_count; i++)
            json_array_append_new(list, light_json(&look->lights[i]));
        put(to, "lights", list);
        return;
    }
    if (!(look->set & MNS_LOOK_LIGHT) && !look->light) return;
    json_t *light = json_pack("{s:s}", "kind", look->light == MNS_LIGHT_HEAD ? "head" : "directional");
    if (!is_zero(look->light_direction)) put(light, "direction", numbers(look->light_direction, 3));
    put(to, "light", light);
}

static json_t *material_of(const mns_look *look)
{
    json_t *to = json_object();
    const struct {
        const char *key;
        unsigned bit;
        double value;
    } weight[] = {{"ambient", MNS_LOOK_AMBIENT, look->ambient},
                  {"diffuse", MNS_LOOK_DIFFUSE, look->diffuse},
                  {"specular", MNS_LOOK_SPECULAR, look->specular}};
    if (look->set & MNS_LOOK_COLOR) put(to, "color", numbers(look->color, 3));
    if (look->color_by) put(to, "color_by", json_string(look->color_by));
    if (look->color_map) put(to, "color_map", json_string(mns_color_map_name(look->color_map)));
    if (look->set & MNS_LOOK_RANGE) put(to, "range", numbers(look->range, 2));
    for (size_t i = 0; i < 3; i++)
        if (look->set & weight[i].bit || weight[i].value > 0)
            put(to, weight[i].key, json_real(weight[i].value));
    put_positive(to, "shininess", look->shininess);
    if (look->shading == MNS_SHADING_CEL) put(to, "shading", json_string("cel"));
    if (look->cel_bands) put(to, "cel_bands", json_integer(look->cel_bands));
    return to;
}

static json_t *blend_of(const mns_blend *b)
{
    json_t *to = json_object();
    if (!b->by) return to;
    put(to, "by", json_string(b->by));
    if (b->range[0] != 0 || b->range[1] != 0) put(to, "range", numbers(b->range, 2));
    if (b->set & MNS_LOOK_COLOR || !is_zero(b->color)) put(to, "color", numbers(b->color, 3));
    if (b->set & MNS_LOOK_MIRROR || b->mirror > 0) put(to, "mirror", json_real(b->mirror));
    if (b->set & MNS_LOOK_TRANSMISSION || b->transmission > 0)
        put(to, "transmission", json_real(b->transmission));
    if (b->set & MNS_LOOK_ABSORPTION || !is_zero(b->absorption))
        put(to, "absorption", numbers(b->absorption, 3));
    return to;
}

/* A whole number that is given, be it by a bit that says that 0 is meant. */
static void put_whole(json_t *to, const char *key, const mns_look *look, unsigned bit, int value)
{
    if (look->set & bit || value) put(to, key, json_integer(value));
}

static void put_share(json_t *to, const char *key, const mns_look *look, unsigned bit, double value)
{
    if (look->set & bit || value > 0) put(to, key, json_real(value));
}

static json_t *effects_of(const mns_look *look)
{
    const mns_effects *e = &look->effects;
    json_t *to = json_object();
    if (e->shadows && e->shadow_samples)
        put(to, "shadows", json_integer(e->shadow_samples));
    else if (e->shadows || look->set & MNS_LOOK_SHADOWS)
        put(to, "shadows", json_boolean(e->shadows));
    put_whole(to, "reflections", look, MNS_LOOK_REFLECTIONS, e->reflections);
    put_whole(to, "refractions", look, MNS_LOOK_REFRACTIONS, e->refractions);
    put_share(to, "mirror", look, MNS_LOOK_MIRROR, e->mirror);
    put_positive(to, "index", e->index);
    put_share(to, "transmission", look, MNS_LOOK_TRANSMISSION, e->transmission);
    if (look->set & MNS_LOOK_ABSORPTION || !is_zero(e->absorption))
        put(to, "absorption", numbers(e->absorption, 3));
    if (e->occlusion_rays && e->occlusion_reach > 0)
        put(to, "occlusion", json_pack("{s:i, s:f}", "rays", e->occlusion_rays, "reach", e->occlusion_reach));
    else
        put_whole(to, "occlusion", look, MNS_LOOK_OCCLUSION, e->occlusion_rays);
    if (e->environment && *e->environment)
        put(to, "environment",
            strcmp(e->environment, "sky") ? file_name(e->environment) : json_string("sky"));
    if (e->seed) put(to, "seed", json_integer(e->seed));
    return to;
}

static void put_meshes(json_t *to, const mns_look *look)
{
    json_t *list = json_array();
    for (size_t i = 0; i < look->mesh_count; i++) {
        const mns_mesh *mesh = &look->meshes[i];
        json_t *one = json_object();
        put(one, "file", file_name(mesh->file));
        if (mesh->has_color) put(one, "color", numbers(mesh->color, 3));
        json_array_append_new(list, one);
    }
    if (look->mesh_count)
        put(to, "meshes", list);
    else
        json_decref(list);
}

/* ---- The file ---- */

static json_t *scene_of(const window_settings *s, const mns_look *look, const mns_view *view, long frame)
{
    json_t *to = json_object();
    put(to, s->input_count == 1 ? "input" : "inputs", inputs_of(s));
    if (frame) put(to, "frame", json_integer(frame));
    put_object(to, "field", field_of(&s->field));
    put(to, "size", json_pack("[i, i]", view->width, view->height));
    put(to, "camera", camera_json(view));
    if (look->preset && *look->preset) put(to, "look", json_string(look->preset));
    put_lights(to, look);
    put_meshes(to, look);
    put_object(to, "material", material_of(look));
    put_object(to, "effects", effects_of(look));
    put_object(to, "blend", blend_of(&look->blend));
    if (look->set & MNS_LOOK_BACKGROUND) put(to, "background", numbers(look->background, 4));
    if (s->draw.method) put(to, "method", json_string(mns_method_name(s->draw.method)));
    if (s->draw.solver) put(to, "solver", json_string(mns_solver_name(s->draw.solver)));
    if (s->draw.samples > 1) put(to, "samples", json_integer(s->draw.samples));
    return to;
}

/* JSON is UTF-8, and names of files need not be. Errors: UNSUPPORTED. */
static mns_status check_text(const char *name, bool is_file, mns_error *error)
{
    json_t *text = !name ? json_null() : is_file ? file_name(name) : json_string(name);
    json_decref(text);
    if (text) return MNS_OK;
    return status_fail(error, MNS_ERROR_UNSUPPORTED,
                       "%.200s: a scene is UTF-8 text, and this name is not; ctrl+C copies a command line",
                       name);
}

static mns_status check_names(const window_settings *s, const mns_look *look, mns_error *error)
{
    mns_status status = check_text(look->color_by, false, error);
    if (!status) status = check_text(look->blend.by, false, error);
    if (!status) status = check_text(look->effects.environment, true, error);
    for (size_t i = 0; i < s->input_count && !status; i++) status = check_text(s->inputs[i], true, error);
    for (size_t i = 0; i < look->mesh_count && !status; i++)
        status = check_text(look->meshes[i].file, true, error);
    return status;
}

mns_status scene_json_write(const window_settings *s, const mns_look *look, const mns_view *view, long frame,
                            const char *path, mns_error *error)
{
    char beside[PATH_MAX];
    mns_status status = check_names(s, look, error);
    if (status) return status;
    json_t *scene = scene_of(s, look, view, frame);
    if (!scene) return status_no_memory(error, "writing a scene");
    errno = 0;
    snprintf(beside, sizeof beside, "%s.meniscus-%ld.part", path, (long)getpid());
    if (json_dump_file(scene, beside, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) || rename(beside, path)) {
        status =
            status_fail(error, MNS_ERROR_IO, "%.300s: cannot write: %s", path, strerror(errno ? errno : EIO));
        unlink(beside);
    }
    json_decref(scene);
    return status;
}
