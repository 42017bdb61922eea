/* The subtrees that the threads built, put together in the order of the crown. */
#include "fbvh/builder.h"

#include <omp.h>
#include <string.h>

static void run_job(const work_set *set, const uint32_t *list, work_bench *bench, work_job *job, bool *failed)
{
    job->bench = bench;
    job->node_first = bench->node_count;
    job->reference_first = bench->reference_count;
    if (!work_subtree(set, &job->node, list + job->node.first, bench, &job->result, &job->found,
                      &job->tally)) {
#pragma omp atomic write
        *failed = true;
    }
    job->node_count = bench->node_count - job->node_first;
    job->reference_count = bench->reference_count - job->reference_first;
}

bool builder_work(fbvh_builder *b, const work_set *set, const uint32_t *list)
{
    bool failed = false;
    int count = (int)b->crown.job_count;
    for (size_t i = 0; i < b->bench_count; i++) b->bench[i].node_count = b->bench[i].reference_count = 0;
#pragma omp parallel for schedule(dynamic, 1) num_threads((int)b->bench_count) if (count > 4)
    for (int i = 0; i < count; i++)
        run_job(set, list, &b->bench[omp_get_thread_num()], &b->crown.job[i], &failed);
    return !failed;
}

/* Where a job's nodes and references stand in the tree, less where they stand on its bench. */
typedef struct move {
    size_t node, reference;
} move;

static fbvh_node moved(const work_job *job, move to, fbvh_node node)
{
    if (node.count)
        node.first = (uint32_t)(node.first - job->reference_first + to.reference);
    else
        node.first = (uint32_t)(node.first - job->node_first + to.node);
    return node;
}

static void copy_job(const work_job *job, move to, builder_slot *slot)
{
    const fbvh_node *node = job->bench->node + job->node_first;
    for (size_t i = 0; i < job->node_count; i++) slot->node[to.node + i] = moved(job, to, node[i]);
    if (!job->reference_count) return;
    memcpy(slot->reference + to.reference, job->bench->reference + job->reference_first,
           job->reference_count * sizeof *slot->reference);
}

/* The root of what lies under top `at`, its nodes added to the slot's. False: nothing. */
static bool join_tops(const fbvh_builder *b, const work_set *set, const fbvh_node *of_job, size_t at,
                      builder_slot *slot, fbvh_node *result, size_t *depth)
{
    const work_top *top = &b->crown.top[at];
    *depth = 0;
    if (top->job >= 0) {
        *result = of_job[top->job];
        *depth = b->crown.job[top->job].tally.depth;
        return b->crown.job[top->job].found;
    }
    fbvh_node pair[2];
    bool is[2] = {false, false};
    size_t depth_of[2];
    for (int k = 0; k < 2; k++)
        if (top->child[k] >= 0)
            is[k] = join_tops(b, set, of_job, (size_t)top->child[k], slot, &pair[k], &depth_of[k]);
    if (!is[0] && !is[1]) return false;
    if (!is[0] || !is[1]) {
        *result = pair[is[1]];
        *depth = depth_of[is[1]];
        return true;
    }
    *result = work_join(set, &top->node, pair, slot->tree.node_count);
    memcpy(slot->node + slot->tree.node_count, pair, sizeof pair);
    slot->tree.node_count += 2;
    *depth = 1 + (depth_of[0] > depth_of[1] ? depth_of[0] : depth_of[1]);
    return true;
}

bool builder_assemble(fbvh_builder *b, const work_set *set, builder_slot *slot)
{
    enum { JOBS_MOST = 256 };
    move to[JOBS_MOST];
    fbvh_node of_job[JOBS_MOST];
    size_t nodes = 2, references = 0;
    int count = (int)b->crown.job_count;
    for (int i = 0; i < count; i++) {
        to[i] = (move){nodes, references};
        nodes += b->crown.job[i].node_count;
        references += b->crown.job[i].reference_count;
    }
    if (!work_reserve(&slot->node, &slot->node_capacity, nodes + b->crown.top_count + 1,
                      sizeof *slot->node) ||
        !work_reserve(&slot->reference, &slot->reference_capacity, references + 1, sizeof *slot->reference))
        return false;
#pragma omp parallel for schedule(dynamic, 1) if (references > 65536)
    for (int i = 0; i < count; i++) {
        copy_job(&b->crown.job[i], to[i], slot);
        of_job[i] = moved(&b->crown.job[i], to[i], b->crown.job[i].result);
    }
    slot->tree.node_count = nodes;
    slot->tree.reference_count = references;
    fbvh_node root;
    if (!join_tops(b, set, of_job, 0, slot, &root, &slot->tree.figures.depth)) {
        slot->tree.node_count = 0;
        return true;
    }
    slot->node[0] = root;
    memset(&slot->node[1], 0, sizeof slot->node[1]);
    return true;
}
