/* The options of `meniscus render`. */
#include "app/render.h"

#include "app/app.h"
#include "app/look_options.h"

#include <stdlib.h>
#include <string.h>

/* ---- Frame and camera ---- */

mns_status option_size(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_size(name, text, &o->view.width, &o->view.height, error);
}

mns_status option_eye(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->view.set |= MNS_VIEW_EYE;
    return parse_point(name, text, o->view.eye, error);
}

mns_status option_look_at(app_options *o, const char *name, const char *text, mns_error *error)
{
    o->view.set |= MNS_VIEW_LOOK_AT;
    return parse_point(name, text, o->view.look_at, error);
}

mns_status option_up(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_direction(name, text, o->view.up, error);
}

mns_status option_fov(app_options *o, const char *name, const char *text, mns_error *error)
{
    static const char expected[] = "degrees between 0 and 180, both excluded";
    mns_status status = parse_numbers(name, text, ',', 1, &o->view.fov, expected, error);
    if (!status && !(o->view.fov > 0 && o->view.fov < 180))
        return app_fail(error, MNS_ERROR_USAGE, "%s %.80s: expected %s", name, text, expected);
    return status;
}

/* ---- Output and measurement ---- */

static mns_status option_samples(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_count(name, text, 64, &o->draw.samples, error);
}

mns_status option_output(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)error;
    o->output = text;
    return MNS_OK;
}

static mns_status option_aov(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)error;
    o->aov = text;
    return MNS_OK;
}

static mns_status option_heat(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)error;
    o->heat = text;
    o->draw.counters = true;
    return MNS_OK;
}

static mns_status option_stats(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)error;
    o->stats = text;
    o->draw.measure = true;
    return MNS_OK;
}

static mns_status option_repeat(app_options *o, const char *name, const char *text, mns_error *error)
{
    mns_status status = parse_count(name, text, 1000000, &o->repeat, error);
    return status;
}

static mns_status option_moving(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)text, (void)error;
    o->draw.moved = true;
    return MNS_OK;
}

static mns_status option_explain(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)text, (void)error;
    o->explain = true;
    return MNS_OK;
}

/* ---- Tests and diagnosis ---- */

static mns_status option_pool(app_options *o, const char *name, const char *text, mns_error *error)
{
    long nodes;
    mns_status status = parse_whole(name, text, 1, LONG_MAX, &nodes, error);
    if (!status) o->draw.max_pool_nodes = (size_t)nodes;
    return status;
}

static mns_status option_slots(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_count(name, text, 1024, &o->draw.slots, error);
}

static mns_status option_root_steps(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_count(name, text, 4096, &o->draw.root_steps, error);
}

static mns_status option_shuffle(app_options *o, const char *name, const char *text, mns_error *error)
{
    long seed;
    mns_status status = parse_whole(name, text, 1, UINT32_MAX, &seed, error);
    if (!status) o->draw.shuffle = (uint32_t)seed;
    return status;
}

/* ---- The table ---- */

#define HEADING(text)                                                                                        \
    {                                                                                                        \
        NULL, 0, NULL, text, NULL                                                                            \
    }

static const option_row ROWS[] = {
    HEADING("Output:"),
    {"output", 'o', "FILE", "the image, .png or .exr; with %04d in its name, a file a frame", option_output},
    {"aov", 0, "FILE.exr", "also write t, t.lo, N.X N.Y N.Z and certain, lossless, beside R G B A",
     option_aov},
    {"size", 0, "WxH", "pixels (default 1024x768)", option_size},
    {"frame", 0, "A[:B[:STEP]]",
     "frames of the input, from 0 (default: 0, or all where the output's name is numbered)", option_frame},
    {"background", 0, "COLOR", "R,G,B[,A] in [0, 1], #rrggbb[aa] or transparent (default 1,1,1)",
     option_background},
    {"aa", 0, "N", "samples a pixel for colour, 1 to 64 (default 1)", option_samples},
    OPTIONS_OF_FIELD,
    OPTIONS_OF_CAMERA,
    OPTIONS_OF_LOOK,
    OPTIONS_OF_EFFECTS,
    HEADING("Method:"),
    {"method", 0, "NAME",
     "auto (the default: the plan picks), list, tile (lists a tile of pixels long, binned on the CPU: "
     "quicker on a software renderer), fbvh (a tree of boxes fitted to the balls), bvh (one whose leaves "
     "overlap) "
     "or reference (slow, on the CPU, certified)",
     option_method},
    {"solver", 0, "NAME",
     "exact (the default); of list and tile: cubic or cubic-monomial; of fbvh and bvh: secant",
     option_solver},
    {"secant-steps", 0, "N", "most steps of the solver secant (default 16)", option_secant_steps},
    {"tree", 0, "LIST",
     "how fbvh, bvh and the tree of later rays are built: cost-n, no-fit, no-tight, no-discard, "
     "leaf-least=N, ... (README)",
     option_tree},
    {"gather", 0, "NAME", "early-z (the default) or paper, the passes as published", option_gather},
    {"backend", 0, "NAME", "auto (the default: the first that starts), egl, osmesa or glfw", option_backend},
    {"threads", 0, "N", "threads on the CPU (default: one a core)", option_threads},
    {"no-cache", 0, NULL,
     "compile every program; else they are kept under $XDG_CACHE_HOME/meniscus/programs where the driver "
     "gives them away",
     option_no_cache},
    HEADING("Measurement:"),
    {"stats", 0, "FILE.json", "write times, counts, and what was left out", option_stats},
    {"repeat", 0, "N", "draw each frame N times; --stats gets the first and the median", option_repeat},
    {"moving", 0, NULL, "take every position as changed before each draw: nothing is reused", option_moving},
    {"counters", 0, NULL,
     "of fbvh and bvh: count a ray's work; --stats gets the means, --aov and -o FILE.exr channels of their "
     "own",
     option_counters},
    {"heat", 0, "FILE", "with --counters: the rounds of solving a pixel as a picture, by --color-map",
     option_heat},
    {"explain", 0, NULL, "print the plan and stop", option_explain},
    HEADING("Tests and diagnosis (slower; the image stays right):"),
    {"pool", 0, "N", "at most N list nodes at once; the frame is cut into tiles to fit", option_pool},
    {"slots", 0, "N", "balls of a ray at once before the slow path", option_slots},
    {"root-steps", 0, "N", "steps of a root search before the slow path", option_root_steps},
    {"shuffle", 0, "SEED", "put the gathered lists in a random order", option_shuffle},
};

const option_table RENDER_OPTIONS = {
    .command = "render",
    .arguments = "INPUT... -o FILE",
    .doc =
        "Draws the surface of INPUT: a particle file, several of them as one sequence, a generator such as "
        "tornado:4000 (name:count[:seed[:frames]]), or a scene, FILE.json, over which options prevail.",
    .rows = ROWS,
    .count = sizeof ROWS / sizeof *ROWS,
};
