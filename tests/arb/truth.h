/* The truth about a ray, in ball arithmetic: what the certified tracer is held against.
 *
 * Every number of a scene and of a ray is taken as exactly the double that it is. Values come as enclosures
 * of 256 bits (1024 where those do not tell), so what is said here is a proof up to errors of the ball
 * library. Nothing is shared with the library: the kernels are written again from the design's table.
 */
#ifndef MNS_TESTS_ARB_TRUTH_H
#define MNS_TESTS_ARB_TRUTH_H

#include "meniscus.h"

/* A field by plain arrays, `count` elements each. */
typedef struct truth_scene {
    size_t count;
    const double *axis[3], *radius, *strength;
    mns_kernel kernel; /* not DEFAULT */
    double iso;
} truth_scene;

typedef struct truth_ray {
    double origin[3], direction[3]; /* direction: any length but zero; t is Euclidean all the same */
} truth_ray;

typedef enum truth_kind {
    TRUTH_MISS,
    TRUTH_HIT,
    TRUTH_TOUCH, /* some extremum of f before the hit is within about 2^-200 of L: no sign could be told */
    TRUTH_UNTOLD /* no memory, or too many intervals */
} truth_kind;

typedef struct truth_answer {
    truth_kind kind;
    double t, t_rest; /* where HIT: t + t_rest is t* to 2^-90 of the hit's surroundings */
    size_t intervals; /* looked at */
} truth_answer;

/* The first t > 0 at which f - L changes its sign. Thread safe; a thread that is done calls truth_thread_end.
 */
truth_answer truth_trace(const truth_scene *scene, const truth_ray *ray);

/* At least |t - t*| of a hit. */
double truth_distance(const truth_answer *hit, double t);

/* How near the ray comes to being undecided, in the design's sense: the least of
 *
 *   |f(e) - L| / (sum of |q| k(e) + sum of |q| |k'(e)| |p - o| / R)
 *
 * over the extrema e of f along the ray up to the hit (on a miss: everywhere; past a hit: the one that the
 * ray is on its way to, if f stays close to L until there) and over the ray's start, whose sign rounding
 * could decide too. o is the ray's origin or the point of the field's box nearest to it, whichever says
 * nearer. 1 where nothing is nearer than 2^-25. */
double truth_gap(const truth_scene *scene, const truth_ray *ray, const truth_answer *answer);

/* f and, where asked for, its gradient, rounded from 256 bits. */
double truth_value(const truth_scene *scene, const double point[3], double gradient[3]);

/* Frees what the ball library keeps for this thread. */
void truth_thread_end(void);

#endif
