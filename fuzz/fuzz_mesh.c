/* Mesh files, OBJ, PLY and serialized, and curve files, distinguished by their first bytes. */
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "fuzz.h"
#include "render/scene/shape.h"

static const char *input_path(void) {
    static char path[64];
    snprintf(path, sizeof path, "fuzz-mesh-%ld", (long)getpid());
    return path;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_write_file(input_path(), data, size);
    const bool ply = size >= 3 && memcmp(data, "ply", 3) == 0;
    const bool serialized = size >= 2 && data[0] == 0x1c && data[1] == 0x04;
    const aur_location where = {.file = input_path(), .line = 1};
    aur_parameters parameters;
    aur_error error = {0};
    /* No line of an OBJ file begins with a number. */
    const bool curves = size >= 1 && (data[0] == '-' || (data[0] >= '0' && data[0] <= '9'));
    const char *const plugin = ply              ? "ply"
                               : serialized     ? "serialized"
                               : !curves        ? "obj"
                               : data[0] == '-' ? "bsplinecurve"
                                                : "linearcurve";
    fuzz_require(aur_parameters_init(&parameters, "shape", plugin, where, &error) == AUR_OK &&
                     aur_parameters_add_text(&parameters, AUR_PARAMETER_STRING, "filename", input_path(),
                                             where, &error) == AUR_OK,
                 "no parameters");
    aur_xml_document document = {0};
    aur_shape *shape = NULL;
    const aur_result result = aur_shape_create(&parameters, &document, &shape, &error);
    aur_parameters_release(&parameters);
    aur_xml_release(&document);
    unlink(input_path());
    if (result != AUR_OK) {
        fuzz_require(shape == NULL, "a failed read left a shape");
        fuzz_require(error.message[0] != '\0' && error.file[0] != '\0',
                     "a failure without a message or a place");
        fuzz_require(result == AUR_ERROR_FORMAT || result == AUR_ERROR_MEMORY, "a failure of the wrong kind");
        return 0;
    }
    fuzz_require(aur_shape_recenter(shape, (const double[3]){0.0}, false, &error) == AUR_OK, "no memory");
    for (size_t i = 0; i < 4 * shape->curves.point_count; ++i)
        fuzz_require(isfinite(shape->curves.points[i]), "a point of a curve that is not finite");
    for (size_t i = 0; i < shape->curves.segment_count; ++i)
        fuzz_require(shape->curves.firsts[i] + (shape->curves.smooth ? 4u : 2u) <= shape->curves.point_count,
                     "a segment beyond the points");
    fuzz_require(curves ? shape->curves.segment_count > 0 : shape->mesh.triangle_count > 0,
                 "a shape without primitives");
    const aur_mesh *const mesh = &shape->mesh;
    for (size_t i = 0; i < 3 * mesh->triangle_count; ++i)
        fuzz_require(mesh->indices[i] < mesh->vertex_count, "an index beyond the vertices");
    for (size_t i = 0; i < 3 * mesh->vertex_count; ++i) {
        fuzz_require(isfinite(mesh->positions[i]), "a position that is not finite");
        fuzz_require(mesh->normals == NULL || isfinite(mesh->normals[i]), "a normal that is not finite");
        fuzz_require(mesh->vertex_colors == NULL || isfinite(mesh->vertex_colors[i]),
                     "a vertex's colour that is not finite");
    }
    for (size_t i = 0; mesh->face_colors != NULL && i < 3 * mesh->triangle_count; ++i)
        fuzz_require(isfinite(mesh->face_colors[i]), "a face's colour that is not finite");
    aur_shape_destroy(shape);
    return 0;
}

