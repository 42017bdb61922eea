// Planes to colour: Lambert and Blinn-Phong under a light at the eye or a directional one, or cel bands with a dark contour as in
// the first figure of Szecsi & Illes 2012. Linear light, premultiplied by alpha, weighted as one of several samples.
#include "color.glsl"

layout(std140, binding = 0) uniform Shade {
    vec4 surface_color; // linear
    vec4 background;    // linear, and alpha
    vec4 light;         // towards it, unit; w: weight of this sample
    vec4 lighting;      // ambient, diffuse, specular, shininess
    vec4 way_corner;    // raw direction at pixel (0, 0), w: cel bands
    vec4 way_x;         // its change a pixel
    vec4 way_y;
    vec4 map[10];       // colour map, sRGB
};

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
#ifdef COLORS
layout(binding = 2) uniform sampler2D plane_color;
#endif

vec3 albedo(ivec2 at)
{
#if defined(COLORS) && defined(COLOR_LABELS)
    return texelFetch(plane_color, at, 0).rgb;
#elif defined(COLORS)
    float place = clamp(texelFetch(plane_color, at, 0).r, 0.0, 1.0) * 9.0;
    int low = min(int(place), 8);
    return color_linear(mix(map[low].rgb, map[low + 1].rgb, place - float(low)));
#else
    return surface_color.rgb;
#endif
}

vec3 shade(vec3 normal, vec3 to_eye, vec3 color)
{
#ifdef DIRECTIONAL
    vec3 to_light = light.xyz;
#else
    vec3 to_light = to_eye;
#endif
    float facing = max(dot(normal, to_light), 0.0);
    float shine = 0.0;
#ifdef SPECULAR
    if (facing > 0.0) shine = lighting.z * pow(max(dot(normal, normalize(to_light + to_eye)), 0.0), lighting.w);
#endif
#ifdef CEL
    float bands = way_corner.w;
    facing = min(floor(facing * bands), bands - 1.0) / max(bands - 1.0, 1.0);
    shine = step(0.5 * lighting.z, shine) * lighting.z;
    if (dot(normal, to_eye) < 0.22) return vec3(0.0);
#endif
    return color * (lighting.x + lighting.y * facing) + vec3(shine);
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
