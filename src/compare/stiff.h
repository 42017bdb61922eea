/* The stiff and extreme suite's cases: scenes by closed formulas, each hard for a reason of its own. */
#ifndef MNS_COMPARE_STIFF_H
#define MNS_COMPARE_STIFF_H

#include "compare/stiff_scene.h"

enum {                    /* bits of stiff_case.flags */
       STIFF_TOUCHES = 1, /* built of rays that touch the surface: many may end undecided */
       STIFF_HEAVY = 2    /* takes seconds: left out of quick runs */
};

typedef struct stiff_case {
    const char *name; /* "neck", or with the kernel where it is not poly3: "neck/perlin" */
    const char *why;  /* what makes it hard, half a line */
    /* The limits of docs/domain.md that it breaks, as domain_limit_name has them, separated by a space; ""
     * for a case inside the stated domain. */
    const char *breaks;
    unsigned flags;
    mns_kernel kernel;
    void (*make)(stiff_scene *scene, const double *number);
    double number[3]; /* what `make` reads; see the maker */
} stiff_case;

/* All cases, in the order in which they are run; *count of them. */
const stiff_case *stiff_cases(size_t *count);

/* Builds a case: its field, for the caller to destroy, and its resolved view. Errors: MEMORY. */
mns_status stiff_build(const stiff_case *which, mns_field **field, mns_view *view, mns_error *error);

#endif
