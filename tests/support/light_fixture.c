#include "support/light_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

const mns_options light_truth = {.method = MNS_METHOD_REFERENCE};
const mns_view light_view = {.width = LIGHT_WIDTH, .height = LIGHT_HEIGHT};
const mns_view light_tilted_view = {.up = {0.6, 0.2, -0.4}, .width = LIGHT_WIDTH, .height = LIGHT_HEIGHT};

static const mns_light sun = {.kind = MNS_LIGHT_DIRECTIONAL, .direction = {1, 2, 1.5}};
const mns_light light_lamps[LIGHT_LAMPS] = {
    {.kind = MNS_LIGHT_POINT, .position = {1, 2, 2}, .color = {1, 0.5, 0.25}},
    {.kind = MNS_LIGHT_AREA, .position = {-1, 2, 1}, .radius = 0.5, .strength = 0.5},
    {.kind = MNS_LIGHT_HEAD, .strength = 0.25},
    {.kind = MNS_LIGHT_AREA, .position = {0, 0.5, 3}, .radius = 9, .strength = 0.25}}; /* around all */

#define SUN .lights = &sun, .light_count = 1

const light_look
    light_hard = {"hard shadows", {SUN, .effects = {.shadows = true}}},
    light_soft =
        {"lamps and occlusion",
         {.lights = light_lamps,
          .light_count = LIGHT_LAMPS,
          .set = MNS_LOOK_BACKGROUND,
          .background = {0.2, 0.4, 0.6, 0.5},
          .effects = {.shadows = true, .shadow_samples = 4, .occlusion_rays = 6, .occlusion_reach = 0.3}}},
    light_mirror = {"mirrors",
                    {SUN,
                     .effects = {.shadows = true, .reflections = 2, .mirror = 0.5, .environment = "sky"}}},
    light_glass = {"glass",
                   {SUN, .effects = {.shadows = true,
                                     .occlusion_rays = 1,
                                     .reflections = 1,
                                     .refractions = 4,
                                     .index = 1.4,
                                     .transmission = 0.75,
                                     .absorption = {1, 2, 3}}}};

bool light_is_second(const draw_fixture *d)
{
    return d->gl.backend == MNS_BACKEND_OSMESA;
}

bool light_differs(const float *got, const float *want, int i, double allowed)
{
    if (!want) return got != NULL;
    return !(got[i] == want[i] || fabs((double)got[i] - (double)want[i]) <= allowed);
}

static bool is_certain(const mns_image *image, int i)
{
    return image->certain[i] == 1 && (!image->effects_certain || image->effects_certain[i] == 1);
}

bool light_is_open(const mns_image *got, const mns_image *want, int i)
{
    return !is_certain(got, i) || !is_certain(want, i);
}

bool light_terms_differ(const mns_image *got, const mns_image *want, int i, double length)
{
    return light_differs(got->shadow, want->shadow, i, 1e-5) ||
           light_differs(got->occlusion, want->occlusion, i, 1e-5) ||
           light_differs(got->mirror_t, want->mirror_t, i, length) ||
           light_differs(got->refract_t, want->refract_t, i, length);
}

bool light_colors_differ(const mns_image *got, const mns_image *want, int i, double allowed)
{
    bool differ = false;
    for (int c = 0; c < 4; c++) differ = differ || light_differs(got->rgba, want->rgba, 4 * i + c, allowed);
    return differ;
}

light_tally light_compare(const mns_image *got, const mns_image *want, double length, double color)
{
    light_tally sum = {0};
    for (int i = 0; i < LIGHT_PIXELS; i++) {
        sum.hits += !isinf(want->t[i]);
        bool open = light_is_open(got, want, i);
        sum.open += open;
        sum.wrong += !open && light_terms_differ(got, want, i, length);
        sum.off += !open && light_colors_differ(got, want, i, color);
    }
    return sum;
}

void light_expect_truth(draw_fixture *d, const mns_field *field, const mns_view *view, const light_look *look,
                        const mns_options *options, double length, int off, const char *what)
{
    mns_image *want = draw_image(d, field, view, &look->look, &light_truth);
    uint64_t rays = d->stats.effects_rays;
    mns_image *got = draw_image(d, field, view, &look->look, options);
    light_tally sum = light_compare(got, want, length, 3e-3);
    if (sum.wrong || sum.off > off || sum.open > 2 + sum.hits / 200)
        fail_msg("%s, %s: of %d hits %d open, %d wrong, %d of another colour", what, look->name, sum.hits,
                 sum.open, sum.wrong, sum.off);
    assert_true(sum.hits > 100 && d->stats.effects_undecided <= (uint64_t)sum.open);
    if (!sum.open && !off) assert_true(d->stats.effects_rays == rays);
    mns_image_destroy(want);
    mns_image_destroy(got);
}
