// A host's depth buffer, taken over as effective distance where the ray meets the host's surface.
layout(binding = 0) uniform sampler2D host_depth;

// The ray parameter at which the host's surface hides everything; FAR_AWAY where it drew nothing.
REAL host_limit(vec2 position)
{
    REAL window = REAL(texelFetch(host_depth, ivec2(position), 0).x);
    if (window >= NUM(1.0)) return FAR_AWAY;
    REAL z = host.x * host.y / (host.y - window * (host.y - host.x)); // depth along forward
    REAL3 raw = view_raw(position);
    return (z - depth.y) * sqrt(dot(raw, raw));
}
