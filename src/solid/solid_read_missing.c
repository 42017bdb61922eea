/* Stands in for solid_read.c where assimp is not there. */
#include "base/status.h"
#include "solid/solid.h"

mns_status solid_read(const char *file, uint32_t mesh, solid_soup *soup, watch *opened, mns_error *error)
{
    (void)mesh, (void)soup, (void)opened;
    return status_fail(
        error, MNS_ERROR_UNSUPPORTED,
        "%s: this build reads no meshes; install assimp (Debian: libassimp-dev) and build anew", file);
}
