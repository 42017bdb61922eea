// What light does beyond a pixel's first hit, as a walk that takes one ray after the other: at each surface those to the lights, those
// of the ambient light, then what is mirrored and what goes through, each with all that it leads to. The truth, as a recursion, is
// src/effects/effects.c.
//
// Between two rays all that the walk knows stands in path_* and place_*, and path_next asks for the same ray again until path_use has
// had its answer: so a walk can be left at any ray, and taken up by another dispatch, or in doubles. Rays and places are REAL; light is
// float.
#if defined(MIRROR) || defined(REFRACTION)
#define PATHS_ON
#endif

const REAL LEAVE_DOUBT = NUM(16.0); // what f may be off L where a ray leaves the surface, in roundings
const int LIGHT_HEAD = 0, LIGHT_DIRECTIONAL = 1, LIGHT_AREA = 3;

// The pixel so far.
uvec2 path_pixel = uvec2(0u);    // from the top left
vec3 path_color = vec3(0.0);
vec4 path_terms = vec4(0.0);     // of the first hit: shadow, occlusion, mirror.t, refract.t
bool path_doubt = false;         // some ray was undecided
int path_top = 0;                // rays that wait

// The surface that the walk is at.
uint place_path = 0u;            // its number on the way (samples.glsl); 0: the walk is at none
REAL3 place_at = REAL3(0.0);
REAL3 place_normal = REAL3(0.0); // turned to the viewer
REAL3 place_viewer = REAL3(0.0); // towards
bool place_inside = false;       // the viewer is in the medium
uvec2 place_left = uvec2(0u);    // levels of mirroring, surfaces to pass
vec3 place_albedo = vec3(0.0);
vec3 place_share = vec3(0.0);    // of the pixel
float place_mirrored = 0.0;      // share of it
vec3 place_shaded = vec3(0.0);   // diffuse light so far
vec3 place_shine = vec3(0.0);
float place_shadow = 0.0;        // the shares of the casting lights, summed
float place_seen = 0.0;          // rays that met nothing, of the present light's or of the ambient light's
uint place_light = 0u;           // the present light; past the last: the ambient
uint place_sample = 0u;          // rays that it has had

#ifdef PATHS_ON
// Rays that wait, the last first.
vec3 wait_at[PATH_STACK];
vec3 wait_way[PATH_STACK];
vec3 wait_share[PATH_STACK];
uvec4 wait_rest[PATH_STACK]; // path, levels of mirroring, surfaces to pass; 1: into the medium
#endif

// The ray that path_next asks for.
const int ASKS_LIGHT = 0, ASKS_OCCLUSION = 1, ASKS_PATH = 2;
Ray path_ray = Ray(REAL3(0.0), REAL3(0.0));
REAL path_limit = NUM(0.0);
bool path_inwards = false;
#if defined(OCCLUSION) || defined(PATHS_ON)
int path_asks = ASKS_LIGHT;
#define PATH_ASKS(what) path_asks = what
#else
const int path_asks = ASKS_LIGHT;
#define PATH_ASKS(what)
#endif

#include "paths_kind.glsl"
#include "paths_material.glsl"

// ---- Places

#ifdef FRESNEL
REAL place_ratio()
{
    return place_inside ? NUM(1.0) / REAL(path_optics.y) : REAL(path_optics.y);
}
#endif

REAL place_cosine()
{
    return min(dot(place_normal, place_viewer), NUM(1.0));
}

// What of the light is neither mirrored nor goes through.
float place_opaque()
{
    return place_solid ? 1.0 : (1.0 - place_transmission()) * (1.0 - place_mirrored);
}

// The place's normal and viewer, for a ray that came along `way`.
void place_turn(REAL3 way, REAL3 outward)
{
    place_inside = dot(outward, way) > NUM(0.0);
    place_normal = place_inside ? -outward : outward;
    place_viewer = -way;
}

// Takes the surface that a ray met after `length`, at place_at; its colour is set.
void place_take(uint path, REAL3 way, REAL3 outward, REAL length, vec3 share, uvec2 left)
{
    place_path = path;
    place_turn(way, outward);
#ifdef SOLIDS
    if (place_solid) place_inside = place_within(path, way);
#endif
    place_share = place_inside ? share * path_absorbed(length) : share;
    place_left = left;
    place_mirrored = place_mirror();
#ifdef FRESNEL
    float shown = float(optics_fresnel(place_ratio(), place_cosine()));
    place_mirrored = shown == 1.0 ? 1.0 : place_mirrored + (1.0 - place_mirrored) * shown;
#endif
    if (place_solid) place_mirrored = 0.0;
    place_shaded = place_shine = vec3(0.0);
    place_shadow = place_seen = 0.0;
    place_light = place_sample = 0u;
}

// ---- Lights

