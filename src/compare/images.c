#include "compare/images.h"

#include <stdio.h>

size_t images_mask_errors(const truth_planes *truth, const mns_image *image, const metrics *m)
{
    size_t undecided = 0;
    for (size_t i = 0; i < m->pixels; i++) undecided += truth->certain[i] && !(image->certain[i] > 0.5f);
    return m->missed_decided + m->invented_decided + undecided;
}

static size_t wrong_terms(const metrics_effects *e)
{
    size_t wrong = 0;
    for (int i = 0; i < TRUTH_TERMS; i++) wrong += e->wrong[i];
    return wrong;
}

bool images_judge(const images_tolerance *tolerance, size_t mask_errors, const metrics *m, char *why,
                  size_t size)
{
    const metrics_pixel *worst = m->worst_count ? &m->worst[0] : NULL;
    char place[48] = "";
    for (size_t i = 0; i < m->worst_count && mask_errors <= tolerance->mask; i++)
        if (m->worst[i].kind == METRICS_DEPTH) {
            worst = &m->worst[i];
            break;
        }
    if (worst) snprintf(place, sizeof place, ", the worst at %d,%d", worst->x, worst->y);
    if (mask_errors > tolerance->mask)
        snprintf(
            why, size,
            "%zu pixels missed, %zu invented, %zu in all that differ or are left undecided (at most %zu)%s",
            m->missed_decided, m->invented_decided, mask_errors, tolerance->mask, place);
    else if (m->t.max > tolerance->t) /* NAN where nothing is compared */
        snprintf(why, size, "t is off by %.3g of the distance (at most %.3g)%s", m->t.max, tolerance->t,
                 place);
    else if (m->normal.max > tolerance->normal)
        snprintf(why, size, "a normal is off by %.3g degrees (at most %.3g)", m->normal.max,
                 tolerance->normal);
    else if (wrong_terms(&m->effects) > tolerance->mask)
        snprintf(why, size,
                 "effects are wrong: %zu pixels of the shadow, %zu occlusion, %zu mirror, %zu refraction (at "
                 "most %zu)",
                 m->effects.wrong[TRUTH_SHADOW], m->effects.wrong[TRUTH_OCCLUSION],
                 m->effects.wrong[TRUTH_MIRROR], m->effects.wrong[TRUTH_REFRACTION], tolerance->mask);
    else
        return true;
    return false;
}
