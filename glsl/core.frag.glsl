// Lay down depth (Szecsi & Illes 2012, section 5): where a core sphere, on which its ball alone reaches L, hides what is behind.
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"

#ifdef CORE_FLAT
void main()
{
}
#else
flat in vec4 sphere;

layout(depth_greater) out float gl_FragDepth;

void main()
{
    Ray ray = view_ray(gl_FragCoord.xy);
    vec3 centre = sphere.xyz - ray.start;
    float middle = dot(centre, ray.way);
    vec3 offset = centre - middle * ray.way;
    // A core that rounding may have put where none is would hide the surface: take it a little small and a little far.
    float radius = sphere.w - 2.0e-6 * (abs(middle) + view_reach);
    float square = radius * radius - dot(offset, offset); // the slack covers what the squares round
    if (!(square > 0.0)) discard;
    if (middle + sqrt(square) <= 0.0) discard; // behind the eye
    float entry = middle - sqrt(square);
#ifdef FAR
    entry += view_excess;
#endif
    float place = (entry + 4.0e-6 * (abs(middle) + view_reach)) * depth.x;
    gl_FragDepth = clamp(max(place, gl_FragCoord.z), 0.0, 1.0);
}
#endif
