/* Uniform points, by solid angle, of a rectangle seen from a point (Urena, Fajardo, King 2013: "An
 * Area-Preserving Parametrization for Spherical Rectangles"). */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "scene/packet.h"

typedef struct aur_rectangle {
    aur_vector corner, x, y; /* x and y: unit, along the edges, perpendicular */
    float width, height;     /* of the edges along x and y */
} aur_rectangle;

typedef struct aur_spherical_rectangle {
    float x0, x1, y0, y1, z0; /* relative to the point */
    float b0, b1, k;
    float solid_angle; /* steradians */
} aur_spherical_rectangle;

/* False when the rectangle is seen under less than `least` steradians, roughly. */
bool aur_spherical_rectangle_create(const aur_rectangle *rectangle, aur_vector reference, float least,
                                    aur_spherical_rectangle *seen);

/* The point that u, v in [0,1) stand for, in parts of the rectangle's width and height. */
void aur_spherical_rectangle_sample(const aur_spherical_rectangle *seen, float u, float v, float *s,
                                    float *t);

/* A light on a rectangle: what samples of it have in common. */
typedef struct aur_rectangle_light {
    aur_rectangle rectangle;
    aur_vector normal; /* of the side that shines */
    aur_vector radiance;
    float area, probability;
} aur_rectangle_light;

/* Samples of the light for sixteen points: by solid angle where the light is seen under `least` or more, else
 * by area. */
typedef void (*aur_rectangle_lanes_function)(const aur_rectangle_light *light, float least,
                                             const aur_lane_vectors *reference, const float *u,
                                             const float *v, aur_light_lanes *drawn);

/* By this processor's instructions. */
typedef struct aur_rectangle_kernels {
    aur_rectangle_lanes_function lanes;
} aur_rectangle_kernels;

const aur_rectangle_kernels *aur_rectangle_kernels_here(void);
