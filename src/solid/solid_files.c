#include "solid/solid_files.h"

#include "base/memory.h"
#include "base/status.h"

#include <string.h>

static void forget(solid_files *files)
{
    for (size_t i = 0; i < files->count; i++) free(files->file[i].name);
    free(files->file);
    solid_set_free(&files->set);
    files->file = NULL;
    files->count = 0;
}

void solid_files_free(solid_files *files)
{
    forget(files);
    *files = (solid_files){0};
}

static bool is_same(const solid_files *files, const mns_mesh *mesh, size_t count, double unit)
{
    struct stat about;
    if (files->count != count || files->unit != unit) return false;
    for (size_t i = 0; i < count; i++) {
        const solid_file *f = &files->file[i];
        if (strcmp(f->name, mesh[i].file) || stat(f->name, &about) || about.st_size != f->size ||
            about.st_mtim.tv_sec != f->time.tv_sec || about.st_mtim.tv_nsec != f->time.tv_nsec)
            return false;
    }
    return true;
}

/* What the files are now, before they are read: one that changes meanwhile is read again. */
static bool note(solid_files *files, const mns_mesh *mesh, size_t count)
{
    files->file = memory_array(count, sizeof *files->file);
    if (!files->file) return false;
    for (size_t i = 0; i < count; i++) {
        struct stat about = {0};
        stat(mesh[i].file, &about);
        files->file[i] = (solid_file){strdup(mesh[i].file), about.st_mtim, about.st_size};
        files->count = i + 1;
        if (!files->file[i].name) return false;
    }
    return true;
}

mns_status solid_files_take(solid_files *files, const mns_mesh *mesh, size_t count, double unit,
                            mns_error *error)
{
    if (is_same(files, mesh, count, unit)) return MNS_OK;
    solid_soup soup = {0};
    mns_status status = MNS_OK;
    forget(files);
    if (!note(files, mesh, count)) status = status_no_memory(error, "while reading meshes");
    for (size_t i = 0; i < count && !status; i++)
        status = solid_read(mesh[i].file, (uint32_t)i, &soup, error);
    if (!status) status = solid_set_make(&soup, unit, &files->set, error);
    solid_soup_free(&soup);
    if (status) forget(files);
    files->unit = unit;
    files->version++;
    return status;
}

mns_status mns_mesh_get_info(const char *file, mns_mesh_info *info, mns_error *error)
{
    solid_soup soup = {0};
    solid_set set = {0};
    if (!file || !info) return status_fail(error, MNS_ERROR_USAGE, "mesh: no file, or nowhere to put it");
    mns_status status = solid_read(file, 0, &soup, error);
    if (!status) status = solid_set_make(&soup, 1, &set, error);
    if (!status) {
        *info = (mns_mesh_info){
            .triangles = set.triangle_count, .corners = set.corner_count, .dropped = set.dropped};
        memcpy(info->lo, set.lo, sizeof info->lo);
        memcpy(info->hi, set.hi, sizeof info->hi);
    }
    solid_set_free(&set);
    solid_soup_free(&soup);
    return status;
}
