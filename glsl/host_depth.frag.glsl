// A host's depth as effective distance along each ray, so that it clips the lists as core depth does.
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#include "host.glsl"

void main()
{
    float limit = host_limit(gl_FragCoord.xy);
#ifdef FAR
    view_ray(gl_FragCoord.xy);
    limit += view_excess;
#endif
    gl_FragDepth = clamp(limit * depth.x * (1.0 + 1.0e-5) + 1.0e-6, 0.0, 1.0);
}
