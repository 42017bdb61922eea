/* What the stages of a build share: the balls, a node that is still to be split, and where results go.
 *
 * All of it is in floats relative to the tree's origin. A ball's float position and radius are off by some
 * roundings; `slack` and WORK_GROW, put on every radius, are more than those and than the roundings of every
 * test made here, so that what the true ball touches is never left out.
 */
#ifndef MNS_FBVH_WORK_H
#define MNS_FBVH_WORK_H

#include "fbvh/fbvh.h"

enum { WORK_SPANS_AN_OCTAVE = 32, WORK_OCTAVES = 24, WORK_SPANS = WORK_SPANS_AN_OCTAVE * WORK_OCTAVES };
#define WORK_GROW (1 + 0x1p-20f)

/* Loops over a block are compiled for wider vectors too, and the processor picks: same operations, same bits.
 * (Sanitizers cannot watch the picking.) */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&     \
    !defined(__SANITIZE_THREAD__)
#define WORK_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define WORK_WIDE
#endif

/* Least and greatest of many, in any order. (Clang warns that it cannot, and loses some time.) */
#if defined(__clang__)
#define WORK_SIMD(clauses)
#else
#define WORK_SIMD(clauses) WORK_PRAGMA(omp simd clauses)
#define WORK_PRAGMA(text)  _Pragma(#text)
#endif

/* Balls side by side, for loops to take several at a time. Up to a multiple of WORK_LANES follow some of
 * strength 0, too far off to reach anything. */
enum { WORK_BLOCK = 1024, WORK_LANES = 8 };
typedef struct work_block {
    size_t count;
    float at[3][WORK_BLOCK], radius[WORK_BLOCK], strength[WORK_BLOCK];
} work_block;

typedef struct work_set {
    fbvh_options options; /* resolved */
    const fbvh_ball *ball;
    const float *strength; /* NULL: all are 1 */
    size_t count;
    float slack;
    size_t own; /* balls of positive strength; in an overlapping tree they come first in the root's list */
    double sum; /* S+ of all */
    double iso;
    int middle_levels;
    float span[WORK_SPANS]; /* of work_span */
} work_set;

/* A node while it is built. Its references are list[first, first + count); in an overlapping tree the first
 * `own` are its own, in a fitted one own == count. */
typedef struct work_node {
    float lo[3], hi[3];
    size_t first, count, own;
    double references, leaves; /* the most that its leaves may have, all together */
    float span;                /* tight radius over R, for S+ of this node */
    int level;
} work_node;

typedef struct work_cut {
    int axis;
    float plane;
} work_cut;

static inline float work_reach(const work_set *set, const fbvh_ball *ball)
{
    return ball->radius * WORK_GROW + set->slack;
}

/* The radius within which `ball` can be the one that brings f to L (section 5.3.1, as mended). */
static inline float work_tight(const work_set *set, const fbvh_ball *ball, float span)
{
    return ball->radius * span + set->slack;
}

static inline float work_strength(const work_set *set, uint32_t ball)
{
    return set->strength ? set->strength[ball] : 1.0f;
}

static inline float work_least(float a, float b)
{
    return a < b ? a : b;
}

static inline float work_most(float a, float b)
{
    return a > b ? a : b;
}

/* Squared distance from p to the box. */
static inline float work_distance(const float lo[3], const float hi[3], const float p[3])
{
    float x = work_most(work_most(lo[0] - p[0], p[0] - hi[0]), 0);
    float y = work_most(work_most(lo[1] - p[1], p[1] - hi[1]), 0);
    float z = work_most(work_most(lo[2] - p[2], p[2] - hi[2]), 0);
    return x * x + y * y + z * z;
}

/* At least k^-1(L / sum), grown; negative where the sum of the positive strengths is below L. */
float work_span(const work_set *set, double sum);
void work_span_fill(work_set *set, mns_kernel kernel);

static inline int work_lanes(const work_block *block)
{
    return (int)((block->count + WORK_LANES - 1) & ~(size_t)(WORK_LANES - 1));
}

/* Fills the block with every `step`th ball of a list. */
void work_gather(const work_set *set, const uint32_t *list, size_t count, size_t step, work_block *block);

/* What work_choose sees of a node: a block of its balls, every `step`th. Small nodes lie in it whole (step
 * 1), and the later stages find them there. */
size_t work_look(const work_set *set, const work_node *node, const uint32_t *list, work_block *block);

/* What is found of balls that reach into a box: S+, and the box of the tight spheres that meet it. */
typedef struct work_side {
    size_t count; /* the caller's */
    double sum;
    float lo[3], hi[3];
} work_side;

