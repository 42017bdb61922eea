/* A field along one ray: enclosures of f - L, of its derivative and of the rounding scale over an interval.
 *
 * The ray is x(s) = origin + s direction with both taken exactly, so that t = s |direction|. A ball has
 * u(s) = |x - p|^2 / R^2 = bend (s - middle)^2 + least. Kernels fall with u and end at u = 1 with slope 0: f
 * has a continuous derivative everywhere, and the ends of chords need no care of their own.
 */
#ifndef MNS_TESTS_ARB_LINE_H
#define MNS_TESTS_ARB_LINE_H

#include "truth.h"

#include <arb.h>

typedef struct line_ball {
    arb_t middle, least, bend;
    arf_t first, last;   /* the chord lies between them */
    double strength;     /* q */
    double radius;       /* R, over |direction|: a length in s, roughly */
    double far, far_box; /* |p - o| / R for both choices of o, roughly */
} line_ball;

typedef struct line {
    const truth_scene *scene;
    line_ball *ball; /* those that the ray meets at s >= 0 */
    size_t count;
    arb_t length; /* |direction| */
    slong bits;   /* working precision */
} line;

/* Over an interval of s. */
typedef struct line_bounds {
    arb_t value; /* f - L */
    arb_t slope; /* df/ds */
    arb_t scale; /* sum of |q| k + sum of |q| |k'| |p - o| / R; only where asked for */
} line_bounds;

bool line_begin(line *l, const truth_scene *scene, const truth_ray *ray, slong bits); /* false: no memory */
void line_end(line *l);

void line_bounds_init(line_bounds *b);
void line_bounds_clear(line_bounds *b);

/* Encloses f - L and df/ds over the ball `s` from the `count` balls of `active`, the only ones near. */
void line_enclose(const line *l, const size_t *active, size_t count, const arb_t s, bool with_scale,
                  line_bounds *b);
/* The same over [lo, hi], f - L also by the mean value form. */
void line_enclose_between(const line *l, const size_t *active, size_t count, const arf_t lo, const arf_t hi,
                          bool with_scale, line_bounds *b);
/* The balls of `from` that may reach into [lo, hi], written to `to`; how many. */
size_t line_active(const line *l, const size_t *from, size_t count, const arf_t lo, const arf_t hi,
                   size_t *to);

/* Points that cut the ray from s = 0 to the last chord's end into intervals: *count of them, rising, the
 * first 0. NULL: no memory. To be given back to line_cuts_free. */
arf_struct *line_cuts(const line *l, size_t *count);
void line_cuts_free(arf_struct *cut, size_t count);

/* A point between lo and hi, off the middle so that no round number of a scene is met by it. */
void line_split(const line *l, const arf_t lo, const arf_t hi, arf_t split);
/* hi - lo over the least radius of the active balls. */
double line_relative_width(const line *l, const size_t *active, size_t count, const arf_t lo, const arf_t hi);
/* -1 or 1 where the enclosure tells, otherwise 0. */
int line_sign(const arb_t x);

#endif
