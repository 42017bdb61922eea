// At a hit: one Newton step on the true field, the outward normal, and the colour of the balls around it.

struct Surface {
    REAL shift;     // what to add to t
    REAL blur;      // about how far rounding may have moved the hit along the ray
    REAL across;    // and across the surface
    REAL radius;    // the least of the balls around
    REAL3 normal;   // outward unit normal, -grad f / |grad f|
    vec4 color;     // density-weighted mean of the balls' colours or values (COLORS); a: place between two materials (MATERIALS)
};

#ifdef BLENDS
#ifdef COLOR_LABELS
#include "color.glsl"
#endif
#if defined(COLORS) && defined(MATERIALS)
#define BALL_WORDS 2u
#else
#define BALL_WORDS 1u
#endif
// Of each ball its colour (COLORS: a place in the colour map's range as float, or an rgba8, sRGB, with COLOR_LABELS), then its place
// between two materials as float (MATERIALS).
layout(std430, binding = 4) readonly buffer BallWords {
    uint ball_word[];
};

vec4 color_of(uint ball)
{
    vec4 color = vec4(0.0, 0.0, 0.0, 1.0);
    uint at = ball * BALL_WORDS;
#ifdef COLOR_LABELS
    color.rgb = color_linear(unpackUnorm4x8(ball_word[at]).rgb);
#elif defined(COLORS)
    color.r = uintBitsToFloat(ball_word[at]);
#endif
#ifdef MATERIALS
    color.a = uintBitsToFloat(ball_word[at + BALL_WORDS - 1u]);
#endif
    return color;
}
#endif

// From a ball's centre to the ray's point at t, in radii.
REAL3 surface_from(REAL t, REAL middle, REAL3 way, REAL3 offset, REAL shrink)
{
    precise REAL3 from = ((t - middle) * way - offset) * shrink;
    return from;
}

Surface surface_none() { return Surface(NUM(0.0), NUM(0.0), NUM(0.0), NUM(0.0), REAL3(0.0), vec4(0.0)); }

Surface surface_at(Ray ray, REAL t)
{
    REAL value = -level.x;
    REAL3 gradient = REAL3(0.0);
    vec4 color = vec4(0.0);
    float weight = 0.0;
    REAL least = FAR_AWAY;
    REAL rounding = NUM(0.0);
    EACH_ACTIVE(j) {
        uint ball = active_ball(j);
        Ball here = ball_get(ball);
        REAL radius = here.radius;
        REAL shrink = NUM(1.0) / radius;
        least = min(least, radius);
        REAL middle;
        REAL3 offset = chord_offset(here.centre - ray.start, ray.way, middle);
        REAL3 from = surface_from(t, middle, ray.way, offset, shrink);
        REAL u = min(dot(from, from), NUM(1.0));
        REAL q = here.strength;
        REAL part = q * density_value(KERNEL, u);
        value += part;
        REAL steep = density_slope_over_v(KERNEL, u);
        gradient += q * steep * shrink * from;
        rounding += abs(part) + abs(q * steep) * sqrt(u) * (t + view_reach) * shrink;
#ifdef BLENDS
        weight += max(float(part), 0.0);
        color += max(float(part), 0.0) * color_of(ball);
#endif
    }
    Surface surface;
    surface.radius = least;
    REAL slope = dot(gradient, ray.way);
    REAL size = sqrt(dot(gradient, gradient));
    surface.shift = slope != NUM(0.0) ? -value / slope : NUM(0.0);
    surface.blur = NUM(0.25) * TAU * rounding / abs(slope);
    surface.across = NUM(0.25) * TAU * rounding / size;
    surface.normal = size > NUM(0.0) ? -gradient / size : -ray.way;
    surface.color = weight > 0.0 ? color / weight : vec4(0.0);
#ifdef MATERIALS
    if (weight > 0.0 && color.a == weight) surface.color.a = 1.0; // whatever a driver's division makes of it
#endif
    return surface;
}

// Whether the hit's place is good to its last digits: a Newton step that is not small is no correction, and where the slope is slight
// or the balls are tiny beside their distance from the origin, rounding may have moved it. solids_first.glsl relies on both bounds.
bool surface_settled(Surface surface, REAL t)
{
    bool settled = abs(surface.shift) <= NUM(1.0e-2) * surface.radius;
#ifdef FAR
    settled = settled && surface.across <= SETTLED * max(t + view_reach, surface.radius);
    t += depth.y + view_excess; // from the eye
#endif
    return settled && surface.blur <= SETTLED * max(t, surface.radius);
}