work_side work_side_none(void);

/* Which of a block's balls reach into the box lo, hi (taken: WORK_BLOCK of 0 or 1), and what they add to
 * *side. */
void work_take(const work_set *set, const work_block *block, const float lo[3], const float hi[3], float span,
               unsigned char *taken, work_side *side);

/* Where to cut (section 5.1.1). False: better, or only possible, a leaf; *bounded then says whether only the
 * bounds forbid a cut. */
bool work_choose(const work_set *set, const work_node *node, const work_block *block, size_t step,
                 work_cut *cut, bool *bounded);

/* Whether the whole box seems to be deep inside the surface: f at its middle and corners is far above L. */
bool work_deep(const work_set *set, const work_node *node, const work_block *block);

/* Shares the node's references out; each child's go to its own array of node->count, its `first` is left to
 * the caller. A child that can hold no surface has count 0. The block holds the node, if all of it fits. */
void work_part(const work_set *set, const work_node *node, const uint32_t *list, const work_cut *cut,
               work_block *block, uint32_t *list_of[2], work_node child[2]);

/* Sets levels and bounds of two children; false where together they break the node's bounds. */
bool work_share(const work_node *node, work_node child[2]);

/* The block holds the node, if all of it fits. Fits a leaf's box, drops what does not reach it or cannot
 * contribute (section 5.3.2), and marks split balls. `list` is rewritten in place; returns the references
 * left, 0: no surface in it. */
size_t work_leaf(const work_set *set, work_node *node, uint32_t *list, work_block *block, size_t *discarded);

/* What one thread makes: subtrees, one after another. Children stand before their parents. */
typedef struct work_bench {
    work_block block;
    uint32_t *list; /* references of the nodes still open, as a stack */
    size_t list_capacity;
    fbvh_node *node;
    size_t node_count, node_capacity;
    uint32_t *reference;
    size_t reference_count, reference_capacity;
} work_bench;

typedef struct work_tally {
    size_t leaves, depth, leaf_largest, discarded, bounded, own, deep;
} work_tally;

typedef struct work_job {
    work_node node;
    fbvh_node result;
    bool found;
    const work_bench *bench; /* where it was built: nodes and references from here, so many */
    size_t node_first, node_count, reference_first, reference_count;
    work_tally tally;
} work_job;

/* A node of the first levels, which are built breadth first for all threads to have work. */
typedef struct work_top {
    work_node node;
    int child[2]; /* -1: none */
    int job;      /* -1: it was cut */
} work_top;

typedef struct work_crown {
    uint32_t *list[2]; /* references of the level at hand, and of the next */
    size_t list_capacity[2];
    work_top *top;
    size_t top_count, top_capacity;
    work_job *job;
    size_t job_count, job_capacity;
} work_crown;

/* Cuts the root until there is a job for each thread and more. The jobs' references are in *list. False: out
 * of memory. */
bool work_crown_grow(const work_set *set, const work_node *root, work_crown *crown, const uint32_t **list);

/* Builds the subtree of `node`, whose references are `list`, into the bench; false: out of memory. *result is
 * its root (indices counted from the bench's starts), *found whether there is any surface in it. */
bool work_subtree(const work_set *set, const work_node *node, const uint32_t *list, work_bench *bench,
                  fbvh_node *result, bool *found, work_tally *tally);

/* Of subtrees side by side; depth is left alone. */
static inline void work_tally_add(work_tally *sum, const work_tally *one)
{
    sum->leaves += one->leaves;
    sum->discarded += one->discarded;
    sum->bounded += one->bounded;
    sum->own += one->own;
    sum->deep += one->deep;
    if (one->leaf_largest > sum->leaf_largest) sum->leaf_largest = one->leaf_largest;
}

/* The packed node of `whole` over its children `pair`, which stand at `first`. */
static inline fbvh_node work_join(const work_set *set, const work_node *whole, const fbvh_node pair[2],
                                  size_t first)
{
    bool cut_only = set->options.no_fit && set->options.kind == FBVH_FITTED;
    fbvh_node node = {.first = (uint32_t)first, .count = 0};
    for (int a = 0; a < 3; a++) {
        node.lo[a] = cut_only ? whole->lo[a] : work_least(pair[0].lo[a], pair[1].lo[a]);
        node.hi[a] = cut_only ? whole->hi[a] : work_most(pair[0].hi[a], pair[1].hi[a]);
    }
    return node;
}

/* Enlarges *block of `size`-byte elements to at least `count`; false: out of memory, and it is as it was. */
bool work_reserve(void *block, size_t *capacity, size_t count, size_t size);

#endif
