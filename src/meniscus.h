/* Meniscus: the exact surface of a particle field, drawn straight from the particles.
 *
 * The field is f(x) = sum of q_i k(|x - p_i| / R_i); the surface is f = L ("iso level"), inside is f > L.
 * A descriptor filled with zeros means the defaults. Every object has one create (or open, load, read) and
 * one null-safe destroy. Lengths are in scene units, angles in degrees; colours are sRGB in [0, 1] in a look,
 * linear in planes and images.
 *
 * Errors: a function that can fail returns an mns_status and, when `error` is not NULL, fills it with one
 * line that says what went wrong, where, and what to do. On failure nothing is created and outputs are left
 * as they were. NULL for something that is needed is MNS_ERROR_USAGE; what has no status and destroys nothing
 * takes none.
 *
 * Threads: there is no global state. An object may be used by one thread at a time; different objects are
 * independent. A renderer and its frames belong to one GL context and must be used on the thread where it is
 * current.
 */
#ifndef MENISCUS_H
#define MENISCUS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define MNS_API __attribute__((visibility("default")))
#else
#define MNS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define MNS_VERSION_MAJOR 0
#define MNS_VERSION_MINOR 1
#define MNS_VERSION_PATCH 0

/* ---- Errors ---- */

typedef enum mns_status {
    MNS_OK = 0,
    MNS_ERROR_USAGE,       /* an argument or an option makes no sense (exit status 2 of the program) */
    MNS_ERROR_INPUT,       /* a file's content is not what its format promises */
    MNS_ERROR_IO,          /* a file cannot be opened, read or written */
    MNS_ERROR_MEMORY,      /* an allocation failed */
    MNS_ERROR_GL,          /* no context, a driver too old, or a driver error */
    MNS_ERROR_UNSUPPORTED, /* well formed, but past a limit of this build or of the driver */
} mns_status;

typedef struct mns_error {
    mns_status status;
    char text[480]; /* one line, no newline, always terminated */
} mns_error;

/* The version and what was built in, one line ("meniscus 0.1.0, EGL, OSMesa, GLFW 3.3.8, ..."). Thread safe.
 */
MNS_API const char *mns_version(void);

/* ---- The field ---- */

/* Kernels k(v), v = |x - p| / R in [0, 1], k(0) = 1, zero beyond 1. Formulas: glsl/density.glsl. */
typedef enum mns_kernel {
    MNS_KERNEL_DEFAULT = 0, /* poly3 */
    MNS_KERNEL_POLY2,       /* (1-v^2)^2: Nossborn, Gourmel alpha 2, Kanamori's quartic, POV-Ray's blob */
    MNS_KERNEL_POLY3,       /* (1-v^2)^3: Gourmel alpha 3 */
    MNS_KERNEL_POLY4,       /* (1-v^2)^4: Gourmel alpha 4 */
    MNS_KERNEL_WYVILL,      /* (1-v^2)^2 (1-4v^2/9): Kanamori's degree six, Szecsi */
    MNS_KERNEL_PERLIN,      /* (1-v)^3 (1+3v+6v^2): Perlin's fade, Szecsi */
    MNS_KERNEL_WENDLAND,    /* (1-v)^4 (1+4v): SPH */
    MNS_KERNEL_COUNT
} mns_kernel;

/* "poly3" and so on; NULL for a value that is no kernel. */
MNS_API const char *mns_kernel_name(mns_kernel kernel);
/* The kernel of that name, or MNS_KERNEL_COUNT where there is none. */
MNS_API mns_kernel mns_kernel_by_name(const char *name);

/* An array of the host's: element i starts at (const char *)data + i * stride. */
typedef struct mns_values {
    const void *data; /* NULL: absent */
    size_t stride;    /* bytes between elements, at least an element's; 0: packed */
    bool is_float;    /* float elements; otherwise double */
} mns_values;

typedef struct mns_column_desc {
    const char *name; /* not NULL, not empty */
    mns_values values;
} mns_column_desc;

typedef struct mns_field_desc {
    size_t count;          /* balls; 0 is legal: an empty field */
    mns_values position;   /* three numbers an element */
    mns_values radius;     /* effective radii R_i > 0; absent: uniform_radius */
    mns_values strength;   /* q_i, any finite sign; absent: 1 */
    double uniform_radius; /* 0: 2 x the median nearest-neighbour distance (a lone ball: 1) */
    mns_kernel kernel;
    double iso;                     /* L > 0; 0: 0.2 */
    const mns_column_desc *columns; /* extra scalars, for colours and materials */
    size_t column_count;
} mns_field_desc;

typedef struct mns_field mns_field;

/* Copies the host's arrays into a field. Errors: USAGE (a number not finite, R <= 0, L < 0, a name twice),
 * MEMORY. */
MNS_API mns_status mns_field_create(const mns_field_desc *desc, mns_field **field, mns_error *error);
MNS_API void mns_field_destroy(mns_field *field);

