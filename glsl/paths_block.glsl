// The camera, the lights and the numbers of light's ways beyond the first hit; what both the list of their pixels and the walks read.
//
// PATHS_LOOSE: the same, but for the lights after the first, by uniforms of their own, as of the view (VIEW_LOOSE).

#define PATH_LIGHTS 256

#ifdef PATHS_LOOSE
#define PATHS_MEMBERS paths
#else
#define PATHS_MEMBERS
#endif

layout(std140, binding = 1) uniform Paths {
    dvec4 path_corner; // raw direction at pixel (0, 0); w: how far the first rays' origin of coordinates is from the tree's
    dvec4 path_step_x; // its change a pixel
    dvec4 path_step_y;
    dvec4 path_eye;    // relative to the tree's origin, as all places are; w: depth of the plane where a far eye's rays begin, else 0
    dvec4 path_optics; // share mirrored at any angle, index of refraction, share that goes through, reach of the occlusion's rays
    dvec4 light_place[PATH_LIGHTS]; // of a directional light the unit direction to it; w: radius
    vec4 light_radiance[PATH_LIGHTS]; // linear; w: kind, as mns_light_kind
    vec4 environment_right; // its axes in the scene
    vec4 environment_up;
    vec4 environment_back;
    vec4 path_absorption; // a unit of length
    ivec4 path_counts; // lights, those that cast shadows, rays a pixel and sphere of light, rays of the ambient light
    uvec4 path_levels; // of mirroring, surfaces that light passes through; seed, index of the pixel's sample
    ivec4 path_size;   // of the frame; z: the eye is in the medium, 1, or on the surface, 2; w: 2
    uvec4 path_solids; // where solids.glsl finds triangles, corners and colours; how many nodes there are
} PATHS_MEMBERS;

#ifdef PATHS_LOOSE
layout(location = 24) uniform dvec4 path_corner;
layout(location = 25) uniform dvec4 path_step_x;
layout(location = 26) uniform dvec4 path_step_y;
layout(location = 27) uniform dvec4 path_eye;
layout(location = 28) uniform dvec4 path_optics;
layout(location = 29) uniform dvec4 light_first;
layout(location = 30) uniform vec4 light_first_radiance;
layout(location = 31) uniform vec4 environment_right;
layout(location = 32) uniform vec4 environment_up;
layout(location = 33) uniform vec4 environment_back;
layout(location = 34) uniform vec4 path_absorption;
layout(location = 35) uniform ivec4 path_counts;
layout(location = 36) uniform uvec4 path_levels;
layout(location = 37) uniform ivec4 path_size;
#ifdef SOLIDS
layout(location = 38) uniform uvec4 path_solids;
#endif
#endif

dvec4 light_at(uint light)
{
#if !defined(PATHS_LOOSE)
    return light_place[light];
#elif defined(LIGHTS_MANY)
    return light == 0u ? light_first : paths.light_place[light];
#else
    return light_first;
#endif
}

vec4 light_sent(uint light)
{
#if !defined(PATHS_LOOSE)
    return light_radiance[light];
#elif defined(LIGHTS_MANY)
    return light == 0u ? light_first_radiance : paths.light_radiance[light];
#else
    return light_first_radiance;
#endif
}

#define PATH_NOTHING uintBitsToFloat(0x7f800000u) // how far a ray goes that meets nothing

// The unit direction of the pixel's ray, from the eye.
dvec3 path_first_way(vec2 position)
{
    dvec3 raw = path_corner.xyz + double(position.x) * path_step_x.xyz + double(position.y) * path_step_y.xyz;
    return raw * (1.0LF / sqrt(dot(raw, raw)));
}
