#include "compare/truth.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/status.h"
#include "compare/truth_cache.h"
#include "image/image.h"

#include <math.h>
#include <omp.h>
#include <string.h>

void truth_free_effects(truth_planes *planes)
{
    for (int i = 0; i < TRUTH_TERMS; i++) {
        free(planes->term[i]);
        planes->term[i] = NULL;
    }
    free(planes->effects_certain);
    planes->effects_certain = NULL;
}

void truth_destroy(truth_planes *planes)
{
    if (!planes) return;
    free(planes->t);
    free(planes->t_error);
    free(planes->normal);
    free(planes->radius);
    free(planes->certain);
    free(planes->rgba);
    truth_free_effects(planes);
    free(planes);
}

mns_status truth_allocate(int width, int height, bool radius, bool rgba, truth_planes **result,
                          mns_error *error)
{
    if (width < 1 || height < 1)
        return status_fail(error, MNS_ERROR_USAGE, "a truth of %d x %d pixels: expected 1 or more a side",
                           width, height);
    size_t pixels = (size_t)width * (size_t)height;
    truth_planes *p = calloc(1, sizeof *p);
    if (!p) return status_no_memory(error, "making a truth");
    p->width = width, p->height = height;
    p->t = memory_array(pixels, sizeof *p->t);
    p->t_error = memory_array(pixels, sizeof *p->t_error);
    p->normal = memory_array(pixels, 3 * sizeof *p->normal);
    p->certain = memory_array(pixels, sizeof *p->certain);
    if (radius) p->radius = memory_array(pixels, sizeof *p->radius);
    if (rgba) p->rgba = memory_array(pixels, 4 * sizeof *p->rgba);
    if (!p->t || !p->t_error || !p->normal || !p->certain || (radius && !p->radius) || (rgba && !p->rgba)) {
        truth_destroy(p);
        return status_no_memory(error, "making a truth");
    }
    *result = p;
    return MNS_OK;
}

bool truth_allocate_effects(truth_planes *p, unsigned which)
{
    size_t pixels = (size_t)p->width * (size_t)p->height;
    bool whole = true;
    for (int i = 0; i <= TRUTH_TERMS && which; i++) {
        float **plane = i < TRUTH_TERMS ? &p->term[i] : &p->effects_certain;
        if (i < TRUTH_TERMS && !(which >> i & 1)) continue;
        *plane = memory_array(pixels, sizeof **plane);
        whole = whole && *plane;
    }
    return whole;
}

const float *truth_image_term(const mns_image *image, truth_term term)
{
    const float *const plane[TRUTH_TERMS] = {image->shadow, image->occlusion, image->mirror_t,
                                             image->refract_t};
    return plane[term];
}

/* The terms that the image has. */
static mns_status copy_effects(const mns_image *image, truth_planes *p, mns_error *error)
{
    size_t size = (size_t)p->width * (size_t)p->height * sizeof(float);
    unsigned which = 0;
    for (int i = 0; i < TRUTH_TERMS; i++) which |= truth_image_term(image, i) ? 1u << i : 0;
    if (!image->effects_certain || !which) return MNS_OK;
    if (!truth_allocate_effects(p, which)) return status_no_memory(error, "making a truth");
    memcpy(p->effects_certain, image->effects_certain, size);
    const float unit = image->t_unit > 0 ? (float)image->t_unit : 1;
    for (int i = 0; i < TRUTH_TERMS; i++) {
        if (p->term[i]) memcpy(p->term[i], truth_image_term(image, i), size);
        bool distance = i == TRUTH_MIRROR || i == TRUTH_REFRACTION;
        for (size_t k = 0; p->term[i] && distance && k < size / sizeof(float); k++) p->term[i][k] *= unit;
    }
    return MNS_OK;
}

static void count_pixels(truth_planes *p)
{
    size_t pixels = (size_t)p->width * (size_t)p->height;
    p->hits = p->undecided = 0;
    for (size_t i = 0; i < pixels; i++) {
        p->hits += isfinite(p->t[i]) != 0;
        p->undecided += !p->certain[i];
    }
}

/* ---- Tracing ---- */

static mns_status trace_row(const truth_desc *desc, const mns_reference *reference, int y, truth_planes *p,
                            mns_error *error)
{
    if (desc->stop && atomic_load(desc->stop))
        return status_fail(error, MNS_ERROR_USAGE, "tracing the truth: stopped");
    for (int x = 0; x < p->width; x++) {
        size_t i = (size_t)y * (size_t)p->width + (size_t)x;
        double direction[3];
        mns_hit hit;
        mns_view_ray(desc->view, x + 0.5, y + 0.5, direction);
        mns_status status = mns_reference_trace(reference, desc->view->eye, direction, &hit, error);
        if (status) return status;
        p->t[i] = hit.hit ? hit.t : INFINITY;
        p->t_error[i] = hit.t_error;
        p->certain[i] = hit.certain;
        p->radius[i] = hit.hit ? mns_field_radius(desc->field, hit.ball) : 0;
        memcpy(p->normal + 3 * i, hit.normal, sizeof hit.normal);
    }
    return MNS_OK;
}

