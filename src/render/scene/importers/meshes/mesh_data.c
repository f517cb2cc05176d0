#include "render/scene/importers/meshes/mesh_data.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "render/scene/importers/meshes/mesh_reader.h"

static aur_result (*const readers[AUR_MESH_FORMAT_COUNT])(aur_mesh_reader *) = {
    [AUR_MESH_OBJ] = aur_obj_read,
    [AUR_MESH_PLY] = aur_ply_read,
    [AUR_MESH_STL] = aur_stl_read,
    [AUR_MESH_OFF] = aur_off_read};

/* --- triangulation */

typedef struct cutter {
    aur_mesh_reader *reader;
    aur_triangulator work;
    size_t point_capacity, index_capacity, face_capacity;
    double (*points)[3]; /* of one face */
} cutter;

static bool put_triangle(cutter *self, size_t face, const uint32_t *corners, const uint32_t triangle[3]) {
    aur_mesh_data *const data = self->reader->data;
    if (!aur_array_reserve(&data->indices, &self->index_capacity, data->triangle_count + 1,
                           3 * sizeof *data->indices) ||
        !aur_array_reserve(&data->faces, &self->face_capacity, data->triangle_count + 1, sizeof *data->faces))
        return false;
    for (size_t i = 0; i < 3; ++i)
        data->indices[3 * data->triangle_count + i] = corners[triangle[i]];
    data->faces[data->triangle_count++] = (uint32_t)face;
    return true;
}

/* Triangles are copied unchanged: degenerate ones do no harm. */
static bool cut_face(cutter *self, size_t face, size_t first, size_t count) {
    static const uint32_t whole[3] = {0, 1, 2};
    aur_mesh_data *const data = self->reader->data;
    const uint32_t *const corners = count < 3 ? NULL : &self->reader->corners[first];
    aur_face_cut cut = {
        .flaw = count < 3 ? AUR_FACE_EMPTY : AUR_FACE_GOOD, .triangle_count = count == 3, .indices = whole};
    if (count > 3) {
        if (!aur_array_reserve(&self->points, &self->point_capacity, count, sizeof *self->points))
            return false;
        for (size_t i = 0; i < count; ++i)
            memcpy(self->points[i], &data->points[3 * (size_t)corners[i]], sizeof self->points[i]);
        if (!aur_triangulate(&self->work, count, (const double(*)[3])self->points, &cut))
            return false;
    }
    aur_face_flaws_count(&data->flaws, cut.flaw, aur_mesh_line(data, face));
    for (size_t i = 0; i < cut.triangle_count; ++i)
        if (!put_triangle(self, face, corners, &cut.indices[3 * i]))
            return false;
    return true;
}

/* Triangulates all faces. If all are triangles, the corner list is used directly. */
static aur_result cut_faces(aur_mesh_reader *reader) {
    aur_mesh_data *const data = reader->data;
    if (reader->end_count == 0) {
        data->indices = reader->corners;
        data->triangle_count = data->flaws.face_count = data->face_count;
        reader->corners = NULL;
        return AUR_OK;
    }
    cutter self = {.reader = reader};
    bool good = true;
    for (size_t i = 0, first = 0; i < data->face_count && good; first = reader->ends[i++])
        good = cut_face(&self, i, first, reader->ends[i] - first);
    aur_triangulator_release(&self.work);
    free(self.points);
    if (good && data->triangle_count >= AUR_MESH_NO_INDEX - 1)
        return aur_mesh_reader_fail(reader, "more than 2^32 - 2 triangles");
    return good ? AUR_OK : aur_fail_memory(reader->error);
}

/* --- entry points */

aur_result aur_mesh_read(const aur_mesh_source *source, aur_mesh_data *data, aur_error *error) {
    *data = (aur_mesh_data){0};
    const aur_mesh_format detected = aur_mesh_format_of_bytes(source->size, source->data);
    const aur_mesh_format format = detected < AUR_MESH_FORMAT_COUNT ? detected : source->format;
    aur_mesh_reader reader = {.source = source,
                              .scanner = {source->data, source->data + source->size, 1},
                              .data = data,
                              .error = error};
    if (strncmp(source->data, "\xef\xbb\xbf", 3) == 0)
        reader.scanner.at += 3;
    aur_result result = readers[format](&reader);
    if (result == AUR_OK)
        result = cut_faces(&reader);
    free(reader.corners);
    free(reader.ends);
    if (result != AUR_OK)
        aur_mesh_data_release(data);
    return result;
}

static void release_names(aur_mesh_names *names) {
    for (size_t i = 0; i < names->count; ++i)
        free(names->items[i]);
    free(names->items);
}

void aur_mesh_data_release(aur_mesh_data *data) {
    free(data->points);
    free(data->normals);
    free(data->uvs);
    for (size_t i = 0; i < data->attribute_count; ++i)
        free(data->attributes[i].values);
    free(data->attributes);
    free(data->indices);
    free(data->faces);
    free(data->lines);
    free(data->spans);
    release_names(&data->groups);
    release_names(&data->materials);
    release_names(&data->libraries);
    *data = (aur_mesh_data){0};
}
