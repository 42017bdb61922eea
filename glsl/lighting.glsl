// How a surface answers light, in whichever pass: its own colour, and what one light gives it by Lambert and Blinn-Phong, or in cel
// bands with a dark contour as in the first figure of Szecsi & Illes 2012. Linear light.

layout(std140, binding = LIGHTING_BLOCK) uniform Shade {
    vec4 surface_color; // linear
    vec4 background;    // linear, and alpha
    vec4 light;         // towards it, unit; w: weight of this sample
    vec4 lighting;      // ambient, diffuse, specular, shininess
    vec4 way_corner;    // raw direction at pixel (0, 0), w: cel bands
    vec4 way_x;         // its change a pixel
    vec4 way_y;
    vec4 map[10];       // colour map, sRGB
#ifdef MATERIALS
    vec4 second_color;  // of the second material: linear; a: 1 where it has one of its own
    vec4 second_optics; // share mirrored at any angle, share that goes through
    vec4 second_absorption; // a unit of length
#endif
};

#ifdef MATERIALS
// How much of the second material is in a blend of balls (surface.glsl).
float lighting_weight(vec4 blend)
{
    return clamp(blend.a, 0.0, 1.0);
}

// So far from the first material's to the second's; at the ends exactly theirs.
float lighting_between(float first, float second, float weight)
{
    return weight >= 1.0 ? second : first + weight * (second - first);
}

vec3 lighting_between(vec3 first, vec3 second, float weight)
{
    return vec3(lighting_between(first.r, second.r, weight), lighting_between(first.g, second.g, weight),
                lighting_between(first.b, second.b, weight));
}
#endif

// The first material's colour; `blend` is what its balls' colours or values come to (surface.glsl).
vec3 lighting_first(vec4 blend)
{
#if defined(COLORS) && defined(COLOR_LABELS)
    return blend.rgb;
#elif defined(COLORS)
    float place = clamp(blend.r, 0.0, 1.0) * 9.0;
    int low = min(int(place), 8);
    return color_linear(mix(map[low].rgb, map[low + 1].rgb, place - float(low)));
#else
    return surface_color.rgb;
#endif
}

// The surface's own colour.
vec3 lighting_albedo(vec4 blend)
{
#ifdef MATERIALS
    return lighting_between(lighting_first(blend), second_color.rgb, second_color.a * lighting_weight(blend));
#else
    return lighting_first(blend);
#endif
}

// What a light in the unit direction to_light gives: diffuse light (to be multiplied by its strength and the surface's colour), and
// shine.
vec2 lighting_of(vec3 normal, vec3 to_eye, vec3 to_light)
{
    float facing = max(dot(normal, to_light), 0.0);
    float shine = 0.0;
#ifdef SPECULAR
    if (facing > 0.0) shine = lighting.z * pow(max(dot(normal, normalize(to_light + to_eye)), 0.0), lighting.w);
#endif
#ifdef CEL
    float bands = way_corner.w;
    facing = min(floor(facing * bands), bands - 1.0) / max(bands - 1.0, 1.0);
    shine = step(0.5 * lighting.z, shine) * lighting.z;
#endif
    return vec2(facing, shine);
}

// Whether the surface is part of the dark contour.
bool lighting_contour(vec3 normal, vec3 to_eye)
{
#ifdef CEL
    return dot(normal, to_eye) < 0.22;
#else
    return false;
#endif
}
