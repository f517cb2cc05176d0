/* Closed solids of triangles, one after the other in a mesh of fixed capacity: boxes, turned profiles and
 * Newell's teapot. z is up. */
#pragma once

#include <stddef.h>

#include "vec.h"

enum { VERTEX_CAPACITY = 4096, TRIANGLE_CAPACITY = 4096, PROFILE_CAPACITY = 64 };

/* One material of a scene: a mesh file. */
typedef struct group {
    size_t vertex_count, triangle_count, first_vertex, first_triangle;
    vec vertices[VERTEX_CAPACITY];
    size_t triangles[TRIANGLE_CAPACITY][3];
} group;

typedef struct span {
    double low, high;
} span;

/* A point of a profile: radius and height. Profiles begin and end on the axis. */
typedef struct profile {
    size_t count;
    double radius[PROFILE_CAPACITY], height[PROFILE_CAPACITY];
} profile;

void add_quad(group *g, size_t a, size_t b, size_t c, size_t d);
/* Corner i has the high end of x where bit 0 of i is set, of y by bit 1, of z by bit 2. */
void add_box_corners(group *g, span x, span y, span z, size_t corner[8]);
void add_box(group *g, span x, span y, span z);
void add_to_profile(profile *p, double radius, double height);
/* The profile turned about the upright axis through `base`, by `sides` flat sides. */
void add_turned(group *g, const profile *p, size_t sides, vec base);
/* 1160 + 188 + 212 = 1560 triangles; handle and spout along x. */
void add_teapot(group *g, double scale, vec base);
