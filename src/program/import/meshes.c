#include <stdlib.h>
#include <string.h>

#include "program/import/writer.h"

/* The columns of a mesh's PLY. */
typedef struct columns {
    bool normals, uvs, colors;
    unsigned uv_set;
    float factor[4]; /* of vertex colors */
} columns;

static const struct aiMaterial *material_of(const writer *self, const struct aiMesh *mesh) {
    return self->scene->mMaterials[mesh->mMaterialIndex];
}

static columns columns_of(writer *self, const struct aiMesh *mesh) {
    const struct aiMaterial *const material = material_of(self, mesh);
    columns all = {.normals = mesh->mNormals != NULL,
                   .colors = mesh->mColors[0] != NULL,
                   .uv_set = writer_uv_set(self, material),
                   .factor = {1.0f, 1.0f, 1.0f, 1.0f}};
    all.uvs = all.uv_set < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh->mTextureCoords[all.uv_set] != NULL;
    writer_color(material, "$clr.base", all.factor);
    return all;
}

static char *append(char *at, const void *values, size_t size) {
    memcpy(at, values, size);
    return at + size;
}

static float share(float value) {
    return value > 0.0f ? value < 1.0f ? value : 1.0f : 0.0f;
}

static char *append_vertex(char *at, const struct aiMesh *mesh, const columns *all, unsigned i) {
    at = append(at, &mesh->mVertices[i], 3 * sizeof(float));
    if (all->normals)
        at = append(at, &mesh->mNormals[i], 3 * sizeof(float));
    if (all->uvs) {
        /* assimp measures v from the bottom. */
        const struct aiVector3D uv = mesh->mTextureCoords[all->uv_set][i];
        at = append(at, (float[2]){uv.x, 1.0f - uv.y}, 2 * sizeof(float));
    }
    if (all->colors) {
        const struct aiColor4D color = mesh->mColors[0][i];
        const float *const f = all->factor;
        at = append(at, (float[3]){share(f[0] * color.r), share(f[1] * color.g), share(f[2] * color.b)},
                    3 * sizeof(float));
    }
    return at;
}

static void add_mesh(writer *self, unsigned index) {
    const struct aiMesh *const mesh = self->scene->mMeshes[index];
    const columns all = columns_of(self, mesh);
    unsigned faces = 0;
    for (unsigned i = 0; i < mesh->mNumFaces; ++i)
        faces += mesh->mFaces[i].mNumIndices == 3;
    self->mesh_file[index] = NO_FILE;
    if (faces == 0)
        return;
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    char header[512];
    const int length = snprintf(
        header, sizeof header,
        "ply\nformat binary_%s_endian 1.0\nelement vertex %u\nproperty float x\nproperty float y\n"
        "property float z\n%s%s%selement face %u\nproperty list uchar uint vertex_indices\nend_header\n",
        first == 1 ? "little" : "big", mesh->mNumVertices,
        all.normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
        all.uvs ? "property float u\nproperty float v\n" : "",
        all.colors ? "property float r\nproperty float g\nproperty float b\n" : "", faces);
    const size_t floats = 3 + (all.normals ? 3u : 0u) + (all.uvs ? 2u : 0u) + (all.colors ? 3u : 0u);
    const size_t size =
        (size_t)length + 4 * floats * mesh->mNumVertices + (1 + 3 * sizeof(uint32_t)) * (size_t)faces;
    char *const data = malloc(size);
    if (data == NULL)
        stream_fail_memory();
    char *at = append(data, header, (size_t)length);
    for (unsigned i = 0; i < mesh->mNumVertices; ++i)
        at = append_vertex(at, mesh, &all, i);
    for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
        const struct aiFace *const face = &mesh->mFaces[i];
        if (face->mNumIndices != 3)
            continue;
        *at++ = 3;
        at = append(at, face->mIndices, 3 * sizeof(uint32_t));
    }
    self->mesh_file[index] = writer_add_mesh_file(self, size, data);
    free(data);
}

void writer_add_meshes(writer *self) {
    for (unsigned i = 0; i < self->scene->mNumMeshes; ++i)
        add_mesh(self, i);
}
