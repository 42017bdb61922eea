#include "brute_image.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

static const long double pi = 3.14159265358979323846264338327950288L;

static void cross(const long double a[3], const long double b[3], long double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static long double dot(const long double a[3], const long double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void make_unit(long double a[3])
{
    long double length = sqrtl(dot(a, a));
    for (int i = 0; i < 3; i++) a[i] /= length;
}

brute_ray brute_pixel_ray(const mns_view *view, int x, int y)
{
    brute_ray ray;
    long double forward[3], up[3], right[3], straight[3];
    for (int a = 0; a < 3; a++) {
        ray.origin[a] = view->eye[a];
        forward[a] = (long double)view->look_at[a] - view->eye[a];
        up[a] = view->up[a];
    }
    make_unit(forward);
    cross(forward, up, right);
    make_unit(right);
    cross(right, forward, straight);
    long double high = 2 * tanl(view->fov * pi / 360), wide = high * view->width / view->height;
    long double sx = ((x + 0.5L) / view->width - 0.5L) * wide, sy = (0.5L - (y + 0.5L) / view->height) * high;
    for (int a = 0; a < 3; a++) ray.direction[a] = forward[a] + sx * right[a] + sy * straight[a];
    make_unit(ray.direction);
    return ray;
}

/* ---- Random pixels ---- */

static uint64_t random_bits(uint64_t *state) /* splitmix64: Steele, Lea, Flood 2014 */
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* Brings `take` random elements of `count` to the front. */
static void shuffle_front(size_t *pixel, size_t count, size_t take, uint64_t *state)
{
    for (size_t i = 0; i < take; i++) {
        size_t j = i + random_bits(state) % (count - i), swap = pixel[i];
        pixel[i] = pixel[j], pixel[j] = swap;
    }
}

/* Gives `rays` pixels, or all there are, at the front of the array returned; *rays of them. */
static size_t *draw_pixels(const mns_image *image, size_t *rays, uint64_t seed)
{
    size_t count = (size_t)image->width * (size_t)image->height, hits = 0;
    size_t *pixel = memory_array(count, sizeof *pixel);
    if (!pixel) return NULL;
    for (size_t i = 0, misses = 0; i < count; i++) {
        if (isfinite(image->t[i]))
            pixel[hits++] = i;
        else
            pixel[count - ++misses] = i;
    }
    if (*rays > count) *rays = count;
    size_t from_hits = *rays * 6 / 10;
    if (from_hits > hits) from_hits = hits;
    if (*rays - from_hits > count - hits) from_hits = *rays - (count - hits);
    shuffle_front(pixel, hits, from_hits, &seed);
    shuffle_front(pixel + hits, count - hits, *rays - from_hits, &seed);
    memmove(pixel + from_hits, pixel + hits, (*rays - from_hits) * sizeof *pixel);
    return pixel;
}

/* ---- The tally ---- */

struct brute_tally {
    brute_report report;
    double *t_error, *angle; /* report.compared of each */
    size_t capacity;
};

brute_tally *brute_tally_create(void)
{
    return calloc(1, sizeof(brute_tally));
}

void brute_tally_destroy(brute_tally *tally)
{
    if (!tally) return;
    free(tally->t_error);
    free(tally->angle);
    free(tally);
}

static bool tally_reserve(brute_tally *tally, size_t more)
{
    size_t capacity = tally->report.compared + more;
    if (capacity <= tally->capacity) return true;
    double *t_error = memory_resize(tally->t_error, capacity, sizeof *t_error);
    if (t_error) tally->t_error = t_error;
    double *angle = memory_resize(tally->angle, capacity, sizeof *angle);
    if (angle) tally->angle = angle;
    if (!t_error || !angle) return false;
    tally->capacity = capacity;
    return true;
}

static double angle_degrees(const float n[3], const long double truth[3])
{
    long double a[3] = {n[0], n[1], n[2]}, across[3];
    cross(a, truth, across);
    return (double)(atan2l(sqrtl(dot(across, across)), dot(a, truth)) * 180 / pi);
}

static void tally_wrong(brute_report *r, size_t *what, const brute_hit *truth)
{
    ++*what;
    r->gap_most = fmax(r->gap_most, truth->gap);
}

static void tally_ray(brute_tally *tally, const mns_image *image, size_t pixel, const brute_hit *truth)
{
    brute_report *r = &tally->report;
    bool undecided = image->certain[pixel] < 0.5f, hit = isfinite(image->t[pixel]);
    r->rays++;
    r->hits += truth->hit;
    r->undecided += undecided;
    r->near += truth->near;
    if (undecided || truth->near || (!hit && !truth->hit)) return;
    if (!hit) {
        tally_wrong(r, &r->missed, truth);
        return;
    }
    if (!truth->hit) {
        tally_wrong(r, &r->invented, truth);
        return;
    }
    long double t = (long double)image->t[pixel] + image->t_lo[pixel], error = fabsl(t - truth->t);
    if (!(error <= 0.1L * truth->radius)) {
        tally_wrong(r, &r->later, truth);
        return;
    }
    tally->t_error[r->compared] = (double)(error / truth->t);
    tally->angle[r->compared++] = angle_degrees(&image->normal[3 * pixel], truth->normal);
}

bool brute_tally_add(brute_tally *tally, const brute *oracle, const mns_view *view, const mns_image *image,
                     size_t rays, double tau, uint64_t seed)
{
    size_t *pixel = draw_pixels(image, &rays, seed);
    brute_hit *truth = memory_array(rays, sizeof *truth);
    bool done = pixel && truth && tally_reserve(tally, rays);
    if (done) {
        brute_limits limits = {.tau = tau, .reference = {view->eye[0], view->eye[1], view->eye[2]}};
#pragma omp parallel for schedule(dynamic, 16)
        for (size_t i = 0; i < rays; i++) {
            size_t wide = (size_t)image->width;
            brute_ray ray = brute_pixel_ray(view, (int)(pixel[i] % wide), (int)(pixel[i] / wide));
            truth[i] = brute_first_hit(oracle, &ray, &limits);
        }
        for (size_t i = 0; i < rays; i++) tally_ray(tally, image, pixel[i], &truth[i]);
    }
    free(pixel);
    free(truth);
    return done;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The nearest-rank quantile of sorted values. */
static double quantile(const double *sorted, size_t count, double share)
{
    if (!count) return 0;
    size_t rank = (size_t)ceil(share * (double)count);
    return sorted[rank ? rank - 1 : 0];
}

brute_report brute_tally_report(brute_tally *tally)
{
    brute_report *r = &tally->report;
    size_t n = r->compared;
    if (!n) return *r;
    qsort(tally->t_error, n, sizeof *tally->t_error, by_value);
    qsort(tally->angle, n, sizeof *tally->angle, by_value);
    r->t_median = quantile(tally->t_error, n, 0.5);
    r->t_p99 = quantile(tally->t_error, n, 0.99);
    r->t_p999 = quantile(tally->t_error, n, 0.999);
    r->t_max = tally->t_error[n - 1];
    r->normal_p999 = quantile(tally->angle, n, 0.999);
    r->normal_max = tally->angle[n - 1];
    return *r;
}