/* What a field holds; the pointers live as long as the field. */
typedef struct mns_field_info {
    size_t count;
    double lo[3], hi[3];                     /* box of the centres; zeros where count is 0 */
    double effective_lo[3], effective_hi[3]; /* box of the effective spheres */
    double radius_min, radius_median, radius_max;
    double strength_min, strength_max;
    bool radius_is_uniform, has_strength;
    const char *radius_source; /* "file", "host", "option", "generator", "default spacing", "van der Waals" */
    mns_kernel kernel;
    double iso;
    const char *format; /* "csv", "lammps", ..., "generator", "host" */
    size_t column_count;
    size_t rows_skipped;
    const char *rows_skipped_why; /* "" where none were */
    bool has_cell;
    double cell_origin[3], cell[3][3]; /* the simulation box: its corner and edge vectors */
} mns_field_info;

typedef struct mns_column_info {
    const char *name;
    bool is_label; /* a text column (element): values are indices into labels */
    double min, max;
    size_t label_count;
    const char *const *labels;
} mns_column_info;

MNS_API void mns_field_get_info(const mns_field *field, mns_field_info *info);
/* Column `index` < column_count. False where there is none. */
MNS_API bool mns_field_get_column(const mns_field *field, size_t index, mns_column_info *info);
/* What ball `ball` < count has in column `index`; NAN where there is no such column or ball. */
MNS_API double mns_field_value(const mns_field *field, size_t index, size_t ball);

/* ---- Input: particle files and generators ---- */

typedef struct mns_input_options { /* zero: what the file says, or the default */
    mns_kernel kernel;
    double iso;          /* L */
    double radius;       /* replaces the file's radii */
    double radius_scale; /* times the radii, whatever their source */
} mns_input_options;

typedef struct mns_input mns_input;

/* Opens `count` names as one sequence: particle files (plain or gzipped, told by content first, by name
 * second), or one generator "name:count[:seed[:frames]]". Errors: USAGE (unknown generator), IO, INPUT,
 * MEMORY. */
MNS_API mns_status mns_input_open(const char *const *names, size_t count, const mns_input_options *options,
                                  mns_input **input, mns_error *error);
MNS_API void mns_input_close(mns_input *input);
/* Frames in the whole sequence, at least 1. */
MNS_API size_t mns_input_frames(const mns_input *input);
/* Reads frame `frame` (from 0). Errors: USAGE (no such frame), IO, INPUT, MEMORY. */
MNS_API mns_status mns_input_read(mns_input *input, size_t frame, mns_field **field, mns_error *error);

/* ---- View, look, options ---- */

enum { MNS_VIEW_EYE = 1, MNS_VIEW_LOOK_AT = 2 }; /* bits of mns_view.set */

typedef struct mns_view {
    unsigned set; /* which of eye and look_at are given; what is not is fitted to the field */
    double eye[3];
    double look_at[3];
    double up[3];      /* 0,0,0: 0,1,0 */
    double fov;        /* vertical, degrees, in (0, 180); 0: 45 */
    int width, height; /* pixels; 0: 1024 x 768 */
} mns_view;

/* Fills what a view leaves open so that the box of the effective spheres fits the frame, looking along -z;
 * afterwards both bits are set. Errors: USAGE (eye = look_at, up along the view, fov or size out of range, a
 * number not finite). */
MNS_API mns_status mns_view_resolve(const mns_view *view, const mns_field *field, mns_view *resolved,
                                    mns_error *error);

typedef enum mns_light_kind {
    MNS_LIGHT_HEAD = 0,    /* at the eye; casts no shadow */
    MNS_LIGHT_DIRECTIONAL, /* from far away */
    MNS_LIGHT_POINT,
    MNS_LIGHT_AREA /* a sphere; without shadows as a point in its middle */
} mns_light_kind;
typedef enum mns_shading { MNS_SHADING_SMOOTH = 0, MNS_SHADING_CEL } mns_shading;
typedef enum mns_color_map {
    MNS_COLOR_MAP_VIRIDIS = 0,
    MNS_COLOR_MAP_MAGMA,
    MNS_COLOR_MAP_INFERNO,
    MNS_COLOR_MAP_PLASMA,
    MNS_COLOR_MAP_CIVIDIS,
    MNS_COLOR_MAP_COUNT
} mns_color_map;

MNS_API const char *mns_color_map_name(mns_color_map map);
MNS_API mns_color_map mns_color_map_by_name(const char *name); /* MNS_COLOR_MAP_COUNT: no such map */

/* A colour as people write it: "R,G,B" or "R,G,B,A" in [0, 1], "#rrggbb", "#rrggbbaa" or "transparent", as
 * sRGB and alpha (1 where none is written). Errors: USAGE. */
MNS_API mns_status mns_color_parse(const char *text, double rgba[4], mns_error *error);

