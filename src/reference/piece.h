/* The field along a piece of a ray, as a polynomial with a bound on what it leaves out. */
#ifndef MNS_REFERENCE_PIECE_H
#define MNS_REFERENCE_PIECE_H

#include "reference/chord.h"

enum { PIECE_DEGREE = 8 };

/* Bounds on f over a piece by the sum of every ball's own range: cheap, and right for any kernel. */
typedef struct piece_range {
    double lo, hi;  /* of f */
    double loose;   /* how much of hi - lo a polynomial cannot take away */
    double at_most; /* sum of |q| k at its largest */
} piece_range;

/* f - L on [from, to] in Bernstein form: each coefficient is right to `rounding`; the polynomial itself is
 * off by at most `model`, and its derivative's coefficients degree (c[j+1] - c[j]) / (to - from) by at most
 * degree * slope_model / (to - from), both of which vanish as the piece shrinks. */
typedef struct piece {
    double from, to;
    int degree;
    double c[PIECE_DEGREE + 1];
    double rounding, model, slope_model;
} piece;

/* f - L at one point of the ray and its slope; |value - true| <= error. */
typedef struct piece_point {
    double value, slope, error;
} piece_point;

typedef struct piece_balls {
    const reference_chord *chord;
    const size_t *item; /* those that may matter, in increasing order */
    size_t count;
    mns_kernel kernel;
    double iso;
} piece_balls;

void piece_range_of(const piece_balls *balls, double from, double to, piece_range *range);
void piece_make(const piece_balls *balls, double from, double to, piece *p);
void piece_point_at(const piece_balls *balls, double s, piece_point *at);

#endif
