/* The options of lights, material and effects. */
#include "app/look_options.h"

#include "app/app.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Material ---- */

static const char *shading_name(int i)
{
    return i == MNS_SHADING_CEL ? "cel" : "smooth";
}

mns_status option_shading(app_options *o, const char *name, const char *text, mns_error *error)
{
    int index;
    mns_status status = parse_name(name, text, shading_name, MNS_SHADING_CEL + 1, &index, error);
    if (!status) o->look.shading = (mns_shading)index;
    return status;
}

mns_status option_cel_bands(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_count(name, text, 64, &o->look.cel_bands, error);
}

static mns_status parse_color(const char *name, const char *text, double rgba[4], mns_error *error)
{
    mns_error what;
    if (!mns_color_parse(text, rgba, &what)) return MNS_OK;
    return app_fail(error, MNS_ERROR_USAGE, "%s: %s", name, what.text);
}

static mns_status parse_opaque(const char *name, const char *text, double color[3], mns_error *error)
{
    double rgba[4];
    mns_status status = parse_color(name, text, rgba, error);
    if (status) return status;
    if (rgba[3] != 1)
        return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected an opaque colour, R,G,B or #rrggbb", name,
                        text);
    memcpy(color, rgba, 3 * sizeof *color);
    return MNS_OK;
}

mns_status option_color(app_options *o, const char *name, const char *text, mns_error *error)
{
    mns_status status = parse_opaque(name, text, o->look.color, error);
    if (status) return status;
    o->look.set |= MNS_LOOK_COLOR;
    o->look.color_by = NULL;
    return MNS_OK;
}

mns_status option_background(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_BACKGROUND;
    return parse_color(name, text, o->look.background, error);
}

mns_status option_color_by(app_options *o, const char *name, const char *text, mns_error *error)
{
    if (!*text) return app_fail(error, MNS_ERROR_USAGE, "%s: expected the name of a column", name);
    if (o->range_is_scenes) o->look.set &= ~(unsigned)MNS_LOOK_RANGE;
    o->look.color_by = text;
    return MNS_OK;
}

static const char *color_map_name(int i)
{
    return mns_color_map_name((mns_color_map)i);
}

mns_status option_color_map(app_options *o, const char *name, const char *text, mns_error *error)
{
    int index;
    mns_status status = parse_name(name, text, color_map_name, MNS_COLOR_MAP_COUNT, &index, error);
    if (!status) o->look.color_map = (mns_color_map)index;
    return status;
}

static mns_status parse_range(const char *name, const char *text, double range[2], mns_error *error)
{
    static const char expected[] = "LO:HI, two numbers, the lower first";
    mns_status status = parse_numbers(name, text, ':', 2, range, expected, error);
    if (!status && !(range[0] < range[1]))
        return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected %s", name, text, expected);
    return status;
}

mns_status option_color_range(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_RANGE;
    o->range_is_scenes = false;
    return parse_range(name, text, o->look.range, error);
}

mns_status option_ambient(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_AMBIENT;
    return parse_weight(name, text, &o->look.ambient, error);
}

mns_status option_diffuse(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_DIFFUSE;
    return parse_weight(name, text, &o->look.diffuse, error);
}

mns_status option_specular(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_SPECULAR;
    return parse_weight(name, text, &o->look.specular, error);
}

mns_status option_shininess(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_positive(name, text, &o->look.shininess, error);
}

/* ---- Lights ---- */

/* What stands before each of up to two "@": where the light is, its strength, its colour. */
static bool split_light(const char *text, char part[3][80])
{
    for (int i = 0; i < 3; i++) {
        size_t length = strcspn(text, "@");
        if (length >= sizeof part[i]) return false;
        memcpy(part[i], text, length);
        part[i][length] = '\0';
        text += length;
        if (!*text) return true;
        text++;
    }
    return false;
}

static bool parse_place(const char *text, mns_light *light)
{
    static const char expected[] = "";
    mns_error unused; /* the caller says what was expected of the whole */
    double v[4];
    if (strcmp(text, "head") == 0) {
        light->kind = MNS_LIGHT_HEAD;
    } else if (strncmp(text, "point:", 6) == 0) {
        light->kind = MNS_LIGHT_POINT;
        return !parse_numbers("", text + 6, ',', 3, light->position, expected, &unused);
    } else if (strncmp(text, "area:", 5) == 0) {
        light->kind = MNS_LIGHT_AREA;
        if (parse_numbers("", text + 5, ',', 4, v, expected, &unused)) return false;
        memcpy(light->position, v, sizeof light->position);
        light->radius = v[3];
        return v[3] > 0;
    } else {
        light->kind = MNS_LIGHT_DIRECTIONAL;
        return !parse_direction("", text, light->direction, &unused);
    }
    return true;
}

