/* Triangle meshes that grow, and the surfaces that bundled scenes are made of. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>

#include "vec.h"

typedef struct mesh {
    size_t vertex_count, vertex_capacity;
    vec *positions, *normals;
    size_t triangle_count, triangle_capacity;
    uint32_t (*triangles)[3];
    bool out_of_memory; /* remembered; mesh_write reports it */
} mesh;

void mesh_release(mesh *m);
uint32_t mesh_vertex(mesh *m, vec position, vec normal);
/* Counter-clockwise from outside; triangles with two equal corners are left out. */
void mesh_triangle(mesh *m, uint32_t a, uint32_t b, uint32_t c);
/* Sets the normals from `first` on to the mean of the triangles around them, from `first_triangle` on. */
void mesh_smooth(mesh *m, size_t first, size_t first_triangle);

/* A surface over the unit square; its outside is du x dv. */
typedef vec (*surface_function)(const void *context, double u, double v);

typedef struct grid {
    size_t rows, columns; /* quads along u and v */
    bool wraps_u, wraps_v;
} grid;

/* Quads split in two, with smooth normals. A row or column that is one point becomes one vertex. */
void mesh_grid(mesh *m, const grid *size, surface_function function, const void *context);

/* A surface of revolution about y: a uniform cubic B-spline of (radius, height), from the bottom upwards on
 * the outside. Its ends are reached; a control point that is there three times is a crease. */
typedef struct profile {
    size_t count;
    const double (*points)[2];
} profile;

enum { PROFILE_CAPACITY = 64 };

void mesh_revolve(mesh *m, const profile *shape, size_t rows, size_t columns);
/* Radius and height at u in [0,1]. */
void profile_at(const profile *shape, double u, double point[2]);

/* A tube of varying radius about a curve, with a frame that turns as little as it can. */
typedef struct tube {
    vec (*curve)(const void *context, double u);
    double (*radius)(const void *context, double u);
    const void *context;
    bool closed; /* else its ends are round */
    size_t rows, columns;
} tube;

void mesh_tube(mesh *m, const tube *shape);

/* Everything from vertex `first` on, scaled, turned about y and moved. */
void mesh_place(mesh *m, size_t first, double size, double angle, vec move);

/* Binary PLY with normals; the file is replaced whole or not at all. */
aur_result mesh_write(const mesh *m, const char *path, aur_error *error);
