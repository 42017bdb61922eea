#include "image/exr.h"

#include <string.h>

void image_list_channels(const mns_image *image, image_channel channels[IMAGE_CHANNELS])
{
    const image_channel list[IMAGE_CHANNELS] = {
        {"A", image->rgba, 4, 3},     {"B", image->rgba, 4, 2},          {"G", image->rgba, 4, 1},
        {"N.X", image->normal, 3, 0}, {"N.Y", image->normal, 3, 1},      {"N.Z", image->normal, 3, 2},
        {"R", image->rgba, 4, 0},     {"certain", image->certain, 1, 0}, {"t", image->t, 1, 0},
        {"t.lo", image->t_lo, 1, 0},
    };
    memcpy(channels, list, sizeof list);
}

const image_channel *image_find_channel(const image_channel channels[IMAGE_CHANNELS], const char *name)
{
    for (int i = 0; i < IMAGE_CHANNELS; i++)
        if (!strcmp(channels[i].name, name)) return &channels[i];
    return NULL;
}
