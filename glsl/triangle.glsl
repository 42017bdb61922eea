// A ray against a triangle, and what rounding leaves open of it: one text for GLSL and C, over REAL, NUM and DENSITY_FN as density.glsl.
// Places are relative to the ray's start; d is its unit direction. `tau`: what rounding may be of a number (TAU in real.glsl).
//
// Based on: Woop et al. 2013, "Watertight ray/triangle intersection", by edge functions of sums and differences instead of a shear: two
// triangles that share an edge get exactly opposite numbers for it, in whatever way the products are rounded, so no ray slips between.

// Twice the signed volume of the ray's direction and the edge from a to b: its sign tells on which side the ray passes.
DENSITY_FN REAL triangle_edge(REAL ax, REAL ay, REAL az, REAL bx, REAL by, REAL bz, REAL dx, REAL dy, REAL dz)
{
    REAL ex = bx - ax;
    REAL ey = by - ay;
    REAL ez = bz - az;
    REAL sx = bx + ax;
    REAL sy = by + ay;
    REAL sz = bz + az;
    return (ey * sz - ez * sy) * dx + (ez * sx - ex * sz) * dy + (ex * sy - ey * sx) * dz;
}

// What of that number is rounding, that of the start among it, which stands `reach` from the origin of coordinates.
DENSITY_FN REAL triangle_edge_margin(REAL ax, REAL ay, REAL az, REAL bx, REAL by, REAL bz, REAL reach, REAL tau)
{
    REAL edge = abs(bx - ax) + abs(by - ay) + abs(bz - az);
    REAL far = abs(bx) + abs(ax) + abs(by) + abs(ay) + abs(bz) + abs(az);
    return tau * edge * (far + NUM(2.0) * reach);
}

// Coordinate `axis` of the normal, as long as twice the area, from two edges that leave one corner.
DENSITY_FN REAL triangle_normal(int axis, REAL ux, REAL uy, REAL uz, REAL vx, REAL vy, REAL vz)
{
    if (axis == 0) return uy * vz - uz * vy;
    if (axis == 1) return uz * vx - ux * vz;
    return ux * vy - uy * vx;
}

// Where a triangle that the ray meets at t lies to those that it meets in one place so far, from `near` to `far`: clearly before or
// behind them, in one place with each, or that is not known. Rounding may be `off` of it, and of each of them from `least` to `most`,
// which is far more than it is of triangles in one plane.
#define TRIANGLE_BEFORE 0
#define TRIANGLE_BEHIND 1
#define TRIANGLE_WITH 2
#define TRIANGLE_OPEN 3

DENSITY_FN int triangle_order(REAL t, REAL off, REAL near, REAL far, REAL least, REAL most)
{
    REAL clear = NUM(4.0) * (off + most);
    if (near - t > clear) return TRIANGLE_BEFORE;
    if (t - near > clear) return TRIANGLE_BEHIND;
    return max(t, far) - min(t, near) <= NUM(0.25) * (off + least) ? TRIANGLE_WITH : TRIANGLE_OPEN;
}
