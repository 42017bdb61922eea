// Planes to colour, under a light at the eye or a directional one: premultiplied by alpha, weighted as one of several samples.
#include "color.glsl"
#define LIGHTING_BLOCK 0
#include "lighting.glsl"

layout(location = 0) out vec4 out_color;

#ifdef LIT
// Colours are made already, premultiplied, with all that light does on its way.
layout(binding = 2) uniform sampler2D plane_lit;

void main()
{
    out_color = texelFetch(plane_lit, ivec2(gl_FragCoord.xy), 0) * light.w;
}
#else
layout(binding = 0) uniform sampler2D plane_t;
layout(binding = 1) uniform sampler2D plane_normal;
#ifdef BLENDS
layout(binding = 2) uniform sampler2D plane_color;
#endif

vec3 albedo(ivec2 at)
{
#ifdef BLENDS
    return lighting_albedo(texelFetch(plane_color, at, 0));
#else
    return lighting_albedo(vec4(0.0));
#endif
}

vec3 shade(vec3 normal, vec3 to_eye, vec3 color)
{
#ifdef DIRECTIONAL
    vec3 to_light = light.xyz;
#else
    vec3 to_light = to_eye;
#endif
    if (lighting_contour(normal, to_eye)) return vec3(0.0);
    vec2 given = lighting_of(normal, to_eye, to_light);
    return color * (lighting.x + lighting.y * given.x) + vec3(given.y);
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 color = vec4(background.rgb * background.a, background.a);
    if (!isinf(texelFetch(plane_t, at, 0).x)) {
        vec3 way = normalize(way_corner.xyz + gl_FragCoord.x * way_x.xyz + gl_FragCoord.y * way_y.xyz);
        vec3 normal = texelFetch(plane_normal, at, 0).xyz;
        if (dot(normal, way) > 0.0) normal = -normal; // seen from inside
        color = vec4(shade(normal, -way, albedo(at)), 1.0);
    }
    out_color = color * light.w;
}
#endif
