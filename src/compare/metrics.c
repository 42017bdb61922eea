#include "compare/metrics.h"

#include "base/memory.h"
#include "base/status.h"
#include "base/vec.h"
#include "image/image.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* Places in the list of the worst that missed, and that invented pixels have for certain. */
enum { WORST_SHARE = 5 };

const char *metrics_kind_name(metrics_kind kind)
{
    static const char *const names[] = {"depth", "wrong root", "missed", "invented"};
    return names[kind];
}

/* ---- Spreads ---- */

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The least of n sorted values that at least `share` of them do not exceed. */
static double quantile(const double *sorted, size_t n, double share)
{
    size_t rank = (size_t)ceil(share * (double)n);
    return sorted[rank ? (rank > n ? n : rank) - 1 : 0];
}

metrics_spread metrics_spread_of(double *value, size_t count)
{
    if (!count) return (metrics_spread){NAN, NAN, NAN, NAN, NAN};
    qsort(value, count, sizeof *value, by_value);
    double squares = 0;
    for (size_t i = 0; i < count; i++) squares += value[i] * value[i];
    return (metrics_spread){.median = quantile(value, count, 0.5),
                            .p99 = quantile(value, count, 0.99),
                            .p999 = quantile(value, count, 0.999),
                            .max = value[count - 1],
                            .rms = sqrt(squares / (double)count)};
}

/* The figures of those of `count` values that are numbers. */
static metrics_spread spread_of_numbers(double *value, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (!isnan(value[i])) value[kept++] = value[i];
    return metrics_spread_of(value, kept);
}

/* ---- One pixel ---- */

static bool is_decided(const truth_planes *truth, const mns_image *image, size_t i)
{
    return truth->certain[i] && image->certain[i] > 0.5f;
}

metrics_mask metrics_mask_of(const truth_planes *truth, const mns_image *image, size_t pixel)
{
    bool has = isfinite(image->t[pixel]), should = isfinite(truth->t[pixel]);
    if (!is_decided(truth, image, pixel)) return METRICS_MASK_UNDECIDED;
    if (has) return should ? METRICS_MASK_BOTH : METRICS_MASK_INVENTED;
    return should ? METRICS_MASK_MISSED : METRICS_MASK_NONE;
}

double metrics_footprint(const mns_view *view, double t)
{
    return t * 2 * tan(view->fov * PI / 360) / view->height;
}

static double radius_at(const truth_planes *truth, size_t i)
{
    return truth->radius ? truth->radius[i] : 0;
}

/* |t - t*|, as far as the truth's own bound leaves no doubt. */
static double distance_error(const truth_planes *truth, size_t i, double t)
{
    return fmax(fabs(t - truth->t[i]) - truth->t_error[i], 0);
}

static double relative_error(const truth_planes *truth, size_t i, double t)
{
    return distance_error(truth, i, t) / fmax(truth->t[i], radius_at(truth, i));
}

static bool is_wrong_root(const truth_planes *truth, size_t i, double t)
{
    double allowed = METRICS_ROOT_RADII * truth->radius[i] + METRICS_ROOT_RELATIVE * truth->t[i];
    return distance_error(truth, i, t) > allowed;
}

/* Degrees between two normals; 180 where one of them is none. By the tangent: an arc cosine of nearly 1 would
 * keep half the digits. */
static double normal_angle(const double a[3], const float b[3])
{
    vec3 u = vec3_load(a), v = vec3_make(b[0], b[1], b[2]);
    double across = vec3_length(vec3_cross(u, v)), along = vec3_dot(u, v);
    if (!(across > 0) && !(fabs(along) > 0)) return 180;
    return atan2(across, along) * 180 / PI;
}

/* ---- Whole images ---- */

/* What is gathered a pixel, NAN where it has no such figure. */
typedef struct columns {
    double *t, *footprint, *residual, *normal;
} columns;

