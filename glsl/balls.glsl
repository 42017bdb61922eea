// The balls in view in order of effective distance, for tiles those of each list in turn: BALL_STRIDE floats each, x y z [R] [q];
// where a double is wanted, a second buffer of the same form holds what the float left over.
// Of tiles and trees a ball has four at least.
//
// The cast reads them as texels where the buffer fits one (BALL_TEXELS): a whole ball a fetch.

#ifdef RADII
#define BALL_STRENGTH_AT 4u
#else
#define BALL_STRENGTH_AT 3u
#endif
#ifdef STRENGTHS
#define BALL_STRIDE (BALL_STRENGTH_AT + 1u)
#else
#if defined(TILES) || defined(TREE_DEPTH)
#define BALL_STRIDE 4u
#else
#define BALL_STRIDE BALL_STRENGTH_AT
#endif
#endif

// What the ray walks need of a ball.
struct Ball {
    REAL3 centre;   // relative to the frame's origin
    REAL radius;
    REAL strength;
};

#if defined(BALL_TEXELS) && !defined(MNS_DOUBLE)
layout(binding = 2) uniform samplerBuffer ball_texels; // 3 or 4 floats a texel; with 5 a ball, one float a texel

Ball ball_get(uint index)
{
    Ball ball;
#if defined(RADII) && defined(STRENGTHS)
    int at = int(index) * 5;
    ball.centre = vec3(texelFetch(ball_texels, at).x, texelFetch(ball_texels, at + 1).x, texelFetch(ball_texels, at + 2).x);
    ball.radius = texelFetch(ball_texels, at + 3).x;
    ball.strength = texelFetch(ball_texels, at + 4).x;
#else
    vec4 texel = texelFetch(ball_texels, int(index));
    ball.centre = texel.xyz;
#ifdef RADII
    ball.radius = texel.w;
#else
    ball.radius = level.y;
#endif
#ifdef STRENGTHS
    ball.strength = texel.w;
#else
    ball.strength = 1.0;
#endif
#endif
    return ball;
}
#else
layout(std430, binding = 0) readonly buffer Balls {
    float ball_high[];
};
#ifdef MNS_DOUBLE
layout(std430, binding = 1) readonly buffer BallsLow {
    float ball_low[];
};
#endif

REAL ball_number(uint at)
{
#ifdef MNS_DOUBLE
    return REAL(ball_high[at]) + REAL(ball_low[at]);
#else
    return ball_high[at];
#endif
}

Ball ball_get(uint index)
{
    uint at = index * BALL_STRIDE;
    Ball ball;
    ball.centre = REAL3(ball_number(at), ball_number(at + 1u), ball_number(at + 2u));
#ifdef RADII
    ball.radius = ball_number(at + 3u);
#else
    ball.radius = level.y;
#endif
#ifdef STRENGTHS
    ball.strength = ball_number(at + BALL_STRENGTH_AT);
#else
    ball.strength = NUM(1.0);
#endif
    return ball;
}
#endif
