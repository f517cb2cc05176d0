/* Mesh files (OBJ, PLY, STL, OFF), read for shapes, models, sensors and view factors. */
#pragma once

#include "points/base/error.h"
#include "render/scene/importers/meshes/triangulate.h"

typedef enum aur_mesh_format {
    AUR_MESH_OBJ,
    AUR_MESH_PLY,
    AUR_MESH_STL,
    AUR_MESH_OFF,
    AUR_MESH_FORMAT_COUNT
} aur_mesh_format;

/* A per-vertex or per-face attribute, such as colours. */
typedef struct aur_mesh_attribute {
    char name[64]; /* without the prefix "vertex_" or "face_" that the texture mesh_attribute uses */
    bool of_faces;
    size_t width;  /* 1 to 4 values each */
    float *values; /* width * vertex_count, or width * face_count */
} aur_mesh_attribute;

/* Distinct names in order of first appearance. */
typedef struct aur_mesh_names {
    size_t count, capacity;
    char **items;
} aur_mesh_names;

/* Faces from this one up to the next span have this group and material. */
typedef struct aur_mesh_span {
    size_t first_face;
    uint32_t group;    /* index into `groups` */
    uint32_t material; /* index into `materials`, or AUR_MESH_NO_MATERIAL */
} aur_mesh_span;

#define AUR_MESH_NO_MATERIAL UINT32_MAX

/* Contents of a mesh file. Faces are numbered in file order, including skipped faces. */
typedef struct aur_mesh_data {
    size_t vertex_count, vertex_capacity;
    double *points; /* 3 * vertex_count */
    float *normals; /* 3 * vertex_count normals as stored in the file, or NULL */
    float *uvs;     /* 2 * vertex_count, or NULL */
    size_t attribute_count;
    aur_mesh_attribute *attributes;
    size_t face_count;
    size_t triangle_count;
    uint32_t *indices; /* 3 * triangle_count vertices */
    uint32_t *faces;   /* face of each triangle; NULL: triangle i is face i */
    uint32_t *lines;   /* line of each face; NULL: a binary file */
    /* OBJ only: groups from `g` and `o` ("default" if none); `usemtl` names; `mtllib` files. */
    size_t span_count, span_capacity;
    aur_mesh_span *spans; /* sorted by first_face, which is 0 for the first */
    aur_mesh_names groups, materials, libraries;
    aur_face_flaws flaws;
} aur_mesh_data;

/* A file in memory. */
typedef struct aur_mesh_source {
    const char *path;       /* for messages */
    aur_mesh_format format; /* format by file extension, used if the content does not identify one */
    size_t size;
    const char *data;     /* a zero byte follows the last one */
    bool without_normals; /* ignore normals in the file */
} aur_mesh_source;

/* The format by file extension; COUNT if unrecognised. */
AUR_INTERNAL aur_mesh_format aur_mesh_format_of_name(const char *path);
/* The format by the first bytes; COUNT if they identify none, as for OBJ. */
aur_mesh_format aur_mesh_format_of_bytes(size_t size, const char *data);

/* Reads a file in the format identified by its content, or else in source->format. Faces are triangulated;
 * degenerate and self-intersecting ones are skipped and counted in data->flaws for the caller to report.
 * Memory grows with the data read, not with counts in headers. *data is empty after errors. Errors: FORMAT
 * with the line, or the byte offset of a binary file; MEMORY. */
AUR_INTERNAL aur_result aur_mesh_read(const aur_mesh_source *source, aur_mesh_data *data, aur_error *error);
AUR_INTERNAL void aur_mesh_data_release(aur_mesh_data *data);

/* The face of a triangle, and the line of a face (0: none). */
static inline size_t aur_mesh_face(const aur_mesh_data *data, size_t triangle) {
    return data->faces != NULL ? data->faces[triangle] : triangle;
}
static inline size_t aur_mesh_line(const aur_mesh_data *data, size_t face) {
    return data->lines != NULL ? data->lines[face] : 0;
}
