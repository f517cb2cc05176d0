/* The header of a PLY file. */
#pragma once

#include "render/scene/importers/meshes/mesh_reader.h"

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

/* The use of a property; all but INDICES belong to vertices. */
typedef enum aur_ply_role {
    AUR_PLY_X,
    AUR_PLY_Y,
    AUR_PLY_Z,
    AUR_PLY_NX,
    AUR_PLY_NY,
    AUR_PLY_NZ,
    AUR_PLY_U,
    AUR_PLY_V,
    AUR_PLY_INDICES,
    AUR_PLY_OTHER, /* part of an attribute, or ignored */
    AUR_PLY_ROLE_COUNT
} aur_ply_role;

typedef struct aur_ply_property {
    char name[64];
    bool list;
    aur_ply_type count_type, type;
    aur_ply_role role;
    /* The value of row i is stored in one of these, at [stride * i]; both NULL: ignored. */
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
    aur_mesh_reader *reader; /* ascii: at the next value; binary: at the next byte */
    aur_ply_format format;
    size_t element_count;
    aur_ply_element elements[AUR_PLY_MOST_ELEMENTS];
    aur_ply_element *vertices, *faces; /* the first `vertex`, and the first `face` with the list; or NULL */
    bool has[AUR_PLY_ROLE_COUNT];
} aur_ply;

/* Reads the header, up to the first value. */
aur_result aur_ply_read_header(aur_ply *self);
/* Groups the remaining properties into attributes, as Mitsuba does: "r", "g" and "b" are the colour; names
 * that end in _0 _1 _2, _1 _2 _3, _x _y _z or _r _g _b form an attribute named by their prefix. Errors:
 * MEMORY. */
aur_result aur_ply_find_attributes(aur_ply *self);
