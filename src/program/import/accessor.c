/* glTF accessors that assimp misreads as floats (KHR_mesh_quantization) or does not read
 * (EXT_mesh_gpu_instancing). */
#include <stdlib.h>
#include <string.h>

#include "program/import/gltf.h"

enum { BYTE = 5120, UBYTE, SHORT, USHORT, UINT = 5125, FLOAT };

/* --- buffers */

static int digit_of(char c) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *const at = c != '\0' ? strchr(digits, c) : NULL;
    return at != NULL ? (int)(at - digits) : -1;
}

static char *decode_base64(const char *text, size_t *size) {
    char *const bytes = malloc(strlen(text) / 4 * 3 + 3);
    unsigned bits = 0, count = 0;
    *size = 0;
    for (int digit; bytes != NULL && (digit = digit_of(*text)) >= 0; ++text) {
        bits = bits << 6 | (unsigned)digit;
        count += 6;
        if (count < 8)
            continue;
        count -= 8;
        bytes[(*size)++] = (char)(bits >> count & 255);
    }
    return bytes;
}

static void load(gltf_buffer *buffer, const writer *self, const json_value *from) {
    const char *const uri = json_text(json_member(from, "uri"));
    const char *const comma = uri != NULL && strncmp(uri, "data:", 5) == 0 ? strchr(uri, ',') : NULL;
    buffer->loaded = true;
    if (uri == NULL) {
        buffer->bytes = self->gltf_binary;
        buffer->size = self->gltf_binary_size;
    } else if (comma != NULL) {
        buffer->bytes = decode_base64(comma + 1, &buffer->size);
    } else {
        char *const name = strdup(uri);
        char *bytes;
        if (name == NULL)
            stream_fail_memory();
        files_decode_address(name);
        stream_send(AUR_IMPORT_OPEN, 0, strlen(name), name);
        if (stream_receive(AUR_IMPORT_ANSWER, &buffer->size, &bytes) != 0)
            buffer->bytes = bytes;
        free(name);
    }
}

/* The bytes of a buffer view from `offset` on; NULL if missing. */
static const char *view_bytes(writer *self, const json_value *view, size_t *size) {
    const json_value *const list = json_member(self->gltf, "buffers");
    const size_t index = json_size(json_member(view, "buffer"), SIZE_MAX);
    const json_value *const from = json_item(list, index);
    if (from == NULL)
        return NULL;
    if (self->gltf_buffers == NULL)
        self->gltf_buffers = calloc(list->count, sizeof *self->gltf_buffers);
    if (self->gltf_buffers == NULL)
        stream_fail_memory();
    gltf_buffer *const buffer = &self->gltf_buffers[index];
    if (!buffer->loaded)
        load(buffer, self, from);
    const size_t offset = json_size(json_member(view, "byteOffset"), 0);
    *size = json_size(json_member(view, "byteLength"), 0);
    if (buffer->bytes == NULL || offset > buffer->size || *size > buffer->size - offset)
        return NULL;
    return buffer->bytes + offset;
}

/* --- accessors */

static size_t size_of(size_t type) {
    return type == BYTE || type == UBYTE ? 1 : type == SHORT || type == USHORT ? 2 : 4;
}

/* Normalization of glTF 2.0, 3.11: c / 127 and so on, at least -1. */
static double value_at(const char *at, size_t type, bool normalized) {
    int8_t byte;
    int16_t word;
    uint16_t unsigned_word;
    uint32_t number;
    float real;
    switch (type) {
    case BYTE:
        memcpy(&byte, at, sizeof byte);
        return normalized ? byte > -127 ? byte / 127.0 : -1.0 : byte;
    case UBYTE:
        return normalized ? (unsigned char)*at / 255.0 : (unsigned char)*at;
    case SHORT:
        memcpy(&word, at, sizeof word);
        return normalized ? word > -32767 ? word / 32767.0 : -1.0 : word;
    case USHORT:
        memcpy(&unsigned_word, at, sizeof unsigned_word);
        return normalized ? unsigned_word / 65535.0 : unsigned_word;
    case UINT:
        memcpy(&number, at, sizeof number);
        return number;
    default:
        memcpy(&real, at, sizeof real);
        return (double)real;
    }
}

