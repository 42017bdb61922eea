// The chord that a ball's effective sphere cuts from a ray: the effective interval [a, b] of Szecsi & Illes 2012, section 3.

struct Chord {
    REAL a, b;      // where the ray enters and leaves; a < b
    REAL shrink;    // 1 / R^2: w = (s - a)(b - s) * shrink is 1 - v^2 at s, exactly
};

// From the ray to the centre, at a right angle: |c - (c.d) d|, never the root of a difference of squares.
REAL3 chord_offset(REAL3 centre, REAL3 way, out REAL middle)
{
    precise REAL m = dot(centre, way);
    precise REAL3 offset = centre - m * way;
    middle = m;
    return offset;
}

// False where the ray misses the sphere or has it behind.
bool chord_cut(Ray ray, uint ball, out Chord chord)
{
    REAL middle;
    REAL3 offset = chord_offset(ball_centre(ball) - ray.start, ray.way, middle);
    REAL radius = ball_radius(ball);
    precise REAL away = sqrt(dot(offset, offset));
    precise REAL square = (radius - away) * (radius + away);
    if (!(square > NUM(0.0))) return false;
    precise REAL half_length = sqrt(square);
    chord.a = middle - half_length;
    chord.b = middle + half_length;
#ifdef RADII
    chord.shrink = NUM(1.0) / (radius * radius);
#else
    chord.shrink = level.z;
#endif
    return chord.b > NUM(0.0) && chord.a < chord.b;
}

// How many rounding allowances a unit of slope is worth at this chord: the distance from the origin of the coordinates over R,
// and one for the density itself (DESIGN, "Undecided").
REAL chord_reach(Chord chord)
{
    return NUM(2.0) + (abs(NUM(0.5) * (chord.a + chord.b)) + view_reach) * sqrt(chord.shrink);
}