static void compare_pixel(const truth_planes *truth, const mns_image *image, size_t i, const columns *c)
{
    double t = image_distance(image, i);
    c->t[i] = c->footprint[i] = c->normal[i] = NAN;
    if (!isfinite(t) || !isfinite(truth->t[i]) || !is_decided(truth, image, i)) return;
    c->t[i] = relative_error(truth, i, t);
    if (truth->has_view) {
        double footprint = metrics_footprint(&truth->view, truth->t[i]);
        c->footprint[i] = distance_error(truth, i, t) / footprint;
    }
    c->normal[i] = normal_angle(truth->normal + 3 * i, image->normal + 3 * i);
}

/* |f - L| / L at the image's hit of the pixel, NAN where it has none. */
static double residual(const truth_planes *truth, const mns_image *image, size_t i,
                       const mns_reference *reference, double iso)
{
    double t = image_distance(image, i), d[3], point[3];
    if (!reference || !truth->has_view || !isfinite(t)) return NAN;
    int x = (int)(i % (size_t)truth->width), y = (int)(i / (size_t)truth->width);
    mns_view_ray(&truth->view, x + 0.5, y + 0.5, d);
    for (int axis = 0; axis < 3; axis++) point[axis] = truth->view.eye[axis] + t * d[axis];
    return fabs(mns_reference_value(reference, point, NULL, NULL) - iso) / iso;
}

static mns_status measure_spreads(const truth_planes *truth, const mns_image *image,
                                  const mns_reference *reference, double iso, metrics *m, mns_error *error)
{
    size_t n = m->pixels;
    double *all = memory_array(n, 4 * sizeof *all);
    if (!all) return status_no_memory(error, "comparing an image");
    columns c = {all, all + n, all + 2 * n, all + 3 * n};
#pragma omp parallel for schedule(dynamic, 1024)
    for (size_t i = 0; i < n; i++) {
        compare_pixel(truth, image, i, &c);
        c.residual[i] = residual(truth, image, i, reference, iso);
    }
    for (size_t i = 0; i < n; i++) m->compared += !isnan(c.t[i]);
    m->t = spread_of_numbers(c.t, n);
    m->footprint = spread_of_numbers(c.footprint, n);
    m->residual = spread_of_numbers(c.residual, n);
    m->normal = spread_of_numbers(c.normal, n);
    free(all);
    return MNS_OK;
}

static void count_masks(const truth_planes *truth, const mns_image *image, metrics *m)
{
    for (size_t i = 0; i < m->pixels; i++) {
        bool has = isfinite(image->t[i]), should = isfinite(truth->t[i]);
        bool decided = is_decided(truth, image, i);
        m->hits += has;
        m->missed += should && !has;
        m->invented += has && !should;
        m->missed_decided += decided && should && !has;
        m->invented_decided += decided && has && !should;
        m->undecided += !(image->certain[i] > 0.5f);
        if (decided && has && should && truth->radius)
            m->wrong_root += is_wrong_root(truth, i, image_distance(image, i));
    }
}

static double encoded(float linear)
{
    double v = fmin(fmax(linear, 0), 1); /* IEC 61966-2-1 */
    return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
}

/* Peak signal 1 over the mean square of the differences of red, green and blue as sRGB. */
static double psnr(const truth_planes *truth, const mns_image *image, size_t pixels)
{
    if (!truth->rgba || !image->rgba) return NAN;
    double squares = 0;
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 4 * i; c < 4 * i + 3; c++) {
            if (truth->rgba[c] == image->rgba[c]) continue;
            double difference = encoded(truth->rgba[c]) - encoded(image->rgba[c]);
            squares += difference * difference;
        }
    double mean = squares / (3 * (double)pixels);
    return mean > 0 ? fmin(-10 * log10(mean), METRICS_PSNR_MOST) : METRICS_PSNR_MOST;
}

/* ---- The worst pixels ---- */

/* The worst of one kind so far, the worst first. */
typedef struct worst_list {
    metrics_pixel pixel[METRICS_WORST];
    double badness[METRICS_WORST];
    size_t count;
} worst_list;

