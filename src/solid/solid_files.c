#include "solid/solid_files.h"

#include "base/memory.h"
#include "base/status.h"

#include <string.h>

static void forget(solid_files *files)
{
    for (size_t i = 0; i < files->count; i++) free(files->name[i]);
    free(files->name);
    solid_set_free(&files->set);
    watch_free(&files->opened);
    files->name = NULL;
    files->count = 0;
}

void solid_files_free(solid_files *files)
{
    forget(files);
    *files = (solid_files){0};
}

static bool is_same(const solid_files *files, const mns_mesh *mesh, size_t count, double unit)
{
    if (files->count != count || files->unit != unit) return false;
    for (size_t i = 0; i < count; i++)
        if (strcmp(files->name[i], mesh[i].file) != 0) return false;
    return watch_is_same(&files->opened);
}

static bool note(solid_files *files, const mns_mesh *mesh, size_t count)
{
    files->name = memory_array(count, sizeof *files->name);
    if (!files->name) return false;
    for (size_t i = 0; i < count; i++) {
        files->name[i] = strdup(mesh[i].file);
        if (!files->name[i]) return false;
        files->count = i + 1;
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
        status = solid_read(mesh[i].file, (uint32_t)i, &soup, &files->opened, error);
    if (!status) status = solid_set_make(&soup, unit, &files->set, error);
    solid_soup_free(&soup);
    if (status) forget(files);
    files->unit = unit;
    files->version++;
    return status;
}

/* FNV-1a over the corners, in words. */
static uint64_t fingerprint_of(const solid_soup *soup)
{
    uint64_t h = 0xcbf29ce484222325u;
    for (size_t i = 0; i < 3 * soup->count; i++)
        for (int a = 0; a < 3; a++) {
            uint64_t word;
            memcpy(&word, &soup->corner[i][a], sizeof word);
            h = (h ^ word) * 0x100000001b3u;
            h ^= h >> 29;
        }
    return h;
}

mns_status mns_mesh_get_info(const char *file, mns_mesh_info *info, mns_error *error)
{
    solid_soup soup = {0};
    solid_set set = {0};
    watch opened = {0};
    if (!file || !info) return status_fail(error, MNS_ERROR_USAGE, "mesh: no file, or nowhere to put it");
    mns_status status = solid_read(file, 0, &soup, &opened, error);
    if (!status) status = solid_set_make(&soup, 1, &set, error);
    if (!status) {
        *info = (mns_mesh_info){.triangles = set.triangle_count,
                                .corners = set.corner_count,
                                .dropped = set.dropped,
                                .fingerprint = fingerprint_of(&soup)};
        memcpy(info->lo, set.lo, sizeof info->lo);
        memcpy(info->hi, set.hi, sizeof info->hi);
    }
    watch_free(&opened);
    solid_set_free(&set);
    solid_soup_free(&soup);
    return status;
}
