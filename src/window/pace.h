/* How large a picture is drawn while it moves: the resolution drops until a frame takes no longer than it
 * may, and comes back by itself. Pure: it is told what a frame took. */
#ifndef MNS_WINDOW_PACE_H
#define MNS_WINDOW_PACE_H

typedef struct pace {
    double target_ms; /* what a frame may take */
    int step;         /* the scale in steps of 1/PACE_STEPS */
    double fixed_ms; /* what of a frame hangs on no pixel, such as sorting the balls; as far as it is known */
    double last_ms;  /* of the frame before, drawn at: */
    int last_step;
} pace;

enum { PACE_STEPS = 16, PACE_LEAST = 3 };

/* Begins at the full resolution; 30 frames a second on a software renderer, else 60. */
void pace_begin(pace *p, int is_software);
/* A moving frame, drawn at the present scale, took `ms`. */
void pace_drawn(pace *p, double ms);
/* The whole frame takes so long, of which a part hangs on no pixel: no larger than may be. */
void pace_expect(pace *p, double whole_ms, double fixed_ms);
/* The part of each side of the frame that is drawn, in (0, 1]. */
double pace_scale(const pace *p);
/* One side of a frame at that scale, at least 1; and at a scale of so many steps. */
int pace_size(const pace *p, int full);
int pace_size_at(int step, int full);

#endif
