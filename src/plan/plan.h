/* What one frame needs, decided before any GL: a feature mask, the passes in order, sizes, and what is left
 * out and why. */
#ifndef MNS_PLAN_PLAN_H
#define MNS_PLAN_PLAN_H

#include "fbvh/fbvh.h"
#include "plan/domain.h"
#include "scene/view.h"

/* One bit a capability; kernel and solver are numbers in the lowest bits. */
#define FEATURE_KERNEL      UINT64_C(0x7)       /* mns_kernel */
#define FEATURE_SOLVER      UINT64_C(0x18)      /* mns_solver << 3 */
#define FEATURE_RADII       (UINT64_C(1) << 5)  /* a radius a ball */
#define FEATURE_STRENGTHS   (UINT64_C(1) << 6)  /* a strength a ball */
#define FEATURE_CORE        (UINT64_C(1) << 7)  /* core depth */
#define FEATURE_CORE_RADII  (UINT64_C(1) << 8)  /* a core radius a ball, not the same part of every R */
#define FEATURE_PAPER       (UINT64_C(1) << 9)  /* gather as the paper has it */
#define FEATURE_POINTS      (UINT64_C(1) << 10) /* small balls drawn as points */
#define FEATURE_QUADS       (UINT64_C(1) << 11) /* some ball may be too large for a point */
#define FEATURE_EYE_IN_BALL (UINT64_C(1) << 12) /* rays may start inside a ball */
#define FEATURE_EYE_INSIDE  (UINT64_C(1) << 13) /* f(eye) >= L: rays look for the exit */
#define FEATURE_FAR         (UINT64_C(1) << 14) /* rays begin on a plane at the field's box */
#define FEATURE_HOST        (UINT64_C(1) << 15) /* a host's depth clips, and its framebuffer is drawn on */
#define FEATURE_SHUFFLE     (UINT64_C(1) << 16) /* lists put in a random order, for tests */
#define FEATURE_COLORS      (UINT64_C(1) << 17) /* colour by a column */
#define FEATURE_LABELS      (UINT64_C(1) << 18) /* of labels (elements), not numbers */
#define FEATURE_CEL         (UINT64_C(1) << 19)
#define FEATURE_DIRECTIONAL (UINT64_C(1) << 20) /* a light of its own, not at the eye */
#define FEATURE_SPECULAR    (UINT64_C(1) << 21)
#define FEATURE_SAMPLES     (UINT64_C(1) << 22) /* more than one sample a pixel */
#define FEATURE_CLIP_ZERO   (UINT64_C(1) << 23) /* clip control: depth without the 2z - 1 */
#define FEATURE_TEXELS      (UINT64_C(1) << 24) /* balls and lists are read as texels */
#define FEATURE_FLAT_CORES                                                                                   \
    (UINT64_C(1) << 25) /* core spheres laid down as flat squares, without a fragment shader */
