/* Mitsuba's .serialized files: meshes as zlib streams, with their places at the end of the file (the format
 * is in Mitsuba 0.6's manual, "Serialized mesh loader"). */
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "core/file.h"
#include "scene/shape.h"

#define LARGEST_FILE ((size_t)1 << 35)

enum {
    MAGIC = 0x041c,
    HAS_NORMALS = 0x0001,
    HAS_UVS = 0x0002,
    HAS_COLORS = 0x0008,
    FACE_NORMALS = 0x0010,
    DOUBLE = 0x2000 /* without it, single precision, whatever 0x1000 says */
};

typedef struct serialized {
    z_stream stream;
    size_t left; /* compressed bytes not yet given to zlib */
    aur_location where;
    aur_error *error;
} serialized;

static uint64_t little(const char *at, size_t size) {
    uint64_t value = 0;
    for (size_t i = 0; i < size; ++i)
        value |= (uint64_t)(unsigned char)at[i] << (8 * i);
    return value;
}

static aur_result fail(const serialized *self, const char *what) {
    return aur_fail_at(self->error, self->where, AUR_ERROR_FORMAT, "%s", what);
}

static aur_result inflate_bytes(serialized *self, void *bytes, size_t size) {
    unsigned char *out = bytes;
    while (size > 0) {
        const size_t piece = size < INT_MAX ? size : INT_MAX;
        self->stream.next_out = out;
        self->stream.avail_out = (uInt)piece;
        while (self->stream.avail_out > 0) {
            if (self->stream.avail_in == 0) {
                self->stream.avail_in = (uInt)(self->left < INT_MAX ? self->left : INT_MAX);
                self->left -= self->stream.avail_in;
            }
            const int status = inflate(&self->stream, Z_NO_FLUSH);
            if (status == Z_OK || (status == Z_STREAM_END && self->stream.avail_out == 0))
                continue;
            return fail(self, "the compressed mesh is broken or ends too soon");
        }
        out += piece;
        size -= piece;
    }
    return AUR_OK;
}

/* `count` numbers of the file's precision. */
static aur_result read_floats(serialized *self, uint32_t flags, size_t count, float *values) {
    if (!(flags & DOUBLE))
        return inflate_bytes(self, values, count * sizeof *values);
    double piece[256];
    for (size_t done = 0; done < count;) {
        const size_t part = count - done < 256 ? count - done : 256;
        const aur_result result = inflate_bytes(self, piece, part * sizeof *piece);
        if (result != AUR_OK)
            return result;
        for (size_t i = 0; i < part; ++i)
            values[done + i] = fabs(piece[i]) <= 1e30 ? (float)piece[i] : NAN;
        done += part;
    }
    return AUR_OK;
}

static aur_result read_mesh(serialized *self, uint64_t version, size_t compressed, bool face_normals,
                            aur_mesh *mesh) {
    uint32_t flags;
    uint64_t counts[2];
    aur_result result = inflate_bytes(self, &flags, sizeof flags);
    char letter = version == 4 ? 'x' : '\0';
    while (result == AUR_OK && letter != '\0')
        result = inflate_bytes(self, &letter, 1); /* the name */
    if (result == AUR_OK)
        result = inflate_bytes(self, counts, sizeof counts);
    if (result != AUR_OK)
        return result;
    /* zlib makes at most 1032 bytes of one; a count that lies is found out before memory is asked for. */
    const uint64_t most = 1032 * ((uint64_t)compressed + 64) / 12;
    if (counts[0] > most || counts[1] > most)
        return fail(self, "the counts of vertices or triangles cannot be right");
    const bool normals = (flags & HAS_NORMALS) && !face_normals && !(flags & FACE_NORMALS);
    const unsigned parts = (normals ? AUR_MESH_NORMALS : 0u) | (flags & HAS_UVS ? AUR_MESH_UVS : 0u);
    const size_t vertices = (size_t)counts[0], triangles = (size_t)counts[1];
    result = aur_mesh_allocate(mesh, vertices, triangles, parts, self->where, self->error);
    if (result == AUR_OK)
        result = read_floats(self, flags, 3 * vertices, mesh->positions);
    float *skipped = NULL;
    if (result == AUR_OK && (((flags & HAS_NORMALS) && !normals) || (flags & HAS_COLORS))) {
        skipped = malloc((3 * vertices + 1) * sizeof *skipped);
        if (skipped == NULL)
            result = aur_fail_memory_at(self->error, self->where);
    }
    if (result == AUR_OK && (flags & HAS_NORMALS))
        result = read_floats(self, flags, 3 * vertices, normals ? mesh->normals : skipped);
    if (result == AUR_OK && (flags & HAS_UVS))
        result = read_floats(self, flags, 2 * vertices, mesh->uvs);
    if (result == AUR_OK && (flags & HAS_COLORS))
        result = read_floats(self, flags, 3 * vertices, skipped);
    free(skipped);
    if (result == AUR_OK)
        result = inflate_bytes(self, mesh->indices, 3 * triangles * sizeof *mesh->indices);
    if (result == AUR_OK && triangles == 0)
        result = fail(self, "the mesh has no triangle");
    return result;
}

