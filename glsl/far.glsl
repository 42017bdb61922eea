// The raw direction in doubles and the depth of the plane on which the rays of a far eye begin (DESIGN, law 1).
#ifdef FAR
layout(std140, binding = 1) uniform Far {
    dvec4 far_corner;
    dvec4 far_step_x;
    dvec4 far_step_y;
    dvec4 far_depth;
};
#endif
