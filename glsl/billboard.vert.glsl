// A ball's sphere as the smallest screen rectangle around its projection, at the depth of its nearest point: for the core pass the
// core sphere, for gather the effective sphere. One instance a ball as a four-vertex strip, or one point a ball (POINTS).
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"

layout(location = 0) in vec3 in_centre;   // relative to o
#ifdef RADII
layout(location = 1) in float in_radius;
#endif
#if defined(CORE_SPHERE) && defined(CORE_RADII)
layout(location = 2) in float in_core;
#endif

flat out vec4 sphere;  // centre from the origin in the camera's axes, z from the plane of starts; radius
flat out float slack;  // what rounding may have moved a chord by
#ifndef CORE_SPHERE
flat out uint ball;
#endif
layout(location = 0) uniform uint last_ball; // rectangles are drawn farthest first for gather

// Bounds of x / z over a circle of `radius` around (x, z), z > radius: the tangents from the eye.
vec2 billboard_span(float x, float z, float radius)
{
    float square = (z - radius) * (z + radius);
    float root = radius * sqrt(max(x * x + square, 0.0));
    return vec2(x * z - root, x * z + root) / square;
}

#ifdef CORE_FLAT
layout(location = 2) uniform float core_inner; // the square's half diagonal over the radius

// A core sphere as a flat square, so that depth is laid down without running a fragment shader: no ray through the square passes the
// centre farther away than `inner`, and so each has entered the core by |c| - sqrt(r^2 - inner^2). Less is hidden than by the sphere.
void billboard_core(vec3 c, float z, float distance, float radius, inout vec2 low, inout vec2 high, inout float place)
{
    float slack = 4.0e-6 * (abs(c.x) + abs(c.y) + abs(c.z) + level.w);
    float inner = core_inner * radius;
    vec2 pixel = 2.0 / lens.zw;
    vec2 centre = c.xy * lens.xy / z - depth.zw * pixel;
    vec2 extent = (inner - slack) * 0.7071 * lens.xy / z - 0.02 * pixel;
    bool good = z > 1.001 * radius && inner > slack;
    low = good ? max(centre - extent, vec2(-1.0)) : vec2(1.0);
    high = good ? min(centre + extent, vec2(1.0)) : vec2(1.0);
    place = clamp((distance - sqrt(1.0 - core_inner * core_inner) * radius + slack) * depth.x, 0.0, 1.0);
}
#endif

void main()
{
#ifdef RADII
    float radius = in_radius;
#else
    float radius = level.y;
#endif
#ifdef CORE_SPHERE
#ifdef CORE_RADII
    radius = in_core;
#else
    radius *= core.x;
#endif
#endif
    // In the camera's axes, z counting from the plane where rays begin; c is relative to the eye.
    vec3 q = vec3(dot(in_centre, right.xyz), dot(in_centre, up.xyz), dot(in_centre, forward.xyz) - forward.w);
    vec3 c = vec3(q.x - right.w, q.y - up.w, q.z);
    slack = 4.0e-6 * (abs(q.x) + abs(q.y) + abs(q.z) + 2.0 * level.w);
#ifdef CORE_SPHERE
    sphere = vec4(q, max(radius - slack, 0.0));
#else
    sphere = vec4(q, radius);
#endif
    float z = c.z + depth.y;
    float cover = radius * 1.00001 + 1.0e-6 * (abs(c.x) + abs(c.y) + abs(c.z) + level.w); // rounding only ever adds pixels
    vec2 low = vec2(-1.0e4), high = vec2(1.0e4);
    if (z > cover * 1.0001) {
        vec2 across = billboard_span(c.x, z, cover) * lens.x;
        vec2 upward = billboard_span(c.y, z, cover) * lens.y;
        low = vec2(across.x, upward.x);
        high = vec2(across.y, upward.y);
    }
    vec2 pixel = 2.0 / lens.zw;
    low = max(low - depth.zw * pixel - 0.02 * pixel, vec2(-1.0));
    high = min(high - depth.zw * pixel + 0.02 * pixel, vec2(1.0));
    // Distance of the nearest point less the depth of the plane: |c| - z_plane without the cancellation of a far eye.
    float away = sqrt(c.x * c.x + c.y * c.y + z * z);
#ifdef FAR
    float nearest = c.z + (c.x * c.x + c.y * c.y) / (away + z) - radius;
#else
    float nearest = away - radius;
#endif
    float place = clamp((nearest - 2.0e-6 * (away - depth.y + level.w)) * depth.x, 0.0, 1.0);
#ifdef CORE_FLAT
    billboard_core(c, z, nearest + radius, radius, low, high, place);
#endif
#ifdef POINTS
    vec2 size = 0.5 * (high - low) * lens.zw;
#ifdef CORE_FLAT
    gl_PointSize = min(size.x, size.y) - 0.25; // must not cover more, whatever the driver rounds sizes to
    if (gl_PointSize < 0.75) high = low;
#else
    gl_PointSize = max(size.x, size.y) + 0.1;
#endif
    vec2 corner_at = 0.5 * (low + high);
#else
    vec2 corner_at = vec2((gl_VertexID & 1) == 0 ? low.x : high.x, (gl_VertexID & 2) == 0 ? low.y : high.y);
#endif
    if (any(greaterThanEqual(low, high))) corner_at = vec2(2.0); // off the frame: nothing
#ifdef CLIP_ZERO_TO_ONE
    gl_Position = vec4(corner_at, place, 1.0);
#else
    gl_Position = vec4(corner_at, 2.0 * place - 1.0, 1.0);
#endif
#ifndef CORE_SPHERE
#ifdef POINTS
    ball = uint(gl_VertexID);
#else
    ball = last_ball - uint(gl_InstanceID);
#endif
#endif
}
