/* The certified tracer against ball arithmetic: what it says for certain is so, and what it leaves open has
 * an extremum too near to L to tell. */
#include "arb/judge.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

enum { RAYS_EACH = 23 }; /* of every kind and kernel: 2,070 rays in all */

static void theTruthIsFoundOrLeftOpen(void **state)
{
    (void)state;
    size_t count[JUDGE_VERDICTS] = {0}, hits = 0;
    for (rays_kind kind = 0; kind < RAYS_KINDS; kind++)
        for (mns_kernel kernel = MNS_KERNEL_POLY2; kernel < MNS_KERNEL_COUNT; kernel++)
            for (uint64_t seed = 0; seed < RAYS_EACH; seed++) {
                rays_case c;
                rays_make(kind, kernel, seed, &c);
                judgement j = judge_ray(&c);
                hits += j.truth.kind == TRUTH_HIT;
                if (count[j.verdict]++ || j.verdict <= JUDGE_UNDECIDED) continue;
                fprintf(stderr, "%s, seed %d: ", rays_name(kind), (int)seed); /* the first of each */
                judge_print(&c, &j);
            }
    printf("%zu right (%zu rays hit), %zu undecided, %zu undecided without need, %zu wrong, %zu untold\n",
           count[JUDGE_RIGHT], hits, count[JUDGE_UNDECIDED], count[JUDGE_NEEDLESS], count[JUDGE_WRONG],
           count[JUDGE_UNTOLD]);
    assert_int_equal(count[JUDGE_WRONG], 0);
    assert_int_equal(count[JUDGE_NEEDLESS], 0);
    assert_int_equal(count[JUDGE_UNTOLD], 0);
    assert_true(hits > 800 && count[JUDGE_RIGHT] > 1500);
}

static int end_thread(void **state)
{
    (void)state;
    truth_thread_end();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(theTruthIsFoundOrLeftOpen)};
    return cmocka_run_group_tests(tests, NULL, end_thread);
}
