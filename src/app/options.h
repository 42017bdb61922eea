/* A command line to the library's descriptors: one table row an option, holding its name, its help and what
 * it sets. */
#ifndef MNS_APP_OPTIONS_H
#define MNS_APP_OPTIONS_H

#include "app/parse.h"
#include "compare/images.h"
#include "meniscus.h"
#include "window/window.h"

enum { APP_LIGHTS = 32, APP_MESHES = 32 };

/* All that a command was told. Strings point into argv or into `scene`. */
typedef struct app_options {
    const char *const *inputs;
    size_t input_count;
    mns_input_options field;
    mns_view view;
    mns_look look;
    mns_light lights[APP_LIGHTS]; /* those of --light, where it was given */
    size_t light_count;
    mns_mesh meshes[APP_MESHES]; /* those of --mesh, likewise, with names of their own */
    size_t mesh_count;
    mns_options draw;
    mns_backend backend;
    const char *output, *aov, *heat, *stats; /* NULL: not asked for */
    parse_frames_range frames;
    int repeat;  /* 0: not asked for */
    int threads; /* 0: OpenMP's own choice */
    bool explain;
    bool gl, json;    /* info */
    const char *runs; /* compare; NULL: the default ones */
    int timed_frames; /* compare */
    bool no_cache;
    const char *suite;             /* compare; NULL: none */
    const char *suite_case;        /* of it, those whose name matches; NULL: all */
    bool quick;                    /* of it, without the heavy ones */
    images_tolerance tolerance;    /* compare of two images */
    unsigned tolerance_set;        /* which of it were given */
    long rays, seed;               /* verify */
    window_context window_context; /* view */
    const char *script, *glsl;     /* view; NULL: none */
    bool no_panel;                 /* view */
    double patience;               /* view, seconds; 0: the default */
    bool range_is_scenes;          /* look.range comes from the scene, and holds for its color_by only */
    bool blend_range_is_scenes;    /* and look.blend.range, for its blend.by */
    bool help;                     /* was asked for and printed: nothing more to do */
    mns_scene *scene;              /* of a .json argument */
    const char **names;
    const char **given; /* the options that were given, "size" and so on, in their order */
    size_t given_count;
} app_options;

/* Sets what the option means; `name` is "--size" and so on, `text` its value or NULL. */
typedef mns_status option_apply(app_options *o, const char *name, const char *text, mns_error *error);

typedef struct option_row {
    const char *name;  /* NULL: a heading, which is `doc` */
    char letter;       /* 0: none */
    const char *value; /* NULL: takes none; "?N": may have one, N */
    const char *doc;
    option_apply *apply;
} option_row;

typedef struct option_table {
    const char *command, *arguments, *doc; /* "render", "INPUT... -o FILE", what it does */
    const option_row *rows;
    size_t count;
} option_table;

/* Reads a command's arguments: every value is checked first, then a .json argument is loaded as a scene, and
 * the options are laid over it. With --help the help is printed and o->help set. The caller calls
 * options_free in either case. */
mns_status options_read(const option_table *table, int argc, char **argv, app_options *o, mns_error *error);
void options_free(app_options *o);
/* The first option that was given and is none of the list, which NULL ends; NULL: there is none. */
const char *options_beside(const app_options *o, const char *const *known);

/* Rows that commands share. */
option_apply option_kernel, option_iso, option_radius, option_radius_scale, option_frame;
option_apply option_output, option_size, option_eye, option_look_at, option_up, option_fov;
option_apply option_method, option_solver, option_tree, option_secant_steps, option_counters, option_gather;
option_apply option_backend, option_threads, option_no_cache;

#define OPTIONS_OF_FIELD                                                                                     \
    {NULL, 0, NULL, "Field (over what the input says):", NULL},                                              \
        {"kernel", 0, "NAME", "poly2, poly3 (the default), poly4, wyvill, perlin or wendland",               \
         option_kernel},                                                                                     \
        {"iso", 0, "L", "the surface is where the field equals L > 0 (default 0.2)", option_iso},            \
        {"radius", 0, "R", "one effective radius for all particles", option_radius},                         \
    {                                                                                                        \
        "radius-scale", 0, "S", "multiply the radii by S, wherever they come from", option_radius_scale      \
    }

#define OPTIONS_OF_CAMERA                                                                                    \
    {NULL, 0, NULL,                                                                                          \
     "Camera (default: the whole field, of a sequence that of frame 0, fits the frame, seen along -z):",     \
     NULL},                                                                                                  \
        {"eye", 0, "X,Y,Z", "where the camera is", option_eye},                                              \
        {"look-at", 0, "X,Y,Z", "the point in the middle of the frame", option_look_at},                     \
        {"up", 0, "X,Y,Z", "what is up in the frame (default 0,1,0)", option_up},                            \
    {                                                                                                        \
        "fov", 0, "DEG", "vertical field of view in degrees (default 45)", option_fov                        \
    }

#endif
