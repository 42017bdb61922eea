/* From particles to a field: kernel, level and radii resolved, extents measured. */
#include "field/field.h"

#include "base/memory.h"
#include "base/status.h"
#include "field/kernel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Of a coordinate or radius: what the field spans stays a double. */
#define LONGEST 1e300
/* Of a strength: the shaders take its products in floats. */
#define STRONGEST 1e30

/* How the radii come about: the particles' own times factor, or where that is 0, R = uniform for all. */
typedef struct radius_rule {
    double uniform, factor;
    const char *source;
} radius_rule;

static bool is_setting(double value)
{
    return isfinite(value) && value >= 0;
}

static mns_status resolve_options(mns_field *f, const mns_input_options *options, mns_error *error)
{
    if ((int)options->kernel < 0 || options->kernel >= MNS_KERNEL_COUNT)
        return status_fail(error, MNS_ERROR_USAGE, "no kernel has the number %d; expected 0 to %d",
                           (int)options->kernel, MNS_KERNEL_COUNT - 1);
    f->kernel = options->kernel ? options->kernel : MNS_KERNEL_POLY3;
    if (!is_setting(options->iso))
        return status_fail(error, MNS_ERROR_USAGE, "the iso level is %g; expected a number above 0",
                           options->iso);
    f->iso = options->iso > 0 ? options->iso : 0.2;
    if (!is_setting(options->radius))
        return status_fail(error, MNS_ERROR_USAGE, "the radius is %g; expected a number above 0",
                           options->radius);
    if (!is_setting(options->radius_scale))
        return status_fail(error, MNS_ERROR_USAGE, "the radius scale is %g; expected a number above 0",
                           options->radius_scale);
    return MNS_OK;
}

static mns_status resolve_radii(const mns_field *f, const particles *p, const mns_input_options *options,
                                const char *radius_source, radius_rule *rule, mns_error *error)
{
    double scale = options->radius_scale > 0 ? options->radius_scale : 1;
    if (options->radius > 0) {
        *rule = (radius_rule){options->radius * scale, 0, "option"};
        return MNS_OK;
    }
    if (!p->radius) {
        double spacing = 0;
        mns_status status = field_spacing(p, &spacing, error);
        *rule = (radius_rule){(spacing > 0 ? 2 * spacing : 1) * scale, 0, "default spacing"};
        return status;
    }
    *rule = (radius_rule){0, scale, radius_source};
    if (!p->radius_is_surface) return MNS_OK;
    /* A lone ball's surface lies at R core(L), which shall be the radius given. */
    double core = f->iso < 1 ? kernel_core_radius(f->kernel, f->iso) : 0;
    if (!(core > 0))
        return status_fail(
            error, MNS_ERROR_USAGE,
            "at the iso level %g no lone ball has a surface, so none can lie at its %s radius; "
            "give --iso below 1, or --radius",
            f->iso, radius_source);
    rule->factor = scale / core;
    return MNS_OK;
}

static mns_status check_position(const particles *p, mns_error *error)
{
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < p->count; i++)
            if (!(fabs(p->axis[k][i]) <= LONGEST))
                return status_fail(
                    error, MNS_ERROR_UNSUPPORTED,
                    "particle %zu: %c = %g lies beyond %g, the largest coordinate; scale the input", i,
                    "xyz"[k], p -> axis[k][i], LONGEST);
    return MNS_OK;
}

static mns_status check_radius(double radius, mns_error *error)
{
    if (radius > 0 && radius <= LONGEST) return MNS_OK;
    return status_fail(error, MNS_ERROR_UNSUPPORTED,
                       "a radius comes to %g; expected one above 0 and up to %g: scale the input", radius,
                       LONGEST);
}

static mns_status check_strength(const particles *p, mns_error *error)
{
    for (size_t i = 0; p->strength && i < p->count; i++)
        if (!(fabs(p->strength[i]) <= STRONGEST))
            return status_fail(error, MNS_ERROR_UNSUPPORTED,
                               "particle %zu: strength %g lies beyond %g, the largest; scale the input", i,
                               p->strength[i], STRONGEST);
    return MNS_OK;
}

/* Smallest and largest of `count` > 0 values. */
static void range_of(const double *value, size_t count, double *min, double *max)
{
    double low = value[0], high = value[0];
    for (size_t i = 1; i < count; i++) {
        low = value[i] < low ? value[i] : low;
        high = value[i] > high ? value[i] : high;
    }
    *min = low, *max = high;
}

