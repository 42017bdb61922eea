/* meniscus info. */
#ifndef MNS_APP_INFO_H
#define MNS_APP_INFO_H

#include "meniscus.h"

#include <jansson.h>

/* What an input holds, as the object of --json: a new reference, NULL where memory ends. */
json_t *info_json(const mns_field *field, size_t frame, size_t frames);

/* The same for people, a line a thing. */
void info_print(const mns_field *field, size_t frame, size_t frames);

/* info_meshes.c: what the meshes of a look are. Errors: as mns_mesh_get_info. */
mns_status info_print_meshes(const mns_look *look, mns_error *error);
mns_status info_add_meshes(json_t *object, const mns_look *look, mns_error *error);

#endif
