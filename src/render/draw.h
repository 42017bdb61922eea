/* The state of one draw, handed from step to step, and the steps that live in files of their own. */
#ifndef MNS_RENDER_DRAW_H
#define MNS_RENDER_DRAW_H

#include "list/lengths.h"
#include "list/uniforms.h"
#include "render/render.h"

/* What a draw by the reference keeps from sample to sample; rows run from the bottom, as GL's. */
typedef struct draw_tracer {
    mns_reference *reference;
    float *t, *normal, *color; /* 2, 4 and 4 floats a pixel; color only with BLENDS */
    float (*label)[3];         /* linear colours of the column's labels (LABELS) */
    struct effects_scene *effects;
    float *lit, *terms, *settled; /* 4, 4 and 1 floats a pixel, with LIT: see mns_frame */
    uint32_t *mesh;               /* with SOLIDS */
} draw_tracer;

typedef struct draw {
    mns_renderer *r;
    const mns_field *field;
    const mns_plan *plan;
    const mns_target *target; /* NULL without a host */
    mns_frame *frame;
    mns_stats *stats;
    GLuint program[SHADER_COUNT];
    list_lengths lengths;
    draw_tracer tracer;
    int sample; /* of the pixels', which is being drawn */
    double wide[VIEW_VECTORS * 4];
    double last_mark,
        spent; /* clock at the last mark; milliseconds spent on figures and compilers, not on the frame */
} draw;

/* Closes a phase: what ran since the last mark is its time. */
void draw_mark(draw *d, mns_phase phase);
/* What ran since the last mark is no part of the frame. */
void draw_pause(draw *d);
void draw_send(draw *d, gl_buffer *buffer, const void *data, size_t size);

/* balls.c: what colours and materials of balls are sent by. */
render_colors draw_colors_of(const mns_plan *plan);
/* Sorts the balls in view, and uploads them but for tiles, unless they are there already. Errors:
 * MEMORY, UNSUPPORTED.
 */
mns_status draw_balls_upload(draw *d, mns_error *error);
/* Sends what the passes read of the balls: all in view, or those of the tiles' lists. Errors: MEMORY,
 * UNSUPPORTED. */
mns_status draw_balls_send(draw *d, mns_error *error);
/* The low words of the balls and the view in doubles, when the first pixel needs them. */
mns_status draw_low_upload(draw *d, mns_error *error);

/* reference.c: makes the tracer; traces one sample of every pixel into the planes, and counts; drops the
 * tracer, also one half made. Errors: MEMORY. */
mns_status draw_reference_begin(draw *d, mns_error *error);
mns_status draw_reference_sample(draw *d, const double jitter[2], mns_error *error);
void draw_reference_end(draw *d);

/* A program that only some frames come to need: compiled when one does. What ran before counts to `phase`. */
mns_status draw_late_program(draw *d, plan_shader which, mns_phase phase, mns_error *error);
/* The view in doubles, to its uniform block. Errors: MEMORY, GL. */
mns_status draw_wide_view(draw *d, mns_error *error);

/* trace.c: builds (or takes, where it was built ahead) and uploads the tree, unless it is there already;
 * traces one sample of every pixel into the planes. Errors: MEMORY, UNSUPPORTED, GL. */
mns_status draw_tree_begin(draw *d, mns_error *error);
mns_status draw_tree_sample(draw *d, mns_error *error);
/* The low words of the tree's balls and the view in doubles. What ran before counts to `phase`. Errors:
 * MEMORY, GL. */
mns_status draw_tree_low(draw *d, mns_phase phase, mns_error *error);

/* effects.c: the meshes of the look, read where they are not there yet. Errors: as solid_read. */
mns_status draw_solids_begin(draw *d, mns_error *error);
/* What a frame's light beyond the first hit needs, a list's tree among it; one sample's light,
 * from the planes that are there. Errors: MEMORY, UNSUPPORTED, GL; of the environment's file. */
mns_status draw_effects_begin(draw *d, mns_error *error);
mns_status draw_effects_sample(draw *d, const double jitter[2], mns_error *error);

/* lists.c: gives every pixel of a region its list. *fits: false where they pass what the driver's blocks
 * hold. Errors: MEMORY, GL. */
mns_status draw_lists(draw *d, list_region region, bool *fits, mns_error *error);

/* figures.c */
void draw_stats_start(draw *d);
void draw_counts_add(mns_stats *stats, const list_counts *counts);
uint64_t draw_buffers_count(const mns_renderer *r);
/* Hit pixels, read back: only when figures were asked for. Errors: MEMORY. */
mns_status draw_hits_count(draw *d, mns_error *error);
/* Means of the rays' work, read back (COUNTERS). Errors: MEMORY. */
mns_status draw_work_count(draw *d, mns_error *error);

#endif
