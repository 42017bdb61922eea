// The meshes beside the surface: a ray's first hit among their triangles, by a tree of boxes. Of what rounding could decide otherwise the
// caller is told. The same in doubles on the CPU: src/solid/solid_trace.c. After solids_texels.glsl.
#include "triangle.glsl"

const uint SOLID_ALONE = 0xffffffffu;

struct Solid {
    bool hit;
    bool open;      // it may be otherwise
    REAL t;         // FAR_AWAY where nothing is hit
    REAL off;       // what t may be off
    REAL3 normal;   // turned against the ray
    uint mesh;
};

// The triangles that are met in one place, so far as rounding tells, before all others.
struct SolidPlace {
    REAL near;      // the first and the last of them on the ray
    REAL far;
    REAL least;     // what t may be off of the best and of the worst placed of them
    REAL most;
    bool mixed;     // they are of more meshes than one
};

REAL3 solid_start = REAL3(0.0);
REAL3 solid_way = REAL3(0.0);
REAL3 solid_leaves = REAL3(0.0); // normal of the triangle that the ray leaves, or 0: what lies in one plane with it is not met
REAL solid_reach = NUM(0.0);     // of the start
REAL solid_limit = NUM(0.0);
REAL solid_begin = NUM(0.0);     // what the start may be off, of the lengths around
bool solid_fine = false;         // which of two triangles is met matters
REAL solid_doubt = NUM(0.0);     // before this nothing is in doubt
int solid_lefts = 0;             // triangles that the ray may have begun on
int solid_work = 0;              // nodes and triangles looked at
Solid solid_best = Solid(false, false, NUM(0.0), NUM(0.0), REAL3(0.0), 0u); // of solid_place: in doubles the nearest of its first mesh
SolidPlace solid_place = SolidPlace(NUM(0.0), NUM(0.0), NUM(0.0), NUM(0.0), false);
vec3 solid_near = vec3(0.0);     // the start, its slabs' scale and slack, in floats
vec3 solid_inverse = vec3(0.0);
vec3 solid_slack = vec3(0.0);

REAL3 solid_corner(uint corner)
{
    int at = int(path_solids.y + 2u * corner);
    uvec4 high = texelFetch(solid_texels, at);
#ifdef MNS_DOUBLE
    uvec4 low = texelFetch(solid_texels, at + 1);
    return REAL3(uintBitsToFloat(high.xyz)) + REAL3(uintBitsToFloat(uvec3(high.w, low.xy))) - solid_start;
#else
    return uintBitsToFloat(high.xyz) - solid_start;
#endif
}

REAL solid_edge(REAL3 a, REAL3 b)
{
    return triangle_edge(a.x, a.y, a.z, b.x, b.y, b.z, solid_way.x, solid_way.y, solid_way.z);
}

REAL solid_room(REAL3 a, REAL3 b)
{
    return triangle_edge_margin(a.x, a.y, a.z, b.x, b.y, b.z, solid_reach, TAU);
}

// As long as twice the area, in units of the longer edge: floats do not hold the square of any.
REAL3 solid_normal(REAL3 a, REAL3 b, REAL3 c)
{
    REAL3 u = b - a;
    REAL3 v = c - a;
    REAL3 most = max(abs(u), abs(v));
    REAL size = max(max(most.x, most.y), most.z);
    u /= size;
    v /= size;
    return REAL3(triangle_normal(0, u.x, u.y, u.z, v.x, v.y, v.z), triangle_normal(1, u.x, u.y, u.z, v.x, v.y, v.z),
                 triangle_normal(2, u.x, u.y, u.z, v.x, v.y, v.z));
}

// Whether a triangle with that normal lies in one plane with the one that the ray leaves, if they touch.
bool solid_left(REAL3 normal)
{
    REAL3 aside = cross(normal / sqrt(dot(normal, normal)), solid_leaves);
    return dot(solid_leaves, solid_leaves) > NUM(0.0) && dot(aside, aside) <= NUM(1.0e-10);
}

// Whether beyond the edge from a to b no neighbour lies on its other side, as the ray sees them, or none that it may meet.
bool solid_outline(REAL3 a, REAL3 b, uint beside, REAL side)
{
    if (solid_fine || beside == SOLID_ALONE) return true;
    REAL3 c = solid_corner(beside);
    REAL turned = solid_edge(b, a) + solid_edge(a, c) + solid_edge(c, b);
    return !(side * turned > solid_room(a, b) + solid_room(a, c) + solid_room(c, b)) || solid_left(solid_normal(a, b, c));
}

