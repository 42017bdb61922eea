/* A renderer and its frames: the GL objects of one context, and one result. */
#ifndef MNS_RENDER_RENDER_H
#define MNS_RENDER_RENDER_H

#include "list/passes.h"
#include "shade/effects.h"
#include "solid/solid_files.h"
#include "tile/tile.h"
#include "trace/passes.h"

/* What colours and materials of balls were sent by; 0 what does not matter. */
typedef struct render_colors {
    uint64_t features;
    size_t column, blend_column;
    double range[2], blend_range[2];
} render_colors;

/* What the sorted and uploaded balls were made from: the same again, and nothing is sorted or uploaded. */
typedef struct render_last {
    const mns_field *field;
    uint64_t stamp; /* of the field: its address may have been used again */
    uint64_t features;
    view_frame frame;
    double origin[3];
    render_colors colors;
    bool low; /* the low words are there too */
} render_last;

/* What the uploaded tree was made from. */
typedef struct render_tree {
    const mns_field *field;
    uint64_t stamp;
    uint64_t features; /* that change what is sent of a ball */
    fbvh_options options;
    bool colored; /* colours are there: */
    render_colors colors;
    bool low;
    fbvh_figures figures;
    size_t references;
} render_tree;

struct mns_renderer {
    gl_device device;
    gl_programs programs;
    list_passes passes;
    list_order order;
    tile_bins bins;
    bool binned; /* the bins are of the balls that are uploaded */
    trace_passes trace;
    trace_worker worker;
    render_tree tree; /* zeroed: none is uploaded */
    gl_buffer shade;
    shade_effects effects;
    solid_files solids;
    render_last last;
    bool disordered; /* lists have come out of order on this driver: sort them before they are cast */
};

struct mns_frame {
    mns_renderer *renderer;
    mns_plan *plan; /* of the last draw; NULL before the first */
    mns_stats stats;
    GLuint t, normal, color, shaded; /* textures; color only with BLENDS */
    GLuint work;                     /* counts of each ray's work, with COUNTERS */
    GLuint lit;                      /* with LIT: colours before the shade pass, linear, premultiplied */
    GLuint terms;   /* and the effects' terms at the first hit: shadow, occlusion, mirror.t, refract.t */
    GLuint mesh;    /* with SOLIDS: 1 + the index of the mesh that is seen, else 0 */
    GLuint settled; /* and 1, or 0 where some ray beyond it was undecided */
    GLuint planes_target, shaded_target, lit_target;
    int width, height;
    int summed;          /* samples that its colours hold; 0 where they are nobody's */
    GLenum color_format; /* of `color`; 0: there is none */
    bool has_work, has_lit, has_mesh;
    float *t_error; /* bound on the error of each distance, row 0 at the top; NULL where the method gives none
                     */
};

/* Makes the frame's textures for a plan. Errors: MEMORY, GL. */
mns_status frame_prepare(mns_frame *frame, const mns_plan *plan, mns_error *error);
/* Floats into a texture of the frame's size, rows from the bottom, whatever rows the host's
 * own textures come in. */
void frame_send(mns_frame *frame, GLuint texture, GLenum format, const float *data);
void frame_send_whole(mns_frame *frame, GLuint texture, const uint32_t *data);
/* Takes the noise of the terms that were read into the frame's figures. */
void frame_measure_noise(mns_frame *frame, const mns_image *image);
/* The planes' distances from the field's unit to the one in which they are told. Errors: MEMORY. */
mns_status frame_leave_unit(mns_frame *frame, const mns_plan *plan, mns_error *error);

#endif
