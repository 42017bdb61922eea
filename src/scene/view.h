/* The pinhole camera: what a view leaves open is fitted to the field, and pixels become rays. */
#ifndef MNS_SCENE_VIEW_H
#define MNS_SCENE_VIEW_H

#include "base/vec.h"
#include "meniscus.h"

/* A fitted box stays this fraction of the frame's half width and half height away from its edges. */
#define VIEW_MARGIN 0.04
/* Pixels a side, at most. */
#define VIEW_MAX_SIZE 65536

/* A resolved view as an orthonormal frame: right x up = -forward. */
typedef struct view_frame {
    vec3 eye, right, up, forward;
    double tan_half; /* of half the vertical field of view */
    int width, height;
} view_frame;

/* The frame of a view that mns_view_resolve has accepted. */
void view_basis(const mns_view *resolved, view_frame *frame);

/* Unit direction of the ray through the image point (px, py) in pixels: (0, 0) is the top left corner of the
 * frame, and the centre of pixel (x, y) is (x + 0.5, y + 0.5). */
vec3 view_direction(const view_frame *frame, double px, double py);

#endif
