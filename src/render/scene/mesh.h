/* Triangle meshes as they are rendered: in world coordinates, counter-clockwise about the outside.
 * Coordinates are doubles until the scene's origin is known, and then floats that count from it. */
#pragma once

#include "points/base/error.h"
#include "points/base/vector.h"
#include "render/scene/transform.h"

#include <stdbool.h>

typedef struct aur_mesh {
    size_t vertex_count, triangle_count;
    double *points; /* 3 * vertex_count, world coordinates; after aur_mesh_recenter NULL in large ones, if not
                       kept */
    float *positions;  /* 3 * vertex_count from the origin, and 4 bytes that Embree may read; NULL before */
    float *normals;    /* 3 * vertex_count of unit length, or NULL: flat triangles */
    float *uvs;        /* 2 * vertex_count, or NULL */
    uint32_t *indices; /* 3 * triangle_count */
    uint32_t
        *sources; /* which triangle of the file each one is part of, in order; NULL: they are the file's */
    size_t source_count;  /* triangles of the file, where `sources` is given */
    float *vertex_colors; /* 3 * vertex_count, or NULL */
    float *face_colors;   /* 3 * triangle_count, or NULL */
} aur_mesh;

enum { AUR_MESH_POSITIONS_ONLY = 0, AUR_MESH_NORMALS = 1, AUR_MESH_UVS = 2, AUR_MESH_VERTEX_COLORS = 4 };

/* Allocates all but `positions`; all is zero. Refuses what 32 bits cannot index. */
aur_result aur_mesh_allocate(aur_mesh *mesh, size_t vertex_count, size_t triangle_count, unsigned parts,
                             aur_location location, aur_error *error);
void aur_mesh_release(aur_mesh *mesh);
/* Makes the `count` indices, of malloc, those of the mesh: *indices becomes NULL. */
void aur_mesh_take_indices(aur_mesh *mesh, size_t count, uint32_t **indices);

/* Moves points by the affine map and normals with them. A map that mirrors turns the winding, so that what
 * was outside stays outside. */
void aur_mesh_transform(aur_mesh *mesh, const aur_transform *to_world, const aur_transform *to_local);
/* Makes `positions` of `points`, as floats that count from `origin`. */
aur_result aur_mesh_recenter(aur_mesh *mesh, const double origin[3], bool keep_points, aur_location location,
                             aur_error *error);
/* Exchanges inside and outside. */
void aur_mesh_flip(aur_mesh *mesh);
/* Normals at vertices: those of the triangles around, by their angle there (Thuermer and Wuethrich 1998). */
AUR_INTERNAL aur_result aur_mesh_smooth(aur_mesh *mesh, aur_location location, aur_error *error);
/* Doubles vertices, before aur_mesh_recenter, where triangles that share a side meet at more than so many
 * degrees, so that aur_mesh_smooth leaves these sides sharp. */
aur_result aur_mesh_split_creases(aur_mesh *mesh, double degrees, aur_location location, aur_error *error);
/* Frees normals that are everywhere those of the triangles, but for rounding: what is flat has faster ways to
 * be rendered. */
void aur_mesh_drop_flat_normals(aur_mesh *mesh);

/* An error when an index is no vertex, a coordinate of `points` is no finite float, or triangles are more
 * than 32 bits count. */
aur_result aur_mesh_check(const aur_mesh *mesh, aur_location location, aur_error *error);

static inline aur_vector aur_mesh_position(const aur_mesh *mesh, uint32_t vertex) {
    const float *const p = &mesh->positions[3 * (size_t)vertex];
    return (aur_vector){p[0], p[1], p[2]};
}

/* The three corners of a triangle. */
static inline void aur_mesh_corners(const aur_mesh *mesh, size_t triangle, aur_vector corner[3]) {
    for (size_t i = 0; i < 3; ++i)
        corner[i] = aur_mesh_position(mesh, mesh->indices[3 * triangle + i]);
}

/* As aur_triangle_normal, by the sides from the first corner, for a triangle whose product of sides leaves
 * the range of floats: with sides longer than 1e9 or shorter than 1e-9. *doubled_area may be NULL. */
aur_vector aur_extreme_triangle_normal(aur_vector a, aur_vector b, double *doubled_area);

/* Whether the squared length of the product of two sides can be used as it is. */
static inline bool aur_is_usual_square(float squared) {
    return squared > 1e-37f && squared < 1e38f;
}

/* The unit normal of a triangle. Zero when it has no area. */
static inline aur_vector aur_triangle_normal(const aur_vector corner[3]) {
    const aur_vector a = aur_vector_subtract(corner[1], corner[0]);
    const aur_vector b = aur_vector_subtract(corner[2], corner[0]);
    const aur_vector cross = aur_vector_cross(a, b);
    const float squared = aur_vector_dot(cross, cross);
    if (aur_is_usual_square(squared))
        return aur_vector_scale(cross, 1.0f / sqrtf(squared));
    return aur_extreme_triangle_normal(a, b, NULL);
}

static inline double aur_triangle_area(const aur_vector corner[3]) {
    const aur_vector a = aur_vector_subtract(corner[1], corner[0]);
    const aur_vector b = aur_vector_subtract(corner[2], corner[0]);
    const aur_vector cross = aur_vector_cross(a, b);
    const float squared = aur_vector_dot(cross, cross);
    double doubled = (double)sqrtf(squared);
    if (!aur_is_usual_square(squared))
        aur_extreme_triangle_normal(a, b, &doubled);
    return 0.5 * doubled;
}
