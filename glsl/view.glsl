// The camera, the level and the balls as a frame's uniforms and buffers; a pixel's ray.
//
// Coordinates are relative to the frame's origin o (the eye, or for a far eye the point of the field's box nearest to it), in the
// axes of the scene. Pixels are GL's: (0.5, 0.5) is the centre of the lower left one.

#ifdef VIEW_LOOSE
// The same by uniforms of their own, for the programs of most pixels: a software renderer reads a block's members lane by lane.
layout(location = 8) uniform vec4 corner;
layout(location = 9) uniform vec4 step_x;
layout(location = 10) uniform vec4 step_y;
layout(location = 11) uniform vec4 start;
layout(location = 12) uniform vec4 start_x;
layout(location = 13) uniform vec4 start_y;
layout(location = 14) uniform vec4 right;
layout(location = 15) uniform vec4 up;
layout(location = 16) uniform vec4 forward;
layout(location = 17) uniform vec4 lens;
layout(location = 18) uniform vec4 depth;
layout(location = 19) uniform vec4 level;
layout(location = 20) uniform vec4 core;
layout(location = 21) uniform vec4 sight_steps;
layout(location = 22) uniform vec4 eye_slope;
layout(location = 23) uniform vec4 host;
#else
layout(std140, binding = 0) uniform View {
    REAL4 corner;  // raw direction at pixel (0, 0): forward component 1
    REAL4 step_x;  // its change a pixel
    REAL4 step_y;
    REAL4 start;   // where rays begin at pixel (0, 0), relative to o; used when FAR
    REAL4 start_x;
    REAL4 start_y;
    REAL4 right;   // the camera's axes; right.w, up.w, forward.w: the eye relative to o along them
    REAL4 up;
    REAL4 forward;
    REAL4 lens;    // cotangents of half the field of view across and up, width, height
    REAL4 depth;   // 1 / range of effective distances, depth of the plane where rays begin, jitter in pixels x, y
    REAL4 level;   // L, the radius of all balls, 1 / its square, reach: how far from o a ray begins at most
    REAL4 core;    // core radius over R of every ball, 1 / the radius of all balls, 2, how far from the eye eye_slope.w holds
    REAL4 sight_steps; // a pixel's step of a raw direction's side, and of a ray's start, which at pixel (0, 0) is zw
    REAL4 eye_slope; // gradient of f at the eye, and a bound on its second derivatives there; used when EYE_ON
    REAL4 host;    // near, far of a host's projection, lower left corner of the view in its framebuffer
};
#endif

#define level_inverse core.y
#define level_two core.z
#define eye_reach core.w

struct Ray {
    REAL3 start;
    REAL3 way; // unit
};

#ifdef PATHS
REAL view_reach = NUM(0.0); // distance of the ray's start from o
#elif defined(FAR)
REAL view_reach;   // distance of the ray's start from o
REAL view_excess;  // way from the eye to the ray's start, less the depth of the plane where rays begin
#elif defined(TREE_DEPTH) && defined(MNS_DOUBLE)
// A ball's two floats hold its place to 2^-49 of its distance from o, far below TAU; the ray's own way has no part in o.
#define view_reach (level.w / NUM(256.0))
#elif defined(TREE_DEPTH)
#define view_reach level.w
#else
const REAL view_reach = NUM(0.0);
#endif

// The raw direction through a pixel position: its forward component is 1.
REAL3 view_raw(vec2 pixel)
{
    // From the frame's middle: counted from a corner, a wide view's directions would carry the rounding of the corner's.
    REAL x = NUM(pixel.x) - NUM(0.5) * lens.z + depth.z;
    REAL y = NUM(pixel.y) - NUM(0.5) * lens.w + depth.w;
    return forward.xyz + x * step_x.xyz + y * step_y.xyz;
}

Ray view_ray(vec2 pixel)
{
    Ray ray;
    precise REAL3 raw = view_raw(pixel);
    precise REAL3 way = raw / sqrt(dot(raw, raw));
    ray.way = way;
#ifdef FAR
    precise REAL3 from = start.xyz + (NUM(pixel.x) + depth.z) * start_x.xyz + (NUM(pixel.y) + depth.w) * start_y.xyz;
    ray.start = from;
    view_reach = sqrt(dot(from, from));
    // raw is forward and this to the side: no cancellation, however far the eye.
    REAL2 side = (NUM(2.0) * (REAL2(pixel) + depth.zw) / lens.zw - NUM(1.0)) / lens.xy;
    REAL tilt = dot(side, side);
    view_excess = depth.y * tilt / (sqrt(NUM(1.0) + tilt) + NUM(1.0));
#elif defined(TREE_DEPTH)
    ray.start = start.xyz; // a tree's origin stands still, the eye does not
#else
    ray.start = REAL3(0.0);
#endif
    return ray;
}
