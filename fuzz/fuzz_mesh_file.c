/* OBJ, PLY, STL and OFF, and the polygons in them. */
#include "fuzz.h"
#include "render/scene/importers/meshes/mesh_data.h"

static void check_mesh(const aur_mesh_data *mesh) {
    size_t flaws = 0;
    for (size_t i = 0; i < AUR_FACE_FLAW_COUNT; ++i)
        flaws += mesh->flaws.counts[i];
    fuzz_require(mesh->flaws.face_count == mesh->face_count && flaws <= mesh->face_count,
                 "faces counted wrongly");
    for (size_t i = 0; i < 3 * mesh->triangle_count; ++i)
        fuzz_require(mesh->indices[i] < mesh->vertex_count, "an index beyond the vertices");
    for (size_t i = 0; i < mesh->triangle_count; ++i)
        fuzz_require(aur_mesh_face(mesh, i) < mesh->face_count, "a triangle of no face");
    for (size_t i = 0; i < 3 * mesh->vertex_count; ++i) {
        fuzz_require(mesh->points[i] >= -1e30 && mesh->points[i] <= 1e30, "a point that is not finite");
        fuzz_require(mesh->normals == NULL || mesh->normals[i] == mesh->normals[i],
                     "a normal that is no number");
    }
    for (size_t i = 0; mesh->uvs != NULL && i < 2 * mesh->vertex_count; ++i)
        fuzz_require(mesh->uvs[i] == mesh->uvs[i], "a texture coordinate that is no number");
    for (size_t k = 0; k < mesh->attribute_count; ++k) {
        const aur_mesh_attribute *const a = &mesh->attributes[k];
        const size_t count = a->width * (a->of_faces ? mesh->face_count : mesh->vertex_count);
        for (size_t i = 0; i < count; ++i)
            fuzz_require(a->values[i] == a->values[i], "an attribute that is no number");
    }
    for (size_t i = 0; i < mesh->span_count; ++i)
        fuzz_require(mesh->spans[i].first_face < mesh->face_count &&
                         mesh->spans[i].group < mesh->groups.count &&
                         (mesh->spans[i].material == AUR_MESH_NO_MATERIAL ||
                          mesh->spans[i].material < mesh->materials.count),
                     "a span of no group");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *const copy = malloc(size + 1);
    fuzz_require(copy != NULL, "no memory");
    if (size > 0)
        memcpy(copy, data, size);
    copy[size] = '\0';
    for (aur_mesh_format format = 0; format < AUR_MESH_FORMAT_COUNT; ++format) {
        const aur_mesh_source source = {.path = "a", .format = format, .size = size, .data = copy};
        const bool recognized = aur_mesh_format_of_bytes(size, copy) < AUR_MESH_FORMAT_COUNT;
        aur_mesh_data mesh;
        aur_error error = {0};
        const aur_result result = aur_mesh_read(&source, &mesh, &error);
        if (result == AUR_OK)
            check_mesh(&mesh);
        else
            fuzz_require(error.message[0] != '\0' && strcmp(error.file, "a") == 0 && mesh.points == NULL,
                         "a failure without a message or a place");
        fuzz_require(result == AUR_OK || result == AUR_ERROR_FORMAT || result == AUR_ERROR_MEMORY,
                     "a failure of the wrong kind");
        aur_mesh_data_release(&mesh);
        if (recognized)
            break;
    }
    free(copy);
    return 0;
}

static const char *const texts[] = {
    "v 0 0 1\nv 1 0 1.0e0\nv +1. 1 1 0.2 0.4 1\nv 0 1 \\\n 1 1.0\nvt 0 0\nvt 1\nvn 0.6 0 0.8\ng a\nusemtl x\n"
    "f -4/1/1 2/2/1 3/1/-1 4/2/1 # note\nf 1 2 3\no b\nf 1//1 2//1 3//1\nmtllib m.mtl\n",
    "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 2 1 0\nv 1 2 0\nf 1 2 3 4 1 5 7 6 5\nf 1 3 2 4\nf 1 2 5 "
    "6 4\nf 4 3 7 2 1\n",
    "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty double y\nproperty float "
    "z\nproperty "
    "float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\nproperty uchar "
    "heat_0\nelement "
    "other 1\nproperty list uchar short stuff\nelement face 1\nproperty int flag_x\nproperty list uchar int "
    "vertex_indices\nend_header\n0 0 1 0 0 1 0 0 7\n1 0 1 0 0 1 1 0 7\n1 1 1 0 0 1 1 1 7\n0 1 1 0 0 1 0 1 "
    "7\n2 7 8\n-3 4 0 1 "
    "2 3\n",
    "ply\rformat binary_little_endian 1.0\relement vertex 1\rproperty char x\rproperty char y\rproperty char "
    "z\relement "
    "face 2\rproperty list uchar uchar vertex_indices\rend_header\raaa\001\001\003\001\001\001",
    "solid a\n facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n endloop\n "
    "endfacet\nendsolid a\n",
    "STCNOFF\n4 2 0 # counts\n0 0 0 0 0 1 1 0 0 1 0 0\n1 0 0 0 0 1 1 0 0 1 0 0\n1 1 0 0 0 1 1 0 0 1 0 0\n0 1 "
    "0 0 0 1 1 0 0 1 0 "
    "0\n4 0 1 2 3\n3 0 1 2 255 0 0\n",
    "4OFF4 1\n0 0 0 1\n1 0 0 1\n1 1 0 2\n0 1 0 1\n4 0 1 2 3\n",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    const size_t count = sizeof texts / sizeof texts[0];
    if (index != count)
        return fuzz_text_seed(count, texts, index, capacity, data);
    /* Binary STL of one facet. */
    memset(data, 0, 84 + 50);
    data[80] = 1;
    data[84 + 12 + 12 + 3] = data[84 + 12 + 24 + 7] = 0x3f;
    return 84 + 50;
}
