// What stands around the scene: the background's colour, the built-in sky (SKY), or a map of the whole sphere (ENVIRONMENT), read as
// src/effects/environment.c reads it.
#ifdef SKY
#include "sky.glsl"
#endif
#ifdef ENVIRONMENT
layout(binding = 9) uniform sampler2D environment_map;

vec3 environment_texel(int x, int y, ivec2 size)
{
    x = x < 0 ? x + size.x : x >= size.x ? x - size.x : x;
    return texelFetch(environment_map, ivec2(x, clamp(y, 0, size.y - 1)), 0).rgb;
}

// Between the four texels around: longitude 0 in the middle is -z, latitude 90 degrees the top.
vec3 environment_look(vec3 d)
{
    ivec2 size = textureSize(environment_map, 0);
    float ahead = d.x == 0.0 && d.z == 0.0 ? -1.0 : -d.z; // straight up and down have no longitude
    float across = (0.5 + atan(d.x, ahead) * 0.15915494309189535) * float(size.x) - 0.5;
    float down = acos(clamp(d.y, -1.0, 1.0)) * 0.3183098861837907 * float(size.y) - 0.5;
    int left = int(floor(across));
    int top = int(floor(down));
    vec3 high = mix(environment_texel(left, top, size), environment_texel(left + 1, top, size), across - float(left));
    vec3 low = mix(environment_texel(left, top + 1, size), environment_texel(left + 1, top + 1, size), across - float(left));
    return mix(high, low, down - float(top));
}
#endif

// Linear light from the unit direction `way`.
vec3 environment_color(vec3 way)
{
#if defined(SKY) || defined(ENVIRONMENT)
    vec3 d = vec3(dot(way, environment_right.xyz), dot(way, environment_up.xyz), dot(way, environment_back.xyz));
#endif
#if defined(ENVIRONMENT)
    return environment_look(d);
#elif defined(SKY)
    return vec3(sky_color(0, d.x, d.y, d.z), sky_color(1, d.x, d.y, d.z), sky_color(2, d.x, d.y, d.z));
#else
    return background.rgb;
#endif
}
