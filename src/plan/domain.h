/* The stated domain: the input for which the exact solver's promises hold (docs/domain.md), and which of its
 * limits an input breaks. */
#ifndef MNS_PLAN_DOMAIN_H
#define MNS_PLAN_DOMAIN_H

#include "field/field.h"

#define DOMAIN_RADIUS_RATIO_MOST 1e6   /* R_max / R_min */
#define DOMAIN_OFFSET_MOST       1e9   /* |p| / R_min, p any ball's centre */
#define DOMAIN_EYE_MOST          1e5   /* from the eye to the box of the effective spheres, in R_max */
#define DOMAIN_STRENGTH_MOST     1e7   /* |q| / L */
#define DOMAIN_RADIUS_LEAST      1e-30 /* R */
#define DOMAIN_DISTANCE_MOST     1e38  /* from the eye to the farthest corner of that box */
#define DOMAIN_ACTIVE_MOST       1e4   /* effective spheres around one point; not known before drawing */
#define DOMAIN_CANCEL_MOST       1e3   /* sum of |q| k at the hit, in L; not known before drawing */

/* Those limits that can be told from the input alone. */
typedef enum domain_limit {
    DOMAIN_RADIUS_RATIO = 0,
    DOMAIN_OFFSET,
    DOMAIN_FAR_EYE,
    DOMAIN_STRENGTH,
    DOMAIN_LENGTHS,
    DOMAIN_LIMITS
} domain_limit;

enum { DOMAIN_LINE = 240 };

/* The limits broken, a line each, with the figure that broke it. */
typedef struct domain_report {
    size_t count;
    const char *line[DOMAIN_LIMITS]; /* into text */
    char text[DOMAIN_LIMITS][DOMAIN_LINE];
} domain_report;

/* "radius-ratio", "offset", "far-eye", "strength", "lengths": also the first word of a line that tells of it.
 */
const char *domain_limit_name(domain_limit limit);

/* Whether planes of floats hold distances in scene units, to a small part of R; `farthest` as of plan_facts.
 */
bool domain_lengths_hold(const mns_field *field, double farthest);

/* Which limits are broken; `eye_distance` and `farthest` as of plan_facts. O(1). */
void domain_check(const mns_field *field, double eye_distance, double farthest, domain_report *report);

#endif