#define FEATURE_REFERENCE    (UINT64_C(1) << 26) /* traced on the CPU; nothing but colours is left to GL */
#define FEATURE_TILES        (UINT64_C(1) << 27) /* lists a tile of pixels long, binned on the CPU */
#define FEATURE_TREE         (UINT64_C(1) << 28) /* traced through a tree of boxes */
#define FEATURE_OVERLAPS     (UINT64_C(1) << 29) /* whose leaves overlap */
#define FEATURE_COUNTERS     (UINT64_C(1) << 30) /* a ray's work is counted */
#define FEATURE_EYE_ON       (UINT64_C(1) << 31) /* f(eye) = L: rays take the side just after */
#define FEATURE_LIT          (UINT64_C(1) << 32) /* some of those below: colours are made before the shade pass */
#define FEATURE_LIGHTS       (UINT64_C(1) << 33) /* several lights, or one with a colour or a strength */
#define FEATURE_POINT_LIGHTS (UINT64_C(1) << 34) /* some light stands at a point: POINT or AREA */
#define FEATURE_SHADOWS      (UINT64_C(1) << 35)
#define FEATURE_SOFT_SHADOWS (UINT64_C(1) << 36) /* of some light that is a sphere */
#define FEATURE_MIRROR       (UINT64_C(1) << 37) /* some share is mirrored; by rays, where reflections > 0 */
#define FEATURE_FRESNEL      (UINT64_C(1) << 38) /* it hangs on the angle; and what passes through is bent */
#define FEATURE_REFRACTION   (UINT64_C(1) << 39) /* some share passes through */
#define FEATURE_ABSORPTION   (UINT64_C(1) << 40) /* and is dimmed on its way */
#define FEATURE_OCCLUSION    (UINT64_C(1) << 41)
#define FEATURE_ENVIRONMENT  (UINT64_C(1) << 42) /* a map in the place of the background */
#define FEATURE_SKY          (UINT64_C(1) << 43) /* the built-in sky in its place */
#define FEATURE_RAYS         (UINT64_C(1) << 44) /* some rays beyond the first are traced, on the GPU */
#define FEATURE_SQUARES      (UINT64_C(1) << 45) /* only squares of pixels that hold listed tiles are cast */
#define FEATURE_SOLIDS       (UINT64_C(1) << 46) /* meshes stand beside the surface */
#define FEATURE_MATERIALS    (UINT64_C(1) << 47) /* a column blends two materials */
enum { FEATURE_COUNT = 48 };

/* Something of the balls is blended into a plane of the first hits, and into every other hit. */
#define FEATURE_BLENDS (FEATURE_COLORS | FEATURE_MATERIALS)

enum { PLAN_MOST = 16 }; /* passes; parts left out are at most PLAN_PARTS */
enum { PLAN_PARTS = 40 };

/* What the decisions hang on; see plan_facts_of. Lengths are in the field's own unit. */
typedef struct plan_facts {
    double eye_distance; /* from the box of the effective spheres; 0 inside */
    bool eye_in_ball;
    double eye_value;       /* f(eye) */
    double eye_gradient[3]; /* of f at the eye, where eye_value = L; and there, within eye_reach, a bound */
    double eye_bend, eye_reach; /* on f's second derivative along any line */
    double strongest;           /* largest strength; 1 without strengths */
    bool negative;              /* some strength below zero */
    double farthest;            /* from the eye to the farthest corner of the box of the effective spheres */
    double plane_depth;         /* depth along the view before which no effective sphere begins; at least 0 */
    double nearest_point[3];    /* of that box to the eye */
} plan_facts;

struct mns_plan {
    uint64_t features;
    const char *pass[PLAN_MOST];
    size_t pass_count;
    mns_left_out left_out[PLAN_PARTS];
    size_t left_out_count;
    mns_limits limits;
    mns_options options; /* resolved: no zeros where zero means a default */
    mns_view view;       /* in scene units; lengths from here on are in the field's own, */
    double unit;         /* which is so many of them */
    double t_unit;       /* of the planes' distances, in scene units: 1, or unit where floats need it */
    view_frame frame;
    plan_facts facts;
    double origin[3];    /* of the GPU's coordinates */
    double plane_depth;  /* where rays begin, along the view; 0 at the eye */
    double reach;        /* distance from the origin of the farthest ray start */
    double depth_range;  /* largest effective distance beyond the plane */
    double radius_max;   /* the largest ball's */
    double core_ratio;   /* core radius over R of every ball, where CORE without CORE_RADII */
    mns_look look;       /* resolved, lengths in the field's unit; its lights are those of `light` */
    mns_light *light;    /* the plan's own, at least one */
    char *environment;   /* a map's file, where ENVIRONMENT */
    mns_mesh *mesh;      /* the plan's own, look.mesh_count of them; their file names are its own too */
    size_t color_column; /* where COLORS */
    double color_range[2];
    size_t blend_column; /* where MATERIALS; the second material is look.blend, of which nothing is open, */
    char blend_by[64];
    const char *no_blend;  /* or why there is none: a literal */
    size_t ball_floats;    /* a ball in the GPU's buffer */
    size_t pool_nodes;     /* to begin with */
    size_t pool_most;      /* allowed */
    fbvh_options tree;     /* where TREE or RAYS, and then */
    double tree_origin[3]; /* of the tree's coordinates: origin where TREE */
    const char *method_reason;
    char color_by[64];
    domain_report domain; /* what of the input lies outside the stated domain */
    char *text;
};

