#include "rays.h"

#include <math.h>
#include <string.h>

/* ---- Dice ---- */

typedef struct dice {
    uint64_t state;
} dice;

static uint64_t roll(dice *d) /* SplitMix64 (Steele, Lea & Flood 2014) */
{
    uint64_t z = d->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static double within(dice *d, double lo, double hi)
{
    return lo + (hi - lo) * ((double)(roll(d) >> 11) * 0x1p-53);
}

static double log_within(dice *d, double lo, double hi)
{
    return exp(within(d, log(lo), log(hi)));
}

static bool chance(dice *d, double share)
{
    return within(d, 0, 1) < share;
}

static size_t below(dice *d, size_t end)
{
    return (size_t)(roll(d) % end);
}

static void unit_vector(dice *d, double v[3])
{
    double length;
    do {
        for (int a = 0; a < 3; a++) v[a] = within(d, -1, 1);
        length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    } while (length > 1 || length < 0.01);
    for (int a = 0; a < 3; a++) v[a] /= length;
}

/* ---- Fields ---- */

/* What finds no room is left out. */
static void add(rays_case *c, double x, double y, double z, double radius, double strength)
{
    if (c->scene.count == RAYS_BALLS) return;
    size_t i = c->scene.count++;
    c->axis[0][i] = x, c->axis[1][i] = y, c->axis[2][i] = z;
    c->radius[i] = radius, c->strength[i] = strength;
}

static double some_strength(dice *d, int mode)
{
    double q = mode == 0 ? 1 : log_within(d, 1e-3, 1e3);
    return mode == 2 && chance(d, 0.4) ? -q : q;
}

/* Balls in the unit cube: each reaches as far as `reach` mean spacings; radii spread over `decades`. */
static void cube(rays_case *c, dice *d, double reach, double decades, int strengths)
{
    size_t count = 1 + below(d, RAYS_BALLS);
    double radius = reach * pow((double)count, -1.0 / 3);
    for (size_t i = 0; i < count; i++)
        add(c, within(d, 0, 1), within(d, 0, 1), within(d, 0, 1), radius * pow(10, within(d, -decades, 0)),
            some_strength(d, strengths));
}

static void some_cube(rays_case *c, dice *d)
{
    static const double reach[] = {0.8, 1.2, 2};
    cube(c, d, reach[below(d, 3)], chance(d, 0.3) ? 2 : 0, (int)below(d, 3));
}

/* Two balls whose level on the axis between them dips to L (1 + something small). */
static void neck(rays_case *c, dice *d, double saddle[3])
{
    double radius[2] = {1, chance(d, 0.5) ? 1 : within(d, 0.5, 2)}, axis[3];
    unit_vector(d, axis);
    if (chance(d, 0.3)) axis[0] = 1, axis[1] = axis[2] = 0;
    double apart = within(d, 0.8, 0.98) * (radius[0] + radius[1]), least = INFINITY;
    for (int i = 0; i < 2; i++)
        add(c, i * apart * axis[0], i * apart * axis[1], i * apart * axis[2], radius[i],
            chance(d, 0.5) ? 1 : some_strength(d, 1));
    double lo = 0, hi = apart; /* golden section: f has one dip between the centres, mostly */
    for (int step = 0; step < 60; step++) {
        double at[2] = {lo + 0.382 * (hi - lo), lo + 0.618 * (hi - lo)}, f[2];
        for (int i = 0; i < 2; i++)
            f[i] =
                truth_value(&c->scene, (double[]){at[i] * axis[0], at[i] * axis[1], at[i] * axis[2]}, NULL);
        if (f[0] < f[1])
            hi = at[1];
        else
            lo = at[0];
        least = fmin(f[0], f[1]);
    }
    for (int a = 0; a < 3; a++) saddle[a] = 0.5 * (lo + hi) * axis[a];
    double off = chance(d, 0.1) ? 0 : log_within(d, 1e-15, 1e-3);
    if (least > 0) c->scene.iso = least * (1 + (chance(d, 0.5) ? off : -off));
}

/* Balls in a row that touch, or balls through one point; all numbers short, so that ends coincide exactly. */
static void chord_ends(rays_case *c, dice *d)
{
    size_t count = 2 + below(d, 12);
    bool row = chance(d, 0.5);
    double x = 0;
    for (size_t i = 0; i < count; i++) {
        double radius = (double)(1 + below(d, 8)) / 4, q = chance(d, 0.7) ? 1 : some_strength(d, 2);
        if (row) {
            add(c, x + radius, 0, 0, radius, q);
            x += 2 * radius;
            if (chance(d, 0.3)) add(c, x, 0, 0, radius / 2, q); /* begins in the middle, ends at a middle */
        } else
            add(c, chance(d, 0.5) ? radius : -radius, 0, 0, radius, q);
    }
}

static void coincident(rays_case *c, dice *d)
{
    size_t places = 1 + below(d, 4);
    for (size_t place = 0; place < places; place++) {
        double p[3] = {within(d, 0, 1), within(d, 0, 1), within(d, 0, 1)}, radius = within(d, 0.3, 1);
        size_t count = 2 + below(d, 13);
        for (size_t i = 0; i < count; i++) {
            double q = some_strength(d, (int)below(d, 3));
            double near = chance(d, 0.3) ? 1e-12 * within(d, -1, 1) : 0;
            double r = chance(d, 0.5) ? radius : radius * within(d, 0.5, 1);
            add(c, p[0] + near, p[1], p[2], r, q);
            if (chance(d, 0.3)) add(c, p[0], p[1], p[2], r, -q * (chance(d, 0.5) ? 1 : 1 - 1e-9));
        }
    }
}

/* ---- Rays ---- */

static void aim(rays_case *c, const double from[3], const double at[3])
{
    for (int a = 0; a < 3; a++) {
        c->ray.origin[a] = from[a];
        c->ray.direction[a] = at[a] - from[a];
    }
}

/* Towards a point of some ball, from `away` times the field's size. */
static void shoot(rays_case *c, dice *d, double away)
{
    double v[3], w[3], from[3], at[3];
    unit_vector(d, v), unit_vector(d, w);
    size_t i = below(d, c->scene.count);
    double off = c->radius[i] * within(d, 0, 1.05);
    for (int a = 0; a < 3; a++) {
        at[a] = c->axis[a][i] + off * w[a];
        from[a] = at[a] + away * v[a];
    }
    aim(c, from, at);
}

/* A point of the surface, to rounding, and the gradient there. False: no luck. */
static bool surface_point(rays_case *c, dice *d, double x[3], double gradient[3])
{
    for (int attempt = 0; attempt < 8; attempt++) {
        shoot(c, d, chance(d, 0.5) ? 3 : 0);
        truth_answer hit = truth_trace(&c->scene, &c->ray);
        if (hit.kind != TRUTH_HIT) continue;
        double length = 0;
        for (int a = 0; a < 3; a++) length += c->ray.direction[a] * c->ray.direction[a];
        for (int a = 0; a < 3; a++) x[a] = c->ray.origin[a] + hit.t * c->ray.direction[a] / sqrt(length);
        truth_value(&c->scene, x, gradient);
        length = sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2]);
        if (!(length > 1e-6)) continue;
        for (int a = 0; a < 3; a++) gradient[a] /= length;
        return true;
    }
    return false;
}

