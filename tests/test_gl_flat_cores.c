/* Many balls: cores are laid down as flat squares, which hide less than the spheres do and never more. Held
 * against the paper's gather, which keeps the spheres: the same hits, from every kind of view. */
#include "render/render.h"
#include "support/draw_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum { WIDE = 160, HIGH = 120 };

/* The same hits; where they are, within what another order of a sum may do to a float. */
static void expect_same_hits(const char *what, const mns_image *a, const mns_image *b)
{
    size_t hits = 0;
    for (size_t i = 0; i < (size_t)WIDE * HIGH; i++) {
        if (isfinite(a->t[i]) != isfinite(b->t[i]) || a->certain[i] != b->certain[i])
            fail_msg("%s: pixel %zu,%zu: t %g and %g", what, i % WIDE, i / WIDE, a->t[i], b->t[i]);
        if (!isfinite(a->t[i])) continue;
        hits++;
        if (fabsf(a->t[i] - b->t[i]) > 2e-6f * a->t[i])
            fail_msg("%s: pixel %zu,%zu: t %.9g and %.9g", what, i % WIDE, i / WIDE, a->t[i], b->t[i]);
    }
    if (hits < 1000) fail_msg("%s: only %zu hits", what, hits);
}

static void flat_cores_hide_no_surface(void **state)
{
    draw_fixture *d = *state;
    static const char *const fields[] = {"scattered:30000", "mixed:30000"};
    const mns_view views[] = {
        draw_view((const double[3]){0.5, 0.8, 2.4}, (const double[3]){0.5, 0.5, 0.5}, 40, WIDE, HIGH),
        draw_view((const double[3]){0.5, 0.7, 1.4}, (const double[3]){0.5, 0.5, 0.5}, 150, WIDE, HIGH),
        draw_view((const double[3]){900, 2100, 1800}, (const double[3]){0.5, 0.5, 0.5}, 0.03, WIDE, HIGH),
    };
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
        for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
            char what[64];
            snprintf(what, sizeof what, "%s, view %zu", fields[f], v);
            mns_field *field = draw_generated(fields[f], MNS_KERNEL_POLY3);
            mns_image *flat = draw_image(d, field, &views[v], NULL, NULL);
            assert_true(d->frame->plan->features & FEATURE_FLAT_CORES);
            mns_image *sphere =
                draw_image(d, field, &views[v], NULL, &(mns_options){.gather = MNS_GATHER_PAPER});
            assert_false(d->frame->plan->features & FEATURE_FLAT_CORES);
            expect_same_hits(what, flat, sphere);
            mns_image_destroy(flat);
            mns_image_destroy(sphere);
            mns_field_destroy(field);
        }
    draw_fixture_check(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(flat_cores_hide_no_surface)};
    return cmocka_run_group_tests(tests, draw_fixture_setup, draw_fixture_teardown);
}