/* O(N) only where the eye is inside the box of the effective spheres. */
void plan_facts_of(const mns_field *field, const view_frame *frame, plan_facts *facts);

/* mns_plan_create with the knowledge that a host's framebuffer is drawn on. */
mns_status plan_make(const mns_field *field, const mns_view *view, const mns_look *look,
                     const mns_options *options, const mns_limits *limits, bool host, mns_plan **result,
                     mns_error *error);

/* Fills view-independent defaults of a look and checks it against the field's columns. */
mns_status plan_look(const mns_look *look, const mns_field *field, mns_plan *plan, mns_error *error);

/* Checks the lights and effects of a look, fills their defaults, copies what was borrowed, and finds which of
 * them do anything. Errors: USAGE, MEMORY, UNSUPPORTED. */
mns_status plan_effects(mns_plan *plan, const mns_field *field, mns_error *error);
/* Checks the look's second material and fills it in from the first, whose defaults are there; where every
 * ball is of the second that becomes the first, and there is no other. Errors: USAGE. */
mns_status plan_blend(mns_plan *plan, const mns_field *field, mns_error *error);
/* Whether the two differ in anything that is seen. */
bool plan_blend_is_seen(const mns_plan *plan);
/* Where a ball stands between the first material, 0, and the second, 1; it may be beyond them (MATERIALS). */
double plan_blend_place(const mns_plan *plan, const mns_field *field, size_t ball);
/* Finds a column by its name; `purpose` is what it was wanted for. Errors: USAGE. */
mns_status plan_find_column(const mns_field *field, const char *name, const char *purpose, size_t *index,
                            mns_error *error);
/* What of the effects is left out, and why. */
void plan_effects_left_out(mns_plan *plan);
/* Of a frame drawn on the GPU: whether rays beyond the first are traced there, and of a list's frame the tree
 * that carries them. Errors: USAGE. */
mns_status plan_rays(mns_plan *plan, const mns_field *field, mns_error *error);
/* Floats a ball of the tree's: x y z [R] [q], and where those are three, one more. */
size_t plan_tree_floats(const mns_plan *plan);

/* A method, and why it is that one: a literal. */
typedef struct plan_choice {
    mns_method method;
    const char *reason;
} plan_choice;

/* The method that the options name, or that what they ask for needs; AUTO: any would do. */
plan_choice plan_required(const mns_options *options);
/* The method that is quickest by what is known before it is drawn. Never AUTO, never the reference by itself.
 */
plan_choice plan_choose(const mns_options *options, const mns_limits *limits);

/* Checks the options and fills plan->options, of whose zeros none is left, and why the method is that one;
 * needs the limits. Errors: USAGE. */
mns_status plan_options(const mns_options *options, mns_plan *plan, mns_error *error);

/* Appends to what is left out; both strings are literals. */
void plan_leave_out(mns_plan *plan, const char *part, const char *reason);
/* What belongs to any method: samples and looks. */
void plan_look_left_out(mns_plan *plan);

/* Radius and strength a ball; the eye, the origin of coordinates, where rays begin. */
void plan_balls(mns_plan *plan, const mns_field *field);
void plan_eye(mns_plan *plan, const mns_field *field);
/* The plan's lengths from the view's, which are in scene units, to the field's own. */
void plan_enter_unit(mns_plan *plan, const mns_field *field);
/* The unit of the planes' distances; and the reference, where the method is left open and floats cannot hold
 * the lengths. Needs the facts. */
