/* A renderer and its frames: the GL objects of one context, and one result. */
#ifndef MNS_RENDER_RENDER_H
#define MNS_RENDER_RENDER_H

#include "list/passes.h"
#include "tile/tile.h"

/* What the sorted and uploaded balls were made from: the same again, and nothing is sorted or uploaded. */
typedef struct render_last {
    const mns_field *field;
    uint64_t stamp; /* of the field: its address may have been used again */
    uint64_t features;
    view_frame frame;
    double origin[3];
    size_t color_column;
    double color_range[2];
    bool low; /* the low words are there too */
} render_last;

struct mns_renderer {
    gl_device device;
    gl_programs programs;
    list_passes passes;
    list_order order;
    tile_bins bins;
    bool binned; /* the bins are of the balls that are uploaded */
    gl_buffer shade;
    render_last last;
    bool disordered; /* lists have come out of order on this driver: sort them before they are cast */
};

struct mns_frame {
    mns_renderer *renderer;
    mns_plan *plan; /* of the last draw; NULL before the first */
    mns_stats stats;
    GLuint t, normal, color, shaded; /* textures; color only with COLORS */
    GLuint planes_target, shaded_target;
    int width, height;
    bool has_color;
    float *t_error; /* bound on the error of each distance, row 0 at the top; NULL where the method gives none
                     */
};

/* Makes the frame's textures for a plan. Errors: MEMORY, GL. */
mns_status frame_prepare(mns_frame *frame, const mns_plan *plan, mns_error *error);

#endif
