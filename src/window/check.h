/* The error of the picture that is shown, against the certified tracer: traced on a thread, in doubles. */
#ifndef MNS_WINDOW_CHECK_H
#define MNS_WINDOW_CHECK_H

#include "compare/metrics.h"

#include <pthread.h>
#include <stdatomic.h>

typedef enum check_state { CHECK_NONE = 0, CHECK_RUNS, CHECK_DONE, CHECK_FAILED } check_state;

typedef struct check {
    pthread_t thread;
    bool running;     /* the thread is to be joined */
    atomic_bool stop; /* it shall end at its next row */
    atomic_int state; /* a check_state */
    atomic_int rows;  /* traced so far */
    /* what it works on, its own but for the field */
    const mns_field *field;
    mns_view view;
    mns_image *image[2]; /* the sides' pictures; the second may be NULL */
    void (*wake)(void);
    int threads; /* it may use; 0: OpenMP's own choice */
    /* what came of it */
    metrics result[2];
    double ms;
    mns_error error;
} check;

/* Begins, on so many threads; takes the images over. The field must stay until check_stop. Errors: MEMORY. */
mns_status check_begin(check *c, const mns_field *field, const mns_view *view, mns_image *const image[2],
                       void (*wake)(void), int threads, mns_error *error);
/* Ends the thread, and forgets what it found; zeroed is nothing. */
void check_stop(check *c);
/* What was found is of another picture: forgets it, or sees to it that it is not found. Does not wait. */
void check_forget(check *c);
/* Where it is; joins a thread that has come to its end. */
check_state check_poll(check *c);
/* Where it was when it was last polled. */
check_state check_last(const check *c);
/* What a side came to in one line. */
void check_text(const check *c, int side, char *text, size_t size);

#endif