void plan_lengths(mns_plan *plan, const mns_field *field, const mns_options *options, bool host);
/* Whether a frame of this size, with distances such as these in its planes, can be made by any method.
 * Errors: UNSUPPORTED. */
mns_status plan_check_frame(const mns_plan *plan, const mns_field *field, mns_error *error);
/* Whether so many balls, and lengths such as these, can be drawn in floats. Errors: UNSUPPORTED. */
mns_status plan_check_limits(const mns_plan *plan, const mns_field *field, mns_error *error);

/* The place of a tree's coordinates: it stands still, so that the tree does. */
void plan_tree_place(const mns_field *field, double origin[3]);
/* Whether the driver reads such a tree as texels. */
bool plan_tree_texels(const mns_plan *plan, const mns_field *field);
/* How a tree is built for a driver. Errors: USAGE. */
mns_status plan_tree_options(const mns_options *options, const mns_limits *limits, fbvh_options *tree,
                             mns_error *error);
/* Features, passes and what is left out of a frame that is traced through a tree. Errors: USAGE, UNSUPPORTED.
 */
mns_status plan_trees(mns_plan *plan, const mns_field *field, bool host, mns_error *error);

/* Features, passes and what is left out of a frame that the reference traces. Errors: UNSUPPORTED. */
mns_status plan_reference(mns_plan *plan, bool host, mns_error *error);

/* Writes plan->text. False: out of memory. */
bool plan_explain(mns_plan *plan, const mns_field *field);

/* The programs that a plan can need. */
typedef enum plan_shader {
    SHADER_CORE_QUADS = 0,
    SHADER_CORE_POINTS,
    SHADER_GATHER_QUADS,
    SHADER_GATHER_POINTS,
    SHADER_SHUFFLE,
    SHADER_ORDER,
    SHADER_CAST,
    SHADER_WALK,    /* resolve.glsl in float */
    SHADER_RESOLVE, /* and in doubles */
    SHADER_TREE,
    SHADER_TREE_WALK,    /* fbvh_resolve.glsl in float */
    SHADER_TREE_RESOLVE, /* and in doubles */
    SHADER_SOLIDS_FIRST,
    SHADER_EFFECTS_LIST,
    SHADER_EFFECTS_PLAIN,   /* effects.glsl without rays */
    SHADER_EFFECTS_ANY,     /* with those rays alone that bounds can tell of */
    SHADER_EFFECTS,         /* with all rays */
    SHADER_EFFECTS_RESOLVE, /* and in doubles */
    SHADER_SHADE,
    SHADER_HOST_DEPTH,
    SHADER_HOST_DRAW,
    SHADER_COUNT
} plan_shader;

enum { PLAN_DEFINES = 2048 };

/* The files of a program (see gl/program.h; NULL where it has no such stage) and the #define lines of this
 * plan's variant, of only those features that the program reads, so that plans which differ elsewhere share
 * it. */
void plan_shader_files(plan_shader shader, const char **vertex, const char **fragment, const char **compute);
void plan_shader_defines(const mns_plan *plan, plan_shader shader, char defines[PLAN_DEFINES]);
/* Rays that wait at once on light's way beyond a first hit. */
int plan_path_stack(const mns_plan *plan);
/* Whether the plan's frame may run that program. */
bool plan_needs(const mns_plan *plan, plan_shader shader);

enum { LIST_NODE = 16 };       /* bytes of a node of the per-pixel lists; of a tile's, a ball's record */
enum { TILE_SHIFT_LEAST = 2 }; /* no tile is fewer than 1 << 2 pixels wide */
enum { RESOLVE_GROUP = 8 };    /* invocations a group of the resolve pass */

enum { SQUARE_SHIFT_MOST = 6, SQUARE_MOST = 1 << SQUARE_SHIFT_MOST }; /* side of a square to be cast */

/* The sides of the largest squares that hold `pixels`, together. */
static inline int plan_square_round(int pixels)
{
    return (pixels + SQUARE_MOST - 1) & ~(SQUARE_MOST - 1);
}

#endif