static void worst_offer(worst_list *list, double badness, const metrics_pixel *pixel)
{
    size_t at = list->count;
    if (at == METRICS_WORST && !(badness > list->badness[at - 1])) return;
    if (at == METRICS_WORST)
        at--;
    else
        list->count++;
    for (; at && badness > list->badness[at - 1]; at--) {
        list->badness[at] = list->badness[at - 1];
        list->pixel[at] = list->pixel[at - 1];
    }
    list->badness[at] = badness;
    list->pixel[at] = *pixel;
}

/* How squarely the ray meets the surface that the one sees and the other does not: a touch is a small fault.
 */
static double squareness(const truth_planes *truth, const metrics_pixel *p, const double normal[3])
{
    double d[3];
    if (!truth->has_view) return 0;
    mns_view_ray(&truth->view, p->x + 0.5, p->y + 0.5, d);
    return fabs(vec3_dot(vec3_load(d), vec3_load(normal)));
}

/* Missed and invented pixels have no distance to be ranked by beside the others, and would fill the list of a
 * bad run: they have a share of it each, and more only where others leave room. */
static void merge_worst(metrics *m, const worst_list list[3])
{
    size_t taken[3], room = METRICS_WORST, used = 0;
    for (int k = 0; k < 2; k++) {
        taken[k] = list[k].count < WORST_SHARE ? list[k].count : WORST_SHARE;
        room -= taken[k];
    }
    taken[2] = list[2].count < room ? list[2].count : room;
    room -= taken[2];
    for (int k = 0; k < 2; k++) {
        size_t more = list[k].count - taken[k];
        more = more < room ? more : room;
        taken[k] += more;
        room -= more;
    }
    for (int k = 0; k < 3; k++) {
        memcpy(m->worst + used, list[k].pixel, taken[k] * sizeof *m->worst);
        used += taken[k];
    }
    m->worst_count = used;
}

static void find_worst(const truth_planes *truth, const mns_image *image, metrics *m)
{
    worst_list list[3] = {{.count = 0}, {.count = 0}, {.count = 0}};
    for (size_t i = 0; i < m->pixels; i++) {
        double t = image_distance(image, i);
        bool has = isfinite(t), should = isfinite(truth->t[i]);
        if (!(has || should) || !is_decided(truth, image, i)) continue;
        metrics_pixel p = {.x = (int)(i % (size_t)truth->width),
                           .y = (int)(i / (size_t)truth->width),
                           .t = t,
                           .truth = truth->t[i],
                           .error = NAN};
        if (has && should) {
            bool wrong = truth->radius && is_wrong_root(truth, i, t);
            p.kind = wrong ? METRICS_WRONG_ROOT : METRICS_DEPTH;
            p.error = relative_error(truth, i, t);
            if (p.error > 0) worst_offer(&list[2], p.error, &p);
        } else if (should) {
            p.kind = METRICS_MISSED;
            worst_offer(&list[0], squareness(truth, &p, truth->normal + 3 * i), &p);
        } else {
            const float *n = image->normal + 3 * i;
            p.kind = METRICS_INVENTED;
            worst_offer(&list[1], squareness(truth, &p, (double[3]){n[0], n[1], n[2]}), &p);
        }
    }
    merge_worst(m, list);
}

mns_status metrics_measure(const truth_planes *truth, const mns_image *image, const mns_reference *reference,
                           double iso, metrics *result, mns_error *error)
{
    if (truth->width != image->width || truth->height != image->height)
        return status_fail(error, MNS_ERROR_USAGE,
                           "images of %dx%d and %dx%d pixels: expected two of the same size", truth->width,
                           truth->height, image->width, image->height);
    metrics m = {.pixels = (size_t)truth->width * (size_t)truth->height};
    mns_status status = measure_spreads(truth, image, reference, iso, &m, error);
    if (status) return status;
    count_masks(truth, image, &m);
    m.effects = metrics_effects_of(truth, image);
    m.psnr = psnr(truth, image, m.pixels);
    find_worst(truth, image, &m);
    *result = m;
    return MNS_OK;
}
