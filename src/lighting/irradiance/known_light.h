/* What is known beforehand of the light that surfaces reflect: a photon map, or a radiosity solution. Where a
 * path meets such a surface for the first time it takes what is known, and goes on now and then to take away
 * what that is wrong by, as render/gather/onward.h has it for pictures. So the mean is that of paths,
 * whatever is known. */
#pragma once

#include <aureole-lighting/irradiance.h>

#include "render/path/path_group.h"
#include "render/photons/irradiance.h"
#include "render/radiosity/solution.h"

typedef struct aur_known_light {
    aur_irradiance_map *map; /* or NULL */
    aur_radiosity *solution; /* or NULL */
    aur_vector *exitances;   /* of its patches: times the albedo they are radiances */
} aur_known_light;

/* Finds what `options` (complete) ask for; nothing for paths. Errors: UNSUPPORTED for scenes that photons or
 * radiosity cannot do, CANCELLED, MEMORY. */
aur_result aur_known_light_create(const aur_scene *scene, const aur_irradiance_options *options,
                                  aur_known_light *known, aur_error *error);
void aur_known_light_release(aur_known_light *known);

/* At the surfaces that the group has met at `depth`, before it scatters there: the lanes of *pending, which
 * have not been here, add what is known; most of these end. */
void aur_known_light_add(const aur_known_light *known, aur_path_group *group, uint32_t depth,
                         uint32_t *pending);
