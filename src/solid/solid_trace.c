/* A ray's first hit among the triangles, in doubles; what rounding could decide otherwise is told. */
#include "solid/solid.h"

#define DENSITY_FN static inline __attribute__((unused))
#define REAL       double
#define NUM(x)     ((REAL)(x))
#define abs        fabs
#define min        fmin
#define max        fmax
#include "triangle.glsl"
#undef max
#undef min
#undef abs
#undef NUM
#undef REAL
#undef DENSITY_FN

#define TAU       0x1p-40 /* as glsl/real.glsl has it of doubles */
#define ONE_PLANE 1e-5    /* sine of the angle between triangles that count as one plane */

/* The triangles that are met in one place, so far as rounding tells, before all others. */
typedef struct place {
    double near, far;   /* the first and the last of them on the ray */
    double least, most; /* t_error of the best and of the worst placed of them */
    bool mixed;         /* they are of more meshes than one */
} place;

/* A ray, and what is known of it so far. */
typedef struct walk {
    const solid_set *set;
    const solid_ray *ray;
    double start[3], inverse[3], slack[3]; /* of boxes' slabs */
    double reach;                          /* of the start, from the origin of coordinates */
    double doubt;
    place place;
    solid_hit best; /* of that place: the nearest of its first mesh */
} walk;

/* ---- A triangle ---- */

static double edge(vec3 a, vec3 b, vec3 d)
{
    return triangle_edge(a.x, a.y, a.z, b.x, b.y, b.z, d.x, d.y, d.z);
}

static double edge_margin(const walk *w, vec3 a, vec3 b)
{
    return triangle_edge_margin(a.x, a.y, a.z, b.x, b.y, b.z, w->reach, TAU);
}

static vec3 corner_at(const walk *w, uint32_t corner)
{
    return vec3_sub(vec3_load(w->set->corner[corner]), w->ray->origin);
}

static vec3 normal_of(vec3 a, vec3 b, vec3 c)
{
    vec3 u = vec3_sub(b, a), v = vec3_sub(c, a);
    return vec3_make(triangle_normal(0, u.x, u.y, u.z, v.x, v.y, v.z),
                     triangle_normal(1, u.x, u.y, u.z, v.x, v.y, v.z),
                     triangle_normal(2, u.x, u.y, u.z, v.x, v.y, v.z));
}

/* Whether a triangle with that normal, of any length, lies in one plane with the one that the ray leaves, if
 * they touch. */
static bool is_left(const walk *w, vec3 normal)
{
    bool leaves = vec3_dot(w->ray->leaves, w->ray->leaves) > 0;
    return leaves && vec3_length(vec3_cross(vec3_unit(normal), w->ray->leaves)) <= ONE_PLANE;
}

/* Whether the ray passes a triangle's edge k as near as rounding, where no neighbour lies on its other side
 * as the ray sees them, or none that it may meet: it may meet either or neither. */
static bool is_outline(const walk *w, const solid_triangle *triangle, const vec3 p[3], int k, double side)
{
    uint32_t beside = triangle->beside[k];
    if (beside == SOLID_ALONE) return true;
    vec3 a = p[k], b = p[(k + 1) % 3], c = corner_at(w, beside), d = w->ray->way;
    /* The neighbour has the edge the other way round: it faces as this triangle does where its own sum, that
     * of its three edges, has this one's sign. */
    double turned = edge(b, a, d) + edge(a, c, d) + edge(c, b, d);
    double margin = edge_margin(w, a, b) + edge_margin(w, a, c) + edge_margin(w, c, b);
    return !(side * turned > margin) || is_left(w, normal_of(a, b, c));
}

/* 1: the ray meets the triangle, 0: it does not; *open: it may be otherwise. */
static bool meets(const walk *w, const solid_triangle *triangle, const vec3 p[3], bool *open)
{
    double e[3], margin[3], sum = 0, room = 0;
    for (int k = 0; k < 3; k++) {
        e[k] = edge(p[k], p[(k + 1) % 3], w->ray->way);
        margin[k] = edge_margin(w, p[k], p[(k + 1) % 3]);
        sum += e[k], room += margin[k];
    }
    double side = sum < 0 ? -1 : 1;
    bool within = true;
    *open = false;
    for (int k = 0; k < 3; k++) {
        if (side * e[k] < -margin[k] && fabs(sum) > room) return false;
        within = within && side * e[k] >= 0;
    }
    if (!(fabs(sum) > room)) { /* seen from its edge */
        *open = true;
        return false;
    }
    for (int k = 0; k < 3; k++)
        *open = *open || (side * e[k] <= margin[k] && is_outline(w, triangle, p, k, side));
    return within || !*open; /* beside an inner edge it is met, or its neighbour: nothing slips between */
}

/* Takes a triangle that is met, if it is seen before the best so far: of meshes in one place that of the
 * lowest number is. */
