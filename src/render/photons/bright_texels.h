/* Texels that reflect far more light than most, sampled like light sources. Where a small part of the
 * surfaces has much of the indirect light (a window's reveal, a lit page), directions about the normal rarely
 * hit it. Gather rays that hit such texels are combined with these samples by multiple importance sampling
 * (Veach 1997), so nothing is counted twice. */
#pragma once

#include "render/photons/irradiance.h"
#include "render/scene/patches.h"
#include "render/trace/packet_rays.h"

/* A texel's part of one triangle, on one side. */
typedef struct aur_bright_patch {
    uint32_t element;
    uint32_t shape;
    uint32_t primitive;
    uint16_t row, column; /* of the triangle's texels */
    bool upper, behind;
} aur_bright_patch;

typedef struct aur_bright_texels {
    aur_distribution distribution; /* of patches; its total is 0 where no texel is bright */
    aur_bright_patch *patches;
    float threshold; /* texels below this radiance are not bright */
    float scale;     /* density = scale * (radiance - threshold), per square unit */
} aur_bright_texels;

/* A point on a bright texel. */
typedef struct aur_bright_point {
    uint32_t element, shape, primitive;
    float u, v; /* barycentric */
    bool behind;
    aur_vector position;
    aur_vector normal; /* of the side that shines */
    float rounding;    /* aur_triangle_rounding */
} aur_bright_point;

/* Only texels of plain shapes are used. Errors: MEMORY. */
aur_result aur_bright_texels_create(const aur_scene *scene, const aur_irradiance_map *map,
                                    const aur_shape_class *classes, aur_bright_texels *bright,
                                    aur_error *error);
void aur_bright_texels_release(aur_bright_texels *bright);

/* Numbers in [0,1). The distribution's total must not be 0. */
aur_bright_point aur_bright_texels_sample(const aur_bright_texels *bright, const aur_scene *scene,
                                          const aur_irradiance_map *map, double choice,
                                          const float position[2]);

/* The density per square unit of the samples on a texel that reflects `radiance` by the map's irradiance. */
static inline float aur_bright_texels_density(const aur_bright_texels *bright, aur_vector radiance) {
    const float excess = aur_vector_max(radiance) - bright->threshold;
    return excess > 0.0f ? bright->scale * excess : 0.0f;
}
