/* Weights of one pattern for its own lobe: optimal ones in the place of p/q, and the part of a lobe above the
 * horizon. */
#ifndef AUR_TRANSPORT_GATHER_RULE_WEIGHTS_H
#define AUR_TRANSPORT_GATHER_RULE_WEIGHTS_H

#include "transport/gather/rule.h"

/* Replaces the weights of a rule whose directions are prepared by the optimal ones for its lobe (Marques 2018
 * section 5.2), their sum held. Turning a pattern about its axis changes none. Errors: UNSUPPORTED for
 * directions that are made at the shading point. */
aur_result aur_gather_rule_optimise(aur_gather_rule *rule, double smoothness, double regularization,
                                    aur_error *error);

enum { AUR_HORIZON_STEPS = 256 };

/* The share of a lobe cos^exponent that is above the surface when its axis is tilted from the normal by i
 * steps of 90 degrees / AUR_HORIZON_STEPS. */
void aur_gather_horizon(double exponent, float visible[AUR_HORIZON_STEPS + 1]);

/* What the weights of the samples that are left above the surface are to be multiplied by, so that their sum
 * is the integral of the lobe's visible part (a ratio estimate: constants are exact). `normal` is the
 * surface's in the frame of the lobe. 1 where the whole lobe is visible, 0 where no sample is. */
float aur_gather_horizon_factor(const aur_gather_rule *rule, const float visible[AUR_HORIZON_STEPS + 1],
                                const aur_gather_turn *turn, aur_vector normal);

#endif
