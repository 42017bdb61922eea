#include "window/check.h"

#include "base/clock.h"
#include "base/status.h"
#include "image/image.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

static void tell_rows(void *context, int done, int rows)
{
    (void)rows;
    check *c = context;
    /* Seldom: each redraws the window. */
    if (atomic_exchange(&c->rows, done) / 64 != done / 64) c->wake();
}

/* What the truth of the field does not know: where a mesh is seen there is nothing to tell. */
static void leave_out_meshes(truth_planes *truth, const mns_image *image)
{
    size_t pixels = (size_t)truth->width * (size_t)truth->height;
    for (size_t i = 0; image->mesh && i < pixels; i++) {
        if (image->mesh[i] == 0) continue;
        truth->t[i] = image_distance(image, i);
        truth->t_error[i] = truth->radius[i] = 0;
        truth->certain[i] = 0;
        for (size_t c = 3 * i; c < 3 * i + 3; c++) truth->normal[c] = (double)image->normal[c];
    }
}

static void *work(void *context)
{
    check *c = context;
    if (c->threads) omp_set_num_threads(c->threads);
    const truth_desc desc = {.field = c->field,
                             .view = &c->view,
                             .use_cache = true,
                             .progress = tell_rows,
                             .context = c,
                             .stop = &c->stop};
    truth_planes *truth = NULL;
    double start = clock_ms();
    mns_status status = truth_create(&desc, &truth, &c->error);
    c->ms = clock_ms() - start;
    for (int i = 0; i < 2 && !status; i++)
        if (c->image[i]) leave_out_meshes(truth, c->image[i]);
    for (int i = 0; i < 2 && !status; i++)
        if (c->image[i]) status = metrics_measure(truth, c->image[i], NULL, 0, &c->result[i], &c->error);
    truth_destroy(truth);
    atomic_store(&c->state, status ? CHECK_FAILED : CHECK_DONE);
    c->wake();
    return NULL;
}

static void join(check *c)
{
    if (c->running) pthread_join(c->thread, NULL);
    c->running = false;
    for (int i = 0; i < 2; i++) {
        mns_image_destroy(c->image[i]);
        c->image[i] = NULL;
    }
}

mns_status check_begin(check *c, const mns_field *field, const mns_view *view, mns_image *const image[2],
                       void (*wake)(void), int threads, mns_error *error)
{
    check_stop(c);
    c->field = field;
    c->view = *view;
    c->wake = wake;
    c->threads = threads;
    atomic_store(&c->state, CHECK_RUNS);
    for (int i = 0; i < 2; i++) c->image[i] = image[i];
    c->running = pthread_create(&c->thread, NULL, work, c) == 0;
    if (c->running) return MNS_OK;
    join(c);
    atomic_store(&c->state, CHECK_NONE);
    return status_no_memory(error, "starting the thread that traces the truth");
}

void check_stop(check *c)
{
    atomic_store(&c->stop, true);
    join(c);
    atomic_store(&c->stop, false);
    atomic_store(&c->rows, 0);
    atomic_store(&c->state, CHECK_NONE);
    memset(c->result, 0, sizeof c->result);
}

void check_forget(check *c)
{
    if (c->running)
        atomic_store(&c->stop, true); /* it ends as one that failed */
    else
        atomic_store(&c->state, CHECK_NONE);
}

check_state check_poll(check *c)
{
    check_state state = (check_state)atomic_load(&c->state);
    if (c->running && (state == CHECK_DONE || state == CHECK_FAILED)) {
        bool forgotten = atomic_load(&c->stop);
        join(c);
        if (!forgotten) return state;
        check_stop(c);
        return CHECK_NONE;
    }
    return state;
}

check_state check_last(const check *c)
{
    if (c->running) return atomic_load(&c->stop) ? CHECK_NONE : CHECK_RUNS;
    return (check_state)atomic_load(&c->state);
}

void check_text(const check *c, int side, char *text, size_t size)
{
    const metrics *m = &c->result[side];
    snprintf(
        text, size,
        "against the reference: %zu missed, %zu invented, %zu wrong roots, |t-t*|/t* median %.2g, p99 %.2g, "
        "normals p99 %.2g degrees",
        m->missed_decided, m->invented_decided, m->wrong_root, m->t.median, m->t.p99, m->normal.p99);
}
