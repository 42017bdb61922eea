// A pixel's ray in the camera's axes, for the fragments of billboards: as short a text as the chord of one sphere needs, since a
// frame runs it some hundred thousand times for a few thousand pixels that are seen.

struct Sight {
    vec2 side;   // the raw direction is (side, 1)
    vec2 start;  // where the ray begins on the plane of starts, from the origin; zero where rays begin at the eye
    float tilt;  // side squared
    float size;  // of the raw direction
};

Sight sight_of(vec2 pixel)
{
    Sight sight;
    // From the frame's middle, as in view_raw.
    sight.side = (pixel - 0.5 * lens.zw + depth.zw) * sight_steps.x;
#ifdef FAR
    sight.start = pixel * sight_steps.y + sight_steps.zw;
#else
    sight.start = vec2(0.0);
#endif
    sight.tilt = dot(sight.side, sight.side);
    sight.size = sqrt(1.0 + sight.tilt);
    return sight;
}

// The ends of the chord of a sphere around `centre` (in the camera's axes, z from the plane of starts), as chord_ends has them: the
// way from the ray to the centre is |c x raw| / |raw|, which cancels no more than |c - (c.d) d|.
bool sight_chord(Sight sight, vec3 centre, float radius, float slack, out vec2 ends)
{
    float inverse = 1.0 / sight.size;
    vec2 c = centre.xy - sight.start;
    precise vec3 aside = vec3(c.y - centre.z * sight.side.y, centre.z * sight.side.x - c.x, c.x * sight.side.y - c.y * sight.side.x);
    precise float middle = (dot(c, sight.side) + centre.z) * inverse;
    precise float away = sqrt(dot(aside, aside)) * inverse;
    precise float square = (radius - away) * (radius + away);
    precise float half_length = sqrt(max(square, 0.0));
    ends = vec2(middle - half_length, middle + half_length);
    return away < radius + slack;
}

// Way from the eye to the ray's start, less the depth of the plane of starts: no cancellation, however far the eye.
float sight_excess(Sight sight)
{
#ifdef FAR
    return depth.y * sight.tilt / (sight.size + 1.0);
#else
    return 0.0;
#endif
}
