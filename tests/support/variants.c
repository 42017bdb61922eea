#include "support/variants.h"

#include <string.h>

/* What a frame that is traced through a tree has no use for. */
#define NEVER_OF_TREES                                                                                       \
    (FEATURE_CORE | FEATURE_CORE_RADII | FEATURE_PAPER | FEATURE_POINTS | FEATURE_QUADS | FEATURE_SHUFFLE |  \
     FEATURE_CLIP_ZERO | FEATURE_FLAT_CORES | FEATURE_TILES)

/* And one whose lists are binned into tiles. */
#define NEVER_OF_TILES                                                                                       \
    (FEATURE_PAPER | FEATURE_POINTS | FEATURE_QUADS | FEATURE_SHUFFLE | FEATURE_CLIP_ZERO |                  \
     FEATURE_FLAT_CORES)

/* What makes a frame LIT; and what only goes with some of it. */
#define LIGHT_WAYS                                                                                           \
    (FEATURE_LIGHTS | FEATURE_POINT_LIGHTS | FEATURE_SHADOWS | FEATURE_MIRROR | FEATURE_REFRACTION |         \
     FEATURE_OCCLUSION | FEATURE_ENVIRONMENT | FEATURE_SKY | FEATURE_SOLIDS)
#define EFFECTS (LIGHT_WAYS | FEATURE_LIT | FEATURE_SOFT_SHADOWS | FEATURE_FRESNEL | FEATURE_ABSORPTION)

/* `a` only with all of `b`. */
static bool implies(uint64_t features, uint64_t a, uint64_t b)
{
    return !(features & a) || (features & b) == b;
}

static bool effects_possible(uint64_t f)
{
    return !(f & FEATURE_LIT) == !(f & LIGHT_WAYS) &&
           implies(f, FEATURE_SOFT_SHADOWS, FEATURE_SHADOWS | FEATURE_POINT_LIGHTS) &&
           implies(f, FEATURE_FRESNEL, FEATURE_MIRROR) &&
           implies(f, FEATURE_ABSORPTION, FEATURE_REFRACTION) &&
           (!(f & FEATURE_SHADOWS) || f & (FEATURE_DIRECTIONAL | FEATURE_POINT_LIGHTS)) &&
           !(f & FEATURE_ENVIRONMENT && f & FEATURE_SKY);
}

/* Rays beyond the first: of these, and of mirrors where they have levels. */
#define ALWAYS_RAYS (FEATURE_SHADOWS | FEATURE_OCCLUSION | FEATURE_REFRACTION)

static bool rays_possible(uint64_t f)
{
    return f & FEATURE_RAYS ? f & (ALWAYS_RAYS | FEATURE_MIRROR) : !(f & ALWAYS_RAYS);
}

bool variant_possible(uint64_t f)
{
    unsigned kernel = f & FEATURE_KERNEL, solver = (f & FEATURE_SOLVER) >> 3;
    if (f & FEATURE_REFERENCE) { /* its looks, and nothing of the list */
        uint64_t looks = FEATURE_COLORS | FEATURE_LABELS | FEATURE_MATERIALS | FEATURE_CEL |
                         FEATURE_DIRECTIONAL | FEATURE_SPECULAR | FEATURE_SAMPLES;
        return kernel >= MNS_KERNEL_POLY2 && kernel <= MNS_KERNEL_WENDLAND &&
               !(f & ~(looks | EFFECTS | FEATURE_KERNEL | FEATURE_REFERENCE)) && effects_possible(f) &&
               implies(f, FEATURE_LABELS, FEATURE_COLORS);
    }
    if (!effects_possible(f) || !rays_possible(f)) return false;
    bool each_core = f & FEATURE_CORE && f & FEATURE_STRENGTHS;
    bool tree = f & FEATURE_TREE;
    if (tree && (f & NEVER_OF_TREES || (solver != MNS_SOLVER_EXACT && solver != MNS_SOLVER_SECANT)))
        return false;
    if (!tree && (solver == MNS_SOLVER_SECANT || f & (FEATURE_OVERLAPS | FEATURE_COUNTERS))) return false;
    if (f & FEATURE_TILES && f & NEVER_OF_TILES) return false;
    return kernel >= MNS_KERNEL_POLY2 && kernel <= MNS_KERNEL_WENDLAND &&
           (tree || f & (FEATURE_POINTS | FEATURE_QUADS | FEATURE_TILES)) &&
           implies(f, FEATURE_LABELS, FEATURE_COLORS) &&
           implies(f, FEATURE_EYE_INSIDE, FEATURE_EYE_IN_BALL) &&
           !(f & FEATURE_EYE_INSIDE && f & FEATURE_CORE) && !(f & FEATURE_FAR && f & FEATURE_EYE_IN_BALL) &&
           each_core == !!(f & FEATURE_CORE_RADII);
}