static mns_status trace(const truth_desc *desc, truth_planes *p, mns_error *error)
{
    mns_reference *reference;
    mns_status status = mns_reference_create(desc->field, &reference, error);
    if (status) return status;
    double start = clock_ms();
    int done = 0, told = 0;
#pragma omp parallel for schedule(dynamic, 1)
    for (int y = 0; y < p->height; y++) {
        mns_error row_error;
        mns_status seen, row_status = MNS_OK;
        int rows;
#pragma omp atomic read
        seen = status;
        if (!seen) row_status = trace_row(desc, reference, y, p, &row_error);
        if (row_status) {
#pragma omp critical(truth_failed)
            if (!status) {
                if (error) *error = row_error;
#pragma omp atomic write
                status = row_status;
            }
        }
#pragma omp atomic capture
        rows = ++done;
        if (desc->progress && omp_get_thread_num() == 0)
            desc->progress(desc->context, told = rows, p->height);
    }
    /* The other threads may have taken the last rows, or all of them. */
    if (desc->progress && !status && told < done) desc->progress(desc->context, done, p->height);
    p->ms = clock_ms() - start;
    mns_reference_destroy(reference);
    return status;
}

/* Where a mesh is seen first, it is the first hit. */
static void take_meshes(const mns_image *image, truth_planes *p)
{
    const double unit = image->t_unit > 0 ? image->t_unit : 1;
    size_t pixels = (size_t)p->width * (size_t)p->height;
    for (size_t i = 0; i < pixels; i++) {
        if (image->mesh[i] == 0) continue;
        p->t[i] = image_distance(image, i);
        p->t_error[i] = (double)image->t_error[i] * unit;
        p->certain[i] = image->certain[i] > 0.5f;
        p->radius[i] = 0;
        for (size_t c = 3 * i; c < 3 * i + 3; c++) p->normal[c] = (double)image->normal[c];
    }
}

/* The same view by the renderer's own reference, for its colours and the terms of its effects. */
static mns_status shade(const truth_desc *desc, truth_planes *p, mns_error *error)
{
    mns_frame *frame = NULL;
    mns_image *image = NULL;
    mns_options options = {.method = MNS_METHOD_REFERENCE};
    mns_status status = mns_frame_create(desc->renderer, &frame, error);
    if (!status)
        status =
            mns_renderer_draw(desc->renderer, desc->field, desc->view, desc->look, &options, frame, error);
    if (!status) status = mns_frame_read(frame, &image, error);
    if (!status) memcpy(p->rgba, image->rgba, (size_t)p->width * (size_t)p->height * 4 * sizeof *p->rgba);
    if (!status) status = copy_effects(image, p, error);
    if (!status && image->mesh) take_meshes(image, p);
    mns_image_destroy(image);
    mns_frame_destroy(frame);
    return status;
}

mns_status truth_create(const truth_desc *desc, truth_planes **result, mns_error *error)
{
    static const mns_look plain = {0};
    truth_planes *p;
    mns_status status =
        truth_allocate(desc->view->width, desc->view->height, true, desc->renderer != NULL, &p, error);
    if (status) return status;
    p->has_view = true;
    p->view = *desc->view;
    const mns_look *look = desc->look ? desc->look : &plain;
    const char *driver = desc->renderer ? mns_renderer_name(desc->renderer) : NULL;
    truth_hash(desc->field, desc->view, driver ? look : NULL, driver, p->hash);
    p->cached = desc->use_cache && truth_cache_read(p);
    if (!p->cached) {
        status = trace(desc, p, error);
        if (!status && desc->renderer) status = shade(desc, p, error);
        if (!status && desc->use_cache) truth_cache_write(p);
    }
    if (status) {
        truth_destroy(p);
        return status;
    }
    count_pixels(p);
    *result = p;
    return MNS_OK;
}

/* ---- Of a saved image ---- */

mns_status truth_from_image(const mns_image *image, truth_planes **result, mns_error *error)
{
    truth_planes *p;
    mns_status status = truth_allocate(image->width, image->height, false, image->rgba != NULL, &p, error);
    if (status) return status;
    size_t pixels = (size_t)image->width * (size_t)image->height;
    const double unit = image->t_unit > 0 ? image->t_unit : 1;
    p->ms = NAN;
    for (size_t i = 0; i < pixels; i++) {
        bool hit = isfinite(image->t[i]) != 0;
        p->t[i] = image_distance(image, i);
        p->t_error[i] = hit && image->t_error ? image->t_error[i] * unit : 0;
        p->certain[i] = image->certain[i] > 0.5f;
        for (int c = 0; c < 3; c++) p->normal[3 * i + (size_t)c] = image->normal[3 * i + (size_t)c];
    }
    if (p->rgba) memcpy(p->rgba, image->rgba, pixels * 4 * sizeof *p->rgba);
    status = copy_effects(image, p, error);
    if (status) {
        truth_destroy(p);
        return status;
    }
    count_pixels(p);
    *result = p;
    return MNS_OK;
}