static void silhouette(rays_case *c, dice *d, double nearest, double farthest)
{
    double x[3], n[3], v[3], along = 0, from[3];
    if (!surface_point(c, d, x, n)) return;
    unit_vector(d, v);
    for (int a = 0; a < 3; a++) along += v[a] * n[a];
    double off = c->radius[0] * log_within(d, 1e-15, 1e-3) * (chance(d, 0.5) ? 1 : -1),
           away = c->radius[0] * log_within(d, nearest, farthest);
    for (int a = 0; a < 3; a++) {
        v[a] -= along * n[a];
        from[a] = x[a] + off * n[a] - away * v[a];
        c->ray.origin[a] = from[a];
        c->ray.direction[a] = v[a];
    }
}

static void through_neck(rays_case *c, dice *d)
{
    double saddle[3], v[3], from[3];
    neck(c, d, saddle);
    unit_vector(d, v);
    if (chance(d, 0.6)) { /* straight across, or straight along */
        double along = 0, square = 0, axis[3];
        for (int a = 0; a < 3; a++) axis[a] = c->axis[a][1] - c->axis[a][0], square += axis[a] * axis[a];
        for (int a = 0; a < 3; a++) along += v[a] * axis[a] / square;
        bool across = chance(d, 0.5);
        for (int a = 0; a < 3; a++) v[a] = across ? v[a] - along * axis[a] : axis[a] / sqrt(square);
    }
    double away = within(d, 0.3, 5);
    for (int a = 0; a < 3; a++) from[a] = saddle[a] - away * v[a];
    for (int a = 0; a < 3; a++) c->ray.origin[a] = from[a], c->ray.direction[a] = v[a];
}