double *gltf_accessor_read(writer *self, const json_value *index, size_t width, size_t *count) {
    static const char *const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const json_value *const accessor =
        index != NULL ? json_item(json_member(self->gltf, "accessors"), json_size(index, SIZE_MAX)) : NULL;
    const json_value *const view = json_item(json_member(self->gltf, "bufferViews"),
                                             json_size(json_member(accessor, "bufferView"), SIZE_MAX));
    const char *const kind = json_text(json_member(accessor, "type"));
    const size_t type = json_size(json_member(accessor, "componentType"), 0);
    if (kind == NULL || view == NULL || strcmp(kind, types[width - 1]) != 0 || type < BYTE || type > FLOAT ||
        json_member(accessor, "sparse") != NULL)
        return NULL;
    size_t size = 0;
    const char *const bytes = view_bytes(self, view, &size);
    const size_t element = width * size_of(type), first = json_size(json_member(accessor, "byteOffset"), 0);
    const size_t stride = json_size(json_member(view, "byteStride"), element);
    *count = json_size(json_member(accessor, "count"), 0);
    if (bytes == NULL || *count == 0 || stride < element || stride > 252 || first > size ||
        size - first < element || (*count - 1) > (size - first - element) / stride)
        return NULL;
    const bool normalized = json_number(json_member(accessor, "normalized"), 0.0) != 0.0;
    double *const values = malloc(*count * width * sizeof *values);
    if (values == NULL)
        stream_fail_memory();
    for (size_t i = 0; i < *count; ++i)
        for (size_t k = 0; k < width; ++k)
            values[width * i + k] =
                value_at(bytes + first + i * stride + k * size_of(type), type, normalized);
    return values;
}

/* --- meshes with integer attributes */

static bool is_float(const writer *self, const json_value *index) {
    const json_value *const accessor =
        json_item(json_member(self->gltf, "accessors"), json_size(index, SIZE_MAX));
    return json_size(json_member(accessor, "componentType"), FLOAT) == FLOAT;
}

/* Replaces values that assimp copied as floats; assimp's v coordinate is measured from the bottom. */
static void refine_attribute(writer *self, const json_value *index, size_t width, unsigned vertices,
                             struct aiVector3D *to) {
    size_t count = 0;
    if (index == NULL || to == NULL || is_float(self, index))
        return;
    double *const values = gltf_accessor_read(self, index, width, &count);
    for (size_t i = 0; values != NULL && count == vertices && i < count; ++i) {
        const double *const v = &values[width * i];
        to[i] = width == 3 ? (struct aiVector3D){(float)v[0], (float)v[1], (float)v[2]}
                           : (struct aiVector3D){(float)v[0], 1.0f - (float)v[1], 0.0f};
    }
    free(values);
}

void gltf_refine_meshes(writer *self, const struct aiNode *node, const gltf_node *exact) {
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        struct aiMesh *const mesh = self->scene->mMeshes[node->mMeshes[i]];
        const json_value *const from = json_member(gltf_primitive(self, node, exact, i), "attributes");
        refine_attribute(self, json_member(from, "POSITION"), 3, mesh->mNumVertices, mesh->mVertices);
        refine_attribute(self, json_member(from, "NORMAL"), 3, mesh->mNumVertices, mesh->mNormals);
        for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set) {
            char name[] = "TEXCOORD_0";
            name[sizeof name - 2] = (char)('0' + set);
            refine_attribute(self, json_member(from, name), 2, mesh->mNumVertices, mesh->mTextureCoords[set]);
        }
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i)
        gltf_refine_meshes(self, node->mChildren[i], gltf_child(self, exact, i));
}

/* --- instances */

size_t gltf_instances(writer *self, const gltf_node *node, double (**matrices)[16]) {
    static const char *const names[] = {"TRANSLATION", "ROTATION", "SCALE"};
    static const size_t widths[] = {3, 4, 3};
    const json_value *const from =
        json_member(json_member(json_member(node, "extensions"), "EXT_mesh_gpu_instancing"), "attributes");
    double *values[3] = {NULL, NULL, NULL};
    size_t count = 0, value_count = 0;
    *matrices = NULL;
    for (size_t k = 0; from != NULL && k < 3; ++k) {
        values[k] = gltf_accessor_read(self, json_member(from, names[k]), widths[k], &value_count);
        if (values[k] != NULL)
            count = count == 0 || value_count < count ? value_count : count;
    }
    *matrices = count > 0 ? malloc(count * sizeof **matrices) : NULL;
    if (count > 0 && *matrices == NULL)
        stream_fail_memory();
    for (size_t i = 0; i < count; ++i)
        gltf_matrix(values[0] != NULL ? &values[0][3 * i] : (const double[3]){0.0, 0.0, 0.0},
                    values[1] != NULL ? &values[1][4 * i] : (const double[4]){0.0, 0.0, 0.0, 1.0},
                    values[2] != NULL ? &values[2][3 * i] : (const double[3]){1.0, 1.0, 1.0}, (*matrices)[i]);
    for (size_t k = 0; k < 3; ++k)
        free(values[k]);
    return count;
}