void light_done(vec3 to_light, float share)
{
    vec4 radiance = light_sent(place_light);
    if (int(radiance.w) != LIGHT_HEAD) place_shadow += share;
    vec2 given = lighting_of(vec3(place_normal), vec3(place_viewer), to_light);
    place_shaded += lighting.y * share * given.x * radiance.rgb;
    if (!place_solid) place_shine += share * given.y * radiance.rgb;
    place_light++;
    place_sample = 0u;
    place_seen = 0.0;
}

#if defined(SOFT_SHADOWS) || defined(OCCLUSION)
uint place_key(uint purpose)
{
    return samples_key(path_pixel.x, path_pixel.y, path_levels.z, place_path, purpose);
}

REAL3 place_turned(REAL3 to, REAL3 v)
{
    return REAL3(samples_turned(0, to.x, to.y, to.z, v.x, v.y, v.z), samples_turned(1, to.x, to.y, to.z, v.x, v.y, v.z),
                 samples_turned(2, to.x, to.y, to.z, v.x, v.y, v.z));
}
#endif

#ifdef SOFT_SHADOWS
// The next ray to the present light, a sphere in the direction `to`. False: it leaves below the surface.
bool light_sample(REAL3 to, REAL away, REAL ratio)
{
    uint key = place_key(1u + place_light);
    uint index = path_levels.w * uint(path_counts.z) + place_sample;
    REAL u = samples_number(key, index, 0);
    REAL v = samples_number(key, index, 1);
    REAL width = samples_cone_width(ratio);
    path_ray.way = place_turned(to, REAL3(samples_cone(0, width, u, v), samples_cone(1, width, u, v), samples_cone(2, width, u, v)));
    path_limit = away * samples_sphere_distance(ratio, u * width);
    return dot(path_ray.way, place_normal) > NUM(0.0);
}
#endif

// The next ray to the present light. False: it needs none, or no more, and is done, or not this one.
bool light_next()
{
    int kind = int(light_sent(place_light).w);
    REAL3 to = REAL3(light_at(place_light).xyz);
    REAL away = FAR_AWAY;
    if (kind != LIGHT_DIRECTIONAL) {
        to -= place_at;
        away = sqrt(dot(to, to));
        to /= away;
    }
    bool lit = dot(place_normal, to) > NUM(0.0);
    float share = lit ? 1.0 : 0.0;
#ifdef SHADOWS
    if (lit && kind != LIGHT_HEAD) {
        PATH_ASKS(ASKS_LIGHT);
        path_ray.start = place_at;
        path_inwards = place_inside;
        path_ray.way = to;
        path_limit = away;
        uint count = 1u;
#ifdef SOFT_SHADOWS
        REAL ratio = REAL(light_at(place_light).w) / away;
        if (kind == LIGHT_AREA) count = ratio < NUM(1.0) ? uint(path_counts.z) : 0u;
        if (kind == LIGHT_AREA && place_sample < count && !light_sample(to, away, ratio)) {
            place_sample++;
            return false;
        }
#endif
        if (place_sample < count) return true;
        if (count > 0u) share = place_seen / float(count);
    }
#endif
    light_done(vec3(to), share);
    return false;
}

#ifdef OCCLUSION
// The next ray of the ambient light. False: none is left.
bool occlusion_next()
{
    uint count = uint(path_counts.w);
    if (place_sample == count || !(place_opaque() > 0.0)) return false;
    uint key = place_key(0u);
    uint index = path_levels.w * count + place_sample;
    REAL u = samples_number(key, index, 0);
    REAL v = samples_number(key, index, 1);
    PATH_ASKS(ASKS_OCCLUSION);
    path_ray.start = place_at;
    path_ray.way = place_turned(place_normal, REAL3(samples_hemisphere(0, u, v), samples_hemisphere(1, u, v), samples_hemisphere(2, u, v)));
    path_limit = REAL(path_optics.w);
    path_inwards = place_inside;
    return true;
}
#endif

// ---- Rays on

#ifdef MIRROR
REAL3 place_mirror_way()
{
    REAL3 way = NUM(2.0) * place_cosine() * place_normal - place_viewer;
    return way / sqrt(dot(way, way));
}
#endif

#ifdef REFRACTION
REAL3 place_refracted_way()
{
    REAL3 way = -place_viewer;
#ifdef FRESNEL
    REAL ratio = place_ratio();
    way = (way + optics_bend(ratio, place_cosine()) * place_normal) / ratio;
    way /= sqrt(dot(way, way));
#endif
    return way;
}
#endif

#ifdef PATHS_ON
// Puts off a ray that leaves the place; one that is not to be traced sees the environment at once.
void path_put_off(REAL3 way, uint path, bool traced, uvec2 left, float share, bool inwards)
{
    vec3 part = place_share * share;
    if (!traced || max(part.r, max(part.g, part.b)) < float(optics_least_share())) {
        path_color += part * environment_color(vec3(way));
        return;
    }
    wait_at[path_top] = vec3(place_at);
    wait_way[path_top] = vec3(way);
    wait_share[path_top] = part;
    wait_weigh(path_top);
    wait_rest[path_top] = uvec4(path, left, inwards ? 1u : 0u);
    path_top++;
}
#endif