// Whether a triangle that the ray meets is seen before the best so far: of meshes in one place that of the lowest number is. Floats do
// not tell where that is.
bool solid_first(REAL t, REAL off, uint mesh)
{
    SolidPlace p = solid_place;
    int order = TRIANGLE_BEFORE;
    if (solid_best.hit) order = triangle_order(t, off, p.near, p.far, p.least, p.most);
    if (order == TRIANGLE_BEHIND) return false;
    bool other = mesh != solid_best.mesh;
    if (order == TRIANGLE_BEFORE) p = SolidPlace(t, t, off, off, false);
    else p = SolidPlace(min(p.near, t), max(p.far, t), min(p.least, off), max(p.most, off), p.mixed || other);
    solid_place = p;
#ifdef MNS_DOUBLE
    bool open = order == TRIANGLE_OPEN;
    bool by_number = order == TRIANGLE_WITH && other;
#else
    bool open = solid_fine;
    bool by_number = false;
#endif
    if (open && p.mixed) solid_doubt = min(solid_doubt, p.near - p.most);
    return by_number ? mesh < solid_best.mesh : t < solid_best.t;
}

// Takes a triangle that the ray may have begun on. To floats a second one may lie apart from it, where either is wide.
void solid_take_left()
{
#ifndef MNS_DOUBLE
    if (solid_lefts > 0) solid_doubt = NUM(0.0);
    solid_lefts++;
#endif
}

// Takes a triangle that the ray meets (`within`), or may meet (`open`).
void solid_take(REAL3 a, REAL3 b, REAL3 c, bool within, bool open, uint mesh)
{
    REAL3 normal = solid_normal(a, b, c);
    REAL size = sqrt(dot(normal, normal));
    REAL facing = dot(normal, solid_way);
    REAL slant = abs(facing) / size;
    REAL lengths = abs(a.x) + abs(a.y) + abs(a.z) + sqrt(dot(b - a, b - a)) + sqrt(dot(c - a, c - a)) + solid_reach;
    bool flat_on = slant > TAU; // else it is seen from its edge
    REAL t = flat_on ? dot(a, normal) / facing : NUM(0.0);
    REAL off = flat_on ? TAU * lengths / slant : FAR_AWAY;
    REAL begin = flat_on ? max(off, solid_begin * lengths / slant) : FAR_AWAY;
    bool leaves = dot(solid_leaves, solid_leaves) > NUM(0.0);
    if (leaves && abs(t) <= begin && solid_left(normal)) { // the triangle that the ray leaves, as far as rounding tells
        solid_take_left();
        return;
    }
    if (t < -off) return;
    if (t <= off) { // where the ray starts
        solid_doubt = NUM(0.0);
        return;
    }
    if (t - off > solid_limit) return;
    if (open || t + off >= solid_limit) solid_doubt = min(solid_doubt, t - off);
    if (!within || t > solid_limit || !solid_first(t, off, mesh)) return;
    solid_best = Solid(true, false, t, off, normal * ((facing < NUM(0.0) ? NUM(1.0) : NUM(-1.0)) / size), mesh);
}

void solid_test(uint triangle)
{
    int at = int(path_solids.x + 2u * triangle);
    uvec4 one = texelFetch(solid_texels, at);
    REAL3 a = solid_corner(one.x);
    REAL3 b = solid_corner(one.y);
    REAL3 c = solid_corner(one.z);
    REAL3 edges = REAL3(solid_edge(a, b), solid_edge(b, c), solid_edge(c, a));
    REAL3 room = REAL3(solid_room(a, b), solid_room(b, c), solid_room(c, a));
    REAL sum = edges.x + edges.y + edges.z;
    bool flat_on = abs(sum) > room.x + room.y + room.z;
    REAL side = sum < NUM(0.0) ? NUM(-1.0) : NUM(1.0);
    edges *= side;
    if (flat_on && (edges.x < -room.x || edges.y < -room.y || edges.z < -room.z)) return;
    bool open = !flat_on;
    bool near_edge = edges.x <= room.x || edges.y <= room.y || edges.z <= room.z;
    if (flat_on && near_edge) {
        uvec4 two = texelFetch(solid_texels, at + 1);
        open = (edges.x <= room.x && solid_outline(a, b, two.x, side)) || (edges.y <= room.y && solid_outline(b, c, two.y, side)) ||
               (edges.z <= room.z && solid_outline(c, a, two.z, side));
    }
    // Within rounding of an edge that goes on beyond it the triangle is met, or its neighbour: so nothing slips between.
    solid_take(a, b, c, flat_on && (!open || min(edges.x, min(edges.y, edges.z)) >= NUM(0.0)), open, one.w);
}