static mns_status choose_unit(mns_field *f, const particles *p, double radius_min, double radius_max,
                              mns_error *error)
{
    double widest = 0, farthest = 0, low, high;
    f->unit = 1;
    if (!p->count) return MNS_OK;
    for (int k = 0; k < 3; k++) {
        range_of(p->axis[k], p->count, &low, &high);
        widest = fmax(widest, high - low);
        farthest = fmax(farthest, fmax(fabs(low), fabs(high)));
    }
    return field_choose_unit(radius_min, widest + 2 * radius_max, farthest, &f->unit, error);
}

/* Puts the rule's radii into f->p and measures them; an array of equal radii becomes one number. */
static mns_status apply_radii(mns_field *f, const particles *p, const radius_rule *rule, mns_error *error)
{
    double low = rule->uniform, high = rule->uniform;
    const bool is_uniform = !(rule->factor > 0);
    if (!is_uniform && p->count) {
        range_of(p->radius, p->count, &low, &high);
        low *= rule->factor, high *= rule->factor;
    } else if (!is_uniform) {
        low = high = 1;
    }
    mns_status status = check_radius(low, error);
    if (!status) status = check_radius(high, error);
    if (status) return status;
    status = choose_unit(f, p, low, high, error);
    if (status) return status;
    f->radius_source = rule->source;
    f->radius_min = low, f->radius_max = high;
    f->uniform_radius = low == high ? low : 0;
    if (low == high) {
        f->radius_median = low;
        return MNS_OK;
    }
    for (size_t i = 0; i < p->count; i++) p->radius[i] *= rule->factor;
    f->radius_median = field_median(p->radius, p->count);
    return MNS_OK;
}

/* Takes the particles over; what turned out uniform goes. */
static void take(mns_field *f, particles *p)
{
    f->p = *p;
    memset(p, 0, sizeof *p);
    f->p.radius_is_surface = false;
    if (f->uniform_radius > 0) {
        free(f->p.radius);
        f->p.radius = NULL;
    }
    if (f->strength_min == 1 && f->strength_max == 1) {
        free(f->p.strength);
        f->p.strength = NULL;
    }
}

static void measure_strength(mns_field *f, const particles *p)
{
    f->strength_min = f->strength_max = 1;
    f->positive_sum_bound = (double)p->count;
    if (!p->strength || !p->count) return;
    range_of(p->strength, p->count, &f->strength_min, &f->strength_max);
    f->positive_sum_bound = 0;
    for (size_t i = 0; i < p->count; i++)
        if (p->strength[i] > 0) f->positive_sum_bound += p->strength[i];
}

static void measure_box(mns_field *f)
{
    const particles *p = &f->p;
    if (!p->count) return;
    for (int k = 0; k < 3; k++) {
        const double *axis = p->axis[k];
        double lo = INFINITY, hi = -INFINITY;
        range_of(axis, p->count, &f->lo[k], &f->hi[k]);
        for (size_t i = 0; i < p->count; i++) {
            double r = field_radius(f, i);
            lo = axis[i] - r < lo ? axis[i] - r : lo;
            hi = axis[i] + r > hi ? axis[i] + r : hi;
        }
        f->effective_lo[k] = lo, f->effective_hi[k] = hi;
    }
}

mns_status field_from_particles(particles *p, const mns_input_options *options, const char *radius_source,
                                mns_field **field, mns_error *error)
{
    mns_input_options defaults = {0};
    radius_rule rule = {0};
    mns_field *f = calloc(1, sizeof *f);
    if (!f) return status_no_memory(error, "making a field");
    mns_status status = resolve_options(f, options ? options : &defaults, error);
    if (!status) status = check_position(p, error);
    if (!status) status = check_strength(p, error);
    if (!status) status = resolve_radii(f, p, options ? options : &defaults, radius_source, &rule, error);
    if (!status) status = apply_radii(f, p, &rule, error);
    if (status) goto fail;
    measure_strength(f, p);
    take(f, p);
    field_enter_unit(f);
    measure_box(f);
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    f->stamp = (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
    *field = f;
    return MNS_OK;
fail:
    free(f);
    return status;
}

void mns_field_destroy(mns_field *field)
{
    if (!field) return;
    particles_free(&field->p);
    free(field);
}

double mns_field_radius(const mns_field *field, size_t index)
{
    return field_radius(field, index) * field_unit(field);
}
