/* The meshes of a look, read once and kept as long as their files, and those that these name, stay as they
 * are. */
#ifndef MNS_SOLID_SOLID_FILES_H
#define MNS_SOLID_SOLID_FILES_H

#include "solid/solid.h"

/* Zeroed: none. */
typedef struct solid_files {
    solid_set set;
    double unit;      /* of its lengths */
    uint64_t version; /* changes with the set */
    char **name;      /* a mesh */
    size_t count;
    watch opened;
} solid_files;

/* Reads the meshes, in that unit, unless they are there as they are. Errors: as solid_read. */
mns_status solid_files_take(solid_files *files, const mns_mesh *mesh, size_t count, double unit,
                            mns_error *error);
void solid_files_free(solid_files *files);

#endif
