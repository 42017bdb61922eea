#include "support/exact.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { BALLS_MOST = 2000, RAYS = 2000 };

mns_field *cloud_field(const cloud *c, mns_kernel kernel)
{
    static double position[3 * BALLS_MOST], radius[BALLS_MOST], strength[BALLS_MOST];
    uint64_t random = 7 + c->count;
    bool one_radius = c->radius_low == c->radius_high, strong = c->strength_low != c->strength_high;
    assert_true(c->count <= BALLS_MOST);
    for (size_t i = 0; i < c->count; i++) {
        for (int a = 0; a < 3; a++) position[3 * i + (size_t)a] = c->offset + draw_random(&random);
        radius[i] = c->radius_low * pow(c->radius_high / c->radius_low, draw_random(&random));
        strength[i] = c->strength_low + (c->strength_high - c->strength_low) * draw_random(&random);
    }
    return draw_field(c->count, position, one_radius ? NULL : radius, c->radius_low, strong ? strength : NULL,
                      kernel);
}

const cloud cloud_plain = {600, 0, 0.11, 0.11, 0, 0};
const cloud cloud_radii = {500, 0, 0.02, 0.25, 0, 0};
const cloud cloud_signs = {500, 0, 0.05, 0.2, -1.5, 2.5};
const cloud cloud_moved = {600, 1e6, 0.11, 0.11, 0, 0};

/* ---- One picture against the oracle ---- */

/* What is wrong with a picture, as one line of words and numbers. */
static void fail_report(const char *what, mns_kernel kernel, const brute_report *r)
{
    fail_msg(
        "%s, %s: %zu rays, %zu hits, %zu missed, %zu invented, %zu later, %zu undecided, %zu near, t p99.9 "
        "%.3g max %.3g, normal p99.9 %.3g, gap %.3g",
        what, mns_kernel_name(kernel), r->rays, r->hits, r->missed, r->invented, r->later, r->undecided,
        r->near, r->t_p999, r->t_max, r->normal_p999, r->gap_most);
}

static brute_report measure(const mns_field *field, const mns_view *view, const mns_image *image)
{
    brute *oracle = brute_create(field);
    brute_tally *tally = brute_tally_create();
    mns_view resolved;
    mns_error error;
    assert_true(oracle && tally);
    if (mns_view_resolve(view, field, &resolved, &error) != MNS_OK) fail_msg("%s", error.text);
    assert_true(brute_tally_add(tally, oracle, &resolved, image, RAYS, 0x1p-40, 1));
    brute_report report = brute_tally_report(tally);
    brute_tally_destroy(tally);
    brute_destroy(oracle);
    return report;
}

brute_report exact_expect(draw_fixture *d, const mns_options *options, const char *what,
                          const mns_field *field, const mns_view *view)
{
    mns_image *image = draw_image(d, field, view, NULL, options);
    brute_report r = measure(field, view, image);
    mns_field_info info;
    mns_field_get_info(field, &info);
    mns_image_destroy(image);
    if (r.missed || r.invented || r.later || r.undecided > r.rays / 1000 || r.near > r.rays / 1000 ||
        r.t_p999 > 2e-6 || r.normal_p999 > 0.1)
        fail_report(what, info.kernel, &r);
    draw_fixture_check(d);
    return r;
}

mns_view exact_view(void)
{
    return draw_view((const double[3]){0.5, 0.8, 2.4}, (const double[3]){0.5, 0.5, 0.5}, 40, EXACT_WIDE,
                     EXACT_HIGH);
}

void exact_expect_cloud(draw_fixture *d, const mns_options *options, const char *what, const cloud *c,
                        mns_kernel kernel, const mns_view *view)
{
    mns_field *field = cloud_field(c, kernel);
    brute_report r = exact_expect(d, options, what, field, view);
    if (r.hits < r.rays / 4) fail_msg("%s: only %zu of %zu rays hit", what, r.hits, r.rays);
    mns_field_destroy(field);
}

void exact_eye(const mns_field *field, bool inside, double eye[3])
{
    brute *oracle = brute_create(field);
    uint64_t random = 3;
    mns_field_info info;
    mns_field_get_info(field, &info);
    for (int tries = 0; tries < 10000; tries++) {
        long double at[3];
        for (int a = 0; a < 3; a++)
            at[a] = info.lo[a] + (info.hi[a] - info.lo[a]) * (0.3 + 0.4 * draw_random(&random));
        for (int a = 0; a < 3; a++) eye[a] = (double)at[a], at[a] = eye[a];
        long double value = brute_value(oracle, at);
        if (inside ? value < info.iso * 1.5 : value < 0.01 || value > 0.8 * info.iso) continue;
        brute_destroy(oracle);
        return;
    }
    fail_msg("no eye found");
}

int exact_kernel_step(const draw_fixture *d)
{
    return d->gl.backend == MNS_BACKEND_OSMESA ? MNS_KERNEL_PERLIN - MNS_KERNEL_POLY2 : 1;
}