static const char *const texts[] = {
    "# square\nv 0 0 1\nv 1 0 1.0e0\nv +1. 1 1 0.2 0.4 1\nv 0 1 \\\n 1 1.0\nvt 0 0\nvt 1 0\nvt 1 0.5\nvt 0 "
    "0.5\n"
    "vn 0.6 0 0.8\ng a\nusemtl x\nf -4/1/1 2/2/1 3/3/-1 4/4/1\nf 1 2 3\nf 1//1 2//1 3//1\n",
    "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty double y\nproperty float "
    "z\n"
    "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\nelement "
    "other 1\n"
    "property list uchar short stuff\nelement face 1\nproperty int flag\nproperty list uchar int "
    "vertex_indices\n"
    "end_header\n0 0 1 0 0 1 0 0\n1 0 1 0 0 1 1 0\n1 1 1 0 0 1 1 1\n0 1 1 0 0 1 0 1\n2 7 8\n-3 4 0 1 2 3\n",
    "ply\nformat ascii 1.0\nelement face 2\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    "property list uchar int vertex_indices\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty float r\nproperty float g\nproperty float b\nend_header\n"
    "255 51 0 4 0 1 2 3\n0 0 255 3 0 1 3\n"
    "0 0 0 1 0 0\n1 0 0 0 1 0\n1 1 0 0 0 1\n0 1 0 0.5 0.5 0.5\n",
    "0 0 0 .1\n1 0.3 0 0.2\n# hair\n2 1 0 .1\n\n1 1 1 0\n+2 1e0 1 .1\n",
    "-1 0 0 .1\r\n1 0.3 0 0.2\r\n2 1 0 .1\r\n3 1 0 .1 \r\n4 2 1 0\r\n",
};

enum { TEXT_COUNT = sizeof texts / sizeof texts[0] };

static size_t binary_ply(bool big, uint8_t *data) {
    static const char head[] = "ply\nformat binary_%s_endian 1.0\nelement vertex 3\nproperty float x\n"
                               "property float y\nproperty short z\nelement face 1\n"
                               "property list uchar uint vertex_indices\nend_header\n";
    size_t size = (size_t)sprintf((char *)data, head, big ? "big" : "little");
    for (size_t i = 0; i < 3; ++i) {
        const uint8_t vertex[10] = {0, 0, (uint8_t)(i == 1 ? 0x80 : 0), (uint8_t)(i == 1 ? 0x3f : 0),
                                    0, 0, (uint8_t)(i == 2 ? 0x80 : 0), (uint8_t)(i == 2 ? 0x3f : 0),
                                    1, 0};
        memcpy(data + size, vertex, sizeof vertex);
        size += sizeof vertex;
    }
    data[size++] = 3;
    for (uint8_t i = 0; i < 3; ++i) {
        const uint8_t index[4] = {big ? 0 : i, 0, 0, big ? i : 0};
        memcpy(data + size, index, sizeof index);
        size += sizeof index;
    }
    return size;
}

static size_t serialized_file(uint8_t *data) {
    uint8_t plain[256];
    size_t used = 0;
    const uint32_t flags = 0x1000u | 2u, indices[3] = {0, 1, 2}, count = 1;
    const uint64_t counts[2] = {3, 1}, offset = 0;
    const float floats[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
    memcpy(plain, &flags, 4);
    memcpy(plain + 4, "m", 2);
    memcpy(plain + 6, counts, 16);
    memcpy(plain + 22, floats, sizeof floats);
    memcpy(plain + 22 + sizeof floats, indices, sizeof indices);
    used = 22 + sizeof floats + sizeof indices;
    memcpy(data, "\x1c\x04\x04\0", 4);
    uLongf size = 1024;
    fuzz_require(compress2(data + 4, &size, plain, used, 0) == Z_OK, "a seed cannot be compressed");
    memcpy(data + 4 + size, &offset, 8);
    memcpy(data + 12 + size, &count, 4);
    return size + 16;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    fuzz_require(capacity >= 4096, "no room for a seed");
    if (index < TEXT_COUNT) {
        const size_t size = strlen(texts[index]);
        memcpy(data, texts[index], size);
        return size;
    }
    switch (index - TEXT_COUNT) {
    case 0:
        return binary_ply(false, data);
    case 1:
        return binary_ply(true, data);
    case 2:
        return serialized_file(data);
    }
    return 0;
}