static void through_chord_ends(rays_case *c, dice *d)
{
    chord_ends(c, d);
    aim(c, (double[]){chance(d, 0.7) ? -8 : 0.25, 0, 0}, (double[]){1, 0, 0});
    if (chance(d, 0.3)) /* the common point is met from the side: every chord there is of length about 0 */
        aim(c, (double[]){0, -4, 0}, (double[]){0, 0, 0});
}

static void from_inside(rays_case *c, dice *d)
{
    size_t i = below(d, c->scene.count);
    double w[3], from[3], off = chance(d, 0.3) ? 0 : c->radius[i] * within(d, 0, 0.8);
    unit_vector(d, w);
    for (int a = 0; a < 3; a++) from[a] = c->axis[a][i] + off * w[a];
    unit_vector(d, c->ray.direction);
    memcpy(c->ray.origin, from, sizeof from);
}

/* A ball of radius 1 with a point exactly on its surface, all in short numbers; from there, or (a touch) past
 * it. */
static void exactly_on_surface(rays_case *c, dice *d)
{
    static const double on[MNS_KERNEL_COUNT][3] = {
        /* x, y, L */
        [MNS_KERNEL_POLY2] = {0.5, 0.5, 0.25},   [MNS_KERNEL_POLY3] = {0.5, 0.5, 0.125},
        [MNS_KERNEL_POLY4] = {0.5, 0.5, 0.0625}, [MNS_KERNEL_WYVILL] = {0.75, 0, 147.0 / 1024},
        [MNS_KERNEL_PERLIN] = {0.5, 0, 0.5},     [MNS_KERNEL_WENDLAND] = {0.5, 0, 0.1875}};
    const double *at = on[c->scene.kernel];
    c->scene.count = 0;
    add(c, 0, 0, 0, 1, 1);
    c->scene.iso = at[2];
    bool from_afar = chance(d, 0.3);
    c->ray.origin[0] = at[0], c->ray.origin[1] = at[1], c->ray.origin[2] = from_afar ? -4 : 0;
    unit_vector(d, c->ray.direction);
    if (from_afar || chance(d, 0.2)) c->ray.direction[0] = c->ray.direction[1] = 0, c->ray.direction[2] = 1;
}

static void from_surface(rays_case *c, dice *d)
{
    double x[3], n[3];
    if (chance(d, 0.3)) {
        exactly_on_surface(c, d);
        return;
    }
    if (!surface_point(c, d, x, n)) return;
    memcpy(c->ray.origin, x, sizeof x);
    unit_vector(d, c->ray.direction);
}

/* Balls about one point, and a ray that just meets or just misses it. */
static void at_peak(rays_case *c, dice *d)
{
    double off[3], peak = 0;
    c->scene.count = 0;
    for (size_t i = 0, count = 1 + below(d, 5); i < count; i++) {
        double w[3], away = chance(d, 0.5) ? 0 : log_within(d, 1e-12, 1e-1);
        unit_vector(d, w);
        add(c, away * w[0], away * w[1], away * w[2], within(d, 0.5, 1), some_strength(d, (int)below(d, 2)));
    }
    peak = truth_value(&c->scene, (double[]){0, 0, 0}, NULL);
    unit_vector(d, c->ray.direction), unit_vector(d, off);
    double past = chance(d, 0.5) ? 0 : log_within(d, 1e-12, 1e-1);
    for (int a = 0; a < 3; a++) c->ray.origin[a] = past * off[a] - 3 * c->ray.direction[a];
    c->scene.iso = peak * (1 + (chance(d, 0.7) ? -1 : 1) * log_within(d, 1e-15, 1e-1));
}