enum { /* bits of mns_look.set: the members below that are given */
       MNS_LOOK_COLOR = 1,
       MNS_LOOK_BACKGROUND = 2,
       MNS_LOOK_RANGE = 4,
       MNS_LOOK_AMBIENT = 8,
       MNS_LOOK_DIFFUSE = 16,
       MNS_LOOK_SPECULAR = 32,
       MNS_LOOK_MIRROR = 64,
       MNS_LOOK_TRANSMISSION = 128,
       /* What is not 0 counts as given; these say that a 0 is meant, where a preset has something else: */
       MNS_LOOK_LIGHT = 256, /* light and lights */
       MNS_LOOK_SHADOWS = 512,
       MNS_LOOK_REFLECTIONS = 1024,
       MNS_LOOK_REFRACTIONS = 2048,
       MNS_LOOK_INDEX = 4096,
       MNS_LOOK_ABSORPTION = 8192,
       MNS_LOOK_OCCLUSION = 16384,
       MNS_LOOK_ENVIRONMENT = 32768
};

typedef struct mns_light {
    mns_light_kind kind;
    double direction[3]; /* of DIRECTIONAL: towards the light; 0,0,0: 1,2,1.5 */
    double position[3];  /* of POINT and AREA, scene units */
    double radius;       /* of AREA, above 0 */
    double color[3];     /* sRGB; 0,0,0: white */
    double strength;     /* times the colour; 0: 1. There is no falloff */
} mns_light;

/* What light does on its way beyond the first hit: a branch at each surface, at most these deep. Each ray is
 * traced as exactly as the first. A ray whose share of the pixel is below 1/1024, and one past the last level
 * that is allowed, sees the environment in its direction. What changes nothing (no share, no rays, no light)
 * is left out, and the picture is that without it, bit for bit. */
typedef struct mns_effects {
    bool shadows;       /* of every light but one at the eye */
    int shadow_samples; /* rays a pixel and area light, at most 4096; 0: 16 */
    int reflections;    /* mirror levels, at most 8; 0: a mirrored share sees the environment alone */
    int refractions;    /* surfaces that a ray may pass through (or meet in total reflection), at most 16 */
    double mirror;      /* share mirrored at any angle, [0, 1]; default 0.3 with reflections and no index */
    double index; /* of refraction, at least 1: it bends rays, and Fresnel's share is mirrored; 0: none */
    double transmission;    /* of what is not mirrored, the share that goes through rather than being shaded,
                               [0, 1]; default 1 with refractions; without them 0 */
    double absorption[3];   /* Beer's law inside, a scene unit, each at least 0 */
    int occlusion_rays;     /* of the ambient light, cosine-weighted, at most 4096; 0: none */
    double occlusion_reach; /* scene units; 0: a tenth of the diagonal of the effective spheres' box */
    const char
        *environment; /* NULL or "": the background's colour; "sky": a built-in one; else an .exr or .png,
                         the whole sphere by longitude and latitude: up is the view's up, the middle is
                         straight ahead of a camera that looks along -z. Borrowed for the call */
    uint32_t seed;    /* of the samples: the same seed gives the same bits */
} mns_effects;

/* A solid beside the surface, from a mesh file (OBJ, PLY, STL, glTF; where assimp is built in: mns_version
 * tells). It is opaque, seen from both sides, and shaded as the surface but without shine, mirror or contour;
 * it hides, casts and receives shadows, occludes, and is seen in mirrors and through refraction. Its colours,
 * shadows and the rest are those of the look. Of faces in one plane that of the first mesh is seen. The view
 * fits the field alone. */
typedef struct mns_mesh {
    const char *file; /* borrowed for the call; read again where it has changed, or a file that it names */
    bool has_color;
    double color[3]; /* sRGB; without: 0.8, 0.8, 0.8 */
} mns_mesh;

typedef struct mns_mesh_info {
    size_t triangles, corners; /* corners in one place are one */
    size_t dropped;            /* triangles without an area */
    double lo[3], hi[3];
    uint64_t fingerprint; /* of the triangles in their order: where two are equal so are, as good as surely,
                             the meshes */
} mns_mesh_info;

/* Reads a mesh file and tells what is in it. Errors: USAGE, IO, INPUT, MEMORY, UNSUPPORTED (too many
 * triangles, or a build that reads no meshes). */
MNS_API mns_status mns_mesh_get_info(const char *file, mns_mesh_info *info, mns_error *error);

/* A second material, into which that of the look and its effects, the first, goes over ball by ball. At every
 * hit, of a first ray or a later one, the column `by` is blended as colours are: the mean over the balls
 * around, weighted by their densities. Where that is range[0] or less the surface is of the first material,
 * where it is range[1] or more of the second, and between them mirror, transmission and colour are as far on
 * their way from the one to the other. A way inside is dimmed by the mean of what absorbs at its two ends;
 * one that begins in the eye, or ends at a mesh, by that of its other end. There is one index of refraction.
 * What a look says of a second material without `by` is an error. */
