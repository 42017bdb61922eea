/* How far the means over sampled rays may be from what endlessly many would give. */
#include "render/render.h"

#include <math.h>

/* The root mean square over the hits of sqrt(m (1 - m) / rays): what so many independent rays a pixel leave
 * in a mean m of 0s and 1s. Spread evenly they leave less. */
static double noise_of(const mns_image *image, const float *mean, double rays)
{
    double sum = 0;
    size_t hits = 0, pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++) {
        if (isinf(image->t[i])) continue;
        double m = mean[i];
        sum += fmax(m * (1 - m), 0);
        hits++;
    }
    return hits ? sqrt(sum / ((double)hits * rays)) : 0;
}

/* The shadow's mean is over all lights that cast: of n lights it is at most as far off as one of n times the
 * rays, for x (1 - x) is concave. */
void frame_measure_noise(mns_frame *f, const mns_image *image)
{
    const mns_plan *plan = f->plan;
    const mns_effects *e = &plan->look.effects;
    double lights = 0, samples = f->summed > 0 ? f->summed : 1;
    for (size_t i = 0; i < plan->look.light_count; i++) lights += plan->light[i].kind != MNS_LIGHT_HEAD;
    f->stats.noise_shadow = f->stats.noise_occlusion = 0;
    if (image->shadow && plan->features & FEATURE_SOFT_SHADOWS)
        f->stats.noise_shadow = noise_of(image, image->shadow, samples * lights * e->shadow_samples);
    if (image->occlusion)
        f->stats.noise_occlusion = noise_of(image, image->occlusion, samples * e->occlusion_rays);
}