/* The place of mesh `index`: the table at the end has an offset a mesh, and the count of meshes last. */
static aur_result find_mesh(const char *data, size_t size, size_t index, aur_location where, size_t *offset,
                            size_t *end, aur_error *error) {
    if (size < 12 || little(data, 2) != MAGIC)
        return aur_fail_at(error, where, AUR_ERROR_FORMAT, "this is no serialized mesh file");
    const uint64_t version = little(data + 2, 2);
    if (version != 3 && version != 4)
        return aur_fail_at(error, where, AUR_ERROR_FORMAT,
                           "version %u of the format is not known: it must be 3 or 4", (unsigned)version);
    const size_t width = version == 4 ? 8 : 4;
    const size_t count = (size_t)little(data + size - 4, 4);
    if (count > (size - 8) / width)
        return aur_fail_at(error, where, AUR_ERROR_FORMAT, "the table of meshes at the end is broken");
    if (index >= count)
        return aur_fail_at(error, where, AUR_ERROR_FORMAT, "'shape_index' is %zu, but there are %zu meshes",
                           index, count);
    const size_t table = size - 4 - count * width;
    const uint64_t first = little(data + table + index * width, width);
    const uint64_t next = index + 1 < count ? little(data + table + (index + 1) * width, width) : table;
    if (first >= table || next > table || next <= first || next - first < 5)
        return aur_fail_at(error, where, AUR_ERROR_FORMAT, "the table of meshes at the end is broken");
    *offset = (size_t)first;
    *end = (size_t)next;
    return AUR_OK;
}

static aur_result read_file(const char *path, size_t index, bool face_normals, aur_mesh *mesh,
                            aur_error *error) {
    char *data;
    size_t size, offset = 0, end = 0;
    aur_result result = aur_file_read(path, LARGEST_FILE, &data, &size, error);
    if (result != AUR_OK)
        return result;
    serialized self = {.where = {.file = path}, .error = error};
    result = find_mesh(data, size, index, self.where, &offset, &end, error);
    if (result == AUR_OK && inflateInit(&self.stream) != Z_OK)
        result = aur_fail_memory_at(error, self.where);
    if (result == AUR_OK) {
        self.stream.next_in = (unsigned char *)data + offset + 4;
        self.left = end - offset - 4;
        result = read_mesh(&self, little(data + offset + 2, 2), self.left, face_normals, mesh);
        inflateEnd(&self.stream);
    }
    if (result == AUR_OK)
        result = aur_mesh_check(mesh, self.where, error);
    free(data);
    return result;
}

typedef struct serialized_keys {
    const char *filename;
    bool face_normals;
    uint64_t shape_index;
} serialized_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(serialized_keys, "filename", filename, NULL,
                     "the file, beside the scene; must be given")},
    {AUR_KEY_OF_BOOLEAN(serialized_keys, "face_normals", face_normals, "false",
                        "flat triangles, whatever normals the file has")},
    {AUR_KEY_OF_INTEGER(serialized_keys, "shape_index", shape_index, 0, INFINITY, "0",
                        "which mesh of the file")},
};

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    serialized_keys p = {.filename = NULL};
    char *path = NULL;
    aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    if (result == AUR_OK)
        result = aur_shape_filename(input, p.filename, &path, error);
    if (result == AUR_OK)
        result = read_file(path, p.shape_index, p.face_normals, &shape->mesh, error);
    free(path);
    if (result != AUR_OK)
        return result;
    aur_shape_place(input, shape);
    return AUR_OK;
}

const aur_shape_descriptor aur_shape_serialized = {.row = {.name = "serialized",
                                                           .summary = "a mesh of Mitsuba's .serialized files",
                                                           .source = "",
                                                           AUR_ROW_KEYS(keys)},
                                                   .create = create};
