/* Triangle meshes for rendering: in world coordinates, counter-clockwise seen from outside. Coordinates are
 * doubles until the scene's origin is chosen, then floats relative to it. */
#pragma once

#include "points/base/error.h"
#include "points/base/vector.h"
#include "render/scene/transform.h"

#include <stdbool.h>

typedef struct aur_mesh {
    size_t vertex_count, triangle_count;
    double *points; /* 3 * vertex_count, world coordinates; freed for large meshes by aur_mesh_recenter unless
                       requested */
    float *positions;     /* 3 * vertex_count relative to the origin, with 4 bytes of padding for Embree; NULL
                             before */
    float *normals;       /* 3 * vertex_count unit vectors, or NULL: flat triangles */
    float *uvs;           /* 2 * vertex_count, or NULL */
    uint32_t *indices;    /* 3 * triangle_count */
    uint32_t *sources;    /* source triangle in the file of each triangle, ascending; NULL: the same */
    size_t source_count;  /* number of triangles in the file, if `sources` is given */
    float *vertex_colors; /* 3 * vertex_count, or NULL */
    float *face_colors;   /* 3 * triangle_count, or NULL */
} aur_mesh;

enum { AUR_MESH_POSITIONS_ONLY = 0, AUR_MESH_NORMALS = 1, AUR_MESH_UVS = 2, AUR_MESH_VERTEX_COLORS = 4 };

/* Allocates all arrays but `positions`, zeroed. Errors if 32 bits cannot index them. */
aur_result aur_mesh_allocate(aur_mesh *mesh, size_t vertex_count, size_t triangle_count, unsigned parts,
                             aur_location location, aur_error *error);
void aur_mesh_release(aur_mesh *mesh);
/* Transfers ownership of the `count` malloc'ed indices to the mesh: *indices becomes NULL. */
void aur_mesh_take_indices(aur_mesh *mesh, size_t count, uint32_t **indices);

/* Applies an affine map to points and normals. A mirroring map reverses the winding, so that outside stays
 * outside. */
void aur_mesh_transform(aur_mesh *mesh, const aur_transform *to_world, const aur_transform *to_local);
/* Computes `positions` from `points`, as floats relative to `origin`. */
aur_result aur_mesh_recenter(aur_mesh *mesh, const double origin[3], bool with_points, aur_location location,
                             aur_error *error);
/* Swaps inside and outside. */
void aur_mesh_flip(aur_mesh *mesh);
/* Vertex normals: triangle normals weighted by the angle at the vertex (Thuermer and Wuethrich 1998). */
AUR_INTERNAL aur_result aur_mesh_smooth(aur_mesh *mesh, aur_location location, aur_error *error);
/* Before aur_mesh_recenter, duplicates vertices at edges where triangles meet at more than this angle in
 * degrees, so that aur_mesh_smooth keeps these edges sharp. */
aur_result aur_mesh_split_creases(aur_mesh *mesh, double degrees, aur_location location, aur_error *error);
/* Removes vertex normals that equal the triangle normals up to rounding: flat meshes render faster. */
void aur_mesh_drop_flat_normals(aur_mesh *mesh);

/* Errors for an index out of range, a coordinate of `points` that is not a finite float, or more triangles
 * than 32 bits can count. */
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

/* As aur_triangle_normal, from the edges at the first corner, for triangles whose cross product overflows or
 * underflows floats: with edges above 1e9 or below 1e-9. *doubled_area may be NULL. */
aur_vector aur_extreme_triangle_normal(aur_vector a, aur_vector b, double *doubled_area);

/* Whether the squared length of a cross product of edges is in the safe range of floats. */
static inline bool aur_is_usual_square(float squared) {
    return squared > 1e-37f && squared < 1e38f;
}

/* The unit normal of a triangle; zero if its area is zero. */
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
