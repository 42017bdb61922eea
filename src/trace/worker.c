#include "trace/worker.h"

#include "base/status.h"

#include <omp.h>
#include <string.h>

static bool same(const worker_job *job, const mns_field *field, const fbvh_options *options)
{
    return job->field == field && job->stamp == field->stamp &&
           memcmp(&job->options, options, sizeof *options) == 0;
}

static void *build_ahead(void *argument)
{
    trace_worker *worker = argument;
    worker_job *job = &worker->ahead;
    omp_set_num_threads(worker->threads);
    job->status = fbvh_build(worker->builder, job->field, &job->options, &job->tree, &job->error);
    atomic_store(&worker->done, true);
    return NULL;
}

/* What is being built becomes what is ready; the next build leaves what is ready alone. */
static void wait_for_it(trace_worker *worker)
{
    if (worker->running) {
        pthread_join(worker->thread, NULL);
        worker->running = false;
        worker->ready = worker->ahead;
        worker->ahead = (worker_job){0};
    }
    if (worker->builder) fbvh_builder_keep(worker->builder, worker->ready.tree);
}

static mns_status make_builder(trace_worker *worker, mns_error *error)
{
    return worker->builder ? MNS_OK : fbvh_builder_create(&worker->builder, error);
}

mns_status trace_worker_begin(trace_worker *worker, const mns_field *field, const fbvh_options *options,
                              mns_error *error)
{
    wait_for_it(worker);
    mns_status status = make_builder(worker, error);
    if (status) return status;
    worker->ahead = (worker_job){.field = field, .stamp = field->stamp, .options = *options};
    worker->threads = omp_get_max_threads();
    atomic_store(&worker->done, false);
    if (pthread_create(&worker->thread, NULL, build_ahead, worker) != 0)
        return status_no_memory(error, "while starting to build a tree ahead");
    worker->running = true;
    return MNS_OK;
}

mns_status trace_worker_take(trace_worker *worker, const mns_field *field, const fbvh_options *options,
                             const fbvh_tree **tree, mns_error *error)
{
    if (!same(&worker->ready, field, options)) wait_for_it(worker);
    if (same(&worker->ready, field, options)) {
        worker_job job = worker->ready;
        worker->ready = (worker_job){0};
        if (job.status && error) *error = job.error;
        if (!job.status) *tree = job.tree;
        return job.status;
    }
    mns_status status = make_builder(worker, error);
    return status ? status : fbvh_build(worker->builder, field, options, tree, error);
}

void trace_worker_settle(trace_worker *worker)
{
    wait_for_it(worker);
}

void trace_worker_free(trace_worker *worker)
{
    wait_for_it(worker);
    fbvh_builder_destroy(worker->builder);
    memset(worker, 0, sizeof *worker);
}
