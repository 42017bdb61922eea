/* For tests that draw: a context with a renderer and a frame, fields by formula, pictures and their bits.
 * Every function ends the running test when something fails. */
#ifndef MNS_TESTS_DRAW_FIXTURE_H
#define MNS_TESTS_DRAW_FIXTURE_H

#include "support/gl_fixture.h"

typedef struct draw_fixture {
    gl_fixture gl;
    mns_renderer *renderer;
    mns_frame *frame;
    mns_stats stats; /* of the last draw */
} draw_fixture;

/* setup and teardown for cmocka: *state is the draw_fixture. No shader comes from a cache on disk, so that
 * the driver's complaints about each are heard; the teardown fails on any complaint and on a pending GL
 * error. */
int draw_fixture_setup(void **state);
int draw_fixture_teardown(void **state);

/* Fails if GL has an error pending, or the driver gave a message of medium or high severity. */
void draw_fixture_check(draw_fixture *d);

/* The options (NULL: defaults), by lists where they name no method: what a test is of does not hang on what
 * the plan would choose. */
mns_options draw_by_lists(const mns_options *options);

/* Draws and reads back; free by mns_image_destroy. view, look and options may be NULL; without a method: by
 * lists. */
mns_image *draw_image(draw_fixture *d, const mns_field *field, const mns_view *view, const mns_look *look,
                      const mns_options *options);

/* A field by a generator's specification; one of the host's packed arrays x,y,z and, where not NULL, radius
 * and strength; free by mns_field_destroy. */
mns_field *draw_generated(const char *spec, mns_kernel kernel);
mns_field *draw_field(size_t count, const double *position, const double *radius, double uniform_radius,
                      const double *strength, mns_kernel kernel);

/* A view from eye to look_at, fov in degrees. */
mns_view draw_view(const double eye[3], const double look_at[3], double fov, int width, int height);

/* All planes that both have and the colours are the same, bit for bit; `what` is named on failure. */
void draw_expect_same(const mns_image *a, const mns_image *b, const char *what);
size_t draw_count_hits(const mns_image *image);

/* In [0, 1): the next of a sequence. */
double draw_random(uint64_t *state);

#endif
