#include "render/scene/importers/meshes/mesh_reader.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/random.h"
#include "points/base/text.h"

aur_result aur_mesh_reader_fail(const aur_mesh_reader *reader, const char *format, ...) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    const aur_location location = {reader->source->path, reader->scanner.line, 0};
    if (location.line > 0)
        return aur_fail_at(reader->error, location, AUR_ERROR_FORMAT, "%s", text);
    return aur_fail_at(reader->error, location, AUR_ERROR_FORMAT, "%s (at byte %zu)", text,
                       (size_t)(reader->scanner.at - reader->source->data));
}

/* --- reading faces */

aur_result aur_mesh_reader_add_vertex(aur_mesh_reader *reader, const double point[3]) {
    aur_mesh_data *const data = reader->data;
    for (size_t d = 0; d < 3; ++d)
        if (!aur_mesh_is_usable(point[d]))
            return aur_mesh_reader_fail(reader, "vertex %zu is not finite, or beyond 1e30",
                                        data->vertex_count);
    if (data->vertex_count >= AUR_MESH_NO_INDEX - 1)
        return aur_mesh_reader_fail(reader, "more than 2^32 - 2 vertices");
    if (!aur_array_reserve(&data->points, &data->vertex_capacity, data->vertex_count + 1,
                           3 * sizeof *data->points))
        return aur_fail_memory(reader->error);
    memcpy(&data->points[3 * data->vertex_count++], point, 3 * sizeof *point);
    return AUR_OK;
}

aur_result aur_mesh_reader_add_corners(aur_mesh_reader *reader, size_t count, const uint32_t *vertices) {
    if (reader->corner_count + count >= AUR_MESH_NO_INDEX)
        return aur_mesh_reader_fail(reader, "more than 2^32 - 2 corners");
    if (!aur_array_reserve(&reader->corners, &reader->corner_capacity, reader->corner_count + count,
                           sizeof *reader->corners))
        return aur_fail_memory(reader->error);
    for (size_t i = 0; i < count; ++i)
        reader->corners[reader->corner_count++] = vertices[i];
    return AUR_OK;
}

aur_result aur_mesh_reader_add_corner(aur_mesh_reader *reader, uint32_t vertex) {
    return aur_mesh_reader_add_corners(reader, 1, &vertex);
}

aur_result aur_mesh_reader_end_face(aur_mesh_reader *reader, size_t line) {
    aur_mesh_data *const data = reader->data;
    if (data->face_count >= AUR_MESH_NO_INDEX - 1)
        return aur_mesh_reader_fail(reader, "more than 2^32 - 2 faces");
    const bool triangles = reader->end_count == 0 && reader->corner_count == 3 * (data->face_count + 1);
    if ((!triangles && !aur_array_reserve(&reader->ends, &reader->end_capacity, data->face_count + 1,
                                          sizeof *reader->ends)) ||
        (line > 0 &&
         !aur_array_reserve(&data->lines, &reader->line_capacity, data->face_count + 1, sizeof *data->lines)))
        return aur_fail_memory(reader->error);
    if (line > 0)
        data->lines[data->face_count] = line < UINT32_MAX ? (uint32_t)line : UINT32_MAX;
    ++data->face_count;
    for (; !triangles && reader->end_count < data->face_count; ++reader->end_count)
        reader->ends[reader->end_count] =
            reader->end_count + 1 < data->face_count ? 3 * (reader->end_count + 1) : reader->corner_count;
    return AUR_OK;
}

/* --- merging duplicates */

static uint64_t hash_bytes(const unsigned char *bytes, size_t size) {
    uint64_t hash = size;
    for (size_t i = 0; i < size; i += 4) {
        uint32_t word;
        memcpy(&word, bytes + i, sizeof word);
        hash = aur_hash3(hash, word, i);
    }
    return hash;
}

aur_result aur_mesh_reader_merge(const aur_mesh_reader *reader, size_t count, size_t key_size,
                                 const void *keys, uint32_t **numbers, uint32_t **unique,
                                 size_t *unique_count) {
    const unsigned char *const bytes = keys;
    size_t slots = 16, found = 0;
    while (slots < 2 * count)
        slots *= 2;
    uint32_t *const table = malloc(slots * sizeof *table);
    *numbers = malloc((count + 1) * sizeof **numbers);
    *unique = malloc((count + 1) * sizeof **unique);
    if (table == NULL || *numbers == NULL || *unique == NULL) {
        free(table);
        return aur_fail_memory(reader->error);
    }
    memset(table, 0xff, slots * sizeof *table);
    for (size_t i = 0; i < count; ++i) {
        const unsigned char *const key = bytes + key_size * i;
        size_t slot = hash_bytes(key, key_size) & (slots - 1);
        while (table[slot] != AUR_MESH_NO_INDEX &&
               memcmp(bytes + key_size * (*unique)[table[slot]], key, key_size) != 0)
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == AUR_MESH_NO_INDEX) {
            table[slot] = (uint32_t)found;
            (*unique)[found++] = (uint32_t)i;
        }
        (*numbers)[i] = table[slot];
    }
    free(table);
    *unique_count = found;
    return AUR_OK;
}
