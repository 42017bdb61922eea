// A host's depth buffer, taken over as effective distance where the ray meets the host's surface.
layout(binding = 0) uniform sampler2D host_depth;

// The ray parameter at which the host's surface hides everything; FAR_AWAY where it drew nothing.
float host_limit(vec2 position)
{
    float window = texelFetch(host_depth, ivec2(position), 0).x;
    if (window >= 1.0) return FAR_AWAY;
    float z = host.x * host.y / (host.y - window * (host.y - host.x)); // depth along forward
    vec3 raw = vec3(view_raw(position));
    return (z - depth.y) * sqrt(dot(raw, raw));
}
