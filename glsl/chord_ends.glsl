// The ends of the chord that a sphere around `centre` (relative to the ray's start) cuts from a ray: the effective interval of
// Szecsi & Illes 2012, section 3.

// From the ray to the centre, at a right angle: |c - (c.d) d|, never the root of a difference of squares.
REAL3 chord_offset(REAL3 centre, REAL3 way, out REAL middle)
{
    precise REAL m = dot(centre, way);
    precise REAL3 offset = centre - m * way;
    middle = m;
    return offset;
}

// False where the ray misses the sphere by more than `slack`; both ends are the middle where it misses by less.
bool chord_ends(REAL3 centre, REAL radius, REAL3 way, REAL slack, out REAL2 ends)
{
    REAL middle;
    REAL3 offset = chord_offset(centre, way, middle);
    precise REAL away = sqrt(dot(offset, offset));
    precise REAL square = (radius - away) * (radius + away);
    precise REAL half_length = sqrt(max(square, NUM(0.0)));
    ends = REAL2(middle - half_length, middle + half_length);
    return away < radius + slack;
}
