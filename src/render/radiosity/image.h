/* Images of a radiosity solution (Keller 1994, section 4): hit points that the camera sees, each with direct
 * light from triangles by solid angle (eq. 6; Arvo 1995), and with indirect light by a hemisphere of gather
 * rays (eq. 9). */
#pragma once

#include <aureole/quadrature.h>

#include "render/film/integrator.h"
#include "render/radiosity/solution.h"

typedef enum aur_radiosity_oversampling {
    AUR_RADIOSITY_HALTON,   /* Halton points, any number */
    AUR_RADIOSITY_ADAPTIVE, /* the same in rounds, until the mean no longer changes */
    AUR_RADIOSITY_SAMPLER   /* the scene's sampler */
} aur_radiosity_oversampling;

typedef enum aur_radiosity_component {
    AUR_RADIOSITY_ALL,
    AUR_RADIOSITY_EMISSION, /* directly visible L0 */
    AUR_RADIOSITY_DIRECT,   /* T L0 */
    AUR_RADIOSITY_INDIRECT  /* T T L */
} aur_radiosity_component;

typedef struct aur_radiosity_image {
    const aur_radiosity *solution; /* owned by the renderer's cache */
    /* patch -> power received / (pi area): times the albedo it is the reflected radiance */
    aur_vector *exitance;
    /* The pattern of gather rays about +z, turned at random at every point; the weights are for cos / pi. */
    size_t direction_count;
    float *x, *y, *z, *weights;
    bool permuted; /* each light at one of four hit points; else all lights at each */
    bool share_neighbours;
    aur_radiosity_oversampling oversampling;
    float threshold; /* of adaptive oversampling */
    aur_radiosity_component component;
    size_t samples_per_pixel;
    uint64_t seed;
} aur_radiosity_image;

/* Fills exitance and pattern; `rule` supplies set, points and weights. The image must be released in every
 * case. */
aur_result aur_radiosity_image_prepare(const aur_rule_options *rule, aur_radiosity_image *image,
                                       aur_error *error);
void aur_radiosity_image_release(aur_radiosity_image *image);

/* A point that light is reflected from. */
typedef struct aur_radiosity_surface_point {
    aur_vector position, normal; /* normal: on the side that is seen */
    uint32_t triangle, patch;    /* patch: of that side, or AUR_NO_PATCH */
    bool mirrored;               /* it is seen through mirrors */
    aur_vector albedo, emission;
} aur_radiosity_surface_point;

/* Finds the shading point of a ray from its first hit, following mirrors, and their throughput. False if the
 * ray leaves the scene or ends between mirrors. `hash` seeds the choices at mirrors. */
bool aur_radiosity_see(const aur_radiosity_scene *scene, uint64_t hash, aur_ray ray, aur_hit hit,
                       aur_radiosity_surface_point *surface_point, aur_vector *throughput);

/* The solid angle of a triangle, three corners of three coordinates, as seen unoccluded from a point, and a
 * direction in it drawn uniformly by u, v in [0,1). 0 if it is seen edge on. */
double aur_spherical_triangle(const double corner[9], const double from[3], double u, double v,
                              double direction[3]);

/* One sample of the reflected radiance due to the light `triangle` at the shading point; 0 if it is occluded.
 */
aur_vector aur_radiosity_direct(const aur_radiosity_scene *scene,
                                const aur_radiosity_surface_point *surface_point, uint32_t triangle, float u,
                                float v);

/* The indirect irradiance over pi at a shading point; `hash` selects the pattern's rotation. */
aur_vector aur_radiosity_gather(const aur_radiosity_image *image,
                                const aur_radiosity_surface_point *surface_point, uint64_t hash);

/* The `tile` of the integrator. */
aur_result aur_radiosity_tile(const aur_integrator *integrator, aur_tile *tile);
