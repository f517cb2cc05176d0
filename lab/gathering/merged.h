/* Shading points with a diffuse and one glossy lobe: the rays of both patterns count for both lobes. These
 * are functions of the method. */
#pragma once

#include "settings.h"

aur_result lab_merged_prepare(const lab_gather_settings *o, const aur_gather_common *common,
                              const aur_gather_directions *pattern, void *diffuse, void **state,
                              aur_error *error);
void lab_merged_release(void *state);
uint32_t lab_merged_gather(const void *diffuse, uint32_t lanes, aur_gather_sweep *sweep, float *memory);
float lab_merged_density(const void *glossy, const float cosines[2]);
