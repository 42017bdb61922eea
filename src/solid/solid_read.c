/* Meshes from files, by assimp's C interface. What it reads are floats. */
#include "base/status.h"
#include "solid/solid.h"
#include "solid/solid_import.h"

#include <assimp/cimport.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { NODES_DEEP = 256 };

typedef struct reading {
    const char *file;
    const struct aiScene *scene;
    uint32_t mesh;
    solid_soup *soup;
    mns_error *error;
} reading;

/* From a node's own coordinates to the scene's: three rows. */
typedef struct placing {
    double row[3][4];
} placing;

static placing within(const placing *outer, const struct aiMatrix4x4 *m)
{
    const double inner[4][4] = {{(double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4},
                                {(double)m->b1, (double)m->b2, (double)m->b3, (double)m->b4},
                                {(double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4},
                                {0, 0, 0, 1}};
    placing both = {{{0}}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 4; k++) both.row[i][j] += outer->row[i][k] * inner[k][j];
    return both;
}

static double placed(const double row[4], const struct aiVector3D *v)
{
    return row[0] * (double)v->x + row[1] * (double)v->y + row[2] * (double)v->z + row[3];
}

static mns_status add_face(reading *r, const struct aiMesh *mesh, const struct aiFace *face,
                           const placing *at)
{
    vec3 corner[3];
    if (face->mNumIndices != 3) return MNS_OK; /* points and lines have no inside */
    for (int k = 0; k < 3; k++) {
        unsigned index = face->mIndices[k];
        if (index >= mesh->mNumVertices)
            return status_fail(r->error, MNS_ERROR_INPUT,
                               "%s: vertex %u of a mesh of %u; expected a whole mesh", r->file, index,
                               mesh->mNumVertices);
        const struct aiVector3D *v = &mesh->mVertices[index];
        corner[k] = vec3_make(placed(at->row[0], v), placed(at->row[1], v), placed(at->row[2], v));
        if (!vec3_is_finite(corner[k]))
            return status_fail(r->error, MNS_ERROR_INPUT, "%s: vertex %u is not finite; expected numbers",
                               r->file, index);
    }
    return solid_soup_add(r->soup, corner, r->mesh, r->file, r->error);
}

static mns_status add_node(reading *r, const struct aiNode *node, const placing *outer, int depth)
{
    mns_status status = MNS_OK;
    placing at = within(outer, &node->mTransformation);
    if (depth == NODES_DEEP)
        return status_fail(r->error, MNS_ERROR_UNSUPPORTED,
                           "%s: nodes more than %d deep; expected fewer levels", r->file, NODES_DEEP);
    for (unsigned i = 0; i < node->mNumMeshes && !status; i++) {
        if (node->mMeshes[i] >= r->scene->mNumMeshes) continue;
        const struct aiMesh *mesh = r->scene->mMeshes[node->mMeshes[i]];
        for (unsigned f = 0; f < mesh->mNumFaces && !status; f++)
            status = add_face(r, mesh, &mesh->mFaces[f], &at);
    }
    for (unsigned i = 0; i < node->mNumChildren && !status; i++)
        status = add_node(r, node->mChildren[i], &at, depth + 1);
    return status;
}

mns_status solid_read(const char *file, uint32_t mesh, solid_soup *soup, watch *opened, mns_error *error)
{
    static const placing here = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    size_t before = soup->count;
    FILE *there = fopen(file, "rb"); /* or the library's own complaint does not tell why */
    if (!there)
        return status_fail(error, MNS_ERROR_IO, "%s: cannot open the mesh: %s", file, strerror(errno));
    fclose(there);
    const struct aiScene *scene;
    mns_status status = solid_import(file, opened, &scene, error);
    if (status) return status;
    if (!scene->mRootNode)
        status = status_fail(error, MNS_ERROR_INPUT, "%s: it has no root; expected a whole mesh", file);
    reading r = {file, scene, mesh, soup, error};
    if (!status) status = add_node(&r, scene->mRootNode, &here, 0);
    aiReleaseImport(scene);
    if (!status && soup->count == before)
        return status_fail(error, MNS_ERROR_INPUT, "%s: no triangles in it; expected a mesh with faces",
                           file);
    return status;
}
