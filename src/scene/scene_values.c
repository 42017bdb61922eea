#include "scene/scene_values.h"

#include "base/status.h"
#include "scene/view.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

static const char *type_name(const json_t *value)
{
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        return "a list";
    case JSON_STRING:
        return "a string";
    case JSON_INTEGER:
    case JSON_REAL:
        return "a number";
    case JSON_NULL:
        return "null";
    default:
        return "true or false";
    }
}

/* The value is not what the key wants: says what it is, and what was expected. */
mns_status scene_wrong(scene_reader *r, const char *key, const json_t *value, const char *expected)
{
    const char *dot = *key ? ": " : "";
    if (json_is_string(value))
        return status_fail(r->error, MNS_ERROR_INPUT, "%s: %s%s\"%.60s\": expected %s", r->path, key, dot,
                           json_string_value(value), expected);
    if (json_is_number(value))
        return status_fail(r->error, MNS_ERROR_INPUT, "%s: %s%s%.9g: expected %s", r->path, key, dot,
                           json_number_value(value), expected);
    return status_fail(r->error, MNS_ERROR_INPUT, "%s: %s%s%s: expected %s", r->path, key, dot,
                       type_name(value), expected);
}

/* ---- Numbers, colours ---- */

static mns_status read_number(scene_reader *r, const char *key, const json_t *value, void *target)
{
    if (!json_is_number(value)) return scene_wrong(r, key, value, "a number");
    *(double *)target = json_number_value(value);
    return MNS_OK;
}

mns_status scene_read_positive(scene_reader *r, const char *key, const json_t *value, void *target)
{
    if (!json_is_number(value) || !(json_number_value(value) > 0))
        return scene_wrong(r, key, value, "a number above 0");
    return read_number(r, key, value, target);
}

mns_status scene_read_weight(scene_reader *r, const char *key, const json_t *value, void *target)
{
    if (!json_is_number(value) || !(json_number_value(value) >= 0))
        return scene_wrong(r, key, value, "a number of 0 or more");
    return read_number(r, key, value, target);
}

mns_status scene_read_angle(scene_reader *r, const char *key, const json_t *value, void *target)
{
    double degrees = json_number_value(value);
    if (!(degrees > 0 && degrees < 180))
        return scene_wrong(r, key, value, "degrees between 0 and 180, both excluded");
    return read_number(r, key, value, target);
}

/* Exactly `count` numbers. */
static mns_status read_numbers(scene_reader *r, const char *key, const json_t *value, double *target,
                               size_t count, const char *expected)
{
    if (!json_is_array(value) || json_array_size(value) != count) return scene_wrong(r, key, value, expected);
    for (size_t i = 0; i < count; i++) {
        char path[SCENE_PATH_SIZE + 16];
        snprintf(path, sizeof path, "%s[%zu]", key, i);
        mns_status status = read_number(r, path, json_array_get(value, i), &target[i]);
        if (status) return status;
    }
    return MNS_OK;
}

mns_status scene_read_point(scene_reader *r, const char *key, const json_t *value, void *target)
{
    return read_numbers(r, key, value, target, 3, "a list of three numbers");
}

mns_status scene_read_direction(scene_reader *r, const char *key, const json_t *value, void *target)
{
    const double *v = target;
    mns_status status = scene_read_point(r, key, value, target);
    if (!status && v[0] == 0 && v[1] == 0 && v[2] == 0)
        return scene_wrong(r, key, value, "three numbers that are not all 0");
    return status;
}

mns_status scene_read_range(scene_reader *r, const char *key, const json_t *value, void *target)
{
    static const char expected[] = "a list of two numbers, the lower first";
    const double *range = target;
    mns_status status = read_numbers(r, key, value, target, 2, expected);
    return !status && !(range[0] < range[1]) ? scene_wrong(r, key, value, expected) : status;
}

/* [r, g, b] with an alpha if `with_alpha`, or text as of mns_color_parse. */
static mns_status read_rgba(scene_reader *r, const char *key, const json_t *value, bool with_alpha,
                            double rgba[4])
{
    const char *expected = with_alpha
                               ? "a list of three or four numbers in [0, 1], \"#rrggbb\", \"#rrggbbaa\" or "
                                 "\"transparent\""
                               : "a list of three numbers in [0, 1], or \"#rrggbb\"";
    rgba[3] = 1;
    if (json_is_string(value)) {
        bool good = !mns_color_parse(json_string_value(value), rgba, NULL);
        return good && (with_alpha || rgba[3] == 1) ? MNS_OK : scene_wrong(r, key, value, expected);
    }
    size_t count = json_array_size(value);
    if (count != 3 && !(count == 4 && with_alpha)) return scene_wrong(r, key, value, expected);
    mns_status status = read_numbers(r, key, value, rgba, count, expected);
    for (size_t i = 0; i < count && !status; i++)
        if (!(rgba[i] >= 0 && rgba[i] <= 1)) status = scene_wrong(r, key, json_array_get(value, i), expected);
    return status;
}

mns_status scene_read_color(scene_reader *r, const char *key, const json_t *value, void *target)
{
    double rgba[4];
    mns_status status = read_rgba(r, key, value, false, rgba);
    if (!status) memcpy(target, rgba, 3 * sizeof *rgba);
    return status;
}

mns_status scene_read_background(scene_reader *r, const char *key, const json_t *value, void *target)
{
    return read_rgba(r, key, value, true, target);
}