static bool parse_light(const char *text, mns_light *light)
{
    char part[3][80] = {"", "", ""};
    mns_error unused;
    double rgba[4];
    if (!split_light(text, part) || !parse_place(part[0], light)) return false;
    bool color_first = part[1][0] == '#' || strchr(part[1], ',');
    const char *color = color_first ? part[1] : part[2], *strength = color_first ? part[2] : part[1];
    if (*strength && parse_positive("", strength, &light->strength, &unused)) return false;
    if (!*color) return true;
    if (mns_color_parse(color, rgba, NULL) || rgba[3] != 1) return false;
    memcpy(light->color, rgba, sizeof light->color);
    return true;
}

/* The first given takes the place of the scene's; those after it are added. */
mns_status option_light(app_options *o, const char *name, const char *text, mns_error *error)
{
    mns_light light = {.kind = MNS_LIGHT_HEAD};
    if (o->light_count == APP_LIGHTS)
        return app_fail(error, MNS_ERROR_USAGE, "%s: at most %d lights; take a scene for more", name,
                        APP_LIGHTS);
    if (!parse_light(text, &light))
        return app_fail(error, MNS_ERROR_USAGE,
                        "%s %.80s: expected head, X,Y,Z (a direction towards the light), point:X,Y,Z or "
                        "area:X,Y,Z,RADIUS, then @STRENGTH or @COLOR or both",
                        name, text);
    o->lights[o->light_count++] = light;
    o->look.lights = o->lights;
    o->look.light_count = o->light_count;
    o->look.set |= MNS_LOOK_LIGHT;
    return MNS_OK;
}

/* ---- Meshes ---- */

/* The first given takes the place of the scene's; those after it are added. What follows the last colon is a
 * colour where it reads as one. */
mns_status option_mesh(app_options *o, const char *name, const char *text, mns_error *error)
{
    mns_mesh mesh = {0};
    double rgba[4];
    const char *colon = strrchr(text, ':');
    size_t length = strlen(text);
    if (o->mesh_count == APP_MESHES)
        return app_fail(error, MNS_ERROR_USAGE, "%s: at most %d meshes; take a scene for more", name,
                        APP_MESHES);
    if (colon && !mns_color_parse(colon + 1, rgba, NULL) && rgba[3] == 1) {
        length = (size_t)(colon - text);
        mesh.has_color = true;
        memcpy(mesh.color, rgba, sizeof mesh.color);
    } else if (colon && access(text, F_OK) != 0) {
        return app_fail(error, MNS_ERROR_USAGE,
                        "%s %.80s: there is no such file, and %.40s is no opaque colour; expected FILE or "
                        "FILE:COLOR, a COLOR R,G,B or #rrggbb",
                        name, text, colon + 1);
    }
    if (!length) return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected FILE or FILE:COLOR", name, text);
    mesh.file = strndup(text, length);
    if (!mesh.file) return app_fail(error, MNS_ERROR_MEMORY, "out of memory reading the command line");
    o->meshes[o->mesh_count++] = mesh;
    o->look.meshes = o->meshes;
    o->look.mesh_count = o->mesh_count;
    return MNS_OK;
}

/* ---- Effects ---- */

mns_status option_look(app_options *o, const char *name, const char *text, mns_error *error)
{
    mns_look none = {0};
    mns_error what;
    if (mns_look_preset(text, &none, &what))
        return app_fail(error, MNS_ERROR_USAGE, "%s: %s", name, what.text);
    o->look.preset = text;
    return MNS_OK;
}

static mns_status parse_rays(const char *name, const char *text, long most, int *count, mns_error *error)
{
    long whole = 0;
    mns_status status = parse_whole(name, text, 0, most, &whole, error);
    if (!status) *count = (int)whole;
    return status;
}

static mns_status parse_share(const char *name, const char *text, double *share, mns_error *error)
{
    static const char expected[] = "a number from 0 to 1";
    mns_status status = parse_numbers(name, text, ',', 1, share, expected, error);
    if (!status && !(*share >= 0 && *share <= 1))
        return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected %s", name, text, expected);
    return status;
}

