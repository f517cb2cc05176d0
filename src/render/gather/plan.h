/* What final gathering compiles once an image, and nothing changes while the image is rendered.
 *
 *     rules.c                   what gathers each kind of lobe, of rule.c and rule_*.c
 *     plan.c                    these rules, maps of photons, and what the keys ask for
 *
 * What happens at sixteen pixels at a time takes the plan, the surface points that the pixels see (points.h),
 * the sums to add to and working memory (sums.h):
 *
 *     incident.c                radiance along gather rays
 *     aim.c                     directions of a rule made into rays at the places, and traced
 *     estimate_*.c              the light of a lobe by such rays; no estimator calls another
 *     drawn_light.c             the light of points on lights and on bright texels
 *     shade.c                   all of these for all lobes of the places
 *     strata.c, pooling.c       what a pixel's samples have seen, where edges are, and irradiance that
 *                               neighbouring pixels have in common
 *     tile.c                    what the eye sees, also through mirrors and glass: sixteen groups of sixteen
 *                               pixels (render/trace/interleave.h)
 */
#pragma once

#include "render/gather/continuation.h"
#include "render/gather/rules.h"
#include "render/photons/bright_texels.h"

/* What gather rays find: light that photons brought to the surfaces, and how often it is drawn as lights are.
 */
typedef struct aur_gather_light {
    /* Owned by the cache. NULL when incident light is the emitters' alone. */
    const aur_irradiance_map *map;
    /* The light that specular bounces brought, which `map` then lacks; or NULL. Owned by the cache. */
    const aur_irradiance_map *caustics;
    uint32_t draws;                  /* points on lights that one sample draws */
    uint32_t bright_draws;           /* points on bright texels that one sample draws; 0: there are none */
    const aur_bright_texels *bright; /* of `map`, owned by the cache; NULL where nobody asks for them */
} aur_gather_light;

typedef struct aur_gather_plan {
    const aur_scene *scene;
    aur_gather_settings policy; /* whose texts are gone */
    size_t samples_per_pattern; /* among which the directions of a pattern are shared out in as many parts */
    size_t part_stride;         /* from the part of one sample to that of the next one, modulo that number */
    bool renews;                /* samples after those have other patterns, else the same again */
    uint64_t seed;              /* of the rules' rotations */
    aur_gather_rules rules;
    aur_gather_light light;
    aur_shape_class *classes; /* one a shape */
    /* Whether gather rays count the lights that they meet in full. Under next-event estimation they count
     * them by multiple importance sampling. */
    bool counts_emitters;
    bool gathers;               /* whether gather rays can bring any light */
    const uint16_t *lamp_edges; /* of the image's pixels: not 0 where the edge of a small lamp is; or NULL */
    aur_continuation continuation; /* in place of the map, where it is too coarse or is corrected */
} aur_gather_plan;

/* `method` is the caller's way to gather lobes, or NULL. The maps of photons come from the context's cache,
 * which outlives the plan. Errors: MEMORY, those of aur_irradiance_map_create, and what the patterns and
 * weights say. */
aur_result aur_gather_plan_create(const aur_gather_settings *p, const aur_gather_method *method,
                                  const aur_integrator_context *context, aur_gather_plan **plan,
                                  aur_error *error);
void aur_gather_plan_destroy(aur_gather_plan *plan); /* NULL is allowed */

/* Adds the means of the tile's samples to its pixels, and the directions that were gathered with to an extra
 * channel where the caller's method chose them. Fails with MEMORY only. */
aur_result aur_gather_tile(const aur_gather_plan *plan, aur_tile *tile);

/* Whether the light of a lobe comes by gather rays. */
static inline bool aur_gather_plan_gathers(const aur_gather_plan *plan, const aur_bsdf_lobe *lobe) {
    if (!plan->gathers || lobe->shape == AUR_LOBE_SHAPE_SPECULAR)
        return false;
    return plan->policy.component == AUR_COMPONENT_ALL ||
           lobe->diffuse == (plan->policy.component == AUR_COMPONENT_DIFFUSE);
}

/* What the photon maps know of a point of a plain triangle. */
typedef struct aur_photon_radiance {
    aur_vector radiance; /* by the first map */
    aur_vector caustics; /* by the second one */
    float area;          /* of the first one's texel */
} aur_photon_radiance;

static inline aur_photon_radiance aur_gather_plan_photons(const aur_gather_plan *plan, uint32_t shape,
                                                          uint32_t element, float u, float v, bool behind) {
    const aur_gather_light *const light = &plan->light;
    const aur_vector albedo = plan->classes[shape].albedo_on_pi[behind];
    const aur_texel_light *const texel = aur_irradiance_on_triangle(light->map, element, u, v, behind);
    aur_photon_radiance known = {.radiance = aur_vector_multiply(albedo, texel->irradiance),
                                 .area = texel->area};
    if (light->caustics != NULL)
        known.caustics = aur_vector_multiply(
            albedo, aur_irradiance_on_triangle(light->caustics, element, u, v, behind)->irradiance);
    return known;
}
