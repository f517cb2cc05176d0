/* What gather rays find: light that photons brought to the surfaces, and how often it is drawn as lights are.
 */
#pragma once

#include "transport/gather/parameters.h"
#include "transport/integrator.h"
#include "transport/photons/bright_texels.h"
#include "transport/photons/irradiance.h"

typedef struct aur_gather_light {
    /* Owned by the cache. NULL when incident light is the emitters' alone. */
    const aur_irradiance_map *map;
    /* The light that specular bounces brought, which `map` then lacks; or NULL. Owned by the cache. */
    const aur_irradiance_map *caustics;
    uint32_t draws;        /* points on lights that one sample draws */
    uint32_t bright_draws; /* points on bright texels that one sample draws; 0: there are none */
    aur_bright_texels bright;
} aur_gather_light;

/* Errors: MEMORY, and those of aur_irradiance_map_create. The light is to be released in every case. */
aur_result aur_gather_light_create(const aur_gather_parameters *p, const aur_integrator_context *context,
                                   const aur_shape_class *classes, bool wants_photons,
                                   aur_gather_light *light, aur_error *error);
void aur_gather_light_release(aur_gather_light *light);
