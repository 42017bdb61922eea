/* Puts pictures on the window: one full-screen draw into the default framebuffer. */
#ifndef MNS_WINDOW_SCREEN_H
#define MNS_WINDOW_SCREEN_H

#include "meniscus.h"

#include <glad/gl.h>

typedef struct screen {
    GladGLContext gl;
    GLuint program, vertex_array, sampler[2]; /* nearest, linear */
    GLuint read_target;
    GLuint small, small_target; /* a picture with fewer pixels than the window, as it will be seen */
    int small_width, small_height;
} screen;

/* A drawn frame as it goes on the window. */
typedef struct screen_picture {
    const mns_frame *frame; /* NULL: there is none */
    double gain;            /* times the colours: samples that are wanted by samples that are summed */
    double t_unit;
} screen_picture;

typedef enum screen_mode { SCREEN_A = 0, SCREEN_B, SCREEN_DIVIDER, SCREEN_DIFFERENCE } screen_mode;

typedef struct screen_desc {
    screen_picture a, b; /* b only where the mode shows it */
    screen_mode mode;
    int width, height;             /* of the window's framebuffer */
    double place;                  /* of the divider, from the left, pixels */
    double line;                   /* its half width, pixels */
    double scale;                  /* difference in scene units that is shown in full */
    int drawn_width, drawn_height; /* of the pictures: smaller than the window while it moves */
} screen_desc;

/* Loads the functions of the current context and makes what drawing needs; zeroed is nothing. Errors: GL. */
mns_status screen_open(screen *s, mns_get_proc get_proc, mns_error *error);
void screen_close(screen *s);

void screen_show(screen *s, const screen_desc *desc);

/* Distance at a pixel of a frame of that size, counted from the top left; INFINITY on a miss. In t_unit. */
double screen_distance(screen *s, const mns_frame *frame, int width, int height, int x, int y);

/* What is in the window now, as it is before the buffers are swapped. Errors: MEMORY, IO, USAGE. */
mns_status screen_grab(screen *s, int width, int height, const char *path, mns_error *error);

/* The first GL error pending, with `where`. Errors: GL. */
mns_status screen_check(screen *s, const char *where, mns_error *error);

#endif
