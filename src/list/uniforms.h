/* The uniform blocks of glsl/view.glsl and glsl/far.glsl. */
#ifndef MNS_LIST_UNIFORMS_H
#define MNS_LIST_UNIFORMS_H

#include "gl/device.h"
#include "plan/plan.h"

enum { VIEW_VECTORS = 16, FAR_VECTORS = 4 };

/* The View block as doubles (resolve reads it so) and as floats (all others), in the order of the GLSL.
 * jitter: of the sample, in pixels from the centre. host: near, far, x, y of a mns_target, or NULL. */
void list_view_block(const mns_plan *plan, const mns_field *field, const double jitter[2],
                     const mns_target *host, double wide[VIEW_VECTORS * 4], float narrow[VIEW_VECTORS * 4]);
/* The same to the program in use, where it reads them as uniforms of their own (VIEW_LOOSE). */
void list_view_loose(const gl_device *device, const float narrow[VIEW_VECTORS * 4]);
void list_far_block(const mns_plan *plan, double block[FAR_VECTORS * 4]);

/* Offset of sample `index` of `count` from the pixel's centre, in pixels: within half a pixel, the same for
 * every pixel. Sample 0 of 1 is the centre. Additive recurrence of the plastic number (Roberts 2018). */
void list_jitter(int index, int count, double jitter[2]);

#endif
