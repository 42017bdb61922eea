// What a pixel of the planes holds, and how the distance is put together.

struct Pixel {
    vec2 t;         // distance from the eye and its low word; +inf, 0 on a miss
    vec4 normal;    // outward; w: 1 certain, 0 undecided
    vec4 color;
};

Pixel pixel_miss(bool certain)
{
    Pixel pixel;
    pixel.t = vec2(uintBitsToFloat(0x7f800000u), 0.0);
    pixel.normal = vec4(0.0, 0.0, 0.0, certain ? 1.0 : 0.0);
    pixel.color = vec4(0.0);
    return pixel;
}

// The sum of a ray parameter and a small step as two floats; FAR adds the way from the eye to where the ray began, in doubles,
// since a float of it would be off by more than the surface's detail.
vec2 pixel_distance(vec2 position, REAL t, REAL shift)
{
#ifdef FAR
    dvec3 raw = dvec3(far_corner.xyz) + (position.x + depth.z) * far_step_x.xyz + (position.y + depth.w) * far_step_y.xyz;
    double whole = far_depth.x * sqrt(dot(raw, raw)) + (double(t) + double(shift));
    float high = float(whole);
    return vec2(high, float(whole - double(high)));
#elif defined(MNS_DOUBLE)
    double whole = t + shift;
    float high = float(whole);
    return vec2(high, float(whole - double(high)));
#else
    precise float high = t + shift;
    precise float low = shift - (high - t);
    return vec2(high, low);
#endif
}
