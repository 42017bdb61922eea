// The shaded surface into a host's framebuffer, at the depth that the host's projection gives it.
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#include "color.glsl"

layout(binding = 0) uniform sampler2D plane_color;
layout(binding = 1) uniform sampler2D plane_t;
layout(location = 0) out vec4 out_color;

void main()
{
    vec2 position = gl_FragCoord.xy - host.zw;
    float t = texelFetch(plane_t, ivec2(position), 0).x;
    if (isinf(t)) discard;
    vec3 raw = vec3(view_raw(position));
    float z = t / sqrt(dot(raw, raw));
    if (z < host.x || z > host.y) discard;
    gl_FragDepth = host.y * (z - host.x) / (z * (host.y - host.x));
    vec4 color = texelFetch(plane_color, ivec2(position), 0);
    out_color = vec4(color_srgb(color.a > 0.0 ? color.rgb / color.a : vec3(0.0)), 1.0);
}