// Leaves the place: what it shows is the pixel's, and its rays on wait.
void place_finish()
{
    float open = 1.0;
#ifdef OCCLUSION
    if (place_sample > 0u) open = place_seen / float(path_counts.w);
#endif
    if (place_path == 1u) {
        path_terms.x = path_counts.y > 0 ? place_shadow / float(path_counts.y) : 1.0;
        path_terms.y = open;
    }
    if (place_solid || !lighting_contour(vec3(place_normal), vec3(place_viewer))) {
        vec3 shaded = place_albedo * (lighting.x * open + place_shaded);
        path_color += place_share * (place_shine + place_opaque() * shaded);
    }
#ifdef REFRACTION
    float passes = place_solid ? 0.0 : place_transmission() * (1.0 - place_mirrored);
    if (passes > 0.0) {
        uint some = min(place_left.y, 1u);
        path_put_off(place_refracted_way(), 2u * place_path + 1u, some > 0u, place_left - uvec2(0u, some), passes, !place_inside);
    }
#endif
#ifdef MIRROR
    if (place_mirrored > 0.0) {
        uvec2 left = place_left;
        bool traced = left.x > 0u;
#ifdef FRESNEL
        // A total reflection is one of the surfaces that a ray may pass; only where none is left is it a mirror's level.
        if (left.y > 0u && optics_beyond(place_ratio(), place_cosine()) <= NUM(0.0)) {
            traced = true;
            left.y--;
        } else
#endif
            left.x -= min(left.x, 1u);
        path_put_off(place_mirror_way(), 2u * place_path, traced, left, place_mirrored, place_inside);
    }
#endif
    place_path = 0u;
}

// ---- The walk

// The next ray of the walk. False: there is none, and the pixel is done.
bool path_next()
{
    bool found = false;
    while (!found && (place_path != 0u || path_top > 0)) {
#ifdef PATHS_ON
        if (place_path == 0u) {
            PATH_ASKS(ASKS_PATH);
            path_ray = Ray(REAL3(wait_at[path_top - 1]), REAL3(wait_way[path_top - 1]));
            path_limit = FAR_AWAY;
            path_inwards = wait_rest[path_top - 1].w != 0u;
            found = true;
        } else
#endif
        {
            if (place_light < uint(path_counts.x)) found = light_next();
            if (!found && place_light >= uint(path_counts.x)) {
#ifdef OCCLUSION
                found = occlusion_next();
#endif
                if (!found) place_finish();
            }
        }
    }
    return found;
}

// Takes the answer to path_ray: nothing, or a surface after `length`, whose outward normal and colour matter to a path alone.
void path_use(bool hit, REAL length, REAL3 outward, vec3 albedo)
{
#if defined(SHADOWS) || defined(OCCLUSION)
    if (path_asks != ASKS_PATH) {
        place_seen += hit ? 0.0 : 1.0;
        place_sample++;
    }
#endif
#ifdef PATHS_ON
    if (path_asks != ASKS_PATH) return;
    path_top--;
    vec3 share = wait_share[path_top];
    uvec4 rest = wait_rest[path_top];
    if (!hit) {
        path_color += share * environment_color(vec3(path_ray.way));
        return;
    }
    if (rest.x == 2u) path_terms.z = float(length);
    if (rest.x == 3u) path_terms.w = float(length);
    place_at = path_ray.start + length * path_ray.way;
    place_albedo = albedo;
#ifdef SOLIDS
    place_solid = path_met_solid;
#endif
    place_weigh_met(path_top);
    place_take(rest.x, path_ray.way, outward, length, share, rest.yz);
#endif
}

// ---- Beginning and end

void path_open(ivec2 at)
{
    path_pixel = uvec2(at.x, path_size.y - 1 - at.y);
    path_color = vec3(0.0);
    path_terms = vec4(1.0, 1.0, PATH_NOTHING, PATH_NOTHING);
    path_doubt = false;
    path_top = 0;
    place_path = 0u;
}

// Begins at the first hit: distance t as two floats, outward normal, blend of the balls' colours; `mesh`: 1 + that of a solid, else 0.
void path_begin(ivec2 at, vec2 t, vec3 outward, vec4 blend, uint mesh)
{
    path_open(at);
    dvec3 way = path_first_way(vec2(at) + 0.5);
    double length = double(t.x) + double(t.y);
    place_at = REAL3(path_eye.xyz + length * way);
    place_albedo = lighting_albedo(blend);
#ifdef SOLIDS
    place_solid = mesh > 0u;
    if (place_solid) place_albedo = solid_color(mesh - 1u);
#endif
    place_weigh_first(blend);
    place_take(1u, REAL3(way), REAL3(outward), REAL(length), vec3(1.0), path_levels.xy);
}
