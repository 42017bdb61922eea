// What a list's order tells of its rest: no ball after this one has an effective distance below this one's, |p - e| - R, and that is
// at least the way to the middle of its chord less R. In the ray's parameter, less what rounding may have added.
float stream_distance(float a, float b, float radius)
{
    float middle = 0.5 * (a + b);
    return middle - radius - 8.0e-6 * (abs(middle) + radius + float(view_reach));
}
