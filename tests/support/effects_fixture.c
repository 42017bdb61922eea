#include "support/effects_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static double give_albedo(const void *user, const reference_scratch *scratch, double s, double color[3])
{
    const effects_fixture *f = user;
    (void)scratch, (void)s;
    memcpy(color, f->albedo, sizeof f->albedo);
    return f->weight;
}

void effects_fixture_open(effects_fixture *f, const mns_field *field, vec3 eye, vec3 at, const mns_look *look)
{
    const mns_options options = {.method = MNS_METHOD_REFERENCE};
    mns_view view = {.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT, .width = 8, .height = 8};
    mns_error error;
    *f = (effects_fixture){.field = field, .albedo = {1, 1, 1}};
    vec3_store(view.eye, eye);
    vec3_store(view.look_at, at);
    vec3 ahead = vec3_unit(vec3_sub(at, eye));
    if (fabs(ahead.y) > 0.9) view.up[0] = 1;
    if (mns_plan_create(field, &view, look, &options, NULL, &f->plan, &error)) fail_msg("%s", error.text);
    if (mns_reference_create(field, &f->reference, &error)) fail_msg("%s", error.text);
    if (effects_begin(&f->scene, f->plan, f->reference, NULL, give_albedo, f, &error))
        fail_msg("%s", error.text);
}

void effects_fixture_close(effects_fixture *f)
{
    effects_end(&f->scene);
    reference_scratch_free(&f->scratch);
    mns_reference_destroy(f->reference);
    mns_plan_destroy(f->plan);
}

effects_pixel effects_fixture_shade(effects_fixture *f, vec3 way, reference_answer *first)
{
    effects_met met;
    effects_pixel pixel = {.x = 3, .y = 5};
    way = vec3_unit(way);
    assert_true(effects_first(&f->scene, &f->scratch, way, &met));
    assert_true(effects_shade(&f->scene, &f->scratch, way, &met, &pixel));
    if (first) *first = met.answer;
    return pixel;
}
