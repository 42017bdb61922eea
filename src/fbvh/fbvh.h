/* The tree over the balls, built on the CPU for the GPU to walk.
 *
 * Based on: Gourmel, Pajot, Paulin, Barthe, Poulin, "Fitted BVH for Fast Raytracing of Metaballs", 2010. One
 * builder makes both of its trees:
 *
 *  - FBVH_FITTED (Algorithm 2): the box of a node is cut at a plane, each half is fitted to the balls that
 *    reach into it. Siblings share at most a face, so the first hit in order of traversal is the hit.
 *    A leaf refers to every ball whose effective sphere meets its box, less those proven not to matter.
 *    In the box of a leaf, {f >= L} and f there are what all balls give; {f >= L} lies in the leaves.
 *  - FBVH_OVERLAPPING (Algorithm 1, the modified BVH): balls are shared out by their centres, a leaf's box
 *    holds the spheres of its own balls, and leaves overlap. A leaf refers to its own balls and to the split
 *    balls, whose spheres overlap one of its own (FBVH_SPLIT marks them). In the box, *where one of its own
 *    balls' effective spheres covers the point*, {f >= L} and f there are what all balls give; elsewhere in
 *    the box a leaf knows nothing. Every point of {f >= L} is so known to at least one leaf, so the first hit
 *    is the nearest of the leaves' hits, sign changes being looked for only where an own ball covers the ray.
 *
 * Tighter boxes (section 5.3.1, mended): where f(x) >= L, some positive ball has k_i(x) >= L / S+, S+ being
 * the sum of the positive strengths that reach x; so the spheres of radius R_i k^-1(L / S+) hold the surface.
 * Negative balls get no box and are nobody's own.
 *
 * Threads: a builder serves one thread at a time, which need not be the one that draws. Nothing is global.
 */
#ifndef MNS_FBVH_FBVH_H
#define MNS_FBVH_FBVH_H

#include "field/field.h"

/* The root is at depth 0 and no node is deeper: a walk defers at most this many nodes. */
enum { FBVH_DEPTH_MOST = 48 };

/* Of a reference: the ball is a split ball of this leaf (only in FBVH_OVERLAPPING). */
#define FBVH_SPLIT 0x80000000u

typedef enum fbvh_kind { FBVH_FITTED = 0, FBVH_OVERLAPPING } fbvh_kind;
/* What a leaf of n balls is taken to cost (section 5.1.1). */
typedef enum fbvh_cost { FBVH_COST_SQUARE = 0, FBVH_COST_LINEAR } fbvh_cost;

/* Bound on references, a ball: the heuristic ends well before it but in the densest parts of a field. */
#define FBVH_REFERENCES 32

/* Zeros are the defaults. fbvh_options_parse names each. */
typedef struct fbvh_options {
    fbvh_kind kind;
    fbvh_cost cost;
    bool no_fit;              /* a child's box is its half of the parent's; FBVH_FITTED only */
    bool no_tight;            /* boxes of whole effective spheres (Table 5, "tighter bbox" off) */
    bool no_discard;          /* keep balls that cannot contribute (Table 5, "discarding" off) */
    bool no_deep;             /* split where the whole box seems to be deep inside, too */
    unsigned discard_most;    /* no discarding in leaves of more balls; 0: 12 */
    unsigned leaf_least;      /* a node of so few balls is not split; 0: 4 */
    double traversal_cost;    /* of one inner node, in units of the leaf's cost; 0: 60 of fewer than 32,768
                                 balls, else 200; 6 of linear cost */
    int middle_levels;        /* so many first levels are cut in the middle of the longest axis; 0: chosen by
                                 the density of the field; -1: none */
    double references_a_ball; /* bound on all references, over the count of balls; 0: FBVH_REFERENCES */
    size_t max_block_bytes;   /* of any one of the packed arrays; 0: 128 MiB */
} fbvh_options;

/* A node as the GPU reads it: two vec4. Node 0 is the root, node 1 is unused, the two children of an inner
 * node stand side by side at an even index: 64 bytes on a 64-byte boundary. Boxes are relative to the
 * tree's origin and rounded outwards by all that floats do to positions and radii; none is empty. */
typedef struct fbvh_node {
    float lo[3];
    uint32_t first; /* inner: the first child, the second follows; leaf: its first reference */
    float hi[3];
    uint32_t count; /* references of a leaf; 0: an inner node */
} fbvh_node;

/* A ball as the GPU reads it. */
typedef struct fbvh_ball {
    float position[3]; /* nearest float of p - origin */
    float radius;      /* nearest float of R */
} fbvh_ball;

typedef struct fbvh_figures {
    size_t leaves, depth, leaf_largest;
    double leaf_mean; /* references a leaf */
    size_t own;       /* FBVH_OVERLAPPING: references that are not split; each ball has at most one */
    size_t discarded; /* references that section 5.3.2 took out */
    size_t reference_bound;
    size_t leaves_deep;    /* leaves not split further since the surface seems not to come there */
    size_t leaves_bounded; /* leaves that the bounds kept from being split further */
    bool made_smaller;     /* max_block_bytes lowered the bounds */
    size_t memory_bytes;   /* of nodes, references, balls and strengths: what the GPU gets */
    size_t scratch_bytes;  /* what the builder holds besides */
    double build_ms, sort_ms;
} fbvh_figures;

/* Owned by its builder. */
typedef struct fbvh_tree {
    fbvh_kind kind;
    double origin[3]; /* the centre of the box of the field's centres */
    const fbvh_node *node;
    size_t node_count;         /* 0: f < L everywhere, nothing to walk; else odd or even >= 1, with node 1 */
    const uint32_t *reference; /* indices into `ball`, own ones first, FBVH_SPLIT set on split ones */
    size_t reference_count;
    const fbvh_ball *ball; /* neighbours in space are near in this order */
    const float *strength; /* of `ball`; NULL: all are 1 */
    const uint32_t *index; /* of `ball` in the field */
    size_t ball_count;     /* balls of strength 0 are left out */
    fbvh_figures figures;
} fbvh_tree;

typedef struct fbvh_builder fbvh_builder;

/* Holds every array that building needs, and reuses them from build to build. Errors: MEMORY. */
mns_status fbvh_builder_create(fbvh_builder **builder, mns_error *error);
void fbvh_builder_destroy(fbvh_builder *builder);

/* Further builds leave `tree`, one of this builder's, as it is, until another is kept or NULL. */
void fbvh_builder_keep(fbvh_builder *builder, const fbvh_tree *tree);

/* Builds the tree of `field`, which is only read, and only during the call. The tree is valid until the next
 * build but one of this builder, so that one can be drawn while the next is built; where one is kept, until
 * the next. options NULL: defaults. The same bits for any number of threads. Errors: USAGE (options), MEMORY,
 * UNSUPPORTED (max_block_bytes cannot hold even the balls); after an error the tree of the build before, or
 * the one that is kept, is still valid. */
mns_status fbvh_build(fbvh_builder *builder, const mns_field *field, const fbvh_options *options,
                      const fbvh_tree **tree, mns_error *error);

/* Sets options by name, comma separated: bvh | fbvh, cost-n | cost-n2, no-fit, no-tight, no-discard, no-deep,
 * and with numbers discard-most=N, leaf-least=N, traversal-cost=X, middle-levels=N, references=X (a ball),
 * block-bytes=N. NULL or "" changes nothing. Errors: USAGE. */
mns_status fbvh_options_parse(const char *text, fbvh_options *options, mns_error *error);

#endif