typedef struct mns_blend {
    unsigned set;    /* MNS_LOOK_COLOR, _MIRROR, _TRANSMISSION, _ABSORPTION: a 0 is meant */
    const char *by;  /* a column of numbers; NULL or "": one material; borrowed for the call */
    double range[2]; /* the lower first; 0, 0: 0, 1 */
    /* As in mns_look and mns_effects; what is 0, and not in `set`, is as the first material's, of the colour
     * that of color_by. */
    double color[3], mirror, transmission, absorption[3];
} mns_blend;

typedef struct mns_look {
    unsigned set;
    const char
        *preset; /* NULL or "": none; else as mns_look_preset would lay it under; borrowed for the call */
    const mns_light *lights; /* instead of `light`; at most 256, borrowed for the call */
    size_t light_count;      /* 0: the one light of `light` and `light_direction` */
    mns_effects effects;
    const mns_mesh *meshes; /* at most 256, borrowed for the call */
    size_t mesh_count;
    mns_blend blend;
    mns_light_kind light;      /* HEAD or DIRECTIONAL */
    double light_direction[3]; /* towards the light; for DIRECTIONAL; 0,0,0: 1,2,1.5 */
    mns_shading shading;
    int cel_bands;        /* 0: 3 */
    double color[3];      /* surface colour, sRGB; default 0.35, 0.62, 0.86 */
    double background[4]; /* sRGB and alpha, not premultiplied; default opaque white; alpha 0: transparent */
    double ambient, diffuse, specular; /* defaults 0.15, 0.85, 0.25 */
    double shininess;                  /* Blinn-Phong exponent; 0: 40 */
    const char *color_by; /* NULL: color; "element" or any column's name; borrowed for the call */
    mns_color_map color_map;
    double range[2]; /* value range of the map; default: the column's minimum and maximum */
} mns_look;

/* Fills what a look leaves open (0, and no bit of `set`) as the preset `name` has it: "plain" (nothing),
 * "clay", "water", "molecule", "glass". Errors: USAGE (no such preset). */
MNS_API mns_status mns_look_preset(const char *name, mns_look *look, mns_error *error);
/* The name of preset `index`; NULL from the last on. */
MNS_API const char *mns_look_preset_name(size_t index);

typedef enum mns_method {
    MNS_METHOD_AUTO =
        0, /* the plan picks by the lengths and what is asked of one method alone: tile, mostly */
    MNS_METHOD_LIST,
    MNS_METHOD_REFERENCE, /* on the CPU, certified: mns_reference; its solver is always exact */
    MNS_METHOD_TILE,      /* the list's cast over lists a tile of pixels long, binned on the CPU */
    MNS_METHOD_FBVH, /* a fitted tree of boxes, built on the CPU, traced on the GPU (Gourmel et al. 2010) */
    MNS_METHOD_BVH   /* its baseline: a tree whose leaves overlap */
} mns_method;
typedef enum mns_solver {
    MNS_SOLVER_EXACT = 0,
    MNS_SOLVER_CUBIC,          /* of list and tile */
    MNS_SOLVER_CUBIC_MONOMIAL, /* of list and tile */
    MNS_SOLVER_SECANT          /* of fbvh and bvh: as published, not certified */
} mns_solver;
/* "list", "exact" and so on; NULL for a value that is none. */
MNS_API const char *mns_method_name(mns_method method);
MNS_API const char *mns_solver_name(mns_solver solver);
typedef enum mns_gather { MNS_GATHER_EARLY_Z = 0, MNS_GATHER_PAPER } mns_gather;

typedef struct mns_options {
    mns_method method;
    mns_solver solver;
    mns_gather gather;
    int samples; /* samples a pixel for colour; 0: 1; planes are the centre sample's whatever it is; at most
                    64 */
    /* A picture sample by sample: of `samples`, those from sample_first on, sample_count of them (0: all that
     * are left), are drawn. From 1 on they are added to what the frame holds, which must be the samples
     * before, of the same view; its colours are weighted so that they are right when the last is in, and the
     * planes are the last sample's until then, the centre's from then on: the whole is the same, bit for bit,
     * as drawn at once. */
    int sample_first, sample_count;
    bool moved;       /* every position changed since the last draw: reuse nothing */
    bool measure;     /* fill the phases' times (each closed by glFinish) and the lengths of the lists */
    const char *tree; /* how the tree of fbvh, bvh and rays beyond the first is built: "no-fit,cost-n,..."
                         (README); borrowed for the call */
    int secant_steps; /* most steps of the solver secant; 0: 16 */
    bool counters;    /* of fbvh and bvh: count a ray's work, see mns_image.work and mns_stats */
    size_t max_pool_nodes; /* 0: what the driver allows; fewer makes the frame be drawn in more tiles */
    /* For tests and diagnosis: each drives a path that ordinary scenes seldom take; the picture stays right.
     */
    int slots;        /* balls of a ray at once before the slow path; 0: the plan's choice */
    int root_steps;   /* steps of a root search before the slow path; 0: the plan's choice */
    uint32_t shuffle; /* not 0: a seed by which the gathered lists are put in a random order */
} mns_options;

