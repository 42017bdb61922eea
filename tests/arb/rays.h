/* Small fields and a ray each, at random and by malice. */
#ifndef MNS_TESTS_ARB_RAYS_H
#define MNS_TESTS_ARB_RAYS_H

#include "truth.h"

typedef enum rays_kind {
    RAYS_SCATTERED = 0, /* few balls overlap */
    RAYS_DENSE,         /* some thirty do */
    RAYS_MIXED,         /* radii over two decades */
    RAYS_SIGNED,        /* strengths of both signs over 1e-3 to 1e3 */
    RAYS_SILHOUETTE,    /* tangent to the level f = L (1 +- something), 1e-3 to 1e-15 of a radius beside it */
    RAYS_SILHOUETTE_FAR, /* the same from up to 1e5 radii away */
    RAYS_NECK,           /* through the saddle between two balls whose neck is near parting */
    RAYS_CHORD_ENDS,     /* many chords end or begin in one point */
    RAYS_COINCIDENT,     /* balls share their centres, and cancel in part */
    RAYS_INSIDE,         /* from within a ball, often from its centre */
    RAYS_ON_SURFACE,     /* from the surface, to rounding or exactly */
    RAYS_FAR,            /* from 1e5 radii away */
    RAYS_OFFSET,         /* all of it 1e9 radii from the origin */
    RAYS_PEAK,           /* L is 1e-1 to 1e-15 below or above what a heap of balls comes to at its middle */
    RAYS_EXTREME,        /* radii over six decades, strengths over twelve, lengths times 1e-23 to 1e26 */
    RAYS_KINDS
} rays_kind;

enum { RAYS_BALLS = 60 };

typedef struct rays_case {
    truth_scene scene; /* its arrays are those below: not to be copied */
    double axis[3][RAYS_BALLS], radius[RAYS_BALLS], strength[RAYS_BALLS];
    truth_ray ray;
} rays_case;

const char *rays_name(rays_kind kind);
/* The same for the same arguments. */
void rays_make(rays_kind kind, mns_kernel kernel, uint64_t seed, rays_case *c);

#endif
