// A ball's chord on the ray, with what the pieces need of the ball.
#ifndef TILES // the lists have it already
#include "chord_ends.glsl"
#endif

struct Chord {
    REAL a, b;      // where the ray enters and leaves; a < b
    REAL shrink;    // 1 / R^2: w = (s - a)(b - s) * shrink is 1 - v^2 at s, exactly
    REAL strength;
};

// False where the ray misses the sphere or has it behind.
bool chord_cut(Ray ray, Ball ball, out Chord chord)
{
    REAL2 ends;
    chord_ends(ball.centre - ray.start, ball.radius, ray.way, NUM(0.0), ends);
    chord.a = ends.x;
    chord.b = ends.y;
#ifdef RADII
    chord.shrink = NUM(1.0) / (ball.radius * ball.radius);
#else
    chord.shrink = level.z;
#endif
    chord.strength = ball.strength;
    return chord.b > NUM(0.0) && chord.a < chord.b;
}

// How many rounding allowances a unit of slope is worth on a piece that ends at `stop`: at least the distance of the chord's ball
// from the origin of the coordinates over R, and one for the density itself (DESIGN, "Undecided").
REAL chord_reach(Chord chord, REAL stop)
{
#ifdef RADII
    return NUM(3.0) + (stop + view_reach) * sqrt(chord.shrink);
#else
    return NUM(3.0) + (stop + view_reach) * level_inverse;
#endif
}
