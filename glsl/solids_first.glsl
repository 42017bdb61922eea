// Where a mesh lies before the surface it is what the pixel sees: its distance and normal take the place of the surface's, and it is noted.
// In doubles, so that nothing is left to decide. Compute shader, a pixel an invocation, eight neighbours a block of 4x2 pixels.
#include "real.glsl"
#include "paths_block.glsl"
#include "solids_texels.glsl"
#include "solids.glsl"
#include "redo.glsl"
#include "loops.glsl"

layout(local_size_x = 64) in;
layout(location = 3) uniform ivec4 path_region; // x, y, past x, past y
layout(location = 4) uniform double first_radius; // the largest ball's
layout(binding = 1, rg32f) uniform image2D plane_t;
layout(binding = 2, rgba32f) uniform image2D plane_normal;
layout(binding = 3, r32ui) writeonly uniform uimage2D plane_mesh;

const double FIRST_NEAR = 4.0e-6LF; // SETTLED of floats: what they take a hit as placed by, however steeply the ray meets it

// How far along the ray the surface may be from where it was found. Floats take a hit as settled by its distance from the eye or by a
// radius, and from a far eye also by the lengths at the field, there across the surface (surface_settled): along a ray that grazes
// it that is more.
double first_gap(vec2 position, dvec3 way, double surface, dvec3 normal)
{
    double most = max(surface, first_radius);
    if (path_eye.w == 0.0LF) return FIRST_NEAR * most;
    dvec3 raw = path_corner.xyz + double(position.x) * path_step_x.xyz + double(position.y) * path_step_y.xyz;
    double begin = path_eye.w * sqrt(dot(raw, raw));
    dvec3 start = path_eye.xyz + begin * way;
    double lengths = max(abs(surface - begin) + sqrt(dot(start, start)) + path_corner.w, first_radius);
    return FIRST_NEAR * min(most, lengths / max(abs(dot(normal, way)), 1.0e-9LF));
}

void main()
{
    uint lane = gl_LocalInvocationIndex;
    ivec2 within = ivec2((lane & 3u) | (lane >> 1u & 4u), (lane >> 2u & 1u) | (lane >> 3u & 6u));
    ivec2 at = path_region.xy + 8 * ivec2(gl_WorkGroupID.xy) + within;
    if (at.x >= path_region.z || at.y >= path_region.w) return;
    vec2 t = imageLoad(plane_t, at).xy;
    vec4 normal = imageLoad(plane_normal, at);
    bool meets = !isinf(t.x);
    double surface = meets ? double(t.x) + double(t.y) : FAR_AWAY;
    dvec3 way = path_first_way(vec2(at) + 0.5);
    Solid solid = solid_cast(path_eye.xyz, way, FAR_AWAY, dvec3(0.0), TAU, false);
    bool before = solid.hit && solid.t < surface;
    double gap = meets ? first_gap(vec2(at) + 0.5, way, surface, dvec3(normal.xyz)) : 0.0LF;
    bool near = meets && solid.hit && abs(solid.t - surface) <= solid.off + gap;
    bool doubt = near || (solid.open && solid_doubt <= surface + gap) || !loops_whole(int(path_size.w));
    imageStore(plane_mesh, at, uvec4(before ? 1u + solid.mesh : 0u));
    if (doubt && normal.w > 0.0) {
        atomicAdd(count_undecided, 1u);
        normal.w = 0.0;
    }
    if (before) {
        float high = float(solid.t);
        imageStore(plane_t, at, vec4(high, float(solid.t - double(high)), 0.0, 0.0));
        normal.xyz = vec3(solid.normal);
    }
    if (before || doubt) imageStore(plane_normal, at, normal);
}