/* The ray through the image point (x, y), in pixels from the top left corner of the frame, of a view that
 * mns_view_resolve has filled: the centre of pixel (i, j) is (i + 0.5, j + 0.5). `direction` becomes a unit
 * vector; the ray starts at the view's eye. Thread safe. */
MNS_API void mns_view_ray(const mns_view *resolved, double x, double y, double direction[3]);

/* ---- The plan ---- */

typedef struct mns_limits {   /* of a driver; zeros: the minima of OpenGL 4.3 */
    size_t max_storage_block; /* bytes, GL_MAX_SHADER_STORAGE_BLOCK_SIZE */
    int max_texture_size;     /* GL_MAX_TEXTURE_SIZE */
    int max_viewport[2];      /* GL_MAX_VIEWPORT_DIMS */
    int max_texture_buffer;   /* texels, GL_MAX_TEXTURE_BUFFER_SIZE */
    double max_point_size;    /* GL_POINT_SIZE_RANGE[1] */
    bool is_software;         /* the renderer is llvmpipe, softpipe or swr */
    bool has_clip_control;    /* GL 4.5 or GL_ARB_clip_control */
} mns_limits;

typedef struct mns_plan mns_plan;

typedef struct mns_left_out {
    const char *part, *reason;
} mns_left_out;

/* What would be done for one frame, and what is left out, and why: a pure function, no GL. Arguments as of
 * mns_renderer_draw; limits may be NULL. Errors: USAGE, MEMORY, UNSUPPORTED. */
MNS_API mns_status mns_plan_create(const mns_field *field, const mns_view *view, const mns_look *look,
                                   const mns_options *options, const mns_limits *limits, mns_plan **plan,
                                   mns_error *error);
MNS_API void mns_plan_destroy(mns_plan *plan);
/* The method, never AUTO; where `reason` is not NULL it becomes why it is that one, which lives as long as
 * the plan. */
MNS_API mns_method mns_plan_method(const mns_plan *plan, const char **reason);
/* The feature mask: one bit a capability, one mask one shader variant. Names: mns_plan_text. */
MNS_API uint64_t mns_plan_features(const mns_plan *plan);
/* Passes in order ("core_depth", "gather", ...); *count of them. */
MNS_API const char *const *mns_plan_passes(const mns_plan *plan, size_t *count);
MNS_API const mns_left_out *mns_plan_left_out(const mns_plan *plan, size_t *count);
/* What of the input lies outside the stated domain (docs/domain.md), a line a limit: it is drawn all the
 * same, but without the promises of the exact solver. *count of them, 0 for most inputs. */
MNS_API const char *const *mns_plan_warnings(const mns_plan *plan, size_t *count);
/* The whole plan as text of several lines, as --explain prints it. Lives as long as the plan. */
MNS_API const char *mns_plan_text(const mns_plan *plan);

/* ---- GL contexts without a window ---- */

typedef enum mns_backend {
    MNS_BACKEND_AUTO = 0,
    MNS_BACKEND_EGL,
    MNS_BACKEND_OSMESA,
    MNS_BACKEND_GLFW
} mns_backend;

typedef void (*mns_proc)(void);
typedef mns_proc (*mns_get_proc)(
    const char *name); /* glfwGetProcAddress and eglGetProcAddress have this type */

typedef struct mns_context mns_context;

/* Makes an OpenGL core context of at least 4.3 with no visible window, and makes it current on this thread;
 * whatever context was current there no longer is. AUTO tries EGL (surfaceless, then device; a GPU's device
 * before a surfaceless software renderer), OSMesa, a hidden GLFW window. GLFW: main thread only, and
 * glfwTerminate is left to the host. Errors: GL (library missing, version too old, driver failed: the text
 * says which, for each one tried), UNSUPPORTED (not built in). */
MNS_API mns_status mns_context_create(mns_backend backend, mns_context **context, mns_error *error);
MNS_API void mns_context_destroy(mns_context *context);
MNS_API mns_status mns_context_make_current(mns_context *context, mns_error *error);
MNS_API mns_get_proc mns_context_get_proc(const mns_context *context);
/* "egl surfaceless", "egl device 0", "osmesa", "glfw". */
MNS_API const char *mns_context_name(const mns_context *context);
/* What a back end (AUTO: each of them) offers on this machine: version, renderer, the limits that matter, or
 * why it cannot start; several lines without a last newline, to be given to free(). NULL: out of memory.
 * Leaves no context current. */
MNS_API char *mns_backend_describe(mns_backend backend);

/* ---- Drawing ---- */

typedef struct mns_renderer mns_renderer;
typedef struct mns_frame mns_frame;

