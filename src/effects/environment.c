#include "effects/environment.h"

#include "base/color.h"
#include "effects/shared.h"

static const double PI = 3.14159265358979323846;

/* v turned by the shortest way that takes +y to `up` (unit). */
static vec3 turned(vec3 up, vec3 v)
{
    if (up.y < -1 + 1e-12) return (vec3){v.x, -v.y, -v.z};
    vec3 axis = vec3_cross((vec3){0, 1, 0}, up); /* as long as the angle's sine */
    vec3 across = vec3_cross(axis, v);
    return vec3_along(vec3_add(v, across), 1 / (1 + up.y), vec3_cross(axis, across));
}

environment environment_of(const mns_plan *plan)
{
    vec3 up = vec3_unit(vec3_load(plan->view.up));
    environment e = {.sky = plan->features & FEATURE_SKY,
                     .right = turned(up, (vec3){1, 0, 0}),
                     .up = up,
                     .back = turned(up, (vec3){0, 0, 1})};
    for (int c = 0; c < 3; c++) e.color[c] = color_linear(plan->look.background[c]);
    return e;
}

mns_status environment_begin(environment *e, const mns_plan *plan, mns_error *error)
{
    *e = environment_of(plan);
    return plan->features & FEATURE_ENVIRONMENT ? image_picture_read(plan->environment, &e->map, error)
                                                : MNS_OK;
}

void environment_end(environment *e)
{
    image_picture_free(&e->map);
}

static int wrapped(int x, int width)
{
    return x < 0 ? x + width : x >= width ? x - width : x;
}

static int clamped(int y, int height)
{
    return y < 0 ? 0 : y >= height ? height - 1 : y;
}

/* Between the four texels around: longitude 0 in the middle is -z, latitude 90 degrees the top. */
static void look_up(const image_picture *map, double x, double y, double z, double color[3])
{
    double across = (0.5 + atan2(x, -z) / (2 * PI)) * map->width - 0.5;
    double down = acos(fmin(fmax(y, -1), 1)) / PI * map->height - 0.5;
    double left = floor(across), top = floor(down), part_x = across - left, part_y = down - top;
    for (int c = 0; c < 3; c++) color[c] = 0;
    for (int corner = 0; corner < 4; corner++) {
        int column = wrapped((int)left + (corner & 1), map->width);
        int row = clamped((int)top + (corner >> 1), map->height);
        double part = (corner & 1 ? part_x : 1 - part_x) * (corner & 2 ? part_y : 1 - part_y);
        const float *texel = map->rgb + 3 * ((size_t)row * (size_t)map->width + (size_t)column);
        for (int c = 0; c < 3; c++) color[c] += part * (double)texel[c];
    }
}

void environment_color(const environment *e, vec3 way, double color[3])
{
    double x = vec3_dot(way, e->right), y = vec3_dot(way, e->up), z = vec3_dot(way, e->back);
    if (e->map.rgb) {
        look_up(&e->map, x, y, z, color);
        return;
    }
    for (int c = 0; c < 3; c++) color[c] = e->sky ? sky_color(c, x, y, z) : e->color[c];
}
