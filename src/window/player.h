/* Reads frames of a sequence on a thread of its own, ahead of what is shown: at most the frame that is read
 * and the one that was not taken yet are held. */
#ifndef MNS_WINDOW_PLAYER_H
#define MNS_WINDOW_PLAYER_H

#include "meniscus.h"

#include <pthread.h>

typedef struct player {
    mns_input *input;   /* used by the thread alone, from the first frame asked for on */
    void (*wake)(void); /* called from the thread when a frame is there */
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool running, stop;
    int threads;      /* that reading may use; 0: OpenMP's own choice */
    long asked;       /* -1: nothing */
    long reading;     /* -1: nothing */
    long ready;       /* the frame that `field` or `status` is of; -1: none */
    mns_field *field; /* NULL where it could not be read */
    double ms;        /* that reading it took */
    mns_status status;
    mns_error error;
} player;

/* Takes the input over, and starts the thread, which reads on so many. Errors: MEMORY. */
mns_status player_open(player *p, mns_input *input, void (*wake)(void), int threads, mns_error *error);
/* Ends the thread, after the frame that it reads, and closes the input; zeroed is nothing. */
void player_close(player *p);

/* Asks for a frame; what was asked for before and is not being read yet is forgotten. */
void player_ask(player *p, long frame);
/* The frame that is asked for, being read, or ready; -1: none. */
long player_busy(player *p);
/* A frame that is there, for the caller to destroy; false: none yet. Where it could not be read *field is
 * NULL, and *status says why. */
bool player_take(player *p, long *frame, mns_field **field, double *ms, mns_status *status, mns_error *error);

#endif
