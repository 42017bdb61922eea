/* For tests of light drawn on the GPU: looks with every effect, and pictures against the truth's, pixel by
 * pixel. Every function ends the running test when something fails. */
#ifndef MNS_TESTS_LIGHT_FIXTURE_H
#define MNS_TESTS_LIGHT_FIXTURE_H

#include "support/draw_fixture.h"

enum { LIGHT_WIDTH = 48, LIGHT_HEIGHT = 36, LIGHT_PIXELS = LIGHT_WIDTH * LIGHT_HEIGHT, LIGHT_LAMPS = 4 };

extern const mns_options light_truth;
extern const mns_view light_view, light_tilted_view; /* of the whole field */

typedef struct light_look {
    const char *name;
    mns_look look;
} light_look;

extern const mns_light light_lamps[LIGHT_LAMPS]; /* of every kind that has a place */
extern const light_look light_hard, light_soft, light_mirror, light_glass;

/* A variant takes seconds to compile: through the second back end go few. */
bool light_is_second(const draw_fixture *d);

/* Of pixel i of two pictures of one look: that some term beyond the first hit is undecided in either, that
 * terms differ (distances by more than `length`), that colours do. */
bool light_is_open(const mns_image *got, const mns_image *want, int i);
bool light_terms_differ(const mns_image *got, const mns_image *want, int i, double length);
bool light_colors_differ(const mns_image *got, const mns_image *want, int i, double allowed);
/* That value i of a plane differs; planes that are not there are alike. */
bool light_differs(const float *got, const float *want, int i, double allowed);

typedef struct light_tally {
    int hits, open, wrong, off; /* pixels: hit, undecided by either, of another term, of another colour */
} light_tally;

light_tally light_compare(const mns_image *got, const mns_image *want, double length, double color);

/* No term is wrong, but few pixels are open, and of the others all but `off` have the truth's colour. A
 * float's ray may pass on the other side of an edge that it meets deep in a path; there a pixel of glass may
 * be off. */
void light_expect_truth(draw_fixture *d, const mns_field *field, const mns_view *view, const light_look *look,
                        const mns_options *options, double length, int off, const char *what);

#endif
