#include "meniscus.h"

const char *mns_version(void)
{
    return MNS_VERSION_TEXT;
}