/* Makes what one context needs, with that context current. `get_proc` finds GL functions. Nothing is compiled
 * before a frame asks for it. Errors: GL (below 4.3), MEMORY. */
MNS_API mns_status mns_renderer_create(mns_get_proc get_proc, mns_renderer **renderer, mns_error *error);
MNS_API void mns_renderer_destroy(mns_renderer *renderer); /* its context current; destroy its frames first */
MNS_API const mns_limits *mns_renderer_limits(const mns_renderer *renderer);
/* GL_RENDERER and GL_VERSION, "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6". */
MNS_API const char *mns_renderer_name(const mns_renderer *renderer);
/* Compiled programs are kept between runs in $XDG_CACHE_HOME/meniscus/programs (~/.cache), where the driver
 * gives them away: at most 64 MiB. This names another folder for those that are made from now on; NULL: they
 * are kept nowhere. Nothing fails because of it: what is not there, or does not fit, is compiled. */
MNS_API void mns_renderer_keep_programs(mns_renderer *renderer, const char *folder);
/* Reads the shaders' text from a folder, such as the glsl/ that this library is made from, in place of what
 * is built in, and compiles every program made so far anew. On failure all stays as it was. For development.
 * Errors: IO, INPUT (no such shaders), GL (the compiler's first complaint), MEMORY. */
MNS_API mns_status mns_renderer_read_shaders(mns_renderer *renderer, const char *folder, mns_error *error);
/* Messages of medium or high severity that the driver's debug output gave so far (0 where it gives none), and
 * the last. */
MNS_API size_t mns_renderer_messages(const mns_renderer *renderer, const char **last);

MNS_API mns_status mns_frame_create(mns_renderer *renderer, mns_frame **frame, mns_error *error);
MNS_API void mns_frame_destroy(mns_frame *frame);

/* Draws the field's surface into the frame's planes and shades it. view, look and options may be NULL
 * (defaults). The GL state that it changes is put back as it was, but for what
 * is set by index (viewports, scissors, blending and colour masks of draw buffers beyond the first); pending
 * GL errors are cleared. Errors: USAGE, MEMORY, GL, UNSUPPORTED. */
MNS_API mns_status mns_renderer_draw(mns_renderer *renderer, const mns_field *field, const mns_view *view,
                                     const mns_look *look, const mns_options *options, mns_frame *frame,
                                     mns_error *error);

/* Begins what the next draw of `field` by these options can have made ahead, on a thread of its own: the tree
 * of fbvh and bvh; of other methods nothing. Call it before the draw of the frame before, so that the tree is
 * built while that frame is drawn (Gourmel et al. 2010, figure 7). The field must stay as it is until it is
 * drawn, or the renderer is destroyed, or, with NULL for a field, this has ended what was begun. A field
 * prepared and then drawn with options.moved is not built again. Errors: USAGE, MEMORY; what building comes
 * to is told by the draw. */
MNS_API mns_status mns_renderer_prepare(mns_renderer *renderer, const mns_field *field,
                                        const mns_options *options, mns_error *error);

/* A host's framebuffer, drawn on with the usual perspective depth in [0, 1]. */
typedef struct mns_target {
    unsigned framebuffer; /* GL name; 0: the default framebuffer. Single-sampled, with a depth buffer */
    int x, y;             /* lower left corner of the view's rectangle in it, pixels */
    double near, far; /* clip planes of the host's projection, 0 < near < far; the rest of it is the view's */
} mns_target;

/* As mns_renderer_draw, then draws the surface into the host's framebuffer, tested against the depth that is
 * there and writing its own; where the host drew nearer, the lists are clipped by it, as by core depth
 * (Szecsi & Illes 2012, section 5, "Lay down depth"). Background pixels are left as they are. Errors: as
 * mns_renderer_draw. */
MNS_API mns_status mns_renderer_draw_on(mns_renderer *renderer, const mns_field *field, const mns_view *view,
                                        const mns_look *look, const mns_options *options,
                                        const mns_target *target, mns_frame *frame, mns_error *error);

typedef enum mns_phase { /* of mns_stats.ms; the total is apart */
                         MNS_PHASE_SORT = 0,
                         MNS_PHASE_BIN,
                         MNS_PHASE_UPLOAD,
                         MNS_PHASE_CORE_DEPTH,
                         MNS_PHASE_GATHER,
                         MNS_PHASE_BUILD,
                         MNS_PHASE_CAST,
                         MNS_PHASE_NORMAL,
                         MNS_PHASE_TRACE,
                         MNS_PHASE_EFFECTS,
                         MNS_PHASE_SHADE,
                         MNS_PHASE_READBACK,
                         MNS_PHASE_COUNT
} mns_phase;

MNS_API const char *mns_phase_name(mns_phase phase);

/* What a ray through a tree costs (Gourmel et al. 2010, table 3), and the iterations of solving (Forcier &
 * Wang 2017). */
