/* Light beyond the first hits against the truth's. */
#include "compare/metrics.h"

#include <math.h>

const char *metrics_term_name(truth_term term)
{
    static const char *const names[TRUTH_TERMS] = {"shadow", "occlusion", "mirror", "refraction"};
    return names[term];
}

static bool is_wrong(const truth_planes *truth, truth_term term, size_t i, double got)
{
    double want = truth->term[term][i];
    if (term == TRUTH_SHADOW || term == TRUTH_OCCLUSION) return !(fabs(got - want) <= METRICS_TERM);
    if (isinf(want) || isinf(got)) return !(isinf(want) && isinf(got));
    double radius = truth->radius ? truth->radius[i] : 0;
    return !(fabs(got - want) <= METRICS_ROOT_RADII * radius + METRICS_TERM_RELATIVE * want);
}

/* Whether a pixel's effects can be compared: both hit, and neither leaves anything open. */
static bool is_compared(const truth_planes *truth, const mns_image *image, size_t i)
{
    return metrics_mask_of(truth, image, i) == METRICS_MASK_BOTH && truth->effects_certain[i] > 0.5f &&
           (!image->effects_certain || image->effects_certain[i] > 0.5f);
}

metrics_effects metrics_effects_of(const truth_planes *truth, const mns_image *image)
{
    metrics_effects e = {.any = truth->effects_certain != NULL};
    size_t pixels = (size_t)truth->width * (size_t)truth->height;
    const double unit = image->t_unit > 0 ? image->t_unit : 1;
    if (!e.any) return e;
    for (size_t i = 0; i < pixels; i++) {
        e.undecided += image->effects_certain && !(image->effects_certain[i] > 0.5f);
        e.compared += is_compared(truth, image, i);
    }
    for (truth_term term = 0; term < TRUTH_TERMS; term++) {
        const float *got = truth_image_term(image, term);
        e.has[term] = truth->term[term] != NULL;
        if (!e.has[term]) continue;
        double scale = term == TRUTH_MIRROR || term == TRUTH_REFRACTION ? unit : 1;
        for (size_t i = 0; i < pixels; i++)
            if (is_compared(truth, image, i))
                e.wrong[term] += !got || is_wrong(truth, term, i, (double)got[i] * scale);
    }
    return e;
}
