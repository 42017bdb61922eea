/* The certified tracer against ball arithmetic: a row of a table for each kind of ray, and for each kernel.
 *
 * usage: bench_reference [-n RAYS] [-s FIRST SEED]
 * Exits 1 where the tracer is wrong anywhere, or leaves open what nothing comes near.
 */
#include "arb/judge.h"
#include "base/clock.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct tally {
    size_t count[JUDGE_VERDICTS], hits;
    double seconds;
    double open;     /* largest gap of a ray left undecided */
    double worst;    /* of |t - t*| / t_error, where certain */
    double farthest; /* of |t - t*| / max(t, the largest R) */
    double widest;   /* of t_error / max(t, the largest R) */
} tally;

static void tally_add(tally *sum, const rays_case *c, const judgement *j)
{
    double size = j->hit.t;
    for (size_t i = 0; i < c->scene.count; i++) size = fmax(size, c->radius[i]);
    sum->count[j->verdict]++;
    sum->hits += j->truth.kind == TRUTH_HIT;
    if (!j->hit.certain) sum->open = fmax(sum->open, j->gap);
    if (!j->hit.hit || !j->hit.certain || j->truth.kind != TRUTH_HIT) return;
    if (j->distance > 0) sum->worst = fmax(sum->worst, j->distance / j->hit.t_error);
    sum->widest = fmax(sum->widest, j->hit.t_error / size);
    sum->farthest = fmax(sum->farthest, j->distance / size);
}

static void tally_join(tally *sum, const tally *part)
{
    for (int v = 0; v < JUDGE_VERDICTS; v++) sum->count[v] += part->count[v];
    sum->hits += part->hits;
    sum->seconds += part->seconds;
    sum->open = fmax(sum->open, part->open);
    sum->worst = fmax(sum->worst, part->worst);
    sum->widest = fmax(sum->widest, part->widest);
    sum->farthest = fmax(sum->farthest, part->farthest);
}

static tally measure(rays_kind kind, mns_kernel kernel, long rays, long first_seed)
{
    tally sum = {0};
    double start = clock_ms();
#pragma omp parallel
    {
        tally part = {0};
#pragma omp for schedule(dynamic, 8)
        for (long i = 0; i < rays; i++) {
            rays_case c;
            rays_make(kind, kernel, (uint64_t)(first_seed + i), &c);
            judgement j = judge_ray(&c);
            tally_add(&part, &c, &j);
            if (j.verdict <= JUDGE_UNDECIDED) continue;
#pragma omp critical
            {
                fprintf(stderr, "%s, seed %ld: ", rays_name(kind), first_seed + i);
                judge_print(&c, &j);
            }
        }
#pragma omp critical
        tally_join(&sum, &part);
        truth_thread_end();
    }
    sum.seconds = (clock_ms() - start) / 1000;
    return sum;
}

static void print_row(const char *name, const tally *t)
{
    size_t rays = 0;
    for (int v = 0; v < JUDGE_VERDICTS; v++) rays += t->count[v];
    printf("| %s | %zu | %zu | %zu | %zu | %zu | %zu | %.1e | %.4f | %.1e | %.1e | %.1f |\n", name, rays,
           t->hits, t->count[JUDGE_UNDECIDED], t->count[JUDGE_NEEDLESS], t->count[JUDGE_WRONG],
           t->count[JUDGE_UNTOLD], t->open, t->worst, t->farthest, t->widest, t->seconds);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    long rays = 100000, first_seed = 1000;
    for (int option; (option = getopt(argc, argv, "n:s:")) != -1;) {
        if (option != 'n' && option != 's') return 2;
        *(option == 'n' ? &rays : &first_seed) = strtol(optarg, NULL, 10);
    }
    const int parts = RAYS_KINDS * (MNS_KERNEL_COUNT - 1);
    if (rays < parts || first_seed < 0) {
        fprintf(stderr, "bench_reference: expected at least %d rays after -n, and a seed from 0 after -s\n",
                parts);
        return 2;
    }
    puts("| rays | number | hit | undecided | undecided without need | wrong | oracle untold | largest gap "
         "left "
         "open | worst \\|t - t*\\| / t.err | worst \\|t - t*\\| / max(t, R) | widest t.err / max(t, R) | "
         "seconds |\n"
         "|-|-|-|-|-|-|-|-|-|-|-|-|");
    tally all = {0}, by_kernel[MNS_KERNEL_COUNT] = {{.seconds = 0}};
    for (rays_kind kind = 0; kind < RAYS_KINDS; kind++) {
        tally by_kind = {0};
        for (mns_kernel kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++) {
            tally t = measure(kind, kernel, (rays + parts - 1) / parts, first_seed);
            tally_join(&by_kind, &t);
            tally_join(&by_kernel[kernel], &t);
        }
        print_row(rays_name(kind), &by_kind);
        tally_join(&all, &by_kind);
    }
    for (mns_kernel kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++)
        print_row(mns_kernel_name(kernel), &by_kernel[kernel]);
    print_row("all", &all);
    return all.count[JUDGE_NEEDLESS] || all.count[JUDGE_WRONG] || all.count[JUDGE_UNTOLD];
}