typedef enum mns_work {
    MNS_WORK_NODES = 0, /* pairs of boxes passed */
    MNS_WORK_LEAVES,    /* leaves tested */
    MNS_WORK_BALLS,     /* balls considered in them */
    MNS_WORK_ROUNDS,    /* rounds of solving: pieces summed and searched (exact), steps (secant) */
    MNS_WORK_COUNT
} mns_work;

/* The tree of fbvh and bvh. */
typedef struct mns_tree_stats {
    uint64_t balls; /* 0: there is none */
    uint64_t leaves, depth, references, leaf_largest, discarded;
    uint64_t leaves_bounded;  /* leaves that the bounds on memory kept from being split */
    uint64_t bytes;           /* on the GPU */
    double leaf_mean;         /* references a leaf */
    bool made_smaller;        /* the driver's blocks lowered the bounds */
    double build_ms, sort_ms; /* of building, whichever thread did it; the sort is part of it */
} mns_tree_stats;

typedef struct mns_stats {
    const char *method, *solver, *gather;
    int width, height;
    double ms[MNS_PHASE_COUNT]; /* milliseconds */
    double ms_total;            /* from the loaded scene to finished planes: without shade and readback */
    bool timed;                 /* options.measure: phases were bracketed by glFinish */
    uint64_t balls, balls_in_view;
    uint64_t pixels_hit, pixels_undecided;
    uint64_t effects_rays;      /* traced beyond the first hit */
    uint64_t effects_undecided; /* pixels of which some of those could not be decided */
    /* What sampling leaves of noise in the image that mns_frame_read gave last, all its samples counted: the
     * root mean square over the hits of the standard error that as many independent rays would leave, in the
     * share of the lights and in that of the ambient light; 0 where nothing is sampled. */
    double noise_shadow, noise_occlusion;
    uint64_t list_nodes;        /* fragments gathered */
    double list_mean, list_p99; /* nodes a non-empty pixel */
    uint64_t list_max;
    uint64_t tiles;               /* parts the frame was drawn in */
    struct {                      /* each counts what took a slower path, and still came out right */
        uint64_t pool_grown;      /* node pool enlarged and gathered again */
        uint64_t tiled;           /* frame cut up because the pool would pass the driver's block limit */
        uint64_t lists_sorted;    /* times that lists came out of order and were sorted */
        uint64_t active_overflow; /* pixels whose active set outgrew the slots */
        uint64_t root_cap;        /* pixels whose root search hit its cap */
        uint64_t undecided_float; /* pixels that float could not decide, solved again in double */
    } fallbacks;
    mns_tree_stats tree;
    bool counted;                /* options.counters: */
    double work[MNS_WORK_COUNT]; /* means a ray */
    uint64_t programs, passes,
        buffers;            /* made and held by the renderer so far; passes of this frame's plan */
    uint64_t programs_kept; /* of the programs, those that had been kept from an earlier run */
    double t_unit; /* scene units that 1 in MNS_PLANE_DEPTH stands for: 1, or another power of two where
                      floats could not hold this field's lengths in scene units (docs/domain.md) */
    double color_range[2];            /* legend: what the ends of the colour map stand for; 0,0 without */
    const char *color_by, *color_map; /* "" without */
} mns_stats;

/* Of the last draw; lives until the next or the frame's end. */
MNS_API const mns_stats *mns_frame_stats(const mns_frame *frame);
MNS_API const mns_plan *mns_frame_plan(const mns_frame *frame);

typedef enum mns_plane {                      /* GL textures of a frame; a host may sample them */
                         MNS_PLANE_COLOR = 0, /* RGBA32F, linear, premultiplied */
                         MNS_PLANE_DEPTH, /* RG32F: t and its low word, +inf on a miss (t is the distance from
                                             the eye along the unit ray to the surface or, where that is
                                             nearer, a mesh, in units of mns_stats.t_unit) */
                         MNS_PLANE_NORMAL, /* RGBA32F: outward normal (of a mesh: turned to the eye), and w: 1
                                              certain, 0 undecided; 0,0,0 on a miss */
} mns_plane;

/* The GL name of a plane's texture; row 0 is the bottom. 0 before the first draw. */
MNS_API unsigned mns_frame_texture(const mns_frame *frame, mns_plane plane);

/* ---- Images ---- */

/* Planes read back. Row 0 is the top, pixels row by row; every array is width * height (x 4 for rgba, x 3 for
 * normal). */