static void take(walk *w, const solid_hit *met)
{
    place *p = &w->place;
    double t = met->t, off = met->t_error;
    int order = TRIANGLE_BEFORE;
    if (w->best.hit) order = triangle_order(t, off, p->near, p->far, p->least, p->most);
    if (order == TRIANGLE_BEHIND) return;
    if (order == TRIANGLE_BEFORE) {
        *p = (place){.near = t, .far = t, .least = off, .most = off};
        w->best = *met;
        return;
    }
    bool is_other = met->mesh != w->best.mesh;
    *p = (place){.near = fmin(p->near, t),
                 .far = fmax(p->far, t),
                 .least = fmin(p->least, off),
                 .most = fmax(p->most, off),
                 .mixed = p->mixed || is_other};
    if (order == TRIANGLE_OPEN && p->mixed) w->doubt = fmin(w->doubt, p->near - p->most);
    if (is_other && order == TRIANGLE_WITH ? met->mesh < w->best.mesh : t < w->best.t) w->best = *met;
}

static void test(walk *w, const solid_triangle *triangle)
{
    vec3 p[3], d = w->ray->way;
    bool open;
    for (int k = 0; k < 3; k++) p[k] = corner_at(w, triangle->corner[k]);
    bool within = meets(w, triangle, p, &open);
    if (!within && !open) return;
    vec3 n = normal_of(p[0], p[1], p[2]);
    double facing = vec3_dot(n, d), size = vec3_length(n), t = vec3_dot(p[0], n) / facing;
    double off = TAU *
                 (fabs(p[0].x) + fabs(p[0].y) + fabs(p[0].z) + vec3_length(vec3_sub(p[1], p[0])) +
                  vec3_length(vec3_sub(p[2], p[0])) + w->reach) *
                 size / fabs(facing);
    if (!(off < INFINITY)) off = INFINITY, t = 0;
    if (t < -off) return;
    if (t <= off) { /* where the ray starts */
        if (!is_left(w, n)) w->doubt = fmin(w->doubt, 0);
        return;
    }
    if (t - off > w->ray->reach) return;
    if (open || t + off >= w->ray->reach) w->doubt = fmin(w->doubt, t - off);
    if (!within || t > w->ray->reach) return;
    n = vec3_scale(n, (facing < 0 ? 1 : -1) / size);
    take(w, &(solid_hit){.hit = true, .t = t, .t_error = off, .normal = n, .mesh = triangle->mesh});
}

/* ---- The tree ---- */

/* Where the ray enters a box, widened by what rounding may be; INFINITY where it does not before the hit. */
static double enters(const walk *w, const solid_node *node)
{
    double enter = 0, leave = fmin(w->ray->reach, w->best.t + w->best.t_error);
    for (int a = 0; a < 3; a++) {
        double x = (node->lo[a] - w->start[a]) * w->inverse[a],
               y = (node->hi[a] - w->start[a]) * w->inverse[a];
        enter = fmax(enter, fmin(x, y) - w->slack[a]);
        leave = fmin(leave, fmax(x, y) + w->slack[a]);
    }
    return enter <= leave * (1 + 0x1p-50) ? enter : INFINITY;
}

static void aim(walk *w)
{
    const double way[3] = {w->ray->way.x, w->ray->way.y, w->ray->way.z};
    vec3_store(w->start, w->ray->origin);
    w->reach = fabs(w->start[0]) + fabs(w->start[1]) + fabs(w->start[2]);
    for (int a = 0; a < 3; a++) {
        const double *lo = w->set->lo, *hi = w->set->hi;
        double safe = fmax(fabs(way[a]), 1e-30);
        w->inverse[a] = (way[a] < 0 ? -1 : 1) / safe;
        w->slack[a] = TAU * (w->reach + fabs(lo[a]) + fabs(hi[a])) / safe;
    }
}

solid_hit solid_trace(const solid_set *set, const solid_ray *ray)
{
    walk w = {.set = set, .ray = ray, .doubt = INFINITY, .best = {.t = INFINITY}};
    uint32_t stack[SOLID_DEPTH + 1], top = 0, at = 0;
    aim(&w);
    bool goes_on = set->node_count && enters(&w, set->node) < INFINITY;
    while (goes_on) {
        const solid_node *node = &set->node[at];
        for (uint32_t i = 0; i < node->count; i++) test(&w, &set->triangle[node->first + i]);
        double low = INFINITY, high = INFINITY;
        if (!node->count)
            low = enters(&w, &set->node[node->first]), high = enters(&w, &set->node[node->first + 1]);
        if (low < INFINITY && high < INFINITY) stack[top++] = node->first + (low <= high);
        if (low < INFINITY || high < INFINITY) {
            at = node->first + !(low <= high);
            continue;
        }
        goes_on = top > 0;
        if (goes_on) at = stack[--top];
    }
    w.best.doubt = w.doubt;
    w.best.certain = !(w.doubt <= w.best.t + w.best.t_error) || !(w.doubt < INFINITY);
    return w.best;
}
