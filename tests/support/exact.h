/* Fields at random, and a picture of one held against the oracle: what every exact method is tested by. */
#ifndef MNS_TESTS_EXACT_H
#define MNS_TESTS_EXACT_H

#include "support/brute_image.h"
#include "support/draw_fixture.h"

enum { EXACT_WIDE = 160, EXACT_HIGH = 120 };

/* Parts of a field that is made at random: the unit cube around `offset`. */
typedef struct cloud {
    size_t count; /* at most 2000 */
    double offset;
    double radius_low, radius_high;     /* log-uniform; equal: one radius for all */
    double strength_low, strength_high; /* uniform, both 0: 1 */
} cloud;

extern const cloud cloud_plain, cloud_radii, cloud_signs, cloud_moved;

mns_field *cloud_field(const cloud *c, mns_kernel kernel);

/* A little above the unit cube, looking at its middle. */
mns_view exact_view(void);

/* A point of the field where f is on the wanted side of L, and some ball is near. */
void exact_eye(const mns_field *field, bool inside, double eye[3]);

/* Draws by `options` (NULL: the defaults) and compares: no missed, no invented, no later root, and the
 * design's bounds on t (2e-6 of it at p99.9: a float's rounding of t, of the ray and of the positions, about
 * 2^-22 each) and on normals (a tenth of a degree). What fails ends the running test. */
brute_report exact_expect(draw_fixture *d, const mns_options *options, const char *what,
                          const mns_field *field, const mns_view *view);
/* The same of a cloud, of which a quarter of the rays must hit. */
void exact_expect_cloud(draw_fixture *d, const mns_options *options, const char *what, const cloud *c,
                        mns_kernel kernel, const mns_view *view);

/* From one kernel to the next that a back end is tested with: both back ends have the same rasteriser behind
 * them, and compiling the variants takes longest; through the second one, a kernel of either kind of search
 * is enough. */
int exact_kernel_step(const draw_fixture *d);

#endif
