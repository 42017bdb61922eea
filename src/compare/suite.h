/* A suite of hard cases: every case by every run, each with a verdict. */
#ifndef MNS_COMPARE_SUITE_H
#define MNS_COMPARE_SUITE_H

#include "compare/run.h"
#include "compare/stiff.h"

#include <jansson.h>

/* The share of pixels that may end undecided in a case that was not built of touches (the design's). */
#define SUITE_UNDECIDED_MOST 1e-4

typedef enum suite_verdict {
    SUITE_HOLDS = 0, /* no decided pixel missed, invented or at another root, few enough undecided */
    SUITE_FAILS,     /* or refused inside the domain */
    SUITE_OUTSIDE,   /* beyond the stated domain and not as SUITE_HOLDS: shown, and not gated */
    SUITE_REFUSED    /* beyond the stated domain, with a clear error */
} suite_verdict;

/* "holds", "fails", "outside", "refused". */
const char *suite_verdict_name(suite_verdict verdict);

/* One case by one run; lives during the call of suite_options.seen. */
typedef struct suite_line {
    const stiff_case *which;
    const run_result *run;
    suite_verdict verdict;
    bool gated;     /* an exact solver inside the domain: it must hold */
    char note[200]; /* what is wrong; "" where nothing is */
} suite_line;

typedef struct suite_options {
    mns_renderer *renderer;
    const run_spec *runs;
    size_t run_count;
    const char *only;  /* cases whose name matches this pattern, as fnmatch has it; NULL: all */
    mns_kernel kernel; /* cases of this kernel; DEFAULT: of all */
    bool quick;        /* leave the heavy cases out; draw once, so that times are of cold frames */
    bool use_cache;    /* of truths */
    void (*seen)(void *context, const suite_line *line); /* NULL, or called as runs end */
    void *context;
} suite_options;

/* Runs the stiff suite. `suite`: a new reference, the document's "suite" (results.h), whose runs are as
 * "runs" there, but that "ms" is one number, and with "verdict", "missed", "invented", "wrong_root",
 * "undecided", "pixels", "t_p999" and "note" beside. `failures`: gated lines that do not hold. Errors: USAGE
 * (no case matches), MEMORY, GL. */
mns_status suite_run(const suite_options *options, json_t **suite, size_t *failures, mns_error *error);

/* What a measured or refused run comes to in that case. */
void suite_judge(const stiff_case *which, const run_result *run, suite_line *line);

#endif
