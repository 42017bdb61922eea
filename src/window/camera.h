/* A camera that a hand moves: pure functions on where it is, with no window and no clock. Angles are radians;
 * lengths are scene units; `up` stays what is up in the scene, so that the horizon stays level. */
#ifndef MNS_WINDOW_CAMERA_H
#define MNS_WINDOW_CAMERA_H

#include "base/vec.h"
#include "meniscus.h"

typedef struct camera {
    vec3 eye, target, up; /* `up` is a unit vector */
    double fov;           /* vertical, degrees */
} camera;

/* Of a resolved view; and back into `view`, which keeps its size. */
camera camera_of(const mns_view *view);
void camera_put(const camera *c, mns_view *view);

/* The eye goes around the target: by `across` to the left around `up`, by `over` upwards; it stops just short
 * of the pole. */
void camera_orbit(camera *c, double across, double over);
/* The look turns about the eye: to the right, upwards; as camera_orbit near the pole. */
void camera_turn(camera *c, double right, double upwards);
/* Eye and target move together, by parts of the frame's height at the target: to the right, upwards. */
void camera_pan(camera *c, double right, double upwards);
/* Eye and target come nearer to `towards` by `factor` (below 1: nearer), which keeps its place in the frame.
 */
void camera_zoom(camera *c, double factor, vec3 towards);
/* Eye and target move along the camera's own axes, by scene units. */
void camera_fly(camera *c, double right, double upwards, double forward);
/* The target becomes `point`, and the eye moves along with it. */
void camera_centre(camera *c, vec3 point);
/* The eye moves along the view so that the box fits a frame of that width to height. */
void camera_fit(camera *c, const double lo[3], const double hi[3], double aspect);
/* Looks along an axis at the same target from the same distance: "front" (along -z), "back", "left", "right",
 * "top", "bottom". False where there is no such side. */
bool camera_stand(camera *c, const char *side);
/* The field of view becomes `fov`, kept within 1 and 170 degrees, what is at the target keeping its size. */
void camera_widen(camera *c, double fov);

/* The unit vectors of the frame. */
void camera_axes(const camera *c, vec3 *right, vec3 *up, vec3 *forward);

#endif
