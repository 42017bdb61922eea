/* The kernels' names, as options and files spell them. */
#include "meniscus.h"

#include <string.h>

static const char *const names[MNS_KERNEL_COUNT] = {
    [MNS_KERNEL_DEFAULT] = "poly3",     [MNS_KERNEL_POLY2] = "poly2",   [MNS_KERNEL_POLY3] = "poly3",
    [MNS_KERNEL_POLY4] = "poly4",       [MNS_KERNEL_WYVILL] = "wyvill", [MNS_KERNEL_PERLIN] = "perlin",
    [MNS_KERNEL_WENDLAND] = "wendland",
};

const char *mns_kernel_name(mns_kernel kernel)
{
    return (int)kernel >= 0 && kernel < MNS_KERNEL_COUNT ? names[kernel] : NULL;
}

mns_kernel mns_kernel_by_name(const char *name)
{
    if (!name) return MNS_KERNEL_COUNT;
    for (int k = MNS_KERNEL_DEFAULT + 1; k < MNS_KERNEL_COUNT; k++)
        if (!strcmp(name, names[k])) return (mns_kernel)k;
    return MNS_KERNEL_COUNT;
}
