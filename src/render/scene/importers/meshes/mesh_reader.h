/* Helpers shared by the readers of mesh files. */
#pragma once

#include "render/scene/importers/meshes/mesh_data.h"
#include "render/scene/importers/meshes/text_scanner.h"

#define AUR_MESH_NO_INDEX UINT32_MAX

typedef struct aur_mesh_reader {
    const aur_mesh_source *source;
    aur_scanner scanner; /* at the file's first byte; `line` is for errors, 0 in binary files */
    aur_mesh_data *data;
    aur_error *error;
    /* Faces being read: concatenated corners, and the end offset of each face. */
    size_t corner_count, corner_capacity;
    uint32_t *corners;
    size_t end_count, end_capacity, line_capacity;
    size_t *ends; /* none as long as all faces are triangles */
} aur_mesh_reader;

aur_result aur_obj_read(aur_mesh_reader *reader);
aur_result aur_ply_read(aur_mesh_reader *reader);
aur_result aur_stl_read(aur_mesh_reader *reader);
aur_result aur_off_read(aur_mesh_reader *reader);

/* Binary STL: 80 bytes of header, the facet count, then the facets. */
enum { AUR_STL_HEAD = 84, AUR_STL_FACET = 50 };
static inline uint32_t aur_stl_count(const char *data) {
    const unsigned char *const n = (const unsigned char *)data + 80;
    return n[0] | (uint32_t)n[1] << 8 | (uint32_t)n[2] << 16 | (uint32_t)n[3] << 24;
}

/* A FORMAT error at the line, or at the byte offset. */
aur_result aur_mesh_reader_fail(const aur_mesh_reader *reader, const char *format, ...) AUR_PRINTF(2, 3);

aur_result aur_mesh_reader_add_vertex(aur_mesh_reader *reader, const double point[3]);
/* Appends corners to the current face, then ends it. `line` is 0 in binary files. */
aur_result aur_mesh_reader_add_corners(aur_mesh_reader *reader, size_t count, const uint32_t *vertices);
aur_result aur_mesh_reader_add_corner(aur_mesh_reader *reader, uint32_t vertex);
aur_result aur_mesh_reader_end_face(aur_mesh_reader *reader, size_t line);

/* The end offset of each face in the corner list. */
static inline size_t aur_mesh_reader_end(const aur_mesh_reader *reader, size_t face) {
    return reader->end_count > 0 ? reader->ends[face] : 3 * (face + 1);
}

/* Gives equal vertices the same number. The key of item i is key[i * width ...]. *unique (malloc'ed) gets the
 * first item of each number, and *numbers the number of each item. */
aur_result aur_mesh_reader_merge(const aur_mesh_reader *reader, size_t count, size_t key_size,
                                 const void *keys, uint32_t **numbers, uint32_t **unique,
                                 size_t *unique_count);

/* Whether a coordinate is valid: finite, and at most 1e30 in magnitude. */
static inline bool aur_mesh_is_usable(double value) {
    return value >= -1e30 && value <= 1e30;
}