static void defines_of(plan_shader shader, uint64_t features, char defines[PLAN_DEFINES])
{
    mns_plan plan = {.features = features};
    plan_shader_defines(&plan, shader, defines);
}

uint64_t variant_reads(plan_shader shader)
{
    char with[PLAN_DEFINES], without[PLAN_DEFINES];
    const uint64_t all = ~UINT64_C(0) >> (64 - FEATURE_COUNT);
    uint64_t reads = 0;
    /* A feature may matter only beside another, or only without it. */
    for (int bit = 0; bit < FEATURE_COUNT; bit++)
        for (int other = 0; other <= 2 * FEATURE_COUNT; other++) {
            uint64_t one = (uint64_t)1 << bit,
                     base = other == 2 * FEATURE_COUNT ? 0 : (uint64_t)1 << other / 2;
            if (other & 1) base = all & ~base;
            defines_of(shader, base | one, with);
            defines_of(shader, base & ~one, without);
            if (strcmp(with, without) != 0) reads |= one;
        }
    return reads;
}

/* Features that the shader does not read, as those that it reads ask for them. */
static uint64_t fill_in(plan_shader shader, uint64_t reads, uint64_t f)
{
    bool quads = shader == SHADER_CORE_QUADS || shader == SHADER_GATHER_QUADS;
    bool tree = shader == SHADER_TREE || shader == SHADER_TREE_WALK || shader == SHADER_TREE_RESOLVE;
    bool effects = shader >= SHADER_EFFECTS_LIST && shader <= SHADER_EFFECTS_RESOLVE;
    uint64_t more = effects             ? FEATURE_TREE | FEATURE_LIT | FEATURE_LIGHTS | FEATURE_DIRECTIONAL
                    : f & FEATURE_TILES ? 0
                    : f & FEATURE_LIT   ? FEATURE_REFERENCE | FEATURE_SKY
                    : tree              ? FEATURE_TREE
                    : quads             ? FEATURE_QUADS
                                        : FEATURE_POINTS | FEATURE_QUADS;
    if (!(reads & FEATURE_KERNEL)) more |= MNS_KERNEL_POLY3;
    if (f & FEATURE_EYE_INSIDE) more |= FEATURE_EYE_IN_BALL;
    if (f & FEATURE_LABELS) more |= FEATURE_COLORS;
    if (f & FEATURE_SOFT_SHADOWS) more |= FEATURE_POINT_LIGHTS;
    if (f & ALWAYS_RAYS) more |= FEATURE_RAYS;
    if (f & FEATURE_CORE_RADII) more |= FEATURE_CORE | FEATURE_STRENGTHS;
    if (shader == SHADER_CORE_QUADS || shader == SHADER_CORE_POINTS) more |= FEATURE_CORE;
    return f | (more & ~reads);
}

bool variant_of(plan_shader shader, uint64_t reads, uint64_t subset, uint64_t *features)
{
    *features = fill_in(shader, reads, subset);
    return variant_possible(*features);
}
