/* Lobes that dip below the surface: which part of them is above it, and the weights of samples mended so that
 * their sum is that part. */
#pragma once

#include "transport/gather/rule.h"

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