// Where the ray enters a node's box, FAR_AWAY where it does not before `limit`.
float solid_enters(uvec4 low, uvec4 high, float limit)
{
    vec3 x = (uintBitsToFloat(low.xyz) - solid_near) * solid_inverse;
    vec3 y = (uintBitsToFloat(high.xyz) - solid_near) * solid_inverse;
    vec3 enter = min(x, y) - solid_slack;
    vec3 leave = max(x, y) + solid_slack;
    float from = max(max(enter.x, enter.y), max(enter.z, 0.0));
    float to = min(min(leave.x, leave.y), min(leave.z, limit));
    return from <= to ? from : float(FAR_AWAY);
}

void solid_aim()
{
    uvec4 low = texelFetch(solid_texels, 0);
    uvec4 high = texelFetch(solid_texels, 1);
    vec3 way = vec3(solid_way);
    vec3 safe = max(abs(way), vec3(1.0e-9));
    solid_near = vec3(solid_start);
    vec3 size = abs(solid_near) + abs(uintBitsToFloat(low.xyz)) + abs(uintBitsToFloat(high.xyz));
    solid_inverse = mix(vec3(1.0), vec3(-1.0), lessThan(way, vec3(0.0))) / safe;
    solid_slack = 1.0e-6 * (size.x + size.y + size.z) * abs(solid_inverse);
}

uint solid_stack[SOLID_DEPTH];

void solid_walk()
{
    uint node = 0u;
    int top = 0;
    bool goes_on = path_solids.w > 0u;
    while (goes_on) {
        uvec4 low = texelFetch(solid_texels, int(2u * node));
        uint count = texelFetch(solid_texels, int(2u * node + 1u)).w;
        solid_work += 1 + int(count);
        float enter_first = float(FAR_AWAY);
        float enter_second = float(FAR_AWAY);
        if (count == 0u) {
            int at = int(2u * low.w);
            float limit = 1.000001 * float(min(solid_limit, solid_best.t + solid_best.off));
            enter_first = solid_enters(texelFetch(solid_texels, at), texelFetch(solid_texels, at + 1), limit);
            enter_second = solid_enters(texelFetch(solid_texels, at + 2), texelFetch(solid_texels, at + 3), limit);
        }
        for (uint i = 0u; i < count; i++) solid_test(low.w + i);
        bool first = enter_first <= enter_second;
        bool any = min(enter_first, enter_second) < float(FAR_AWAY);
        if (max(enter_first, enter_second) < float(FAR_AWAY)) {
            solid_stack[top] = low.w + (first ? 1u : 0u);
            top++;
        }
        if (any) {
            node = low.w + (first ? 0u : 1u);
        } else {
            top--;
            goes_on = top >= 0;
            node = solid_stack[max(top, 0)];
        }
    }
}

// The first triangle on the ray within `limit`. `leaves`: see solid_leaves; `begin`: what the start may be off, of the lengths around.
Solid solid_cast(REAL3 start, REAL3 way, REAL limit, REAL3 leaves, REAL begin, bool fine)
{
    solid_start = start;
    solid_way = way;
    solid_leaves = leaves;
    solid_reach = abs(start.x) + abs(start.y) + abs(start.z);
    solid_limit = limit;
    solid_begin = begin;
    solid_fine = fine;
    solid_doubt = FAR_AWAY;
    solid_lefts = 0;
    solid_work = 0;
    solid_best = Solid(false, false, FAR_AWAY, NUM(0.0), REAL3(0.0), 0u);
    solid_aim();
    solid_walk();
    solid_best.open = solid_doubt < FAR_AWAY && solid_doubt <= solid_best.t + solid_best.off;
    return solid_best;
}