/* All lengths by one factor, after radii and strengths have been spread. */
static void extreme(rays_case *c, dice *d)
{
    c->scene.count = 0;
    cube(c, d, 2, 6, 0);
    bool is_signed = chance(d, 0.5);
    for (size_t i = 0; i < c->scene.count; i++)
        c->strength[i] = log_within(d, 1e-6, 1e6) * (is_signed && chance(d, 0.4) ? -1 : 1);
    shoot(c, d, log_within(d, 1e-3, 1e3));
    if (chance(d, 0.3)) silhouette(c, d, 0.5, 30);
    double scale = log_within(d, 1e-23, 1e26);
    for (int a = 0; a < 3; a++) {
        for (size_t i = 0; i < c->scene.count; i++) c->axis[a][i] *= scale;
        c->ray.origin[a] *= scale;
    }
    for (size_t i = 0; i < c->scene.count; i++) c->radius[i] *= scale;
}

static void move(rays_case *c, dice *d)
{
    double by[3];
    unit_vector(d, by);
    double far = c->radius[0] * log_within(d, 1e6, 1e9);
    for (int a = 0; a < 3; a++) {
        for (size_t i = 0; i < c->scene.count; i++) c->axis[a][i] += far * by[a];
        c->ray.origin[a] += far * by[a];
    }
}

/* ---- Cases ---- */

static const char *const names[RAYS_KINDS] = {
    "scattered",  "dense",  "mixed",      "signed", "silhouette", "silhouette far", "neck",    "chords' ends",
    "coincident", "inside", "on surface", "far",    "offset",     "peak",           "extreme",
};

const char *rays_name(rays_kind kind)
{
    return names[kind];
}

static void make_adversarial(rays_kind kind, rays_case *c, dice *d)
{
    if (kind == RAYS_NECK) {
        through_neck(c, d);
        return;
    }
    if (kind == RAYS_CHORD_ENDS) {
        through_chord_ends(c, d);
        return;
    }
    if (kind == RAYS_COINCIDENT)
        coincident(c, d);
    else
        some_cube(c, d);
    shoot(c, d, kind == RAYS_FAR ? 1e5 * c->radius[0] : 3); /* what stays where no better is found below */
    if (kind == RAYS_SILHOUETTE) silhouette(c, d, 0.5, 30);
    if (kind == RAYS_SILHOUETTE_FAR) silhouette(c, d, 30, 1e5);
    if (kind == RAYS_INSIDE) from_inside(c, d);
    if (kind == RAYS_ON_SURFACE) from_surface(c, d);
    if (kind == RAYS_PEAK) at_peak(c, d);
    if (kind == RAYS_EXTREME) extreme(c, d);
    if (kind == RAYS_OFFSET) {
        if (chance(d, 0.3)) silhouette(c, d, 0.5, 30);
        move(c, d);
    }
}

void rays_make(rays_kind kind, mns_kernel kernel, uint64_t seed, rays_case *c)
{
    dice d = {(seed * RAYS_KINDS + (uint64_t)kind) * MNS_KERNEL_COUNT + (uint64_t)kernel};
    memset(c, 0, sizeof *c);
    c->scene = (truth_scene){.axis = {c->axis[0], c->axis[1], c->axis[2]},
                             .radius = c->radius,
                             .strength = c->strength,
                             .kernel = kernel,
                             .iso = chance(&d, 0.7) ? 0.2 : log_within(&d, 0.01, 0.95)};
    static const struct {
        double reach, decades;
        int strengths;
    } plain[] = {{0.8, 0, 0}, {2, 0, 0}, {1.5, 2, 1}, {1.2, 0.5, 2}};
    if (kind <= RAYS_SIGNED) {
        cube(c, &d, plain[kind].reach, plain[kind].decades, plain[kind].strengths);
        shoot(c, &d, within(&d, 0, 5));
    } else
        make_adversarial(kind, c, &d);
    double length = 0; /* a rounding may have left none, where a ray starts at its aim */
    for (int a = 0; a < 3; a++) length += fabs(c->ray.direction[a]);
    if (!(length > 0)) c->ray.direction[2] = 1;
    if (chance(&d, 0.2)) {
        double stretch = log_within(&d, 1e-3, 1e3);
        for (int a = 0; a < 3; a++) c->ray.direction[a] *= stretch;
    }
}
