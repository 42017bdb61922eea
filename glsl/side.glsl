// Which side of the surface a ray starts on (SIDE: -1 outside, 1 inside), and where its walk begins (RAY_BEGIN).
#ifdef EYE_ON
// The eye is on the surface, f(eye) = L: the side just after counts, and the slope along the ray tells it. With C a bound on the
// second derivative of f about the eye, the slope keeps its sign up to |f'(0)| / C, and so f - L keeps its own from 0 on; half of that
// way leaves the most room for rounding.
REAL ray_side = NUM(0.0);
REAL ray_begin = NUM(0.0);
#define SIDE ray_side
#define RAY_BEGIN ray_begin

void side_take(Ray ray)
{
    REAL slope = dot(eye_slope.xyz, ray.way);
    ray_side = slope > NUM(0.0) ? NUM(1.0) : NUM(-1.0);
    ray_begin = min(NUM(0.5) * abs(slope) / eye_slope.w, eye_reach);
}
#else
#ifdef EYE_INSIDE
#define SIDE NUM(1.0)
#else
#define SIDE NUM(-1.0)
#endif
#define RAY_BEGIN NUM(0.0)

void side_take(Ray ray)
{
}
#endif
