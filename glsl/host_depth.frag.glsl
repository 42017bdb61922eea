// A host's depth as effective distance along each ray, so that it clips the lists as core depth does.
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#include "host.glsl"

void main()
{
    float limit = host_limit(gl_FragCoord.xy);
#ifdef FAR
    vec3 raw = vec3(view_raw(gl_FragCoord.xy));
    limit += depth.y * (dot(raw, raw) - 1.0) / (sqrt(dot(raw, raw)) + 1.0);
#endif
    gl_FragDepth = clamp(limit * depth.x * (1.0 + 1.0e-5) + 1.0e-6, 0.0, 1.0);
}
