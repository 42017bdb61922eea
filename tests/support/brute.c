#include "brute.h"

#include "base/memory.h"
#include "brute_tree.h"

#include <math.h>
#include <string.h>

/* ---- The kernels, from the design's table ---- */

long double brute_kernel(mns_kernel kernel, long double u, long double *slope_over_v)
{
    *slope_over_v = 0;
    if (!(u < 1)) return 0;
    long double w = 1 - u, v = sqrtl(u), x = 1 - v;
    switch (kernel) {
    case MNS_KERNEL_POLY2:
        *slope_over_v = -4 * w;
        return w * w;
    case MNS_KERNEL_POLY4:
        *slope_over_v = -8 * w * w * w;
        return w * w * w * w;
    case MNS_KERNEL_WYVILL:
        *slope_over_v = -4 * w * (1 - 4 * u / 9) - 8 * w * w / 9;
        return w * w * (1 - 4 * u / 9);
    case MNS_KERNEL_PERLIN:
        *slope_over_v = -30 * v * x * x;
        return x * x * x * (1 + 3 * v + 6 * u);
    case MNS_KERNEL_WENDLAND:
        *slope_over_v = -20 * x * x * x;
        return x * x * x * x * (1 + 4 * v);
    default:
        *slope_over_v = -6 * w * w;
        return w * w * w;
    }
}

long double brute_kernel_slope_bound(mns_kernel kernel)
{
    switch (kernel) {
    case MNS_KERNEL_POLY2:
        return 1.54L; /* at v^2 = 1/3 */
    case MNS_KERNEL_POLY4:
        return 1.91L; /* at v^2 = 1/7 */
    case MNS_KERNEL_WYVILL:
        return 1.584L; /* near v = 0.503 */
    case MNS_KERNEL_PERLIN:
        return 1.876L; /* 15/8 at v = 1/2 */
    case MNS_KERNEL_WENDLAND:
        return 2.11L; /* 135/64 at v = 1/4 */
    default:
        return 1.718L; /* at v^2 = 1/5 */
    }
}

long double brute_kernel_curvature_bound(mns_kernel kernel)
{
    switch (kernel) {
    case MNS_KERNEL_POLY2: /* k'' at v = 1 */
    case MNS_KERNEL_POLY4: /* at v = 0 */
        return 8;
    case MNS_KERNEL_WYVILL:
        return 4.889L; /* 44/9 at v = 0 */
    case MNS_KERNEL_PERLIN:
        return 5.774L; /* 10/sqrt(3) at v = (3 - sqrt(3))/6 */
    case MNS_KERNEL_WENDLAND:
        return 20; /* at v = 0 */
    default:
        return 6; /* at v = 0 */
    }
}

/* ---- The field at a point ---- */

struct brute {
    const mns_field *field;
    brute_tree *tree;
};

brute *brute_create(const mns_field *field)
{
    brute *oracle = calloc(1, sizeof *oracle);
    if (!oracle) return NULL;
    oracle->field = field;
    oracle->tree = brute_tree_create(field);
    if (oracle->tree) return oracle;
    free(oracle);
    return NULL;
}

void brute_destroy(brute *oracle)
{
    if (!oracle) return;
    brute_tree_destroy(oracle->tree);
    free(oracle);
}

/* Ball i's share of f at x; adds its gradient. */
static long double ball_at(const mns_field *f, size_t i, const long double x[3], long double gradient[3])
{
    long double r = field_radius(f, i), q = field_strength(f, i), d[3], distance2 = 0, slope;
    for (int a = 0; a < 3; a++) {
        d[a] = x[a] - f->p.axis[a][i];
        distance2 += d[a] * d[a];
    }
    long double value = q * brute_kernel(f->kernel, distance2 / (r * r), &slope);
    for (int a = 0; a < 3; a++) gradient[a] += q * slope * d[a] / (r * r);
    return value;
}

void brute_gradient(const brute *oracle, const long double x[3], long double gradient[3])
{
    gradient[0] = gradient[1] = gradient[2] = 0;
    for (size_t i = 0; i < oracle->field->p.count; i++) ball_at(oracle->field, i, x, gradient);
}

long double brute_value(const brute *oracle, const long double x[3])
{
    long double sum = 0, unused[3] = {0, 0, 0};
    for (size_t i = 0; i < oracle->field->p.count; i++) sum += ball_at(oracle->field, i, x, unused);
    return sum;
}

/* ---- The walk along a ray ---- */

/* With s = +1 inside and -1 outside, the walk looks at F = s (f - L), which is positive until the hit. On [t,
 * t + h], with |f''| <= M there, F(t + h) >= F + F' h - M h^2 / 2: so far a step may go without passing a
 * sign change. Near a root that is Newton's step from the safe side, and near a tangency it converges to the
 * extremum geometrically and passes it, so nothing stalls. f' is Lipschitz across the ends of chords too, as
 * every kernel has k'(1) = 0. */
