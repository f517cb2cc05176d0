/* What stands in the header of a PLY file. */
#pragma once

#include "scene/shapes/mesh_file.h"

enum { AUR_PLY_MOST_ELEMENTS = 32, AUR_PLY_MOST_PROPERTIES = 64 };

typedef enum aur_ply_type {
    AUR_PLY_INT8,
    AUR_PLY_UINT8,
    AUR_PLY_INT16,
    AUR_PLY_UINT16,
    AUR_PLY_INT32,
    AUR_PLY_UINT32,
    AUR_PLY_FLOAT,
    AUR_PLY_DOUBLE,
    AUR_PLY_TYPE_COUNT
} aur_ply_type;

/* What a property is for: those of vertices come first, then those of faces. */
typedef enum aur_ply_role {
    AUR_PLY_X,
    AUR_PLY_Y,
    AUR_PLY_Z,
    AUR_PLY_NX,
    AUR_PLY_NY,
    AUR_PLY_NZ,
    AUR_PLY_U,
    AUR_PLY_V,
    AUR_PLY_RED,
    AUR_PLY_GREEN,
    AUR_PLY_BLUE,
    AUR_PLY_FACE_RED,
    AUR_PLY_FACE_GREEN,
    AUR_PLY_FACE_BLUE,
    AUR_PLY_INDICES,
    AUR_PLY_LEFT_OUT,
    AUR_PLY_ROLE_COUNT
} aur_ply_role;

typedef struct aur_ply_property {
    bool list;
    aur_ply_type count_type, type;
    aur_ply_role role;
    /* The value of vertex i goes to one of them, [stride * i]; both NULL: it is left out. */
    double *doubles;
    float *values;
    size_t stride;
} aur_ply_property;

typedef struct aur_ply_element {
    char name[32];
    size_t count, property_count;
    aur_ply_property properties[AUR_PLY_MOST_PROPERTIES];
} aur_ply_element;

typedef enum aur_ply_format { AUR_PLY_ASCII, AUR_PLY_LITTLE, AUR_PLY_BIG } aur_ply_format;

typedef struct aur_ply {
    aur_mesh_file *file; /* ascii: at the next value; binary: `at` is the next byte */
    aur_ply_format format;
    size_t element_count;
    aur_ply_element elements[AUR_PLY_MOST_ELEMENTS];
    const aur_ply_element *vertices; /* the first element of that name, or NULL */
    bool has[AUR_PLY_ROLE_COUNT];
    size_t index_count, index_capacity;
    uint32_t *indices;
    /* Where faces have colours: those, 3 a face, and the face of each triangle. */
    float *colors;
    size_t face_count, face_capacity;
    uint32_t *faces;
} aur_ply;

/* Reads the header of self->file, up to the first value. */
aur_result aur_ply_read_header(aur_ply *self);
