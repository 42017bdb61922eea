/* A mesh file by assimp's C interface, and the files that it names. */
#ifndef MNS_SOLID_SOLID_IMPORT_H
#define MNS_SOLID_SOLID_IMPORT_H

#include "meniscus.h"
#include "solid/watch.h"

#include <assimp/scene.h>

/* Notes every file that is opened. The caller releases *scene (aiReleaseImport), NULL where it fails. Any
 * thread. Errors: INPUT, MEMORY. */
mns_status solid_import(const char *file, watch *opened, const struct aiScene **scene, mns_error *error);

#endif