typedef struct sample {
    long double F, slope; /* s (f - L) and its derivative along the ray */
} sample;

typedef struct walk {
    const brute *oracle;
    const brute_ray *ray;
    const brute_limits *limits;
    brute_chords chords;
    size_t *active; /* chords that reach past t and begin before the furthest `reach` asked for */
    size_t active_count, next;
    long double t, sign;
    sample here; /* at t */
    brute_hit result;
} walk;

typedef struct bounds {
    long double curvature; /* of |f''| */
    long double margin;    /* how near to L is too near to call */
} bounds;

static sample walk_sample(const walk *w, long double t)
{
    const mns_field *f = w->oracle->field;
    long double value = 0, derivative = 0;
    for (size_t i = 0; i < w->active_count; i++) {
        const brute_chord *c = &w->chords.chord[w->active[i]];
        if (t <= c->entry || t >= c->exit) continue;
        long double r = field_radius(f, c->ball), q = field_strength(f, c->ball), s = t - c->middle, slope;
        value += q * brute_kernel(f->kernel, (c->away2 + s * s) / (r * r), &slope);
        derivative += q * slope * s / (r * r);
    }
    return (sample){w->sign * (value - f->iso), w->sign * derivative};
}

/* Drops the chords that ended by t, takes in those that begin before t + reach. */
static void walk_activate(walk *w, long double reach)
{
    size_t kept = 0;
    for (size_t i = 0; i < w->active_count; i++)
        if (w->chords.chord[w->active[i]].exit > w->t) w->active[kept++] = w->active[i];
    w->active_count = kept;
    while (w->next < w->chords.count && w->chords.chord[w->next].entry < w->t + reach) {
        if (w->chords.chord[w->next].exit > w->t) w->active[w->active_count++] = w->next;
        w->next++;
    }
}

/* Never below what long double itself can tell. */
static long double walk_tau(const walk *w)
{
    return fmaxl(w->limits->tau, 0x1p-58L);
}

/* Over the balls that overlap [t, t + reach]. */
static bounds walk_bounds(const walk *w, long double reach)
{
    const mns_field *f = w->oracle->field;
    long double curvature = brute_kernel_curvature_bound(f->kernel),
                slope = brute_kernel_slope_bound(f->kernel);
    long double sum = 0, sum_margin = 0;
    for (size_t i = 0; i < w->active_count; i++) {
        const brute_chord *c = &w->chords.chord[w->active[i]];
        if (c->entry >= w->t + reach) continue;
        long double r = field_radius(f, c->ball), q = fabsl((long double)field_strength(f, c->ball)),
                    away2 = 0;
        for (int a = 0; a < 3; a++) {
            long double d = (long double)f->p.axis[a][c->ball] - w->limits->reference[a];
            away2 += d * d;
        }
        sum += q / (r * r);
        sum_margin += q * (1 + slope * sqrtl(away2) / r);
    }
    return (bounds){curvature * sum, walk_tau(w) * sum_margin};
}

/* The furthest h with F + F' h - M h^2 / 2 >= margin, given F > margin. */
static long double safe_step(sample s, bounds b)
{
    long double room = s.F - b.margin;
    long double root = sqrtl(s.slope * s.slope + 2 * b.curvature * room);
    return s.slope < 0 ? 2 * room / (root - s.slope) : (s.slope + root) / b.curvature;
}

static void take_hit(walk *w, long double lo, long double hi)
{
    for (int i = 0; i < 200; i++) { /* to neighbouring long doubles */
        long double middle = lo + (hi - lo) / 2;
        if (middle <= lo || middle >= hi) break;
        if (walk_sample(w, middle).F > 0)
            lo = middle;
        else
            hi = middle;
    }
    const mns_field *f = w->oracle->field;
    brute_hit *hit = &w->result;
    long double x[3], gradient[3] = {0, 0, 0}, length = 0;
    for (int a = 0; a < 3; a++) x[a] = w->ray->origin[a] + hi * w->ray->direction[a];
    hit->radius = INFINITY;
    for (size_t i = 0; i < w->active_count; i++) {
        const brute_chord *c = &w->chords.chord[w->active[i]];
        if (hi < c->entry || hi > c->exit) continue;
        ball_at(f, c->ball, x, gradient);
        hit->radius = fmin(hit->radius, field_radius(f, c->ball));
    }
    for (int a = 0; a < 3; a++) length += gradient[a] * gradient[a];
    length = sqrtl(length);
    for (int a = 0; a < 3; a++) hit->normal[a] = length > 0 ? -gradient[a] / length : 0;
    hit->hit = true;
    hit->t = hi;
}

/* A root by which F falls from s.F at t to below -margin while its slope keeps its sign: a proven, simple
 * crossing. */
