#include "compare/probe.h"

#include "base/memory.h"
#include "base/status.h"
#include "image/image.h"

#include <math.h>

/* What all pixels share. */
typedef struct probe {
    const mns_field *field;
    const mns_reference *reference;
    const mns_view *view;
    const mns_image *image;
    double iso;
} probe;

typedef enum verdict { AGREED, UNDECIDED, DISAGREED } verdict;

typedef struct probe_pixel {
    verdict verdict;
    bool true_hit;
    metrics_pixel pixel; /* error over t* alone: |t - t*| / t* */
} probe_pixel;

static uint64_t next_random(uint64_t *state)
{
    /* Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators": SplitMix64 */
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* The first `rays` of a random order of all pixels, for the caller to free. */
static uint32_t *draw_pixels(size_t pixels, size_t rays, uint64_t seed)
{
    uint32_t *order = memory_array(pixels, sizeof *order);
    if (!order) return NULL;
    for (size_t i = 0; i < pixels; i++) order[i] = (uint32_t)i;
    for (size_t i = 0; i < rays; i++) {
        size_t k = i + (size_t)(next_random(&seed) % (pixels - i));
        uint32_t kept = order[i];
        order[i] = order[k];
        order[k] = kept;
    }
    return order;
}

/* How far the image's hit may lie from the truth's. */
static double allowed_error(const probe *p, const double direction[3], const mns_hit *hit)
{
    double point[3], gradient[3], along = 0, radius = mns_field_radius(p->field, hit->ball);
    for (int axis = 0; axis < 3; axis++) point[axis] = p->view->eye[axis] + hit->t * direction[axis];
    mns_reference_value(p->reference, point, gradient, NULL);
    for (int axis = 0; axis < 3; axis++) along += gradient[axis] * direction[axis];
    double slope = fmin(1, fabs(along) * radius / p->iso);
    double rounding = PROBE_RELATIVE * fmax(hit->t, radius) / slope;
    return hit->t_error + fmin(rounding, METRICS_ROOT_RADII * radius + METRICS_ROOT_RELATIVE * hit->t);
}

static mns_status solve(const probe *p, uint32_t index, probe_pixel *result, mns_error *error)
{
    double direction[3];
    mns_hit hit;
    int x = (int)(index % (uint32_t)p->image->width), y = (int)(index / (uint32_t)p->image->width);
    mns_view_ray(p->view, x + 0.5, y + 0.5, direction);
    mns_status status = mns_reference_trace(p->reference, p->view->eye, direction, &hit, error);
    if (status) return status;
    bool has = isfinite(p->image->t[index]) != 0;
    double t = image_distance(p->image, index);
    *result = (probe_pixel){.true_hit = hit.hit, .pixel = {.x = x, .y = y, .t = t, .error = NAN}};
    result->pixel.truth = hit.hit ? hit.t : INFINITY;
    if (p->image->mesh &&
        p->image->mesh[index] > 0) { /* all that is asked: does the surface lie before it? */
        bool before = hit.hit && hit.t < t - allowed_error(p, direction, &hit);
        result->true_hit = before;
        result->pixel.kind = METRICS_MISSED;
        result->verdict = before ? DISAGREED : AGREED;
    } else if (has != hit.hit) {
        result->pixel.kind = has ? METRICS_INVENTED : METRICS_MISSED;
        result->verdict = DISAGREED;
    } else if (has) {
        double off = fabs(t - hit.t);
        result->pixel.error = off / hit.t;
        result->verdict = off <= allowed_error(p, direction, &hit) ? AGREED : DISAGREED;
    }
    if (!hit.certain || !(p->image->certain[index] > 0.5f)) result->verdict = UNDECIDED;
    return MNS_OK;
}

/* A pixel without a distance is worse than any with one. */
static bool is_worse(const probe_pixel *a, const probe_pixel *b)
{
    if (a->verdict != b->verdict) return a->verdict == DISAGREED;
    double x = isnan(a->pixel.error) ? INFINITY : a->pixel.error;
    double y = isnan(b->pixel.error) ? INFINITY : b->pixel.error;
    return x > y;
}

static void count(const probe_pixel *list, size_t rays, probe_report *report)
{
    const probe_pixel *worst = NULL;
    *report = (probe_report){.rays = rays};
    for (size_t i = 0; i < rays; i++) {
        const probe_pixel *p = &list[i];
        bool wrong = p->verdict == DISAGREED;
        report->hits += p->true_hit;
        report->agreed += p->verdict == AGREED;
        report->undecided += p->verdict == UNDECIDED;
        report->missed += wrong && p->pixel.kind == METRICS_MISSED;
        report->invented += wrong && p->pixel.kind == METRICS_INVENTED;
        report->off += wrong && p->pixel.kind == METRICS_DEPTH;
        bool shows = wrong || (p->verdict == AGREED && p->true_hit);
        if (shows && (!worst || is_worse(p, worst))) worst = p;
    }
    report->has_worst = worst != NULL;
    if (worst) report->worst = worst->pixel;
}

static mns_status solve_all(const probe *p, const uint32_t *order, size_t rays, probe_pixel *list,
                            mns_error *error)
{
    mns_status status = MNS_OK;
#pragma omp parallel for schedule(dynamic, 16)
    for (size_t i = 0; i < rays; i++) {
        mns_error one;
        mns_status failed = solve(p, order[i], &list[i], &one);
        if (!failed) continue;
#pragma omp critical(probe_failed)
        {
            if (!status && error) *error = one;
            status = failed;
        }
    }
    return status;
}

mns_status probe_image(const mns_field *field, const mns_view *view, const mns_image *image, size_t rays,
                       uint64_t seed, probe_report *report, mns_error *error)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    if (view->width != image->width || view->height != image->height || pixels > UINT32_MAX)
        return status_fail(error, MNS_ERROR_USAGE, "an image of %dx%d pixels for a view of %dx%d",
                           image->width, image->height, view->width, view->height);
    mns_field_info info;
    mns_reference *reference = NULL;
    mns_field_get_info(field, &info);
    if (rays > pixels) rays = pixels;
    uint32_t *order = draw_pixels(pixels, rays, seed);
    probe_pixel *list = memory_array(rays, sizeof *list);
    mns_status status = order && list ? mns_reference_create(field, &reference, error)
                                      : status_no_memory(error, "checking an image");
    if (!status) {
        probe p = {field, reference, view, image, info.iso};
        status = solve_all(&p, order, rays, list, error);
    }
    if (!status) count(list, rays, report);
    mns_reference_destroy(reference);
    free(order);
    free(list);
    return status;
}
