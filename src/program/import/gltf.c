#include "program/import/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/import/writer.h"

/* The bytes of the file, with a terminating zero byte. */
static char *bytes_of(const model_file *file, size_t *size) {
    char *data = NULL;
    if (file->bytes == NULL) {
        stream_send(AUR_IMPORT_OPEN, 0, strlen(file->name), file->name);
        return stream_receive(AUR_IMPORT_ANSWER, size, &data) != 0 ? data : NULL;
    }
    *size = file->size;
    data = malloc(file->size + 1);
    if (data == NULL)
        stream_fail_memory();
    memcpy(data, file->bytes, file->size);
    data[file->size] = '\0';
    return data;
}

void gltf_read(writer *self, const model_file *file) {
    enum { HEADER = 20 }; /* of a .glb: 12 bytes of file header and 8 of the JSON chunk's header */
    size_t size = 0;
    char *const data = bytes_of(file, &size), *text = data;
    if (data == NULL)
        return;
    if (size > HEADER && memcmp(data, "glTF", 4) == 0) {
        uint32_t length;
        memcpy(&length, data + 12, sizeof length);
        text += HEADER;
        if (length < size - HEADER) {
            /* The binary chunk follows, with a header of 8 bytes. */
            const size_t binary = HEADER + (size_t)length + 8;
            self->gltf_binary = binary < size ? data + binary : NULL;
            self->gltf_binary_size = binary < size ? size - binary : 0;
            text[length] = '\0';
        }
        self->gltf_head = HEADER;
        self->gltf_length = length < size - HEADER ? length : size - HEADER;
    }
    self->gltf_text = text;
    self->gltf = json_parse(text);
}

/* The item of a list of the file that an index property refers to; the first without the property. */
static const json_value *item_at(const writer *self, const char *list, const json_value *index) {
    const double number = json_number(index, index == NULL ? 0.0 : -1.0);
    return number >= 0.0 && number < 1e9 ? json_item(json_member(self->gltf, list), (size_t)number) : NULL;
}

static const json_value *root_list(const writer *self) {
    return json_member(item_at(self, "scenes", json_member(self->gltf, "scene")), "nodes");
}

static const json_value *node_at(const writer *self, const json_value *index) {
    return index != NULL ? item_at(self, "nodes", index) : NULL;
}

const gltf_node *gltf_root(const writer *self, const struct aiNode *root) {
    const json_value *const list = root_list(self);
    if (list == NULL)
        return NULL;
    return list->count == 1                    ? node_at(self, list->first)
           : list->count == root->mNumChildren ? self->gltf
                                               : NULL;
}

const gltf_node *gltf_child(const writer *self, const gltf_node *node, size_t index) {
    const json_value *const list = node == self->gltf ? root_list(self) : json_member(node, "children");
    return node_at(self, json_item(list, index));
}

/* assimp drops points and lines. */
const json_value *gltf_primitive(const writer *self, const struct aiNode *node, const gltf_node *exact,
                                 size_t index) {
    enum { TRIANGLES = 4 };
    const json_value *const mesh = json_member(exact, "mesh"), *found = NULL;
    const json_value *const list = json_member(
        mesh != NULL ? json_item(json_member(self->gltf, "meshes"), json_size(mesh, SIZE_MAX)) : NULL,
        "primitives");
    size_t count = 0;
    for (const json_value *item = list != NULL ? list->first : NULL; item != NULL; item = item->next)
        if (json_number(json_member(item, "mode"), TRIANGLES) >= TRIANGLES && count++ == index)
            found = item;
    return count == node->mNumMeshes ? found : NULL;
}

/* --- matrices */

static void read_numbers(const json_value *node, const char *name, size_t count, double *values) {
    const json_value *item = json_member(node, name);
    item = item != NULL && item->count == count ? item->first : NULL;
    for (size_t i = 0; item != NULL && i < count; ++i, item = item->next)
        values[i] = json_number(item, values[i]);
}

void gltf_matrix(const double t[3], const double q[4], const double s[3], double matrix[16]) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double turned[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                              2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                              2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    for (size_t i = 0; i < 16; ++i) {
        const size_t row = i / 4, column = i % 4;
        matrix[i] = row == 3      ? (column == 3 ? 1.0 : 0.0)
                    : column == 3 ? t[row]
                                  : turned[3 * row + column] * s[column];
    }
}

static void matrix_of(const json_value *node, double matrix[16]) {
    double columns[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    read_numbers(node, "matrix", 16, columns);
    read_numbers(node, "translation", 3, t);
    read_numbers(node, "rotation", 4, q);
    read_numbers(node, "scale", 3, s);
    gltf_matrix(t, q, s, matrix);
    for (size_t i = 0; json_member(node, "matrix") != NULL && i < 16; ++i)
        matrix[i] = columns[4 * (i % 4) + i / 4];
}

void gltf_refine(const gltf_node *node, double matrix[16]) {
    double exact[16], largest = 0.0;
    if (node == NULL || json_member(node, "nodes") != NULL)
        return;
    matrix_of(node, exact);
    for (size_t i = 0; i < 16; ++i)
        largest = fmax(largest, fabs(matrix[i]));
    /* assimp's values stay if it is a different node. */
    for (size_t i = 0; i < 16; ++i)
        if (!(fabs(exact[i] - matrix[i]) <=
              1e-5 * (i % 4 == 3 ? largest : fmin(largest, 1.0 + fabs(matrix[i])))))
            return;
    memcpy(matrix, exact, sizeof exact);
}

/* --- materials */

void gltf_map_materials(writer *self, const struct aiNode *node, const gltf_node *exact) {
    const unsigned count = self->scene->mNumMaterials;
    if (self->gltf_materials == NULL) {
        self->gltf_materials = malloc((count + (size_t)1) * sizeof *self->gltf_materials);
        if (self->gltf_materials == NULL)
            stream_fail_memory();
        for (unsigned i = 0; i < count; ++i)
            self->gltf_materials[i] = SIZE_MAX;
    }
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        const unsigned material_index = self->scene->mMeshes[node->mMeshes[i]]->mMaterialIndex;
        const json_value *const from = gltf_primitive(self, node, exact, i);
        if (from != NULL && material_index < count)
            self->gltf_materials[material_index] = json_size(json_member(from, "material"), SIZE_MAX);
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i)
        gltf_map_materials(self, node->mChildren[i], gltf_child(self, exact, i));
}

const json_value *gltf_extension(const writer *self, unsigned material, const char *name) {
    const size_t material_index = self->gltf_materials != NULL ? self->gltf_materials[material] : SIZE_MAX;
    return json_member(
        json_member(json_item(json_member(self->gltf, "materials"), material_index), "extensions"), name);
}
