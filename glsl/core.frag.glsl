// Lay down depth (Szecsi & Illes 2012, section 5): where a core sphere, on which its ball alone reaches L, hides what is behind.
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#include "sight.glsl"

#ifdef CORE_FLAT
void main()
{
}
#else
flat in vec4 sphere; // in the camera's axes; the radius is taken a little small, so that rounding hides no surface
flat in float slack;

layout(depth_greater) out float gl_FragDepth;

void main()
{
    Sight sight = sight_of(gl_FragCoord.xy);
    vec2 chord;
    if (!sight_chord(sight, sphere.xyz, sphere.w, 0.0, chord) || chord.x <= 0.0) discard;
    float place = (chord.x + sight_excess(sight) + slack) * depth.x;
    gl_FragDepth = clamp(max(place, gl_FragCoord.z), 0.0, 1.0);
}
#endif
