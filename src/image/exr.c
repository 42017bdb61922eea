#include "image/exr.h"

#include <string.h>

void image_list_channels(const mns_image *image, bool has_error, image_channels *channels)
{
    const image_channel list[IMAGE_CHANNELS] = {
        {"A", image->rgba, 4, 3},     {"B", image->rgba, 4, 2},
        {"G", image->rgba, 4, 1},     {"N.X", image->normal, 3, 0},
        {"N.Y", image->normal, 3, 1}, {"N.Z", image->normal, 3, 2},
        {"R", image->rgba, 4, 0},     {"certain", image->certain, 1, 0},
        {"t", image->t, 1, 0},        {IMAGE_ERROR_CHANNEL, image->t_error, 1, 0},
        {"t.lo", image->t_lo, 1, 0},
    };
    channels->count = 0;
    for (int i = 0; i < IMAGE_CHANNELS; i++)
        if (has_error || strcmp(list[i].name, IMAGE_ERROR_CHANNEL) != 0)
            channels->channel[channels->count++] = list[i];
    const image_channel work[IMAGE_WORK_CHANNELS] = {
        {"work.balls", image->work, MNS_WORK_COUNT, MNS_WORK_BALLS},
        {"work.leaves", image->work, MNS_WORK_COUNT, MNS_WORK_LEAVES},
        {"work.nodes", image->work, MNS_WORK_COUNT, MNS_WORK_NODES},
        {"work.rounds", image->work, MNS_WORK_COUNT, MNS_WORK_ROUNDS},
    };
    for (int i = 0; i < IMAGE_WORK_CHANNELS && image->work; i++)
        channels->channel[channels->count++] = work[i];
}

const image_channel *image_find_channel(const image_channels *channels, const char *name)
{
    for (int i = 0; i < channels->count; i++)
        if (!strcmp(channels->channel[i].name, name)) return &channels->channel[i];
    return NULL;
}
