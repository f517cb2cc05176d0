/* Optimal weights of one rule for its own lobe, in the place of p/q (Marques 2018, section 5.2). */
#pragma once

#include "transport/gather/rule.h"

/* Replaces the weights of a rule whose directions are prepared by the optimal ones for its lobe, their sum
 * held. Rotating a pattern about its axis changes none. Errors: UNSUPPORTED for directions that are made at
 * the shading point. */
aur_result aur_gather_rule_optimise(aur_gather_rule *rule, double smoothness, double regularization,
                                    aur_error *error);
