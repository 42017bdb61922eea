/* What the meshes of a scene are. */
#include "app/info.h"

#include <stdio.h>

mns_status info_print_meshes(const mns_look *look, mns_error *error)
{
    for (size_t i = 0; i < look->mesh_count; i++) {
        mns_mesh_info m;
        mns_status status = mns_mesh_get_info(look->meshes[i].file, &m, error);
        if (status) return status;
        printf("mesh %s: %zu triangles, %zu corners, %zu dropped; %.7g,%.7g,%.7g to %.7g,%.7g,%.7g\n",
               look->meshes[i].file, m.triangles, m.corners, m.dropped, m.lo[0], m.lo[1], m.lo[2], m.hi[0],
               m.hi[1], m.hi[2]);
    }
    return MNS_OK;
}

mns_status info_add_meshes(json_t *object, const mns_look *look, mns_error *error)
{
    json_t *list = json_array();
    json_object_set_new(object, "meshes", list);
    for (size_t i = 0; i < look->mesh_count; i++) {
        mns_mesh_info m;
        mns_status status = mns_mesh_get_info(look->meshes[i].file, &m, error);
        if (status) return status;
        json_array_append_new(list,
                              json_pack("{s:s, s:I, s:I, s:I, s:[[f, f, f], [f, f, f]]}", "file",
                                        look->meshes[i].file, "triangles", (json_int_t)m.triangles, "corners",
                                        (json_int_t)m.corners, "dropped", (json_int_t)m.dropped, "box",
                                        m.lo[0], m.lo[1], m.lo[2], m.hi[0], m.hi[1], m.hi[2]));
    }
    return MNS_OK;
}