mns_status scene_read_bands(scene_reader *r, const char *key, const json_t *value, void *target)
{
    json_int_t bands = json_integer_value(value);
    if (bands < 1 || bands > 64) return scene_wrong(r, key, value, "a whole number from 1 to 64");
    *(int *)target = (int)bands;
    return MNS_OK;
}

mns_status scene_read_whole(scene_reader *r, const char *key, const json_t *value, int least, int most,
                            int *to)
{
    char expected[80];
    json_int_t number = json_is_integer(value) ? json_integer_value(value) : -1;
    snprintf(expected, sizeof expected, "a whole number from %d to %d", least, most);
    if (number < least || number > most) return scene_wrong(r, key, value, expected);
    *to = (int)number;
    return MNS_OK;
}

mns_status scene_read_samples(scene_reader *r, const char *key, const json_t *value, void *target)
{
    return scene_read_whole(r, key, value, 1, 64, target);
}

mns_status scene_read_frame(scene_reader *r, const char *key, const json_t *value, void *target)
{
    return scene_read_whole(r, key, value, 0, INT_MAX, target);
}

mns_status scene_read_size(scene_reader *r, const char *key, const json_t *value, void *target)
{
    static const char expected[] = "a list of two whole numbers from 1 to 65536, width and height";
    (void)target;
    int *size[2] = {&r->file->scene.view.width, &r->file->scene.view.height};
    if (json_array_size(value) != 2) return scene_wrong(r, key, value, expected);
    for (size_t i = 0; i < 2; i++) {
        json_int_t pixels = json_integer_value(json_array_get(value, i));
        if (pixels < 1 || pixels > VIEW_MAX_SIZE)
            return scene_wrong(r, key, json_array_get(value, i), expected);
        *size[i] = (int)pixels;
    }
    return MNS_OK;
}

/* ---- Names ---- */

/* The value as an index below `count` by its name; `name_of` gives NULL for an index that has none. */
static mns_status read_name(scene_reader *r, const char *key, const json_t *value,
                            const char *(*name_of)(int), int count, int *index)
{
    char expected[160] = "one of";
    size_t used = strlen(expected);
    for (int i = 0; i < count; i++) {
        const char *name = name_of(i);
        if (!name) continue;
        if (json_is_string(value) && strcmp(json_string_value(value), name) == 0) {
            *index = i;
            return MNS_OK;
        }
        if (used < sizeof expected)
            used += (size_t)snprintf(expected + used, sizeof expected - used, " %s", name);
    }
    return scene_wrong(r, key, value, expected);
}

static const char *kernel_name(int i)
{
    return i == MNS_KERNEL_DEFAULT ? NULL : mns_kernel_name((mns_kernel)i);
}

static const char *color_map_name(int i)
{
    return mns_color_map_name((mns_color_map)i);
}

static const char *light_name(int i)
{
    return i == MNS_LIGHT_HEAD ? "head" : "directional";
}

static const char *shading_name(int i)
{
    return i == MNS_SHADING_SMOOTH ? "smooth" : "cel";
}

mns_status scene_read_kernel(scene_reader *r, const char *key, const json_t *value, void *target)
{
    int index = 0;
    mns_status status = read_name(r, key, value, kernel_name, MNS_KERNEL_COUNT, &index);
    if (!status) *(mns_kernel *)target = (mns_kernel)index;
    return status;
}

mns_status scene_read_color_map(scene_reader *r, const char *key, const json_t *value, void *target)
{
    int index = 0;
    mns_status status = read_name(r, key, value, color_map_name, MNS_COLOR_MAP_COUNT, &index);
    if (!status) *(mns_color_map *)target = (mns_color_map)index;
    return status;
}

mns_status scene_read_light_kind(scene_reader *r, const char *key, const json_t *value, void *target)
{
    int index = 0;
    mns_status status = read_name(r, key, value, light_name, MNS_LIGHT_DIRECTIONAL + 1, &index);
    if (!status) *(mns_light_kind *)target = (mns_light_kind)index;
    return status;
}

mns_status scene_read_shading(scene_reader *r, const char *key, const json_t *value, void *target)
{
    int index = 0;
    mns_status status = read_name(r, key, value, shading_name, MNS_SHADING_CEL + 1, &index);
    if (!status) *(mns_shading *)target = (mns_shading)index;
    return status;
}

static const char *method_name(int i)
{
    return mns_method_name((mns_method)i);
}

static const char *solver_name(int i)
{
    return mns_solver_name((mns_solver)i);
}

mns_status scene_read_method(scene_reader *r, const char *key, const json_t *value, void *target)
{
    int index = 0;
    mns_status status = read_name(r, key, value, method_name, MNS_METHOD_BVH + 1, &index);
    if (!status) *(mns_method *)target = (mns_method)index;
    return status;
}

mns_status scene_read_solver(scene_reader *r, const char *key, const json_t *value, void *target)
{
    int index = 0;
    mns_status status = read_name(r, key, value, solver_name, MNS_SOLVER_SECANT + 1, &index);
    if (!status) *(mns_solver *)target = (mns_solver)index;
    return status;
}

mns_status scene_read_text(scene_reader *r, const char *key, const json_t *value, char **text)
{
    const char *string = json_string_value(value);
    if (!string || !*string) return scene_wrong(r, key, value, "a string that is not empty");
    *text = strdup(string);
    return *text ? MNS_OK : status_no_memory(r->error, "reading a scene");
}

mns_status scene_read_color_by(scene_reader *r, const char *key, const json_t *value, void *target)
{
    (void)target;
    return scene_read_text(r, key, value, &r->file->color_by);
}
