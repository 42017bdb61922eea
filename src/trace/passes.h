/* The GL objects and passes of the tree methods. */
#ifndef MNS_TRACE_PASSES_H
#define MNS_TRACE_PASSES_H

#include "list/passes.h"
#include "trace/blocks.h"
#include "trace/pack.h"
#include "trace/worker.h"

/* Zeroed is empty. Beside these the list's passes hold what all methods have: the view, the redo list, a
 * host's depth. */
typedef struct trace_passes {
    gl_buffer balls, balls_low, colors, pairs, leaves, references, block_list;
    GLuint ball_texels, pair_texels, leaf_texels, reference_texels; /* buffer textures (TEXELS) */
    trace_grid grid;
    trace_blocks blocks;
    uint32_t *index; /* of the uploaded balls, in the field */
    size_t count, index_capacity;
} trace_passes;

/* Sends a tree; colours are sent apart. Errors: MEMORY, UNSUPPORTED. */
mns_status trace_upload(trace_passes *t, gl_device *device, const mns_plan *plan, const fbvh_tree *tree,
                        mns_error *error);
mns_status trace_upload_colors(trace_passes *t, gl_device *device, const mns_plan *plan,
                               const mns_field *field, mns_error *error);
/* The low words of the uploaded balls. Errors: MEMORY. */
mns_status trace_upload_low(trace_passes *t, gl_device *device, const mns_plan *plan, const mns_field *field,
                            mns_error *error);

/* For whoever traces through the tree: binds it and the list of pixels to be done again; tells a program of
 * it, which is then in use; waits for what was dispatched, and reads the list's counts. */
void trace_bind(trace_passes *t, list_passes *p, gl_device *device, const mns_plan *plan);
void trace_use(const trace_passes *t, gl_device *device, GLuint program);
void trace_finish(list_passes *p, gl_device *device, list_counts *counts);

/* Planes: t, normal, color or 0, counts or 0. */
enum { TRACE_PLANES = 4 };

/* Traces a region into the planes, `target` being the framebuffer of the first three, and tells what is left
 * to resolve. Errors: MEMORY. */
mns_status trace_cast(trace_passes *t, list_passes *p, gl_device *device, const mns_plan *plan,
                      GLuint program, GLuint target, const GLuint plane[TRACE_PLANES], list_region region,
                      list_counts *counts, mns_error *error);
/* As list_resolve. */
void trace_resolve(trace_passes *t, list_passes *p, gl_device *device, const mns_plan *plan, GLuint program,
                   bool wide, const GLuint plane[TRACE_PLANES], list_counts *counts);
void trace_passes_free(trace_passes *t, gl_device *device);

#endif