static bool take_simple_crossing(walk *w, bounds b, long double reach)
{
    sample s = w->here;
    if (!(s.slope < 0)) return false;
    long double h = fminl(-s.slope / b.curvature, reach); /* F' < 0 up to here */
    if (s.F + s.slope * h - b.curvature * h * h / 2 >= -b.margin) return false;
    if (walk_sample(w, w->t + h).F >= -b.margin) return false;
    take_hit(w, w->t, w->t + h);
    return true;
}

/* Where F had a low point between t and t + h and came near to 0 there, remembers how near. */
static void note_gap(walk *w, sample to, long double h, bounds b)
{
    if (!(w->here.slope < 0 && to.slope >= 0) || b.margin == 0) return;
    long double scale = b.margin / walk_tau(w);
    if (fminl(w->here.F, to.F) > 1e-3L * scale) return;
    long double lo = w->t, hi = w->t + h;
    for (int i = 0; i < 60; i++) {
        long double middle = lo + (hi - lo) / 2;
        if (walk_sample(w, middle).slope < 0)
            lo = middle;
        else
            hi = middle;
    }
    w->result.gap = fmin(w->result.gap, (double)(fabsl(walk_sample(w, hi).F) / scale));
}

/* The step where F is within the margin and no simple crossing is proven. */
static long double close_step(walk *w, bounds b, long double reach)
{
    long double rising = fminl(w->here.slope / b.curvature, reach); /* F' > 0 up to here */
    if (w->here.slope > 0 && w->here.slope * rising > b.margin / 16) return rising;
    w->result.near = true;
    return fminl(sqrtl(2 * b.margin / b.curvature) / 2,
                 reach); /* half the width of a parabola in the margin */
}

/* The sign of f - L just after t = 0. */
static void walk_start(walk *w, long double reach)
{
    walk_activate(w, reach);
    bounds b = walk_bounds(w, reach);
    w->sign = 1;
    sample s = w->here = walk_sample(w, 0);
    bool rises = s.F > 0;
    if (b.curvature > 0 && fabsl(s.F) <= b.margin) {
        if (fabsl(s.F) > b.margin * (0x1p-58L / walk_tau(w)))
            w->result.near = true; /* not on the surface, but rounding could decide the side */
        else {
            rises = s.slope >= 0; /* on the surface: the sign just after counts */
            w->result.near = s.slope * s.slope <= 8 * b.curvature * b.margin;
        }
    }
    if (!rises) w->sign = -1, w->here = (sample){-s.F, -s.slope};
}

/* f is 0 up to the next chord, and L > 0. False: there is none. */
static bool walk_leap(walk *w, long double *reach)
{
    if (w->next == w->chords.count) return false;
    const brute_chord *c = &w->chords.chord[w->next];
    w->t = c->entry;
    w->here = (sample){-w->sign * w->oracle->field->iso, 0};
    *reach = (c->exit - c->entry) / 4;
    return true;
}

/* One step; false: the walk is over. */
static bool walk_step(walk *w, long double *reach)
{
    walk_activate(w, *reach);
    if (!w->active_count) return walk_leap(w, reach);
    bounds b = walk_bounds(w, *reach);
    long double h = *reach, least = fmaxl(w->t, 1e-300L) * 0x1p-61L;
    if (b.curvature > 0) {
        if (take_simple_crossing(w, b, *reach)) return false;
        h = w->here.F > b.margin ? fminl(safe_step(w->here, b), *reach) : close_step(w, b, *reach);
    }
    if (h < least) {
        h = least;
        w->result.near = true;
    }
    sample there = walk_sample(w, w->t + h);
    if (there.F < 0 && w->here.F >= 0) { /* within the margin only */
        take_hit(w, w->t, w->t + h);
        return false;
    }
    note_gap(w, there, h, b);
    w->t += h, w->here = there;
    /* A step cut short looks less far ahead next time, but always past a crossing of the margin at any slope
     * that can be proven. */
    *reach = h >= *reach ? 2 * *reach : 2 * h;
    if (b.curvature > 0) *reach = fmaxl(*reach, 8 * sqrtl(b.margin / b.curvature));
    return true;
}

brute_hit brute_first_hit(const brute *oracle, const brute_ray *ray, const brute_limits *limits)
{
    enum { STEPS_MOST = 4000000 };
    walk w = {.oracle = oracle, .ray = ray, .limits = limits, .result = {.gap = 1}};
    if (!brute_tree_collect(oracle->tree, ray, &w.chords)) goto fail;
    w.active = memory_array(w.chords.count, sizeof *w.active);
    if (!w.active) goto fail;
    long double reach = w.chords.count ? (w.chords.chord[0].exit - w.chords.chord[0].entry) / 4 : 1;
    walk_start(&w, reach);
    while (walk_step(&w, &reach))
        if (++w.result.steps > STEPS_MOST) goto fail;
    free(w.chords.chord);
    free(w.active);
    return w.result;
fail: /* no answer: nobody can be measured by this ray */
    free(w.chords.chord);
    free(w.active);
    w.result.near = true;
    return w.result;
}
