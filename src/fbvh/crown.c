/* The first levels of a tree, breadth first: each level's nodes are cut by all threads, until there are
 * enough subtrees to share out. What is made does not depend on the number of threads. */
#include "fbvh/work.h"

#include <string.h>

enum { JOBS = 128, LEVELS = 12, JOB_LEAST = 1024 };

/* Levels of fewer references are cut by one thread: waking others takes longer. */
enum { ALONE = 65536 };

/* A node of the level while it is cut. */
typedef struct cutting {
    work_node node;
    int top;   /* which it is in the crown */
    size_t at; /* in the next list: room for its children, or for itself */
    bool divided;
    work_node child[2];
} cutting;

/* Where it is not cut, its references move on as they are, and its job closes it. */
static void cut_one(const work_set *set, const uint32_t *list, uint32_t *next, size_t job_most, cutting *c)
{
    const uint32_t *own = list + c->node.first;
    size_t count = c->node.count;
    work_cut cut;
    bool bounded;
    work_block block;
    c->divided = false;
    if (count > job_most &&
        work_choose(set, &c->node, &block, work_look(set, &c->node, own, &block), &cut, &bounded)) {
        uint32_t *list_of[2] = {next + c->at, next + c->at + count};
        work_part(set, &c->node, own, &cut, &block, list_of, c->child);
        c->child[0].first = c->at;
        c->child[1].first = c->at + count;
        c->divided = work_share(&c->node, c->child);
    }
    if (c->divided) return;
    memcpy(next + c->at, own, count * sizeof *own);
    c->node.first = c->at;
}

/* Puts the children of the level's nodes, or the nodes themselves, into `next`. Sets *divided where any was
 * cut. -1: out of memory. */
static int follow(work_crown *crown, const cutting *level, int count, cutting *next, bool *divided)
{
    int n = 0;
    *divided = false;
    for (int i = 0; i < count; i++) {
        if (!level[i].divided) {
            next[n++] = level[i];
            continue;
        }
        *divided = true;
        if (!work_reserve(&crown->top, &crown->top_capacity, crown->top_count + 2, sizeof *crown->top))
            return -1;
        for (int k = 0; k < 2; k++) {
            if (!level[i].child[k].count) continue;
            int top = (int)crown->top_count++;
            crown->top[level[i].top].child[k] = top;
            crown->top[top] = (work_top){level[i].child[k], {-1, -1}, -1};
            next[n++] = (cutting){.node = level[i].child[k], .top = top};
        }
    }
    return n;
}

static bool make_jobs(work_crown *crown, const cutting *level, int count)
{
    if (!work_reserve(&crown->job, &crown->job_capacity, (size_t)count, sizeof *crown->job)) return false;
    for (int i = 0; i < count; i++) {
        crown->job[i] = (work_job){.node = level[i].node};
        crown->top[level[i].top].job = i;
    }
    crown->job_count = (size_t)count;
    return true;
}

bool work_crown_grow(const work_set *set, const work_node *root, work_crown *crown, const uint32_t **list)
{
    cutting level[2 * JOBS], next[2 * JOBS];
    size_t job_most = root->count / JOBS;
    if (job_most < JOB_LEAST) job_most = JOB_LEAST;
    crown->top_count = 1;
    if (!work_reserve(&crown->top, &crown->top_capacity, 1, sizeof *crown->top)) return false;
    crown->top[0] = (work_top){*root, {-1, -1}, -1};
    level[0] = (cutting){.node = *root, .top = 0};
    int count = 1, from = 0;
    bool divided = true;
    for (int depth = 0; divided && count <= JOBS && depth < LEVELS; depth++) {
        size_t room = 0;
        for (int i = 0; i < count; i++) {
            level[i].at = room;
            room += (level[i].node.count > job_most ? 2 : 1) * level[i].node.count;
        }
        if (!work_reserve(&crown->list[!from], &crown->list_capacity[!from], room, sizeof(uint32_t)))
            return false;
        const uint32_t *given = crown->list[from];
        uint32_t *taken = crown->list[!from];
#pragma omp parallel for schedule(dynamic, 1) if (room > ALONE)
        for (int i = 0; i < count; i++) cut_one(set, given, taken, job_most, &level[i]);
        from = !from;
        count = follow(crown, level, count, next, &divided);
        if (count < 0) return false;
        memcpy(level, next, (size_t)count * sizeof *next);
    }
    *list = crown->list[from];
    return make_jobs(crown, level, count);
}
