/* Mitsuba's .serialized files: meshes as zlib streams, with their offsets at the end of the file (see Mitsuba
 * 0.6's manual, "Serialized mesh loader"). */
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "render/scene/shapes/mesh_file.h"

enum {
    MAGIC = 0x041c,
    HAS_NORMALS = 0x0001,
    HAS_UVS = 0x0002,
    HAS_COLORS = 0x0008,
    FACE_NORMALS = 0x0010,
    DOUBLE = 0x2000 /* if unset: single precision, regardless of 0x1000 */
};

typedef struct serialized {
    z_stream stream;
    size_t left; /* compressed bytes not yet passed to zlib */
    uint32_t flags;
    aur_mesh_file *file;
} serialized;

static uint64_t little(const char *at, size_t size) {
    uint64_t value = 0;
    for (size_t i = 0; i < size; ++i)
        value |= (uint64_t)(unsigned char)at[i] << (8 * i);
    return value;
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
            return aur_mesh_file_fail(self->file, "the compressed mesh is broken or ends too soon");
        }
        out += piece;
        size -= piece;
    }
    return AUR_OK;
}

static double usable(double value) {
    return fabs(value) <= 1e30 ? value : (double)NAN;
}

/* Of floats all bytes come at once into the last half, from which they are widened from the first one on:
 * zlib is slower for many short pieces. */
static aur_result read_points(serialized *self, size_t count, double *points) {
    const bool is_double = (self->flags & DOUBLE) != 0;
    char *const bytes = (char *)points + (is_double ? 0 : count * sizeof(float));
    const aur_result result =
        inflate_bytes(self, bytes, count * (is_double ? sizeof(double) : sizeof(float)));
    for (size_t i = 0; result == AUR_OK && i < count; ++i) {
        float narrow;
        memcpy(&narrow, bytes + i * sizeof narrow, sizeof narrow);
        points[i] = is_double ? usable(points[i]) : (double)narrow;
    }
    return result;
}

/* `values` may be NULL: the numbers are skipped. */
static aur_result read_values(serialized *self, size_t count, float *values) {
    const bool is_double = (self->flags & DOUBLE) != 0;
    if (!is_double && values != NULL)
        return inflate_bytes(self, values, count * sizeof *values);
    double part[1024];
    aur_result result = AUR_OK;
    for (size_t done = 0, some; done < count && result == AUR_OK; done += some) {
        some = count - done < 1024 ? count - done : 1024;
        result = inflate_bytes(self, part, some * (is_double ? sizeof(double) : sizeof(float)));
        for (size_t i = 0; result == AUR_OK && values != NULL && i < some; ++i)
            values[done + i] = (float)usable(part[i]);
    }
    return result;
}

static aur_result read_mesh(serialized *self, uint64_t version, aur_mesh *mesh) {
    aur_mesh_file *const file = self->file;
    const size_t compressed = self->left;
    uint64_t counts[2];
    aur_result result = inflate_bytes(self, &self->flags, sizeof self->flags);
    char letter = version == 4 ? 'x' : '\0';
    while (result == AUR_OK && letter != '\0')
        result = inflate_bytes(self, &letter, 1); /* skip the name */
    if (result == AUR_OK)
        result = inflate_bytes(self, counts, sizeof counts);
    if (result != AUR_OK)
        return result;
    /* zlib expands one byte to at most 1032: rejects false counts before allocating. */
    const uint64_t most = 1032 * ((uint64_t)compressed + 64) / 12;
    if (counts[0] > most || counts[1] > most)
        return aur_mesh_file_fail(file, "the counts of vertices or triangles cannot be right");
    const uint32_t flags = self->flags;
    file->face_normals = file->face_normals || (flags & FACE_NORMALS);
    const bool normals = (flags & HAS_NORMALS) && !file->face_normals;
    const unsigned parts = (normals ? AUR_MESH_NORMALS : 0u) | (flags & HAS_UVS ? AUR_MESH_UVS : 0u);
    const size_t vertices = (size_t)counts[0], triangles = (size_t)counts[1];
    result =
        aur_mesh_allocate(mesh, vertices, triangles, parts, (aur_location){.file = file->path}, file->error);
    if (result == AUR_OK)
        result = read_points(self, 3 * vertices, mesh->points);
    if (result == AUR_OK && (flags & HAS_NORMALS))
        result = read_values(self, 3 * vertices, mesh->normals);
    if (result == AUR_OK && (flags & HAS_UVS))
        result = read_values(self, 2 * vertices, mesh->uvs);
    if (result == AUR_OK && (flags & HAS_COLORS))
        result = read_values(self, 3 * vertices, NULL);
    return result == AUR_OK ? inflate_bytes(self, mesh->indices, 3 * triangles * sizeof *mesh->indices)
                            : result;
}

/* The table at the end of the file has the offset of each mesh, and finally their count. */
static aur_result read_file(aur_mesh_file *file, aur_shape *shape) {
    const char *const data = file->scanner.at;
    const size_t size = (size_t)(file->scanner.end - data);
    if (size < 12 || little(data, 2) != MAGIC)
        return aur_mesh_file_fail(file, "not a serialized mesh file");
    const uint64_t version = little(data + 2, 2);
    if (version != 3 && version != 4)
        return aur_mesh_file_fail(file, "unknown version %u of the format: expected 3 or 4",
                                  (unsigned)version);
    const size_t width = version == 4 ? 8 : 4;
    const size_t count = (size_t)little(data + size - 4, 4), index = file->shape_index;
    if (count > (size - 8) / width)
        return aur_mesh_file_fail(file, "the table of meshes at the end is broken");
    if (index >= count)
        return aur_mesh_file_fail(file, "'shape_index' is %zu, but there are %zu meshes", index, count);
    const size_t table = size - 4 - count * width;
    const char *const entry = data + table + index * width;
    const uint64_t first = little(entry, width),
                   next = index + 1 < count ? little(entry + width, width) : table;
    if (first >= table || next > table || next <= first || next - first < 5)
        return aur_mesh_file_fail(file, "the table of meshes at the end is broken");
    serialized self = {.left = (size_t)(next - first - 4), .file = file};
    self.stream.next_in = (unsigned char *)(uintptr_t)data + first + 4;
    if (inflateInit(&self.stream) != Z_OK)
        return aur_fail_memory(file->error);
    const aur_result result = read_mesh(&self, little(data + first + 2, 2), &shape->mesh);
    inflateEnd(&self.stream);
    if (result == AUR_OK && shape->mesh.triangle_count == 0)
        return aur_mesh_file_fail(file, "no face in this file");
    return result;
}

static const aur_key keys[] = {
    AUR_MESH_FILE_KEYS,
    {AUR_KEY_OF_INTEGER(aur_mesh_file_keys, "shape_index", shape_index, 0, INFINITY, "0",
                        "index of the mesh in the file")},
};

const aur_shape_descriptor aur_shape_serialized = {
    .row = {.name = "serialized", .summary = "a mesh of Mitsuba's .serialized files", AUR_ROW_KEYS(keys)},
    .create = aur_mesh_file_create,
    .read_file = read_file};
