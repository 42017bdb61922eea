// What the cast runs for: the squares of pixels that hold listed tiles, each a point (SQUARES), or a triangle that covers the frame.
#ifdef SQUARES
layout(location = 0) in vec3 square; // lower left corner and side, in pixels from the viewport's corner
layout(location = 4) uniform vec2 square_view; // the viewport's size: whole squares, so that no centre is clipped

void main()
{
    gl_PointSize = square.z;
    gl_Position = vec4((2.0 * square.xy + square.z) / square_view - 1.0, 0.0, 1.0);
}
#else
#include "screen.vert.glsl"
#endif
