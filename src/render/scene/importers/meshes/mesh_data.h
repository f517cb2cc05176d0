/* Meshes in files: OBJ, PLY, STL and OFF, by readers that shapes, models, sensors and view factors share. */
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

/* Values of vertices or of faces, such as colours. */
typedef struct aur_mesh_attribute {
    char name[64]; /* with "vertex_" or "face_" before it, as the texture mesh_attribute has it */
    bool of_faces;
    size_t width;  /* 1 to 4 values each */
    float *values; /* width * vertex_count, or width * face_count */
} aur_mesh_attribute;

/* Names in the order in which they came. */
typedef struct aur_mesh_names {
    size_t count, capacity;
    char **items;
} aur_mesh_names;

/* From this face on faces are of this group and material, up to the next span. */
typedef struct aur_mesh_span {
    size_t first_face;
    uint32_t group;    /* of `groups` */
    uint32_t material; /* of `materials`, or AUR_MESH_NO_MATERIAL */
} aur_mesh_span;

#define AUR_MESH_NO_MATERIAL UINT32_MAX

/* What a file has. Faces are numbered in its order, those that are left out included. */
typedef struct aur_mesh_data {
    size_t vertex_count, vertex_capacity;
    double *points; /* 3 * vertex_count */
    float *normals; /* 3 * vertex_count as they are in the file, or NULL */
    float *uvs;     /* 2 * vertex_count, or NULL */
    size_t attribute_count;
    aur_mesh_attribute *attributes;
    size_t face_count;
    size_t triangle_count;
    uint32_t *indices; /* 3 * triangle_count vertices */
    uint32_t *faces;   /* of triangles; NULL: triangle i is face i */
    uint32_t *lines;   /* of faces; NULL: a binary file */
    /* OBJ only: groups by `g` and `o`, "default" where there are none; `usemtl`, and the files of `mtllib`.
     */
    size_t span_count, span_capacity;
    aur_mesh_span *spans; /* by first_face, the first of them 0 */
    aur_mesh_names groups, materials, libraries;
    aur_face_flaws flaws;
} aur_mesh_data;

/* A file in memory. */
typedef struct aur_mesh_source {
    const char *path;       /* for messages */
    aur_mesh_format format; /* that of its name, where its bytes do not tell */
    size_t size;
    const char *data;     /* a zero byte follows the last one */
    bool without_normals; /* normals of the file are not read */
} aur_mesh_source;

/* The format by the end of the name; COUNT for others. */
AUR_INTERNAL aur_mesh_format aur_mesh_format_of_name(const char *path);
/* The format by the first bytes; COUNT where they do not tell, as those of OBJ. */
aur_mesh_format aur_mesh_format_of_bytes(size_t size, const char *data);

/* Reads a file by the format that its bytes tell, or else by source->format. Faces are cut into triangles,
 * and those without area or with crossing outlines left out, as data->flaws says: the caller warns. Memory is
 * taken for what is there, not for what a header says. *data is empty after errors. Errors: FORMAT with the
 * line, or the byte of a binary file; MEMORY. */
AUR_INTERNAL aur_result aur_mesh_read(const aur_mesh_source *source, aur_mesh_data *data, aur_error *error);
AUR_INTERNAL void aur_mesh_data_release(aur_mesh_data *data);

/* The face of a triangle, and the line of a face, 0 for none. */
static inline size_t aur_mesh_face(const aur_mesh_data *data, size_t triangle) {
    return data->faces != NULL ? data->faces[triangle] : triangle;
}
static inline size_t aur_mesh_line(const aur_mesh_data *data, size_t face) {
    return data->lines != NULL ? data->lines[face] : 0;
}
