/* Optimal weights of samples (Marques 2018): of one lobe, and of merged lobes. */
#pragma once

#include "settings.h"

#include <aureole/quadrature.h>

/* OSW: each lobe by itself. */
extern const aur_gather_method lab_gather_weighted;
/* OSWA, MIS and SOLVE: a diffuse and a glossy lobe together; single lobes as by OSW, or p/q for MIS. */
extern const aur_gather_method lab_gather_merged;

/* Copies the directions of a copy of the pattern from float to double and normalises them in double, as the
 * solver requires. */
void lab_widen(const aur_gather_directions *pattern, size_t copy, double *xyz);
/* Optimal weights for the lobe of a potential; their sum is its mass. */
aur_result lab_optimal_weights(size_t count, const double *xyz, const aur_potential *potential,
                               double regularization, double *weights, aur_error *error);
