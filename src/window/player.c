#include "window/player.h"

#include "base/clock.h"
#include "base/status.h"

#include <omp.h>
#include <string.h>

/* Reads what is asked for, with the lock given up meanwhile. */
static void read_asked(player *p)
{
    mns_field *field = NULL;
    mns_error error = {0};
    long frame = p->reading = p->asked;
    p->asked = -1;
    pthread_mutex_unlock(&p->lock);
    double start = clock_ms();
    mns_status status = mns_input_read(p->input, (size_t)frame, &field, &error);
    double ms = clock_ms() - start;
    pthread_mutex_lock(&p->lock);
    mns_field_destroy(p->field); /* one that nobody took */
    p->field = field;
    p->ready = frame;
    p->reading = -1;
    p->ms = ms;
    p->status = status;
    p->error = error;
}

static void *work(void *context)
{
    player *p = context;
    if (p->threads) omp_set_num_threads(p->threads);
    pthread_mutex_lock(&p->lock);
    while (!p->stop) {
        if (p->asked < 0) {
            pthread_cond_wait(&p->changed, &p->lock);
            continue;
        }
        read_asked(p);
        p->wake();
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

mns_status player_open(player *p, mns_input *input, void (*wake)(void), int threads, mns_error *error)
{
    memset(p, 0, sizeof *p);
    p->input = input;
    p->wake = wake;
    p->threads = threads;
    p->asked = p->reading = p->ready = -1;
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->changed, NULL);
    p->running = pthread_create(&p->thread, NULL, work, p) == 0;
    return p->running ? MNS_OK : status_no_memory(error, "starting the thread that reads frames");
}

void player_close(player *p)
{
    if (!p->input) return;
    if (p->running) {
        pthread_mutex_lock(&p->lock);
        p->stop = true;
        pthread_cond_signal(&p->changed);
        pthread_mutex_unlock(&p->lock);
        pthread_join(p->thread, NULL);
    }
    pthread_cond_destroy(&p->changed);
    pthread_mutex_destroy(&p->lock);
    mns_field_destroy(p->field);
    mns_input_close(p->input);
    memset(p, 0, sizeof *p);
}

void player_ask(player *p, long frame)
{
    pthread_mutex_lock(&p->lock);
    p->asked = p->reading == frame ? -1 : frame; /* what was asked for before is wanted no more */
    if (p->asked >= 0) pthread_cond_signal(&p->changed);
    pthread_mutex_unlock(&p->lock);
}

long player_busy(player *p)
{
    pthread_mutex_lock(&p->lock);
    long frame = p->asked >= 0 ? p->asked : p->reading >= 0 ? p->reading : p->ready;
    pthread_mutex_unlock(&p->lock);
    return frame;
}

bool player_take(player *p, long *frame, mns_field **field, double *ms, mns_status *status, mns_error *error)
{
    pthread_mutex_lock(&p->lock);
    bool is_there = p->ready >= 0;
    if (is_there) {
        *frame = p->ready;
        *field = p->field;
        *ms = p->ms;
        *status = p->status;
        *error = p->error;
        p->ready = -1;
        p->field = NULL;
    }
    pthread_mutex_unlock(&p->lock);
    return is_there;
}
