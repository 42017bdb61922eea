// The balls in view in order of effective distance: BALL_STRIDE floats each, x y z [R] [q]; where a double is wanted, a second
// buffer of the same form holds what the float left over.

layout(std430, binding = 0) readonly buffer Balls {
    float ball_high[];
};
#ifdef MNS_DOUBLE
layout(std430, binding = 1) readonly buffer BallsLow {
    float ball_low[];
};
#endif

#ifdef RADII
#define BALL_STRENGTH_AT 4u
#else
#define BALL_STRENGTH_AT 3u
#endif
#ifdef STRENGTHS
#define BALL_STRIDE (BALL_STRENGTH_AT + 1u)
#else
#define BALL_STRIDE BALL_STRENGTH_AT
#endif

REAL ball_number(uint index)
{
#ifdef MNS_DOUBLE
    return REAL(ball_high[index]) + REAL(ball_low[index]);
#else
    return ball_high[index];
#endif
}

REAL3 ball_centre(uint ball)
{
    uint at = ball * BALL_STRIDE;
    return REAL3(ball_number(at), ball_number(at + 1u), ball_number(at + 2u));
}

REAL ball_radius(uint ball)
{
#ifdef RADII
    return ball_number(ball * BALL_STRIDE + 3u);
#else
    return level.y;
#endif
}

REAL ball_strength(uint ball)
{
#ifdef STRENGTHS
    return ball_number(ball * BALL_STRIDE + BALL_STRENGTH_AT);
#else
    return NUM(1.0);
#endif
}
