/* Data that final gathering computes once per image and that is constant while the image is rendered:
 *
 *     rules.c                   directions and weights for each kind of lobe, from sampling/rule.c
 *     plan.c                    these rules, photon maps and the integrator's parameters
 *
 * Functions that process sixteen pixels at a time take the plan, the surface points that the pixels see
 * (points.h), the sums to add to and working memory (sums.h):
 *
 *     incident.c                radiance along gather rays
 *     aim.c                     turns a rule's directions into rays at the shading points, and traces them
 *     estimate_method.c         radiance of lobes by a method of the caller (gather.h)
 *     drawn_light.c             samples of lights and of bright texels
 *     shade.c                   calls the above for all lobes of the shading points
 *     strata.c, pooling.c       surfaces that a pixel's samples hit, edges, and irradiance pooled between
 *                               neighbouring pixels
 *     tile.c                    what the camera sees, also through mirrors and glass: sixteen groups of
 *                               sixteen pixels (render/trace/interleave.h) */
#pragma once

#include "render/gather/continuation.h"
#include "render/gather/rules.h"
#include "render/photons/bright_texels.h"

/* Light that gather rays collect: photon maps, and the number of light samples. */
typedef struct aur_gather_light {
    /* Owned by the cache. NULL when incident light is the emitters' alone. */
    const aur_irradiance_map *map;
    /* Light after specular bounces, which `map` then lacks; or NULL. Owned by the cache. */
    const aur_irradiance_map *caustics;
    uint32_t draws;                  /* light samples per sample of a pixel */
    uint32_t bright_draws;           /* samples of bright texels per sample of a pixel; 0: none */
    const aur_bright_texels *bright; /* of `map`, owned by the cache; NULL: not used */
} aur_gather_light;

typedef struct aur_gather_plan {
    const aur_scene *scene;
    aur_gather_settings policy; /* its strings are no longer valid */
    size_t samples_per_pattern; /* among which the directions of a pattern are shared out in as many parts */
    size_t part_stride; /* from the part of one sample to that of the next, modulo samples_per_pattern */
    bool renews;        /* later samples use new patterns; else the patterns repeat */
    uint64_t seed;      /* of the rules' rotations */
    aur_gather_rules rules;
    aur_gather_light light;
    aur_shape_class *classes; /* one per shape */
    /* Whether gather rays count emission in full. Under next-event estimation they weigh it by multiple
     * importance sampling. */
    bool counts_emitters;
    bool gathers;                  /* whether gather rays can carry any light */
    const uint16_t *emitter_edges; /* per pixel of the image: not 0 at the edge of a small emitter; or NULL */
    aur_continuation continuation; /* replaces the map where it is too coarse, or corrects it */
} aur_gather_plan;

/* `method` is the caller's gathering method, or NULL. Photon maps come from the context's cache, which
 * outlives the plan. Errors: MEMORY, those of aur_irradiance_map_create, and those of patterns and weights.
 */
aur_result aur_gather_plan_create(const aur_gather_settings *p, const aur_gather_method *method,
                                  const aur_integrator_context *context, aur_gather_plan **plan,
                                  aur_error *error);
void aur_gather_plan_destroy(aur_gather_plan *plan); /* NULL is allowed */

/* Adds the means of the tile's samples to its pixels. With a caller's method, an extra channel gets the
 * number of gathered directions. Fails with MEMORY only. */
aur_result aur_gather_tile(const aur_gather_plan *plan, aur_tile *tile);

/* Whether the light of a lobe comes by gather rays. */
static inline bool aur_gather_plan_gathers(const aur_gather_plan *plan, const aur_bsdf_lobe *lobe) {
    if (!plan->gathers || lobe->shape == AUR_LOBE_SHAPE_SPECULAR)
        return false;
    return plan->policy.component == AUR_COMPONENT_ALL ||
           lobe->diffuse == (plan->policy.component == AUR_COMPONENT_DIFFUSE);
}

/* The photon maps' radiance at a point of a plain triangle. */
typedef struct aur_photon_radiance {
    aur_vector radiance; /* by the first map */
    aur_vector caustics; /* by the second one */
    float area;          /* of the first one's texel */
} aur_photon_radiance;

/* `texel` belongs to the first map. */
static inline aur_photon_radiance aur_gather_plan_photons(const aur_gather_plan *plan, uint32_t shape,
                                                          uint32_t element, uint32_t texel, float u, float v,
                                                          bool behind) {
    const aur_gather_light *const light = &plan->light;
    const aur_vector albedo = plan->classes[shape].albedo_on_pi[behind];
    const aur_texel_light *const found = &light->map->lights[2 * (size_t)texel + (behind ? 1 : 0)];
    aur_photon_radiance map_light = {.radiance = aur_vector_multiply(albedo, found->irradiance),
                                     .area = found->area};
    if (light->caustics != NULL)
        map_light.caustics = aur_vector_multiply(
            albedo, aur_irradiance_on_triangle(light->caustics, element, u, v, behind)->irradiance);
    return map_light;
}