mns_status option_shadows(app_options *o, const char *name, const char *text, mns_error *error)
{
    mns_effects *e = &o->look.effects;
    o->look.set |= MNS_LOOK_SHADOWS;
    e->shadows = true;
    if (!text) return MNS_OK;
    mns_status status = parse_rays(name, text, 4096, &e->shadow_samples, error);
    if (!status) e->shadows = e->shadow_samples > 0;
    return status;
}

mns_status option_reflections(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_REFLECTIONS;
    return parse_rays(name, text, 8, &o->look.effects.reflections, error);
}

mns_status option_refractions(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_REFRACTIONS;
    return parse_rays(name, text, 16, &o->look.effects.refractions, error);
}

mns_status option_mirror(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_MIRROR;
    return parse_share(name, text, &o->look.effects.mirror, error);
}

mns_status option_index(app_options *o, const char *name, const char *text, mns_error *error)
{
    static const char expected[] = "a number from 1 to 100, or 0";
    double *index = &o->look.effects.index;
    o->look.set |= MNS_LOOK_INDEX;
    mns_status status = parse_numbers(name, text, ',', 1, index, expected, error);
    if (!status && *index != 0 && !(*index >= 1 && *index <= 100))
        return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected %s", name, text, expected);
    return status;
}

mns_status option_transmission(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_TRANSMISSION;
    return parse_share(name, text, &o->look.effects.transmission, error);
}

static mns_status parse_absorption(const char *name, const char *text, double v[3], mns_error *error)
{
    static const char expected[] = "R,G,B, three numbers of 0 or more, a scene unit";
    mns_status status = parse_numbers(name, text, ',', 3, v, expected, error);
    if (!status && !(v[0] >= 0 && v[1] >= 0 && v[2] >= 0))
        return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected %s", name, text, expected);
    return status;
}

mns_status option_absorption(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.set |= MNS_LOOK_ABSORPTION;
    return parse_absorption(name, text, o->look.effects.absorption, error);
}

mns_status option_occlusion(app_options *o, const char *name, const char *text, mns_error *error)
{
    mns_effects *e = &o->look.effects;
    char rays[16] = "";
    size_t length = strcspn(text, ":");
    mns_status status = MNS_OK;
    o->look.set |= MNS_LOOK_OCCLUSION;
    if (length < sizeof rays) memcpy(rays, text, length);
    if (text[length]) status = parse_positive(name, text + length + 1, &e->occlusion_reach, error);
    if (!status) status = parse_rays(name, rays, 4096, &e->occlusion_rays, error);
    return status;
}

mns_status option_environment(app_options *o, const char *name, const char *text, mns_error *error)
{
    if (!*text) return app_fail(error, MNS_ERROR_USAGE, "%s: expected sky, FILE.exr, FILE.png or none", name);
    o->look.set |= MNS_LOOK_ENVIRONMENT;
    o->look.effects.environment = strcmp(text, "none") == 0 ? NULL : text;
    return MNS_OK;
}

mns_status option_effects_seed(app_options *o, const char *name, const char *text, mns_error *error)
{
    long seed = 0;
    mns_status status = parse_whole(name, text, 0, UINT32_MAX, &seed, error);
    if (!status) o->look.effects.seed = (uint32_t)seed;
    return status;
}

/* ---- The second material ---- */

mns_status option_blend_by(app_options *o, const char *name, const char *text, mns_error *error)
{
    if (!*text) return app_fail(error, MNS_ERROR_USAGE, "%s: expected the name of a column, or none", name);
    if (strcmp(text, "none") == 0)
        o->look.blend = (mns_blend){.by = NULL};
    else
        o->look.blend.by = text;
    if (o->blend_range_is_scenes) memset(o->look.blend.range, 0, sizeof o->look.blend.range);
    return MNS_OK;
}

mns_status option_blend_range(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->blend_range_is_scenes = false;
    return parse_range(name, text, o->look.blend.range, error);
}

mns_status option_blend_color(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.blend.set |= MNS_LOOK_COLOR;
    return parse_opaque(name, text, o->look.blend.color, error);
}

mns_status option_blend_mirror(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.blend.set |= MNS_LOOK_MIRROR;
    return parse_share(name, text, &o->look.blend.mirror, error);
}

mns_status option_blend_transmission(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.blend.set |= MNS_LOOK_TRANSMISSION;
    return parse_share(name, text, &o->look.blend.transmission, error);
}

mns_status option_blend_absorption(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->look.blend.set |= MNS_LOOK_ABSORPTION;
    return parse_absorption(name, text, o->look.blend.absorption, error);
}
