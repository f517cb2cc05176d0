/* Weights of one rule in the place of p/q: optimal ones for its own lobe (Marques 2018, section 5.2), and
 * weights mended where a lobe dips below the surface. */
#pragma once

#include "render/gather/settings.h"
#include "render/sampling/rule.h"

/* Replaces the weights of a rule whose directions are prepared by the optimal ones for its lobe, their sum
 * held. Rotating a pattern about its axis changes none. Errors: UNSUPPORTED for directions that are made at
 * the shading point. */
aur_result aur_gather_rule_optimise(aur_gather_rule *rule, double smoothness, double regularization,
                                    aur_error *error);

/* --- lobes that dip below the surface */

enum { AUR_HORIZON_STEPS = 256 };

/* For one exponent: the part of a lobe cos^exponent that is above the surface when its axis is tilted from
 * the normal by i steps of 90 degrees / AUR_HORIZON_STEPS. */
typedef struct aur_gather_horizon {
    float visible[AUR_HORIZON_STEPS + 1];
} aur_gather_horizon;

void aur_gather_horizon_fill(double exponent, aur_gather_horizon *horizon);

/* What the weights of the samples that are left above the surface are to be multiplied by, so that their sum
 * is the integral of the lobe's visible part (a ratio estimate: constants are exact). `normal` is the
 * surface's in the frame of the lobe. 1 where the whole lobe is visible, 0 where no sample is. */
float aur_gather_horizon_factor(const aur_gather_rule *rule, const aur_gather_horizon *horizon,
                                const aur_gather_rotation *rotation, aur_vector normal);