typedef struct mns_image {
    int width, height;
    float *rgba;     /* linear, premultiplied by alpha */
    float *t, *t_lo; /* distance; t + t_lo is it to more than a float; +inf and 0 on a miss */
    float *normal;
    float *certain; /* 1, or 0 where undecided */
    float *t_error; /* bound on the error of t + t_lo; NULL where the method gives none */
    double t_unit;  /* scene units that 1 in a distance here (t, t_lo, t_error, mirror_t, refract_t) stands
                       for; 1 but at the ends of what floats  hold, see mns_stats.t_unit; 0: 1 */
    float *work;    /* MNS_WORK_COUNT counts a pixel, with options.counters; else NULL */
    /* Terms of the look's effects at the first hit; NULL where the effect is off. */
    float *shadow;          /* mean share of the casting lights that reaches it; 1 on a miss */
    float *occlusion;       /* share of its occlusion rays that meet nothing; 1 on a miss */
    float *mirror_t;        /* distance on to what its mirrored ray meets; +inf: nothing, or not traced */
    float *refract_t;       /* and its refracted ray */
    float *effects_certain; /* 1, or 0 where some ray beyond the first hit was undecided */
    float *mesh;            /* 1 + the index of the look's mesh that is seen, else 0; NULL without meshes */
} mns_image;

/* Reads a frame's planes. Errors: USAGE (not drawn yet), MEMORY, GL. */
MNS_API mns_status mns_frame_read(mns_frame *frame, mns_image **image, mns_error *error);
MNS_API void mns_image_destroy(mns_image *image);
/* One count of a ray's work as a picture: colours of `map` from 0 to the count that one pixel in a thousand
 * passes, which *most (where not NULL) becomes. Errors: USAGE (the image has no counts), MEMORY. */
MNS_API mns_status mns_image_heat(const mns_image *image, mns_work count, mns_color_map map, mns_image **heat,
                                  double *most, mns_error *error);
/* Writes an image: .png (8-bit sRGB with alpha where any pixel is not opaque) or .exr (float32 R G B A, t,
 * t.lo, N.X, N.Y, N.Z, certain and, where there are some, t.err, work.nodes, work.leaves, work.balls,
 * work.rounds, shadow, occlusion, mirror.t, refract.t, certain.effects and mesh, ZIP-compressed), written
 * beside the name and renamed. Errors: USAGE (unknown ending), IO, MEMORY, UNSUPPORTED
 * (.exr of distances that floats do not hold: t_unit is not 1). */
MNS_API mns_status mns_image_write(const mns_image *image, const char *path, mns_error *error);
/* Reads back an .exr that mns_image_write wrote. Errors: IO, INPUT, MEMORY. */
MNS_API mns_status mns_image_read(const char *path, mns_image **image, mns_error *error);

/* ---- The truth: the certified tracer on the CPU, in doubles ---- */

typedef struct mns_reference mns_reference;

/* What one ray meets. A decision is certain when no extremum of f before it (on a miss: anywhere) comes so
 * near to L that rounding could decide; otherwise the ray is undecided, and the rest is the best guess. */
typedef struct mns_hit {
    bool hit;         /* f - L changes its sign at some t > 0 */
    bool certain;     /* proven */
    double t;         /* distance of the first change of sign; INFINITY on a miss */
    double t_error;   /* proven bound on |t - t*|; 0 on a miss */
    double normal[3]; /* -grad f / |grad f| there, outward; 0,0,0 on a miss */
    size_t ball;      /* of those around the hit, the one of the largest |q| k; 0 on a miss */
} mns_hit;

/* Makes what tracing a field needs; the field must outlive it and stay as it is. Errors: USAGE, MEMORY. */
MNS_API mns_status mns_reference_create(const mns_field *field, mns_reference **reference, mns_error *error);
MNS_API void mns_reference_destroy(mns_reference *reference);
/* Finds the first hit of the ray from `origin` along `direction` (any length but zero; t is Euclidean
 * distance). Several threads may trace through one reference at a time. Errors: USAGE, MEMORY. */
MNS_API mns_status mns_reference_trace(const mns_reference *reference, const double origin[3],
                                       const double direction[3], mns_hit *hit, mns_error *error);
/* f at a point, in doubles; its gradient and the ball of the largest |q| k there where asked for (NULL: not).
 * The ball is SIZE_MAX where none is near. Thread safe. */
MNS_API double mns_reference_value(const mns_reference *reference, const double point[3], double gradient[3],
                                   size_t *ball);
/* The effective radius of ball `index` < count. Thread safe. */
MNS_API double mns_field_radius(const mns_field *field, size_t index);

/* ---- Scene files ---- */

typedef struct mns_scene {
    const char *const *inputs; /* names for mns_input_open, relative ones resolved beside the scene file */
    size_t input_count;
    mns_input_options field;
    mns_view view;
    mns_look look;
    mns_options draw; /* method, solver and samples */
    int frame;        /* of the input; 0: the first */
} mns_scene;

/* Loads a JSON scene; keys: README.md. Errors: IO, INPUT (syntax with line and column; an unknown key or a
 * wrong type with its path, "light.kind"), MEMORY. */
MNS_API mns_status mns_scene_load(const char *path, mns_scene **scene, mns_error *error);
MNS_API void mns_scene_destroy(mns_scene *scene);

#ifdef __cplusplus
}
#endif
#endif
