#include "image/exr.h"

#include <string.h>

const char *const image_optional_names[IMAGE_OPTIONAL] = {
    "t.err", "shadow", "occlusion", "mirror.t", "refract.t", "certain.effects", "mesh"};

float **image_optional(mns_image *image, int index)
{
    float **const planes[IMAGE_OPTIONAL] = {&image->t_error,  &image->shadow,    &image->occlusion,
                                            &image->mirror_t, &image->refract_t, &image->effects_certain,
                                            &image->mesh};
    return planes[index];
}

void image_list_channels(const mns_image *image, image_channels *channels)
{
    const image_channel list[] = {
        {"A", image->rgba, 4, 3},     {"B", image->rgba, 4, 2},          {"G", image->rgba, 4, 1},
        {"N.X", image->normal, 3, 0}, {"N.Y", image->normal, 3, 1},      {"N.Z", image->normal, 3, 2},
        {"R", image->rgba, 4, 0},     {"certain", image->certain, 1, 0}, {"t", image->t, 1, 0},
        {"t.lo", image->t_lo, 1, 0},
    };
    const image_channel work[MNS_WORK_COUNT] = {
        {IMAGE_WORK, image->work, MNS_WORK_COUNT, MNS_WORK_BALLS},
        {"work.leaves", image->work, MNS_WORK_COUNT, MNS_WORK_LEAVES},
        {"work.nodes", image->work, MNS_WORK_COUNT, MNS_WORK_NODES},
        {"work.rounds", image->work, MNS_WORK_COUNT, MNS_WORK_ROUNDS},
    };
    mns_image same = *image;
    channels->count = 0;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) channels->channel[channels->count++] = list[i];
    for (int i = 0; i < IMAGE_OPTIONAL; i++) {
        float *plane = *image_optional(&same, i);
        if (plane)
            channels->channel[channels->count++] = (image_channel){image_optional_names[i], plane, 1, 0};
    }
    for (int i = 0; i < MNS_WORK_COUNT && image->work; i++) channels->channel[channels->count++] = work[i];
}

const image_channel *image_find_channel(const image_channels *channels, const char *name)
{
    for (int i = 0; i < channels->count; i++)
        if (!strcmp(channels->channel[i].name, name)) return &channels->channel[i];
    return NULL;
}
