/* Uniform sampling, by solid angle, of a rectangle seen from a point (Urena, Fajardo, King 2013: "An
 * Area-Preserving Parametrization for Spherical Rectangles"). */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/simd.h"
#include "render/scene/lanes.h"
#include "render/scene/patches.h"

typedef struct aur_rectangle {
    aur_vector corner, x, y; /* x and y: unit, along the edges, perpendicular */
    float width, height;     /* lengths of the edges along x and y */
} aur_rectangle;

typedef struct aur_spherical_rectangle {
    float x0, x1, y0, y1, z0; /* relative to the point */
    float b0, b1, k;
    float solid_angle; /* steradians */
} aur_spherical_rectangle;

/* Rectangles of about this solid angle (steradians) or more are sampled by solid angle. Smaller ones are
 * sampled by area, which is faster and, with weights at the corners, as good. */
static const float AUR_LEAST_RECTANGLE = 0.15f;

/* False if the rectangle's solid angle is smaller. */
bool aur_spherical_rectangle_create(const aur_rectangle *rectangle, aur_vector reference,
                                    aur_spherical_rectangle *seen);

/* The point for u, v in [0,1), as fractions of the rectangle's width and height. */
void aur_spherical_rectangle_sample(const aur_spherical_rectangle *seen, float u, float v, float *s,
                                    float *t);

/* Sampling of a rectangle from a reference point: by solid angle or by area, nearly in proportion to the
 * cosine at the reference. */
typedef struct aur_seen_rectangle {
    bool by_area;
    aur_spherical_rectangle sphere; /* if not by solid angle */
    aur_bilinear weights;
} aur_seen_rectangle;

aur_seen_rectangle aur_rectangle_see(const aur_rectangle *rectangle, const aur_light_reference *reference);
/* The point for uniform u, v, as fractions of width and height. Returns the pdf by solid angle, or, if
 * by_area, relative to uniform area sampling. */
float aur_seen_rectangle_draw(const aur_seen_rectangle *seen, float u, float v, float *s, float *t);
/* The pdf of a point. */
float aur_seen_rectangle_density(const aur_seen_rectangle *seen, float s, float t);

/* A rectangular light: data shared by its samples. */
typedef struct aur_rectangle_light {
    aur_rectangle rectangle;
    aur_vector normal; /* normal of the emitting side */
    aur_vector radiance;
    float area;
    float rounding; /* aur_triangle_rounding */
} aur_rectangle_light;

/* Samples of the light for 16 reference points: by solid angle for large lights, else by area. */
typedef void (*aur_rectangle_lanes_function)(const aur_rectangle_light *light,
                                             const aur_light_references *references, const float *u,
                                             const float *v, aur_light_lanes *drawn);

/* Sixteen such lights. */
typedef struct aur_rectangle_lanes {
    aur_lane_vectors corner, x, y, normal, radiance;
    aur_lane_numbers width, height, area, rounding;
} aur_rectangle_lanes;

static inline void aur_rectangle_lane_set(aur_rectangle_lanes *lanes, size_t lane,
                                          const aur_rectangle_light *light) {
    aur_lane_set(&lanes->corner, lane, light->rectangle.corner);
    aur_lane_set(&lanes->x, lane, light->rectangle.x);
    aur_lane_set(&lanes->y, lane, light->rectangle.y);
    aur_lane_set(&lanes->normal, lane, light->normal);
    aur_lane_set(&lanes->radiance, lane, light->radiance);
    lanes->width[lane] = light->rectangle.width;
    lanes->height[lane] = light->rectangle.height;
    lanes->area[lane] = light->area;
    lanes->rounding[lane] = light->rounding;
}

/* The kernels for this processor. */
typedef struct aur_rectangle_kernels {
    aur_rectangle_lanes_function lanes;
    /* A sample of another light for each reference point, with its direction: bit-identical to single
     * samples of the lights. */
    void (*each)(const aur_rectangle_lanes *lights, const aur_light_references *references, const float *u,
                 const float *v, aur_light_lanes *drawn);
} aur_rectangle_kernels;

AUR_KERNELS(const aur_rectangle_kernels, aur_rectangle_kernels);
