#include "plan/domain.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

static const char *const names[DOMAIN_LIMITS] = {
    [DOMAIN_RADIUS_RATIO] = "radius-ratio", [DOMAIN_OFFSET] = "offset",   [DOMAIN_FAR_EYE] = "far-eye",
    [DOMAIN_STRENGTH] = "strength",         [DOMAIN_LENGTHS] = "lengths",
};

const char *domain_limit_name(domain_limit limit)
{
    return names[limit];
}

/* Adds a line where `value` is beyond `most`. `what` says which figure it is. */
static void check_most(domain_report *report, domain_limit limit, const char *what, double value, double most)
{
    if (value <= most) return;
    char *text = report->text[report->count];
    snprintf(text, DOMAIN_LINE, "%s: %s is %.4g; the stated domain ends at %g (docs/domain.md)", names[limit],
             what, value, most);
    report->line[report->count++] = text;
}

bool domain_lengths_hold(const mns_field *field, double farthest)
{
    double unit = field_unit(field);
    return field->radius_min * unit >= DOMAIN_RADIUS_LEAST && farthest * unit <= DOMAIN_DISTANCE_MOST;
}

static void check_lengths(domain_report *report, const mns_field *field, double farthest)
{
    double unit = field_unit(field), radius = field->radius_min * unit;
    char *text = report->text[report->count], told[60] = "";
    if (domain_lengths_hold(field, farthest)) return;
    if (unit != 1) snprintf(told, sizeof told, ", told in units of %.6g", unit);
    snprintf(text, DOMAIN_LINE,
             "%s: radii from %.4g%s, distances to %.4g%s; the stated domain holds %g to %g (docs/domain.md)",
             names[DOMAIN_LENGTHS], radius, radius < DBL_MIN ? " (doubles there have lost digits)" : "",
             farthest * unit, told, DOMAIN_RADIUS_LEAST, DOMAIN_DISTANCE_MOST);
    report->line[report->count++] = text;
}

void domain_check(const mns_field *field, double eye_distance, double farthest, domain_report *report)
{
    report->count = 0;
    if (!field->p.count) return;
    double square = 0; /* of the distance from zero to the farthest corner of the centres' box */
    for (int a = 0; a < 3; a++) {
        double most = fmax(fabs(field->lo[a]), fabs(field->hi[a]));
        square += most * most;
    }
    double strongest = fmax(fabs(field->strength_min), fabs(field->strength_max));
    check_most(report, DOMAIN_RADIUS_RATIO, "R_max / R_min", field->radius_max / field->radius_min,
               DOMAIN_RADIUS_RATIO_MOST);
    check_most(report, DOMAIN_OFFSET, "|p| / R_min", sqrt(square) / field->radius_min, DOMAIN_OFFSET_MOST);
    check_most(report, DOMAIN_FAR_EYE, "the eye's distance / R_max", eye_distance / field->radius_max,
               DOMAIN_EYE_MOST);
    check_most(report, DOMAIN_STRENGTH, "|q| / L", strongest / field->iso, DOMAIN_STRENGTH_MOST);
    check_lengths(report, field, farthest);
}
