// Effective distance of a ball in the ray's parameter, less what rounding may have added, from the ends of its chord: the square of
// the way from the ray's start to the centre is m^2 + R^2 - Q^2.
float stream_distance(float a, float b, float radius)
{
    float middle = 0.5 * (a + b), half_length = 0.5 * (b - a);
    float lateral = max((radius - half_length) * (radius + half_length), 0.0);
#ifdef FAR
    // From the eye, which is the way `before` behind the ray's start; less that way, without cancellation.
    float before = float(depth.y) + float(view_excess), along = before + middle;
    float distance = middle + lateral / (sqrt(along * along + lateral) + along);
#else
    float distance = sqrt(middle * middle + lateral);
#endif
    return distance - radius - 8.0e-6 * (abs(middle) + radius + float(view_reach));
}
