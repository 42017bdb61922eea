/* The judgement of the certified tracer on one ray. */
#ifndef MNS_TESTS_ARB_JUDGE_H
#define MNS_TESTS_ARB_JUDGE_H

#include "rays.h"

typedef enum judge_verdict {
    JUDGE_RIGHT = 0, /* certain, and as the truth says */
    JUDGE_UNDECIDED, /* not certain, and rightly so */
    JUDGE_NEEDLESS,  /* not certain, though nothing comes near L */
    JUDGE_WRONG,     /* certain, and not as the truth says, or an error */
    JUDGE_UNTOLD,    /* the oracle gave up */
    JUDGE_VERDICTS
} judge_verdict;

typedef struct judgement {
    judge_verdict verdict;
    truth_answer truth;
    mns_hit hit;     /* the tracer's */
    double gap;      /* truth_gap, where it was needed; otherwise 1 */
    double distance; /* |t - t*|, where both hit */
} judgement;

/* Traces by mns_reference_trace, and judges. */
judgement judge_ray(const rays_case *c);
/* The case and its judgement in full, the numbers as hexadecimal doubles: written to stderr. */
void judge_print(const rays_case *c, const judgement *j);

#endif
