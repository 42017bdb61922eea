/* For tests of drawing on a host's framebuffer: a host with a rectangle of its own in it, and what it should
 * hold afterwards. Every function ends the running test when something fails. */
#ifndef MNS_TESTS_HOST_FIXTURE_H
#define MNS_TESTS_HOST_FIXTURE_H

#include "support/draw_fixture.h"

/* Sizes of the view and of the framebuffer that it is drawn into. */
enum {
    VIEW_WIDE = 120,
    VIEW_HIGH = 90,
    HOST_WIDE = 170,
    HOST_HIGH = 130,
    HOST_PIXELS = HOST_WIDE * HOST_HIGH
};

typedef struct host {
    GLuint framebuffer, color, depth;
} host;

typedef struct host_pixels { /* row 0 at the bottom */
    uint8_t color[HOST_PIXELS][4];
    float depth[HOST_PIXELS];
} host_pixels;

typedef struct host_outcome {
    size_t ours, behind; /* pixels that we drew; that hit, but behind the host */
} host_outcome;

/* A rectangle of the framebuffer that lies inside the view at 23,17: x, y, width, height. */
extern const int host_rectangle[4];

/* The unit cube's cloud of balls, and a view of it. */
mns_field *host_cloud(void);
mns_view host_view(void);

/* A framebuffer with 8-bit colour and a depth of 32 bits, or of 24 with a stencil beside it. */
host host_make(draw_fixture *d, bool stencil);
void host_free(draw_fixture *d, host *h);
/* Paints it magenta at the far plane, and in the rectangle (NULL: none) blue, at depth z along the view. */
void host_paint(draw_fixture *d, const host *h, const int rectangle[4], double z, double near, double far);
/* The whole framebuffer, to be given to free. */
host_pixels *host_read(draw_fixture *d, const host *h);
void host_draw_on(draw_fixture *d, const mns_field *field, const mns_view *view, const mns_target *target);

/* Holds every pixel of the framebuffer, painted as above and drawn on, against the plain draw: the nearer one
 * wins, and colour and depth are the winner's. */
host_outcome host_expect_nearer_wins(const host_pixels *got, const mns_image *plain, const mns_view *view,
                                     const mns_target *target, const int rectangle[4], double z,
                                     double depth_slack);

#endif
