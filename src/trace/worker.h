/* Builds trees, on the caller's thread or ahead on a thread of its own while another is drawn (Gourmel et al.
 * 2010, figure 7). */
#ifndef MNS_TRACE_WORKER_H
#define MNS_TRACE_WORKER_H

#include "fbvh/fbvh.h"

#include <pthread.h>
#include <stdatomic.h>

/* What a tree was, or is being, built of. */
typedef struct worker_job {
    const mns_field *field; /* NULL: nothing */
    uint64_t stamp;         /* of the field: its address may be used again */
    fbvh_options options;
    const fbvh_tree *tree;
    mns_status status;
    mns_error error;
} worker_job;

/* Zeroed is empty. */
typedef struct trace_worker {
    fbvh_builder *builder;
    pthread_t thread;
    bool running;
    int threads;      /* that it may use: as many as who began it */
    atomic_bool done; /* what is running has come to its end: it can be had without waiting */
    worker_job ahead; /* what the thread builds */
    worker_job ready; /* what it has built, and nobody has taken yet */
} trace_worker;

/* Begins the tree of `field`, which must stay as it is until it is taken, or the next is begun or taken.
 * Waits for one that is still being built; of those built ahead and not taken, only the last is kept. Errors:
 * MEMORY. */
mns_status trace_worker_begin(trace_worker *worker, const mns_field *field, const fbvh_options *options,
                              mns_error *error);
/* The tree of `field`: one built ahead, or built now. It is valid until the next is begun or taken. Errors:
 * as fbvh_build. */
mns_status trace_worker_take(trace_worker *worker, const mns_field *field, const fbvh_options *options,
                             const fbvh_tree **tree, mns_error *error);
/* Waits for what is being built, so that its field may go. */
void trace_worker_settle(trace_worker *worker);
void trace_worker_free(trace_worker *worker);

#endif
