/* Solid meshes beside the surface: their triangles, a tree of boxes over them, and a ray's first hit. */
#ifndef MNS_SOLID_SOLID_H
#define MNS_SOLID_SOLID_H

#include "base/vec.h"
#include "meniscus.h"
#include "solid/watch.h"

/* Triangles of all meshes together: what indices of 32 bits and a tree's depth hold with room to spare. */
enum { SOLID_MOST = 1 << 24, SOLID_DEPTH = 64 };
#define SOLID_ALONE UINT32_MAX /* beyond an edge there is no triangle, or more than one */

typedef struct solid_triangle {
    uint32_t corner[3];
    uint32_t beside[3]; /* the corner beyond edge k, which runs from corner k to the next; or SOLID_ALONE */
    uint32_t mesh;
} solid_triangle;

/* Inner: `first` and the one after are its children. Leaf: `count` triangles from `first` on. */
typedef struct solid_node {
    double lo[3], hi[3];
    uint32_t first, count;
} solid_node;

typedef struct solid_set {
    double (*corner)[3];
    solid_triangle *triangle;
    solid_node *node; /* the root first; none where there are no triangles */
    size_t corner_count, triangle_count, node_count;
    size_t dropped; /* faces without an area */
    double lo[3], hi[3];
} solid_set;

/* ---- Making one ---- */

/* Triangles as they come, three corners each, not joined yet. Zeroed is empty. */
typedef struct solid_soup {
    double (*corner)[3];
    uint32_t *mesh; /* a triangle */
    size_t count, capacity;
    size_t dropped;
} solid_soup;

/* Adds a triangle; one without an area is dropped and counted. Errors: MEMORY, UNSUPPORTED (too many). */
mns_status solid_soup_add(solid_soup *soup, vec3 corner[3], uint32_t mesh, const char *file,
                          mns_error *error);
void solid_soup_free(solid_soup *soup);

/* Adds a file's triangles, in scene units, and notes the files that were opened for it. Errors: IO, INPUT,
 * MEMORY, UNSUPPORTED (also: this build reads no meshes). */
mns_status solid_read(const char *file, uint32_t mesh, solid_soup *soup, watch *opened, mns_error *error);

/* Joins corners, finds each edge's neighbour, and builds the tree, all divided by `unit`. Errors: MEMORY. */
mns_status solid_set_make(const solid_soup *soup, double unit, solid_set *set, mns_error *error);
void solid_set_free(solid_set *set);
/* solid_tree.c: puts the triangles in the tree's order. False: out of memory. */
bool solid_tree_build(solid_set *set);

/* ---- A ray ---- */

typedef struct solid_ray {
    vec3 origin, way; /* way: a unit */
    double reach;     /* what lies beyond is not looked at; or INFINITY */
    vec3 leaves; /* normal of the triangle that the ray leaves, or 0,0,0: it is not met again, nor what lies
                    in one plane with it */
} solid_ray;

typedef struct solid_hit {
    bool hit, certain;
    double t, t_error; /* INFINITY and 0 on a miss */
    double doubt;      /* before this distance nothing is in doubt */
    vec3 normal;       /* unit, turned against the ray */
    uint32_t mesh;
} solid_hit;

solid_hit solid_trace(const solid_set *set, const solid_ray *ray);

#endif
