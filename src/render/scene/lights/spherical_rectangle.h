/* Uniform points, by solid angle, of a rectangle seen from a point (Urena, Fajardo, King 2013: "An
 * Area-Preserving Parametrization for Spherical Rectangles"). */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/simd.h"
#include "render/scene/lanes.h"
#include "render/scene/patches.h"

typedef struct aur_rectangle {
    aur_vector corner, x, y; /* x and y: unit, along the edges, perpendicular */
    float width, height;     /* of the edges along x and y */
} aur_rectangle;

typedef struct aur_spherical_rectangle {
    float x0, x1, y0, y1, z0; /* relative to the point */
    float b0, b1, k;
    float solid_angle; /* steradians */
} aur_spherical_rectangle;

/* Rectangles seen under so many steradians or more, roughly, are drawn by solid angle; smaller ones by area,
 * which is faster and, weighed at the corners, as good. */
static const float AUR_LEAST_RECTANGLE = 0.15f;

/* False when the rectangle is seen under less. */
bool aur_spherical_rectangle_create(const aur_rectangle *rectangle, aur_vector reference,
                                    aur_spherical_rectangle *seen);

/* The point that u, v in [0,1) stand for, in parts of the rectangle's width and height. */
void aur_spherical_rectangle_sample(const aur_spherical_rectangle *seen, float u, float v, float *s,
                                    float *t);

/* Points of a rectangle as a reference draws them: by solid angle or by area, nearly in proportion to the
 * cosine at the reference. */
typedef struct aur_seen_rectangle {
    bool by_area;
    aur_spherical_rectangle sphere; /* else */
    aur_bilinear weights;
} aur_seen_rectangle;

aur_seen_rectangle aur_rectangle_see(const aur_rectangle *rectangle, const aur_light_reference *reference);
/* The point that uniform u, v stand for, in parts of width and height; returns its density, a steradian, or
 * where by_area over that of uniform points. */
float aur_seen_rectangle_draw(const aur_seen_rectangle *seen, float u, float v, float *s, float *t);
/* The density of a point. */
float aur_seen_rectangle_density(const aur_seen_rectangle *seen, float s, float t);

/* A light on a rectangle: what samples of it have in common. */
typedef struct aur_rectangle_light {
    aur_rectangle rectangle;
    aur_vector normal; /* of the side that shines */
    aur_vector radiance;
    float area, probability;
    float rounding; /* aur_triangle_rounding */
} aur_rectangle_light;

/* Samples of the light for sixteen points: by solid angle where the light is large enough, else by area. */
typedef void (*aur_rectangle_lanes_function)(const aur_rectangle_light *light,
                                             const aur_light_references *references, const float *u,
                                             const float *v, aur_light_lanes *drawn);

/* By this processor's instructions. */
typedef struct aur_rectangle_kernels {
    aur_rectangle_lanes_function lanes;
} aur_rectangle_kernels;

AUR_KERNELS(const aur_rectangle_kernels, aur_rectangle_kernels);
